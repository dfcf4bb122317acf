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

/// Lines that are not empty of each C++ program on the page.
std::vector<std::vector<std::string>> programs() {
  std::vector<std::vector<std::string>> found;
  bool open = false;
  for (const std::string& line : read_lines(kReadmeRoot / "README.md")) {
    if (line == "```cpp") found.emplace_back();
    if (line.rfind("```", 0) == 0)
      open = line == "```cpp";
    else if (open && !line.empty())
      found.back().push_back(line);
  }
  return found;
}

TEST(Readme, ProgramsAreShortWithOneHeaderOfTheLibrary) {
  const auto found = programs();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_LE(found[0].size(), 25u);
  EXPECT_LE(found[1].size(), 12u);
  for (const auto& program : found) {
    int headers = 0;
    for (const std::string& line : program) {
      headers += line.rfind("#include <lacuna/", 0) == 0;
      EXPECT_LE(line.size(), 102u) << line;
    }
    EXPECT_EQ(headers, 1);
  }
}

/// What the picture shows of the pendulum is what the text quotes, and a test of the program
/// compares that with its answer.
TEST(Readme, PictureHasTheNumbersOfTheText) {
  const std::string text = text_of(kReadmeRoot / "README.md");
  const std::string picture = text_of(kReadmeRoot / "docs/pictures/overview.svg");
  std::smatch friction, gap;
  ASSERT_TRUE(std::regex_search(text, friction, std::regex("-([0-9.]+) \\+- ([0-9.]+) rad")));
  ASSERT_TRUE(std::regex_search(text, gap, std::regex("falls from ([0-9.]+ %) to ([0-9.]+ %)")));
  EXPECT_NE(picture.find("dry friction, " + friction[1].str() + " &#177; " + friction[2].str()),
            std::string::npos);
  EXPECT_NE(picture.find(gap[1].str() + " &#8594; " + gap[2].str()), std::string::npos);
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
