// SPDX-License-Identifier: MIT
// A class has one definition, a public function no row of arguments.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "repository/declarations.hpp"
#include "repository/source_tree.hpp"

namespace lacuna::repository {
namespace {

constexpr int kMostParameters = 5;

using Names = std::set<std::string>;

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

}  // namespace
}  // namespace lacuna::repository
