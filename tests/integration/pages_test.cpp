// SPDX-License-Identifier: MIT
// Pages as a reader types them: files are written, commands run, what is shown is looked for
// in what they print.
#include <fstream>
#include <sstream>

#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

/// A block of code of a page: what stands behind ``` and its lines.
struct Block {
  std::string kind;
  std::vector<std::string> lines;
};

std::vector<Block> blocks_of(const std::string& page) {
  std::ifstream file(page);
  std::vector<Block> blocks;
  bool open = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("```", 0) != 0) {
      if (open) blocks.back().lines.push_back(line);
      continue;
    }
    open = !open;
    if (open) blocks.push_back({line.substr(3), {}});
  }
  return blocks;
}

/// The words of a text with one blank between them.
std::string plain(const std::string& text) {
  std::istringstream words(text);
  std::string result;
  for (std::string word; words >> word;) result += (result.empty() ? "" : " ") + word;
  return result;
}

/// Does what a page says in a folder. @return number of commands that were run.
int follow(const std::string& page, const TemporaryFolder& folder) {
  std::filesystem::create_directory_symlink(std::string(LACUNA_SOURCE_DIR) + "/data",
                                            folder.file("data"));
  const std::string here = "cd '" + folder.path().string() + "' &&";
  std::string printed;
  int commands = 0;
  for (const Block& block : blocks_of(std::string(LACUNA_SOURCE_DIR) + "/docs/" + page)) {
    if (block.kind.rfind("ode ", 0) == 0) {
      std::ofstream file(folder.file(block.kind.substr(4)));
      for (const std::string& line : block.lines) file << line << "\n";
    } else if (block.kind == "sh") {
      printed.clear();
      for (const std::string& line : block.lines) {
        EXPECT_EQ(line.rfind("lacuna ", 0), 0u) << line;
        const CommandResult result = run_program(line.substr(7), here);
        EXPECT_EQ(result.status, 0) << line << "\n" << result.err;
        printed += result.out;
        ++commands;
      }
    } else {
      for (const std::string& line : block.lines)
        EXPECT_THAT(plain(printed), ::testing::HasSubstr(plain(line)));
    }
  }
  return commands;
}

TEST(Pages, TheTutorialRunsAsItStands) {
  const TemporaryFolder folder;
  EXPECT_GE(follow("tutorial.md", folder), 7);
  EXPECT_THAT(folder.read("pendulum.html"), ::testing::HasSubstr("coulomb-friction"));
  EXPECT_NE(folder.read("pendulum.c"), "");
}

TEST(Pages, TheCookbookRunsAsItStands) {
  const TemporaryFolder folder;
  EXPECT_GE(follow("cookbook.md", folder), 15);
  EXPECT_THAT(folder.read("circuit.cir"), ::testing::HasSubstr("exp("));
  const std::string lynx = folder.read("lynx.ode");
  for (const char* equation : {"dhare/dt = 0.", "dlynx/dt = -0."})
    EXPECT_THAT(lynx, ::testing::HasSubstr(equation));
  for (const char* cubic : {"hare^2", "lynx^2", "^3"})
    EXPECT_THAT(lynx, ::testing::Not(::testing::HasSubstr(cubic)));
}

TEST(Pages, TheGalleryRunsAsItStands) {
  const TemporaryFolder folder;
  EXPECT_GE(follow("gallery.md", folder), 22);
}

}  // namespace
}  // namespace lacuna::testing
