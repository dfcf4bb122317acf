// SPDX-License-Identifier: MIT
// Every source has its test: in tests/unit, which mirrors the library, or said to be elsewhere.
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

#include "repository/source_tree.hpp"

namespace lacuna::repository {
namespace {

const std::filesystem::path kRoot = LACUNA_SOURCE_DIR;
constexpr std::size_t kSmall = 60;  // lines of a source that needs no test of its own

/// Folders inside the folders of a wing are mirrored too.
std::filesystem::path mirror_of(const std::filesystem::path& source) {
  const std::filesystem::path folder = *source.begin() == "src"
                                           ? source.parent_path().lexically_relative("src")
                                           : std::filesystem::path(folder_of(source));
  return std::filesystem::path("tests/unit") / folder /
         (source.stem().string() + "_test.cpp");
}

/// Source to test, from lines "source -> test"; "#" begins a comment.
std::map<std::string, std::string> covered_elsewhere() {
  std::map<std::string, std::string> covered;
  for (const std::string& line : read_lines(kRoot / "tests/repository/covered_elsewhere.txt")) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string source, arrow, test;
    words >> source >> arrow >> test;
    EXPECT_TRUE(arrow == "->" && !test.empty() && words.eof()) << line;
    EXPECT_TRUE(covered.emplace(source, test).second) << source << " is there twice";
  }
  return covered;
}

TEST(Mirrors, EverySourceThatIsNotSmallHasATest) {
  const auto covered = covered_elsewhere();
  ASSERT_FALSE(covered.empty());
  for (const SourceFile& file : sources_below({"src", "bases", "solvers", "effects"}))
    if (file.lines.size() > kSmall && !std::filesystem::exists(kRoot / mirror_of(file.path))) {
      EXPECT_TRUE(covered.contains(file.path.string()))
          << file.path << " has no " << mirror_of(file.path)
          << " and no line in covered_elsewhere.txt";
    }
}

TEST(Mirrors, WhatIsCoveredElsewhereIsThereAndHasNoTestOfItsOwn) {
  ASSERT_FALSE(covered_elsewhere().empty());
  for (const auto& [source, test] : covered_elsewhere()) {
    EXPECT_TRUE(std::filesystem::exists(kRoot / source)) << source << " is gone";
    EXPECT_TRUE(std::filesystem::exists(kRoot / test)) << test << " is gone";
    EXPECT_GT(read_lines(kRoot / source).size(), kSmall) << source << " needs no line";
    EXPECT_FALSE(std::filesystem::exists(kRoot / mirror_of(source)))
        << source << " has a test of its own";
  }
}

/// Whether a header has a source, in src/ or on one of the shelves.
bool has_source(const std::filesystem::path& folder, const std::string& stem) {
  return std::filesystem::exists(kRoot / "src" / folder / (stem + ".cpp")) ||
         std::filesystem::exists(kRoot / folder / (stem + ".cpp"));
}

TEST(Mirrors, EveryHeaderWithASourceHasATest) {
  ASSERT_FALSE(sources_below("include").empty());
  for (const SourceFile& file : sources_below("include")) {
    const auto folder = std::filesystem::relative(file.path.parent_path(), "include/lacuna");
    if (!has_source(folder, file.path.stem().string())) continue;
    EXPECT_TRUE(std::filesystem::exists(kRoot / mirror_of(file.path)))
        << file.path << " has no " << mirror_of(file.path);
  }
}

}  // namespace
}  // namespace lacuna::repository
