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

const char* const kLandingPage = "site/pages/index.md";

TEST(Readme, HasAtMost700Words) {
  std::istringstream words(text_of(kReadmeRoot / "README.md"));
  int count = 0;
  for (std::string word; words >> word;) ++count;
  EXPECT_LE(count, 700);
}

/// Lines that are not empty of each block of a language on a page.
std::vector<std::vector<std::string>> blocks_of(const std::string& page,
                                                const std::string& language) {
  std::vector<std::vector<std::string>> found;
  bool open = false;
  for (const std::string& line : read_lines(kReadmeRoot / page)) {
    if (line == "```" + language) found.emplace_back();
    if (line.rfind("```", 0) == 0)
      open = line == "```" + language;
    else if (open && !line.empty())
      found.back().push_back(line);
  }
  return found;
}

/// Each is compiled and run by a test (tests/CMakeLists.txt).
TEST(Readme, ProgramsAreShortWithOneHeaderOfTheLibrary) {
  for (const auto& [page, most] : {std::pair{"README.md", 25u}, std::pair{kLandingPage, 12u}}) {
    const auto programs = blocks_of(page, "cpp");
    ASSERT_EQ(programs.size(), 1u) << page;
    EXPECT_LE(programs[0].size(), most) << page;
    int headers = 0;
    for (const std::string& line : programs[0]) {
      headers += line.rfind("#include <lacuna/", 0) == 0;
      EXPECT_LE(line.size(), 102u) << line;
    }
    EXPECT_EQ(headers, 1) << page;
  }
}

/// Those of the README are run by tests of the Python package.
TEST(Readme, ThePythonOfTheSiteIsItsOwn) {
  const auto here = blocks_of("README.md", "python");
  ASSERT_EQ(here.size(), 1u);
  EXPECT_EQ(blocks_of(kLandingPage, "python"), here);
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
/// @return number of rows.
int check_numbers(const std::string& page) {
  int rows = 0;
  for (const std::string& line : read_lines(kReadmeRoot / page)) {
    const auto files = all_matches(line, R"(\[table\]\(([^)]+)\))");
    if (line.rfind("| ", 0) != 0 || files.empty()) continue;
    ++rows;
    const std::string results = text_of(kReadmeRoot / files[0]);
    const std::string answer = line.substr(line.find(") | ") + 4);
    for (const std::string& number : all_matches(answer, R"(([0-9]+(?:\.[0-9]+)?))"))
      EXPECT_TRUE(std::regex_search(results, std::regex("[^0-9.]" + number + "[^0-9.]")))
          << number << " is not in " << files[0];
  }
  return rows;
}

TEST(Readme, NumbersAreThoseOfTheResults) {
  EXPECT_EQ(check_numbers("README.md"), 4);
  EXPECT_EQ(check_numbers(kLandingPage), 3);
}

}  // namespace
}  // namespace lacuna::repository
