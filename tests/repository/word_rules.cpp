// SPDX-License-Identifier: MIT
#include "repository/word_rules.hpp"

#include <cctype>
#include <regex>
#include <sstream>

#include "repository/pages.hpp"

namespace lacuna::repository {
namespace {

bool is_in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }

/// The parts of a name: "kMostNumbers_" has k, most, numbers; "RMSError" rms, error.
std::vector<std::string> parts_of_name(const std::string& name) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool begins =
        i > 0 && is_upper(name[i]) &&
        (!is_upper(name[i - 1]) || (i + 1 < name.size() && is_lower(name[i + 1])));
    if ((begins || name[i] == '_') && !parts.back().empty()) parts.emplace_back();
    if (name[i] != '_')
      parts.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  if (parts.back().empty()) parts.pop_back();
  return parts;
}

std::vector<std::string> split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(by, begin)) != std::string::npos;
       begin = end + by.size())
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

bool is_none(const std::string& line) { return line.empty() || line.front() == '#'; }

}  // namespace

std::vector<Word> words_of(const std::vector<std::string>& lines) {
  std::vector<Word> words;
  for (std::size_t n = 0; n < lines.size(); ++n)
    for (std::size_t i = 0; i < lines[n].size(); ++i) {
      const char c = lines[n][i];
      if (!is_in_name(c)) {
        if (std::string(" \t\r/\"").find(c) == std::string::npos)
          words.push_back({std::string(1, c), n, false});
        continue;
      }
      std::size_t end = i;
      while (end < lines[n].size() && is_in_name(lines[n][end])) ++end;
      const auto parts = parts_of_name(lines[n].substr(i, end - i));
      for (const std::string& part : parts) words.push_back({part, n, parts.size() > 1});
      i = end - 1;
    }
  return words;
}

std::vector<WordRule> word_rules(const std::vector<std::string>& lines) {
  static const std::string in_names = "name: ";
  std::vector<WordRule> rules;
  for (const std::string& line : lines) {
    if (is_none(line)) continue;
    WordRule rule;
    rule.text = line;
    rule.only_in_names = line.rfind(in_names, 0) == 0;
    const std::string phrase = split(line, " -> ").front();
    std::istringstream places(rule.only_in_names ? phrase.substr(in_names.size()) : phrase);
    for (std::string place; places >> place;) rule.phrase.push_back(split(place, "|"));
    rules.push_back(rule);
  }
  return rules;
}

bool matches(const WordRule& rule, const std::vector<Word>& words, std::size_t at) {
  if (at + rule.phrase.size() > words.size()) return false;
  for (std::size_t k = 0; k < rule.phrase.size(); ++k) {
    const Word& word = words[at + k];
    const auto& allowed = rule.phrase[k];
    if (rule.only_in_names && !word.is_of_name) return false;
    if (std::find(allowed.begin(), allowed.end(), word.text) == allowed.end()) return false;
  }
  return true;
}

std::vector<WordException> word_exceptions(const std::vector<std::string>& lines) {
  std::vector<WordException> exceptions;
  for (const std::string& line : lines) {
    if (is_none(line)) continue;
    std::vector<std::string> parts = split(line, " | ");
    parts.resize(3);
    exceptions.push_back({parts[0], parts[1], parts[2]});
  }
  return exceptions;
}

std::vector<std::string> readable_lines(const SourceFile& file) {
  if (file.path.extension() != ".md") return file.lines;
  static const std::regex code("`[^`]*`");
  std::vector<std::string> lines = prose_of(file.lines);
  for (std::string& line : lines) line = std::regex_replace(line, code, " # ");
  return lines;
}

}  // namespace lacuna::repository
