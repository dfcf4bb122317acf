// SPDX-License-Identifier: MIT
// Writes a call of every public function that takes arrays, or sizes, numbers or positions of
// what is in them, as it finds them in the headers: generate INCLUDE LEFT_OUT OUT...
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "repository/declarations.hpp"

namespace lacuna::repository {
namespace {

namespace fs = std::filesystem;

/// A public header: its path in the include folder, its lines and what it declares.
struct Header {
  std::string path;
  std::vector<std::string> lines;
  Declarations found;
};

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream stream(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<Header> headers_below(const fs::path& root) {
  std::vector<Header> headers;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    // Suites for parts of others are no functions.
    if (entry.path().extension() != ".hpp" || entry.path().filename() == "testing.hpp")
      continue;
    std::vector<std::string> lines = lines_of(entry.path());
    Declarations found = read_declarations(lines);
    headers.push_back({fs::relative(entry.path(), root), std::move(lines), std::move(found)});
  }
  std::sort(headers.begin(), headers.end(),
            [](const Header& a, const Header& b) { return a.path < b.path; });
  return headers;
}

bool has_word(const std::string& text, const std::string& word) {
  return std::regex_search(text, std::regex("\\b" + word + "\\b"));
}

/// Functions, classes and parts of their types that are not called, each with its reason.
class LeftOut {
 public:
  explicit LeftOut(const fs::path& path) {
    for (const std::string& line : lines_of(path)) {
      const std::size_t colon = line.find(": ");
      if (line.empty() || line.front() == '#') continue;
      if (colon == std::string::npos) throw std::runtime_error(line + ": no reason is given");
      unused_.insert(line.substr(0, colon));
    }
    words_ = {unused_.begin(), unused_.end()};
  }

  bool contains(const FunctionText& function) {
    const std::string name =
        function.owner.empty() ? function.name : function.owner + "::" + function.name;
    bool is_left_out = false;
    for (const std::string& word : words_) {
      const bool holds =
          name == word || function.owner == word ||
          std::any_of(function.types.begin(), function.types.end(),
                      [&](const std::string& type) { return has_word(type, word); });
      if (holds) unused_.erase(word);
      is_left_out = is_left_out || holds;
    }
    return is_left_out;
  }

  const std::set<std::string>& unused() const { return unused_; }

