// SPDX-License-Identifier: MIT
// Pages of the documentation: one idea each, with links that lead somewhere.
#include "repository/pages.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <sstream>

namespace lacuna::repository {
namespace {

constexpr int kWordsOfAPage = 1500, kWordsUnderAHeading = 250, kPagesOfAFolder = 12;

/// Words of a line: what has a letter or a digit.
int words_in(const std::string& line) {
  std::istringstream stream(line);
  int count = 0;
  for (std::string word; stream >> word;)
    count +=
        std::any_of(word.begin(), word.end(), [](unsigned char c) { return std::isalnum(c); });
  return count;
}

/// Words under each heading of a page, of whatever level; under "" what stands before the
/// first.
std::map<std::string, int> words_under_headings(const std::vector<std::string>& lines) {
  std::map<std::string, int> words;
  std::string heading;
  for (const std::string& line : prose_of(lines)) {
    if (line.rfind("#", 0) == 0) heading = line;
    words[heading] += words_in(line);
  }
  return words;
}

TEST(Pages, HaveAtMost1500Words) {
  const auto pages = pages_below("docs");
  ASSERT_FALSE(pages.empty());
  for (const SourceFile& page : pages) {
    int words = 0;
    for (const std::string& line : prose_of(page.lines)) words += words_in(line);
    EXPECT_LE(words, kWordsOfAPage) << page.path;
  }
}

TEST(Pages, HaveAtMost250WordsUnderAHeading) {
  const auto pages = pages_below("docs");
  ASSERT_FALSE(pages.empty());
  for (const SourceFile& page : pages)
    for (const auto& [heading, words] : words_under_headings(page.lines))
      EXPECT_LE(words, kWordsUnderAHeading) << page.path << ": " << heading;
}

TEST(Pages, StandInFoldersOfAtMost12BesideAnIndexOfTheSameName) {
  std::map<std::filesystem::path, int> folders;
  for (const SourceFile& page : pages_below("docs")) ++folders[page.path.parent_path()];
  ASSERT_GT(folders.size(), 1u);
  for (const auto& [folder, count] : folders) {
    if (folder == "docs") continue;
    EXPECT_LE(count, kPagesOfAFolder) << folder;
    const std::filesystem::path root = LACUNA_SOURCE_DIR;
    EXPECT_TRUE(std::filesystem::exists(root / (folder.string() + ".md"))) << folder;
  }
}

TEST(Pages, LinksLeadSomewhere) {
  auto pages = pages_below("docs");
  for (const std::string name : {"README.md", "CONTRIBUTING.md"})
    pages.push_back({name, read_lines(std::filesystem::path(LACUNA_SOURCE_DIR) / name)});
  std::size_t links = 0;
  for (const SourceFile& page : pages)
    for (const std::string& line : prose_of(page.lines))
      for (const std::string& link : all_matches(line, R"(\]\(([^)#:]+)(?:#[^)]*)?\))")) {
        const auto folder =
            (std::filesystem::path(LACUNA_SOURCE_DIR) / page.path).parent_path();
        EXPECT_TRUE(std::filesystem::exists(folder / link)) << page.path << ": " << link;
        ++links;
      }
  EXPECT_GE(links, 100u);
}

TEST(Pages, EachOfAFolderIsLinkedFromItsIndex) {
  std::size_t count = 0;
  for (const SourceFile& page : pages_below("docs")) {
    const auto folder = page.path.parent_path();
    if (folder == "docs") continue;
    std::string index;
    for (const std::string& line :
         read_lines(std::filesystem::path(LACUNA_SOURCE_DIR) / (folder.string() + ".md")))
      index += line + "\n";
    const std::string link = folder.filename().string() + "/" + page.path.filename().string();
    EXPECT_NE(index.find("(" + link), std::string::npos) << page.path;
    ++count;
  }
  EXPECT_GT(count, 10u);
}

}  // namespace
}  // namespace lacuna::repository
