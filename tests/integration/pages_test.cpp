// SPDX-License-Identifier: MIT
// Pages as a reader types them: files are written, commands run, what is shown is looked for
// in what they print.
#include <filesystem>
#include <fstream>
#include <map>
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
  for (const std::string shipped : {"data", "examples"})
    std::filesystem::create_directory_symlink(std::string(LACUNA_SOURCE_DIR) + "/" + shipped,
                                              folder.file(shipped));
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

TEST(Pages, TheLoopOfAPlanRunsAsItStands) {
  const TemporaryFolder folder;
  EXPECT_GE(follow("plan.md", folder), 7);
  EXPECT_THAT(folder.read("third.csv"), ::testing::HasSubstr("u [N]"));
}

TEST(Pages, PopulationsRunAsTheyStand) {
  const TemporaryFolder folder;
  EXPECT_GE(follow("fit/populations.md", folder), 2);
}

/// Lines of blocks, fenced or indented, that begin with `lacuna`, a `$` in front of it or not.
std::vector<std::string> shown_commands(const std::filesystem::path& page) {
  std::vector<std::string> commands;
  std::ifstream file(page);
  bool fenced = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("```", 0) == 0) fenced = !fenced;
    std::string text = plain(line.substr(0, line.find(" # ")));
    if (text.rfind("$ ", 0) == 0) text.erase(0, 2);
    const bool is_code = fenced || line.rfind("    ", 0) == 0;
    if (is_code && text.rfind("lacuna ", 0) == 0) commands.push_back(text.substr(7));
  }
  return commands;
}

TEST(Pages, CommandsOfAllPagesAndTheirOptionsAreThere) {
  const std::filesystem::path root = LACUNA_SOURCE_DIR;
  std::vector<std::filesystem::path> pages{root / "README.md", root / "site/pages/index.md"};
  for (const char* folder : {"docs", "effects", "bases", "solvers", "data"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
  std::map<std::string, std::string> help;
  int count = 0;
  for (const auto& page : pages) {
    for (const std::string& line : shown_commands(page)) {
      std::istringstream words(line);
      std::string command;
      words >> command;
      if (!help.contains(command)) help[command] = run_program(command + " --help-all").out;
      EXPECT_NE(help[command], "") << page << ": " << line;
      for (std::string word; words >> word;) {
        word.erase(0, word.find_first_not_of('['));
        if (word.rfind("--", 0) != 0) continue;
        const std::string option = word.substr(0, word.find_first_of("=]"));
        EXPECT_THAT(help[command], ::testing::ContainsRegex(option + "[ ,\n]")) << page;
      }
      ++count;
    }
  }
  EXPECT_GE(count, 60);
}

/// Blocks of a kind of a page, each as one text.
std::vector<std::string> texts_of(const std::string& page, const std::string& kind) {
  std::vector<std::string> texts;
  for (const Block& block : blocks_of(std::string(LACUNA_SOURCE_DIR) + "/docs/" + page)) {
    if (block.kind != kind) continue;
    texts.emplace_back();
    for (const std::string& line : block.lines) texts.back() += line + "\n";
  }
  return texts;
}

TEST(Pages, ModelsOfFormatsAreRead) {
  const TemporaryFolder folder;
  const auto expect_read = [&](const std::string& name, const std::string& text) {
    const CommandResult result = run_program("model " + folder.write(name, text));
    EXPECT_EQ(result.status, 0) << text << result.err;
    return result.out;
  };
  const auto models = texts_of("file-formats/models.md", "json");
  ASSERT_EQ(models.size(), 2u) << "a model, and keys that it may have too";
  expect_read("m.json", models[0]);
  std::string whole = models[0];
  whole.insert(whole.rfind('}'), "," + models[1]);
  EXPECT_THAT(expect_read("whole.json", whole), ::testing::HasSubstr("k1"));
  const auto texts = texts_of("file-formats/models.md", "ode");
  ASSERT_EQ(texts.size(), 1u);
  expect_read("m.ode", texts[0]);
}

TEST(Pages, ConfigurationsOfFormatsAreTaken) {
  const TemporaryFolder folder;
  const auto configurations = texts_of("file-formats/configurations.md", "json");
  ASSERT_EQ(configurations.size(), 2u) << "of a diagnosis, of a pipeline";
  const std::string model =
      folder.write("m.ode", "state x\nstate v\ndx/dt = v\ndv/dt = -4*x - 0.2*v\n");
  const std::string record = folder.file("run.csv");
  for (const std::string& command :
       {"simulate " + model + " --x0 1,0 --t-end 10 --dt 0.02 --noise x=0.01,v=0.01 -o " + record,
        "diagnose --model " + model + " " + record + " --config " +
            folder.write("diagnosis.json", configurations[0]),
        "identify " + record + " --config " + folder.write("pipeline.json", configurations[1])}) {
    const CommandResult result = run_program(command);
    EXPECT_EQ(result.status, 0) << command << "\n" << result.err;
  }
}

TEST(Pages, TheGalleryRunsAsItStands) {
  const TemporaryFolder folder;
  EXPECT_GE(follow("gallery.md", folder), 22);
}

}  // namespace
}  // namespace lacuna::testing
