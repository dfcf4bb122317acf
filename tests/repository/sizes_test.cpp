// SPDX-License-Identifier: MIT
// Small files, small folders, small functions; every source has its test.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "repository/source_tree.hpp"

namespace lacuna::repository {
namespace {

const std::vector<std::string> kOwnCode = {
    "include", "src", "bases", "solvers", "effects", "apps", "tests", "examples", "benchmarks"};

TEST(Sizes, NoFileIsOver450Lines) {
  for (const SourceFile& file : sources_below(kOwnCode))
    EXPECT_LE(file.lines.size(), 450u) << file.path;
}

TEST(Sizes, MedianFileIsAtMost120Lines) {
  std::vector<std::size_t> sizes;
  for (const SourceFile& file : sources_below(kOwnCode)) sizes.push_back(file.lines.size());
  ASSERT_FALSE(sizes.empty());
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<long>(sizes.size() / 2),
                   sizes.end());
  EXPECT_LE(sizes[sizes.size() / 2], 120u);
}

TEST(Sizes, LinesHaveAtMost100Columns) {
  for (const SourceFile& file : sources_below(kOwnCode))
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      EXPECT_LE(file.lines[i].size(), 100u) << file.path << ":" << i + 1;
}

TEST(Sizes, AtMost12HeadersInAFolder) {
  std::map<std::string, int> headers;
  for (const SourceFile& file : sources_below("include"))
    ++headers[file.path.parent_path().string()];
  for (const auto& [folder, count] : headers) EXPECT_LE(count, 12) << folder;
}

/// With this formatting a function body outside a class starts with a line that begins at
/// column 0 and ends in "{", and ends with "}" at column 0; namespaces and classes are told
/// apart.
bool opens_function(const std::string& line, const std::string& previous) {
  if (line.empty() || line.back() != '{' || line[0] == '}') return false;
  for (const char* other : {"namespace", "class ", "struct ", "enum ", "template", "const ",
                            "constexpr ", "static const", "union ", "//", "extern"})
    if (line.rfind(other, 0) == 0 && line.find('(') == std::string::npos) return false;
  const bool has_call =
      line.find('(') != std::string::npos || line.find(')') != std::string::npos;
  return has_call && (line[0] != ' ' || previous.find('(') != std::string::npos);
}

TEST(Sizes, NoFunctionIsOver60Lines) {
  for (const SourceFile& file : sources_below(kOwnCode)) {
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      if (!opens_function(file.lines[i], i > 0 ? file.lines[i - 1] : "")) continue;
      const std::size_t indent = file.lines[i].find_first_not_of(' ');
      if (indent != 0) continue;
      std::size_t end = i + 1;
      while (end < file.lines.size() && file.lines[end].rfind("}", 0) != 0) ++end;
      EXPECT_LE(end - i + 1, 60u) << file.path << ":" << i + 1;
    }
  }
}

/// Whether a header has a source, in src/ or on one of the two shelves.
bool has_source(const std::filesystem::path& folder, const std::string& stem) {
  const std::filesystem::path root = LACUNA_SOURCE_DIR;
  return std::filesystem::exists(root / "src" / folder / (stem + ".cpp")) ||
         std::filesystem::exists(root / folder / (stem + ".cpp"));
}

TEST(Sizes, EveryHeaderWithASourceHasATest) {
  const std::filesystem::path root = LACUNA_SOURCE_DIR;
  for (const SourceFile& file : sources_below("include")) {
    const auto folder = std::filesystem::relative(file.path.parent_path(), "include/lacuna");
    const std::string stem = file.path.stem().string();
    if (!has_source(folder, stem)) continue;
    const auto test = root / "tests/unit" / folder / (stem + "_test.cpp");
    EXPECT_TRUE(std::filesystem::exists(test)) << file.path << " has no " << test;
  }
}

}  // namespace
}  // namespace lacuna::repository
