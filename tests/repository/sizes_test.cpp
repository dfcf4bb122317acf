// SPDX-License-Identifier: MIT
// Small files, small functions.
#include <gtest/gtest.h>

#include <string>

#include "repository/declarations.hpp"
#include "repository/source_tree.hpp"

namespace lacuna::repository {
namespace {

const std::vector<std::string> kOwnCode = {"include",    "src",   "bases", "solvers",
                                           "effects",    "apps",  "tests", "examples",
                                           "benchmarks", "python"};

TEST(Sizes, NoFileIsOver450Lines) {
  ASSERT_FALSE(sources_below(kOwnCode).empty());
  for (const SourceFile& file : sources_below(kOwnCode))
    EXPECT_LE(file.lines.size(), 450u) << file.path;
}

TEST(Sizes, LinesHaveAtMost100Columns) {
  ASSERT_FALSE(sources_below(kOwnCode).empty());
  for (const SourceFile& file : sources_below(kOwnCode))
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      EXPECT_LE(file.lines[i].size(), 100u) << file.path << ":" << i + 1;
}

TEST(Sizes, NoFunctionIsOver60Lines) {
  ASSERT_FALSE(sources_below(kOwnCode).empty());
  for (const SourceFile& file : sources_below(kOwnCode))
    for (const FunctionText& function : read_declarations(file.lines).functions)
      if (function.has_body) {
        EXPECT_LE(function.lines(), 60u) << file.path << ":" << function.first;
      }
}

}  // namespace
}  // namespace lacuna::repository
