// SPDX-License-Identifier: MIT
// The first page: short, with numbers that come from results.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "repository/pages.hpp"

namespace lacuna::repository {
namespace {

const std::filesystem::path kReadmeRoot = LACUNA_SOURCE_DIR;

std::string text_of(const std::filesystem::path& path) {
  std::string text;
  for (const std::string& line : read_lines(path)) text += line + "\n";
  return text;
}

TEST(Readme, HasAtMost800Words) {
  std::istringstream words(text_of(kReadmeRoot / "README.md"));
  int count = 0;
  for (std::string word; words >> word;) ++count;
  EXPECT_LE(count, 800);
}

/// Rows "| question ([table](FILE)) | answer |": every number of the answer stands in the file.
TEST(Readme, NumbersAreThoseOfTheResults) {
  int rows = 0;
  for (const std::string& line : read_lines(kReadmeRoot / "README.md")) {
    const auto files = all_matches(line, R"(\[table\]\(([^)]+)\))");
    if (line.rfind("| ", 0) != 0 || files.empty()) continue;
    ++rows;
    const std::string results = text_of(kReadmeRoot / files[0]);
    const std::string answer = line.substr(line.find(") | ") + 4);
    for (const std::string& number : all_matches(answer, R"(([0-9]+(?:\.[0-9]+)?))"))
      EXPECT_TRUE(std::regex_search(results, std::regex("[^0-9.]" + number + "[^0-9.]")))
          << number << " is not in " << files[0];
  }
  EXPECT_EQ(rows, 5);
}

}  // namespace
}  // namespace lacuna::repository
