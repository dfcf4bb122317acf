// SPDX-License-Identifier: MIT
// What a class and a function may carry: no long function in the form of a class whose members
// are its locals, no public function with a row of arguments.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "repository/declarations.hpp"
#include "repository/source_tree.hpp"

namespace lacuna::repository {
namespace {

constexpr std::size_t kMostLines = 150;
constexpr int kMostMembers = 3, kMostParameters = 5;

using Names = std::set<std::string>;

/// A class with the lines of its member functions, wherever they stand in its folder.
struct ClassSize {
  int members = 0;
  std::size_t lines = 0;

  bool is_too_large() const { return members > kMostMembers && lines > kMostLines; }
};

/// Sizes of the classes by "folder/Class", or "folder/file.cpp/Class" where a source has it for
/// itself.
std::map<std::string, ClassSize> class_sizes(const std::vector<SourceFile>& files) {
  std::map<std::string, ClassSize> sizes;
  for (const SourceFile& file : files) {
    const Declarations found = read_declarations(file.lines);
    const bool is_source = file.path.extension() == ".cpp";
    const std::string folder = folder_of(file.path) + "/";
    const std::string own = folder + file.path.filename().string() + "/";
    Names own_classes;
    for (const ClassText& type : found.classes) {
      if (is_source) own_classes.insert(type.name);
      sizes[(is_source ? own : folder) + type.name].members += type.mutable_members;
    }
    for (const FunctionText& function : found.functions)
      if (function.has_body && !function.owner.empty())
        sizes[(own_classes.contains(function.owner) ? own : folder) + function.owner].lines +=
            function.lines();
  }
  return sizes;
}

Names too_large(const std::vector<SourceFile>& files) {
  Names names;
  for (const auto& [name, size] : class_sizes(files))
    if (size.is_too_large()) names.insert(name);
  return names;
}

/// Public functions of the headers with too many parameters, as "path: Class::function".
Names with_many_parameters(const std::vector<SourceFile>& files) {
  Names names;
  for (const SourceFile& file : files)
    for (const FunctionText& function : read_declarations(file.lines).functions)
      if (function.is_public && function.parameters > kMostParameters)
        names.insert(file.path.string() + ": " +
                     (function.owner.empty() ? "" : function.owner + "::") + function.name);
  return names;
}

/// Classes that two headers define: for the linker they are one, and their functions are mixed
/// up.
Names defined_twice(const std::vector<SourceFile>& files) {
  std::map<std::string, std::set<std::string>> headers;
  for (const SourceFile& file : files)
    if (file.path.extension() == ".hpp")
      for (const ClassText& type : read_declarations(file.lines).classes)
        headers[type.name].insert(file.path.string());
  Names names;
  for (const auto& [name, places] : headers)
    if (places.size() > 1) names.insert(name);
  return names;
}

const std::vector<std::string> kLibrary = {"include", "src", "bases", "solvers", "effects"};

TEST(Classes, AreNoLongFunctionsWithTheirLocalsAsMembers) {
  EXPECT_EQ(too_large(sources_below(kLibrary)), Names{});
}

TEST(Classes, AreDefinedOnce) { EXPECT_EQ(defined_twice(sources_below(kLibrary)), Names{}); }

TEST(ClassRule, KnowsOneNameInTwoHeaders) {
  const SourceFile a{"src/a/x.hpp", {"struct X { int a; };"}};
  const SourceFile b{"src/b/y.hpp", {"class X {", "};", "class Y {", "};"}};
  const SourceFile own{"src/b/y.cpp", {"struct Y {", "};"}};
  EXPECT_EQ(defined_twice({a, b, own}), Names{"X"});
}

TEST(Functions, OfTheInterfaceHaveAtMost5Parameters) {
  EXPECT_EQ(with_many_parameters(sources_below("include")), Names{});
}

/// A class of `members` members with two functions, one in the class and one in the folder.
std::vector<SourceFile> class_of(int members, std::size_t lines_inside,
                                 std::size_t lines_outside) {
  SourceFile header{"src/some/long.hpp", {"class Long {", " public:", "  void run() {"}};
  header.lines.insert(header.lines.end(), lines_inside - 2, "    go();");
  header.lines.insert(header.lines.end(), {"  }", "  void go();", " private:"});
  for (int i = 0; i < members; ++i)
    header.lines.push_back("  double x" + std::to_string(i) + "_;");
  header.lines.push_back("};");
  SourceFile source{"src/some/other.cpp", {"void Long::go() {"}};
  source.lines.insert(source.lines.end(), lines_outside - 2, "  run();");
  source.lines.push_back("}");
  return {header, source};
}

TEST(ClassRule, CountsLinesInTheWholeFolder) {
  EXPECT_EQ(too_large(class_of(4, 75, 76)), Names{"some/Long"});
  EXPECT_TRUE(too_large(class_of(4, 75, 75)).empty());
  EXPECT_TRUE(too_large(class_of(3, 75, 76)).empty());
}

TEST(ClassRule, KeepsClassesOfTwoSourcesApart) {
  std::vector<SourceFile> files = class_of(4, 75, 76);
  files[0].path = "src/some/one.cpp";
  EXPECT_TRUE(too_large(files).empty());
  files[1].lines.insert(files[1].lines.begin(), "struct Long { int a, b, c, d; void go(); };");
  EXPECT_TRUE(too_large(files).empty());
}

TEST(ParameterRule, LooksAtWhatAUserCanCall) {
  const SourceFile header{"include/lacuna/some/long.hpp",
                          {"void few(int a, int b, int c, int d, std::map<int, int> e);",
                           "void many(int a, int b, int c, int d,", "          int e, int f);",
                           "class Long {", "  Long(int, int, int, int, int, int);",
                           " public:", "  Long(int, int, int, int, int, int, int);", "};"}};
  EXPECT_EQ(with_many_parameters({header}),
            (Names{"include/lacuna/some/long.hpp: many",
                   "include/lacuna/some/long.hpp: Long::Long"}));
}

}  // namespace
}  // namespace lacuna::repository
