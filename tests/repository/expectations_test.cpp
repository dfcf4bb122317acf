// SPDX-License-Identifier: MIT
// A test whose every expectation stands in a loop over a result passes where that is empty.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include "repository/declarations.hpp"
#include "repository/source_tree.hpp"

namespace lacuna::repository {
namespace {

/// A piece of a text, [begin, end).
struct Piece {
  std::size_t begin = 0, end = 0;
};

/// The end of the statement that begins at `at`.
std::size_t end_of_statement(const std::string& code, std::size_t at) {
  static const std::regex headed(R"(^\s*(for|if|while)\b\s*(constexpr\s*)?\()");
  std::smatch head;
  const std::string rest = code.substr(at, 400);
  if (std::regex_search(rest, head, headed))
    return end_of_statement(code, closing(code, at + head.length() - 1) + 1);
  for (std::size_t i = at; i < code.size(); ++i) {
    if (code[i] == ';') return i + 1;
    if (std::string("([{").find(code[i]) == std::string::npos) continue;
    const bool is_block =
        code[i] == '{' && std::all_of(code.begin() + long(at), code.begin() + long(i),
                                      [](char c) { return c == ' ' || c == '\n'; });
    i = closing(code, i);
    if (is_block) return i + 1;
  }
  return code.size();
}

/// The range of a loop over a range; nothing for other loops.
std::string range_in(const std::string& head) {
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (std::string("([{").find(head[i]) != std::string::npos) i = closing(head, i);
    if (head[i] == ':' && head[i + 1] == ':')
      ++i;
    else if (head[i] == ':')
      return head.substr(std::min(head.find_first_not_of(" \n", i + 1), head.size()));
  }
  return "";
}

/// Whether the head of a loop goes over what has no end that is written there: a result.
/// @param code of the whole source, where a name may be given its list.
bool is_over_a_result(const std::string& head, const std::string& code) {
  static const std::regex counted(R"((size|rows|cols|count|samples)\(\))");
  static const std::regex listed(R"(^(\{|(std::)?(array|vector|set|initializer_list)[^(]*\{))");
  static const std::regex name(R"(^\w+\s*$)");
  const std::string range = range_in(head);
  if (range.empty()) return std::regex_search(head, counted);
  if (std::regex_search(range, listed)) return false;
  if (!std::regex_search(range, name)) return true;
  const std::string word = range.substr(0, range.find_first_of(" \n"));
  return !std::regex_search(code, std::regex("\\b" + word + R"((\[\w*\])?\s*(=\s*)?\{[^}])")) &&
         !std::regex_search(code, std::regex(R"(\barray<[^;]*>\s+)" + word + "\\b"));
}

std::vector<std::size_t> places_of(const std::string& text, const std::regex& what) {
  std::vector<std::size_t> places;
  for (std::sregex_iterator it(text.begin(), text.end(), what), end; it != end; ++it)
    places.push_back(static_cast<std::size_t>(it->position()));
  return places;
}

/// Whether all expectations of a test stand in loops over results.
bool may_expect_nothing(const std::string& body, const std::string& code) {
  static const std::regex loop(R"(\bfor\s*\()");
  static const std::regex expectation(
      R"(\b(EXPECT_|ASSERT_|FAIL\(|ADD_FAILURE\(|expect_\w+\())");
  std::vector<Piece> loops;
  for (const std::size_t place : places_of(body, loop)) {
    const std::size_t open = body.find('(', place), close = closing(body, open);
    if (is_over_a_result(body.substr(open + 1, close - open - 1), code))
      loops.push_back({place, end_of_statement(body, close + 1)});
  }
  const auto expectations = places_of(body, expectation);
  return !expectations.empty() &&
         std::all_of(expectations.begin(), expectations.end(), [&](std::size_t at) {
           return std::any_of(loops.begin(), loops.end(), [&](const Piece& each) {
             return each.begin <= at && at < each.end;
           });
         });
}

/// Names of the tests of a source that may expect nothing. With one of its parameters a
/// parametrised test may have nothing to expect.
std::vector<std::string> vacuous_tests(const std::vector<std::string>& lines) {
  static const std::regex test(R"(\bTEST(_F)?\()");
  const std::string code = code_of(lines);
  std::vector<std::string> names;
  for (const std::size_t place : places_of(code, test)) {
    const std::size_t open = code.find('(', place), close = closing(code, open);
    const std::size_t begin = code.find('{', close);
    const std::string body = code.substr(begin, closing(code, begin) + 1 - begin);
    if (may_expect_nothing(body, code))
      names.push_back(code.substr(open + 1, close - open - 1));
  }
  return names;
}

TEST(Expectations, StandOutsideOfLoopsOverResultsOrTheseAreNotEmpty) {
  const auto files = sources_below("tests");
  ASSERT_FALSE(files.empty());
  for (const SourceFile& file : files)
    for (const std::string& name : vacuous_tests(file.lines))
      ADD_FAILURE() << file.path << ": " << name
                    << " expects nothing where what it goes through "
                    << "is empty; begin with ASSERT_FALSE(....empty())";
}

TEST(Expectations, TheirReaderTellsResultsFromLists) {
  const auto vacuous = [](const std::string& body) {
    return !vacuous_tests({"constexpr int kAll[] = {1, 2};", "TEST(A, B) {", body, "}"})
                .empty();
  };
  EXPECT_TRUE(vacuous("for (int x : found()) EXPECT_EQ(x, 1);"));
  EXPECT_TRUE(vacuous("for (int x : found()) { y = x;\n EXPECT_EQ(x, 1); }"));
  EXPECT_TRUE(vacuous("for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i], 1);"));
  EXPECT_TRUE(
      vacuous("for (int x : {1, 2})\n for (int y : f(x)) if (y > 0) { EXPECT_EQ(y, 1); }"));
  EXPECT_FALSE(vacuous("for (int x : found()) EXPECT_EQ(x, 1);\nEXPECT_TRUE(done);"));
  EXPECT_FALSE(vacuous("ASSERT_FALSE(a.empty());\nfor (int x : a) EXPECT_EQ(x, 1);"));
  EXPECT_FALSE(vacuous("for (int x : {1, 2}) EXPECT_EQ(x, 1);"));
  EXPECT_FALSE(vacuous("for (int x : kAll) EXPECT_EQ(x, 1);"));
  EXPECT_FALSE(vacuous("for (int i = 0; i < 5; ++i) EXPECT_EQ(i, 1);"));
  EXPECT_FALSE(vacuous("run();"));
}

}  // namespace
}  // namespace lacuna::repository
