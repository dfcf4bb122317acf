// SPDX-License-Identifier: MIT
// What is public is described: every function has a docstring, and where arrays go in or come
// out it says their shapes.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "repository/declarations.hpp"
#include "repository/source_tree.hpp"

namespace lacuna::repository {
namespace {

using Lines = std::vector<std::string>;

/// A line without the blanks in front of it; empty where there is no such line (from 1).
std::string line_at(const Lines& lines, std::size_t number) {
  if (number < 1 || number > lines.size()) return "";
  const std::string& line = lines[number - 1];
  const std::size_t first = line.find_first_not_of(' ');
  return first == std::string::npos ? "" : line.substr(first);
}

bool starts_with(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

/// The lines from `template` to the "{" or ";" of a declaration.
std::string head_of(const Lines& lines, const FunctionText& function) {
  std::string head;
  for (std::size_t line = function.first; line <= function.last; ++line) {
    const std::string text = lines[line - 1];
    head += text.substr(0, text.find("//")) + " ";
    if (text.find_first_of("{;") != std::string::npos) break;
  }
  return head;
}

/// The docstring behind a declaration, on its lines.
std::string docstring_behind(const Lines& lines, const FunctionText& function) {
  std::string text;
  for (const std::size_t line : std::set<std::size_t>{function.first, function.last})
    if (const std::size_t at = lines[line - 1].find("///<"); at != std::string::npos)
      text += lines[line - 1].substr(at);
  for (std::size_t line = function.last + 1; starts_with(line_at(lines, line), "///<"); ++line)
    text += line_at(lines, line);
  return text;
}

/// Whether two are overloads, or operators of one class.
bool are_alike(const FunctionText& a, const FunctionText& b) {
  const bool operators = starts_with(a.name, "operator") && starts_with(b.name, "operator");
  return a.owner == b.owner && (a.name == b.name || operators);
}

/// The docstring in front of a declaration and behind it; of overloads that stand right below
/// one another the first one's is that of all.
std::string docstring_of(const Lines& lines, const std::vector<FunctionText>& all,
                         std::size_t place) {
  const FunctionText& function = all[place];
  std::size_t line = function.first - 1;
  while (starts_with(line_at(lines, line), "template")) --line;
  const std::size_t above = line;
  std::string text;
  for (; starts_with(line_at(lines, line), "///") && !starts_with(line_at(lines, line), "///<");
       --line)
    text = line_at(lines, line) + " " + text;
  if (text.empty() && place > 0 && all[place - 1].last == above &&
      are_alike(all[place - 1], function))
    text = docstring_of(lines, all, place - 1);
  return text + docstring_behind(lines, function);
}

/// Whether a contract elsewhere says what it does: a hook of an interface, the list of options
/// (OptionVisitor), what every value has.
bool is_described_elsewhere(const Lines& lines, const FunctionText& function) {
  const std::string head = head_of(lines, function);
  const std::size_t colon = function.owner.rfind(':');
  const std::string type =
      colon == std::string::npos ? function.owner : function.owner.substr(colon + 1);
  const bool copies = function.name == type && function.types.size() == 1 &&
                      function.types[0].find(type + "&") != std::string::npos;
  const bool is_macro = std::none_of(function.name.begin(), function.name.end(), [](char c) {
    return std::islower(static_cast<unsigned char>(c)) != 0;
  });  // of GoogleTest, in the suites that are installed
  return copies || is_macro || function.name[0] == '~' || function.name == "operator=" ||
         function.name == "operator==" || function.name == "describe" ||
         head.find(" override") != std::string::npos ||
         head.find(" final") != std::string::npos;
}

bool has_arrays(const std::string& head) {
  static const std::regex arrays(
      R"(\b(Vector|Matrix|TermSet|span)\b|)"
      R"(vector<(const )?(double|int|Index|bool|Vector|Matrix|std::size_t)>)");
  return std::regex_search(head, arrays);
}

/// Whether words say how many numbers there are: n x m, one per state, m entries.
bool says_shape(const std::string& docstring) {
  static const std::regex shapes(
      R"(\w+ x \w+|\b(one|two) (entry|value|number|column|row|for each|per|sample)|)"
      R"(\bentr(y|ies)\b|\brows?\b|\bcolumns?\b|\b[nmpkLPKNsh]\b|)"
      R"(\bper (state|record|sample|target|term)|for each|\beach\b|\bdiagonal\b)");
  return std::regex_search(docstring, shapes);
}

struct Described {
  FunctionText function;
  std::string docstring, head;
  bool elsewhere = false;
};

std::vector<Described> described(const Lines& lines) {
  std::vector<Described> all;
  const std::vector<FunctionText> functions = read_declarations(lines).functions;
  for (std::size_t i = 0; i < functions.size(); ++i)
    if (functions[i].is_public && !functions[i].is_deleted)
      all.push_back({functions[i], docstring_of(lines, functions, i),
                     head_of(lines, functions[i]),
                     is_described_elsewhere(lines, functions[i])});
  return all;
}

TEST(Docstrings, AreFoundInFrontAndBehind) {
  const auto found =
      described({"/// Counts: n x m.", "template <class T>", "Matrix f(T a);", "", "struct A {",
                 "  int g() const;  ///< m", "  int h();", "};", "", "/// Both.",
                 "int k(int a,", "      int b);", "int k(int a);", "int l();"});
  ASSERT_EQ(found.size(), 6u);
  EXPECT_EQ(found[0].docstring, "/// Counts: n x m. ");
  EXPECT_TRUE(has_arrays(found[0].head));
  EXPECT_TRUE(says_shape(found[0].docstring));
  EXPECT_EQ(found[1].docstring, "///< m");
  EXPECT_EQ(found[2].docstring, "");
  EXPECT_EQ(found[3].docstring, "/// Both. ");
  EXPECT_EQ(found[4].docstring, "/// Both. ");
  EXPECT_EQ(found[5].docstring, "");
  EXPECT_FALSE(says_shape("/// The numbers."));
}

TEST(Docstrings, EveryPublicFunctionHasOne) {
  std::size_t functions = 0;
  for (const SourceFile& file : sources_below("include"))
    for (const Described& found : described(file.lines)) {
      if (found.elsewhere) continue;
      ++functions;
      EXPECT_NE(found.docstring, "")
          << file.path << ":" << found.function.first << ": " << found.function.name;
    }
  EXPECT_GT(functions, 400u);
}

TEST(Docstrings, SayTheShapesOfArrays) {
  double with_arrays = 0.0, with_shapes = 0.0;
  std::string without;
  for (const SourceFile& file : sources_below("include"))
    for (const Described& found : described(file.lines)) {
      if (found.elsewhere || !has_arrays(found.head)) continue;
      ++with_arrays;
      if (says_shape(found.docstring))
        ++with_shapes;
      else
        without += file.path.string() + ": " + found.function.name + "\n";
    }
  EXPECT_GT(with_arrays, 80.0);
  EXPECT_GE(with_shapes, 0.95 * with_arrays) << without;
}

}  // namespace
}  // namespace lacuna::repository
