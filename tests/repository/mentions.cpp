// SPDX-License-Identifier: MIT
#include "repository/mentions.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>

#include "repository/source_tree.hpp"

namespace lacuna::repository {
namespace {

namespace fs = std::filesystem;

/// Whether sources of a kind are read: all that is code, no pages and no tables.
bool is_code_file(const fs::path& path) {
  static const std::set<std::string> kKinds = {".hpp", ".cpp", ".py",   ".cmake", ".txt",
                                               ".sh",  ".js",  ".json", ".inc",   ".toml",
                                               ".in",  ".ode", ".yml",  ""};
  const std::string text = path.string();
  const bool is_of_rules = text.rfind("tests/repository/mentions", 0) == 0 ||
                           text.rfind("tests/repository/words", 0) == 0;
  return kKinds.contains(path.extension().string()) && !is_of_rules;
}

/// Whether a folder or file of the root is made by builds and tools, not kept.
bool is_made(const std::string& name) {
  return name.rfind("build", 0) == 0 || name == "__pycache__" ||
         (name.rfind(".", 0) == 0 && name != ".ci");
}

void add_words(const std::string& line, std::set<std::string>& words) {
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  for (auto at = line.begin(); at != line.end();) {
    const auto begin = std::find_if(at, line.end(), is_part);
    at = std::find_if_not(begin, line.end(), is_part);
    if (begin != at) words.emplace(begin, at);
  }
}

void add_file(const fs::path& file, const fs::path& path, NamesOfTree& tree) {
  tree.files.insert(path.filename().string());
  tree.words.insert(path.stem().string());
  tree.paths.insert(path.string());
  tree.paths.insert((path.parent_path() / path.stem()).string());
  if (!is_code_file(path)) return;
  const bool is_cpp = path.extension() == ".cpp" || path.extension() == ".hpp";
  for (const std::string& line : read_lines(file)) {
    tree.lines.push_back(without_comment(line, is_cpp ? "//" : "#"));
    add_words(tree.lines.back(), tree.words);
  }
}

/// Where pages begin paths: the root, and the folders in which sources, headers and tests lie.
const std::vector<std::string> kPlaces = {
    "",           "src",    "include",       "include/lacuna", "tests",
    "tests/unit", "python", "python/lacuna", "benchmarks"};

bool is_path(const NamesOfTree& tree, std::string name, const std::string& folder) {
  if (name.back() == '/') name.pop_back();
  std::vector<std::string> places = kPlaces;
  places.push_back(folder);
  const bool has_star = name.find('*') != std::string::npos;
  return std::any_of(places.begin(), places.end(), [&](const std::string& place) {
    const std::string path = (fs::path(place) / name).lexically_normal().string();
    if (!has_star) return tree.paths.contains(path);
    const std::regex pattern(std::regex_replace(path, std::regex("\\*"), "[^/]*"));
    return std::any_of(tree.paths.begin(), tree.paths.end(), [&](const std::string& known) {
      return std::regex_match(known, pattern);
    });
  });
}

/// Whether a line of code has a text that does not go on behind it as a name does.
bool is_in_a_line(const NamesOfTree& tree, const std::string& text) {
  return std::any_of(tree.lines.begin(), tree.lines.end(), [&](const std::string& line) {
    for (auto at = line.find(text); at != std::string::npos; at = line.find(text, at + 1)) {
      const char next = at + text.size() < line.size() ? line[at + text.size()] : ' ';
      if (!std::isalnum(static_cast<unsigned char>(next)) && next != '-' && next != '_')
        return true;
    }
    return false;
  });
}

bool has_source_extension(const std::string& name) {
  static const std::regex kSource(R"(.*\.(hpp|cpp|md|py|sh|txt|cmake|js))");
  return std::regex_match(name, kSource);
}

}  // namespace

std::string without_comment(const std::string& line, const std::string& mark) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != '\0' && line[i] == '\\')
      ++i;
    else if (quote != '\0')
      quote = line[i] == quote ? '\0' : quote;
    else if (line[i] == '"')
      quote = line[i];
    else if (line.compare(i, mark.size(), mark) == 0 && (i == 0 || line[i - 1] == ' '))
      return line.substr(0, i);
  }
  return line;
}

NamesOfTree names_of_tree() {
  NamesOfTree tree;
  const fs::path root = LACUNA_SOURCE_DIR;
  for (auto it = fs::recursive_directory_iterator(root);
       it != fs::recursive_directory_iterator(); ++it) {
    if (is_made(it->path().filename().string())) {
      it.disable_recursion_pending();
      continue;
    }
    const fs::path path = it->path().lexically_relative(root);
    if (it->is_directory()) tree.paths.insert(path.string());
    if (it->is_regular_file()) add_file(it->path(), path, tree);
  }
  return tree;
}

std::vector<std::string> names_in(const std::string& span) {
  static const std::regex kPath(R"([\w.*-]+(/[\w.*-]+)+/?)");
  static const std::regex kFile(R"([\w-]+\.(hpp|cpp|md|txt|sh|py|js|cmake|csv|ode|yml|toml))");
  static const std::regex kWords(R"([A-Za-z_]\w*((::|\.)\w+)*(\(\))?)");
  // kNumber, CamelCase, snake_case: these stand for themselves in any code.
  static const std::regex kIdentifier(R"((k[A-Z]\w+|[A-Z][a-z0-9]+[A-Z]\w*|[A-Za-z]\w*_\w+))");
  static const std::regex kSetting("-D(?=[A-Z])");  // of CMake
  static const std::regex kOption("(?:^|[^-])(--[a-z][a-z-]*[a-z])");
  static const std::regex kAny(R"([A-Za-z_]\w*)");
  if (std::regex_match(span, kPath) || std::regex_match(span, kFile)) return {span};
  const bool is_name = std::regex_match(span, kWords);
  const std::string text = std::regex_replace(span, kSetting, " ");
  std::vector<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), kOption), end; it != end; ++it)
    names.push_back((*it)[1]);
  for (std::sregex_iterator it(text.begin(), text.end(), kAny), end; it != end; ++it)
    if (is_name || std::regex_match(it->str(), kIdentifier)) names.push_back(it->str());
  return names;
}

bool is_known(const NamesOfTree& tree, const std::string& name, const std::string& folder) {
  if (name.rfind("--", 0) == 0) return is_in_a_line(tree, name);
  if (name.find('/') != std::string::npos)
    return is_path(tree, name, folder) ||
           (!has_source_extension(name) && is_in_a_line(tree, name));
  return name.find('.') == std::string::npos ? tree.words.contains(name)
                                             : tree.files.contains(name);
}

}  // namespace lacuna::repository