 private:
  std::vector<std::string> words_;
  std::set<std::string> unused_;
};

/// Whether a type holds many numbers, or counts or numbers them.
bool is_array_or_size(const std::string& type) {
  static const std::regex pattern(
      R"(\b(span|vector|Vector|Matrix|TermSet|Dataset|Trajectory|Table|CoefficientPlaces|)"
      R"(RateForm|Equation|RecordStream|Index|int|size_t|uint64_t)\b)");
  return std::regex_search(type, pattern);
}

bool is_called(const FunctionText& function) {
  if (!function.is_public || function.is_template || function.is_deleted) return false;
  if (function.name.starts_with("operator") && function.name != "operator()") return false;
  return std::any_of(function.types.begin(), function.types.end(), is_array_or_size);
}

/// Whether words near a line, in front of it or behind, speak of numbers that are not finite.
bool speaks_of_infinity(const std::vector<std::string>& lines, std::size_t line) {
  static const std::regex comment(R"(^\s*///)");
  static const std::regex words(R"(///.*(\bNaN\b|\b[Ii]nfinit|finite))");
  std::size_t first = line - 1, last = line;
  while (first > 0 && std::regex_search(lines[first - 1], comment)) --first;
  while (last < lines.size() && std::regex_search(lines[last], comment)) ++last;
  for (std::size_t i = first; i < last; ++i)
    if (std::regex_search(lines[i], words)) return true;
  return false;
}

/// Whether a header says in its first lines what it makes of numbers that are not finite.
bool passes_on(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    if (!line.starts_with("//")) return false;
    if (line.find("not finite") != std::string::npos) return true;
  }
  return false;
}

/// A type as it is named outside of its class.
std::string qualified(std::string type, const std::string& owner,
                      const std::set<std::string>& nested) {
  for (std::string scope = owner; !scope.empty();) {
    for (const std::string& name : nested)
      if (name.starts_with(scope + "::")) {
        const std::string last = name.substr(scope.size() + 2);
        type = std::regex_replace(type, std::regex("(^|[^:\\w])" + last + "\\b"), "$1" + name);
      }
    const std::size_t colon = scope.rfind("::");
    scope = colon == std::string::npos ? "" : scope.substr(0, colon);
  }
  return type;
}

std::string taken(const std::vector<std::string>& types) {
  std::string text;
  for (std::size_t i = 0; i < types.size(); ++i)
    text += (i == 0 ? "" : ", ") +
            ("hand.template take<" + types[i] + ">(" + std::to_string(i) + ")");
  return text;
}

std::string joined(const std::vector<std::string>& types) {
  std::string text;
  for (const std::string& type : types) text += (text.empty() ? "" : ", ") + type;
  return text;
}

/// One entry of the list of calls.
std::string call_of(const Header& header, const FunctionText& function,
                    const std::set<std::string>& nested) {
  std::vector<std::string> types;
  for (const std::string& type : function.types)
    types.push_back(qualified(type, function.owner, nested));
  const std::size_t colon = function.owner.rfind("::");
  const std::string short_owner =
      colon == std::string::npos ? function.owner : function.owner.substr(colon + 2);
  const bool is_constructor = !function.owner.empty() && function.name == short_owner;
  const bool needs_object = !function.owner.empty() && !is_constructor && !function.is_static;
  std::string callee = function.name;
  if (is_constructor) callee = function.owner;
  if (function.is_static) callee = function.owner + "::" + function.name;
  std::vector<std::string> all = types;
  if (needs_object) {
    all.push_back(function.owner + "&");
    callee = "hand.template take<" + all.back() + ">(" + std::to_string(types.size()) + ")." +
             callee;
  }
  const std::string name =
      function.owner.empty() || is_constructor ? callee : function.owner + "::" + function.name;
  return "    call<" + joined(all) + ">(\n        \"" + header.path + "\", \"" + name + "(" +
         joined(types) + ")\", " +
         (speaks_of_infinity(header.lines, function.first) ? "true, " : "false, ") +
         (passes_on(header.lines) ? "true" : "false") +
         ",\n        [](auto& hand) -> decltype(auto) { return " + callee + "(" + taken(types) +
         "); }),\n";
}

/// What tells `finite()` of the members of a struct.
std::string fields_of(const Header& header, const ClassText& type) {
  std::string text;
  for (const MemberText& member : type.members)
    if (!speaks_of_infinity(header.lines, member.line))
      text += (text.empty() ? "" : " && ") + ("f(v." + member.name + ")");
  if (text.empty()) return "";
  return "template <>\nstruct Fields<" + type.name + "> {\n  template <class F>\n" +
         "  static bool all(const " + type.name + "& v, F f) {\n    return " + text +
         ";\n  }\n};\n";
}

std::string begin_of(const std::vector<Header>& headers) {
  std::string text = "#include \"arguments/calls.hpp\"\n#include \"arguments/values.hpp\"\n";
  for (const Header& header : headers) text += "#include \"lacuna/" + header.path + "\"\n";
  text += "namespace lacuna::arguments {\n";
  for (const Header& header : headers)
    for (const ClassText& type : header.found.classes)
      if (type.is_public && !type.is_template) text += fields_of(header, type);
  return text;
}

/// The function that puts the lists of all parts together.
std::string all_of(std::size_t parts) {
  std::string declared, text = "std::vector<Call> all_calls() {\n  std::vector<Call> all;\n";
  for (std::size_t part = 0; part < parts; ++part) {
    const std::string name = "calls_" + std::to_string(part) + "()";
    declared += "std::vector<Call> " + name + ";\n";
    text += "  for (Call& call : " + name + ") all.push_back(std::move(call));\n";
  }
  return declared + text + "  return all;\n}\n";
}

int run(const fs::path& include, const fs::path& left_out, const std::vector<fs::path>& outs) {
  const std::vector<Header> headers = headers_below(include);
  std::set<std::string> nested;
  for (const Header& header : headers)
    for (const ClassText& type : header.found.classes)
      if (type.name.find("::") != std::string::npos) nested.insert(type.name);
  LeftOut without(left_out);
  std::vector<std::string> calls;
  for (const Header& header : headers)
    for (const FunctionText& function : header.found.functions)
      if (is_called(function) && !without.contains(function))
        calls.push_back(call_of(header, function, nested));
  for (const std::string& word : without.unused())
    throw std::runtime_error(word + " is left out and is not there");
  for (std::size_t part = 0; part < outs.size(); ++part) {
    std::ofstream out(outs[part]);
    out << begin_of(headers) << "std::vector<Call> calls_" << part << "() {\n  return {\n";
    for (std::size_t i = part; i < calls.size(); i += outs.size()) out << calls[i];
    out << "  };\n}\n" << (part == 0 ? all_of(outs.size()) : "") << "}  // namespace\n";
  }
  std::cout << calls.size() << " functions\n";
  return 0;
}

}  // namespace
}  // namespace lacuna::repository

int main(int count, char** words) {
  try {
    if (count < 4) throw std::runtime_error("generate INCLUDE LEFT_OUT OUT...");
    return lacuna::repository::run(words[1], words[2], {words + 3, words + count});
  } catch (const std::exception& error) {
    std::cerr << "generate: " << error.what() << "\n";
    return 1;
  }
}
