// SPDX-License-Identifier: MIT
// The field's words: what words.txt lists is used nowhere but where words_exceptions.txt says
// why.
#include <gtest/gtest.h>

#include <set>

#include "repository/pages.hpp"
#include "repository/word_rules.hpp"

namespace lacuna::repository {
namespace {

const std::vector<std::string> kReadPlaces = {"docs",  "src",  "include",  "effects", "solvers",
                                              "bases", "apps", "examples", "python"};

std::vector<std::string> lines_beside_this(const std::string& name) {
  return read_lines(std::filesystem::path(LACUNA_SOURCE_DIR) / "tests/repository" / name);
}

std::vector<SourceFile> read_files() {
  std::vector<SourceFile> files = sources_below(kReadPlaces);
  for (const std::string& place : kReadPlaces)
    for (SourceFile& page : pages_below(place)) files.push_back(std::move(page));
  return files;
}

/// Whether an exception excuses a line; notes which.
bool is_meant(const SourceFile& file, const std::string& line,
              const std::vector<WordException>& exceptions, std::set<std::size_t>& used) {
  for (std::size_t e = 0; e < exceptions.size(); ++e)
    if (file.path.generic_string().rfind(exceptions[e].path, 0) == 0 &&
        line.find(exceptions[e].text) != std::string::npos) {
      used.insert(e);
      return true;
    }
  return false;
}

TEST(Words, AreThoseOfTheField) {
  const auto rules = word_rules(lines_beside_this("words.txt"));
  const auto exceptions = word_exceptions(lines_beside_this("words_exceptions.txt"));
  const auto files = read_files();
  ASSERT_FALSE(rules.empty());
  ASSERT_FALSE(files.empty());
  std::set<std::size_t> used;
  for (const SourceFile& file : files) {
    const std::vector<Word> words = words_of(readable_lines(file));
    for (std::size_t at = 0; at < words.size(); ++at)
      for (const WordRule& rule : rules) {
        if (!matches(rule, words, at)) continue;
        const std::string& line = file.lines[words[at].line];
        EXPECT_TRUE(is_meant(file, line, exceptions, used))
            << file.path << ":" << words[at].line + 1 << ": " << line << "\n  " << rule.text;
      }
  }
  for (std::size_t e = 0; e < exceptions.size(); ++e) {
    EXPECT_TRUE(used.count(e)) << "excuses nothing: " << exceptions[e].text;
    EXPECT_GE(exceptions[e].reason.size(), 10u) << "no reason: " << exceptions[e].text;
  }
}

bool is_found(const std::string& rule, const std::vector<std::string>& lines) {
  const auto words = words_of(lines);
  for (std::size_t at = 0; at < words.size(); ++at)
    if (matches(word_rules({rule}).front(), words, at)) return true;
  return false;
}

TEST(Words, PhrasesGoOnInTheNextLineAndEndAtSigns) {
  const std::string rule = "what is|was left -> residual";
  EXPECT_TRUE(is_found(rule, {"/// What was", "/// left of it"}));
  EXPECT_TRUE(is_found(rule, {R"("what is ")", R"("left")"}));
  EXPECT_FALSE(is_found(rule, {"what is, left"}));
  EXPECT_FALSE(is_found(rule, {"what is right"}));
}

}  // namespace
}  // namespace lacuna::repository
