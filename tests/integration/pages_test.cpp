// SPDX-License-Identifier: MIT
// Pages as a reader types them: files are written, commands run, what is shown is looked for
// in what they print.
#include <cstdlib>
#include <map>
#include <regex>
#include <set>

#include "integration/page_blocks.hpp"
#include "integration/program.hpp"

namespace lacuna::testing {
namespace {

/// A line of a page that no test runs: "PAGE or FOLDER/ | START OF THE LINE or * | REASON".
struct NotRun {
  std::string page, start, reason;

  bool covers(const std::string& path, const std::string& line) const {
    const bool is_here = page.back() == '/' ? path.rfind(page, 0) == 0 : path == page;
    return is_here && (start == "*" || line.rfind(start, 0) == 0);
  }
};

std::vector<NotRun> not_run() {
  std::ifstream file(std::string(LACUNA_SOURCE_DIR) + "/tests/integration/pages_not_run.txt");
  std::vector<NotRun> entries;
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(" | "), last = line.find(" | ", first + 1);
    if (line.empty() || line.front() == '#') continue;
    if (last == std::string::npos)
      entries.push_back({line, "", ""});
    else
      entries.push_back({line.substr(0, first), line.substr(first + 3, last - first - 3),
                         line.substr(last + 3)});
  }
  return entries;
}

/// The commands of a block that are to be run.
std::vector<std::string> commands_of(const std::string& page, const Block& block) {
  static const std::vector<NotRun> left_out = not_run();
  std::vector<std::string> commands;
  for (const std::string& line : shell_lines(block))
    if (!is_synopsis(line) &&
        std::none_of(left_out.begin(), left_out.end(),
                     [&](const NotRun& entry) { return entry.covers(page, line); }))
      commands.push_back(line);
  return commands;
}

/// Whether the parts of a line between ... stand in a text, one behind the other.
bool shows(const std::string& text, const std::string& line) {
  std::size_t from = 0;
  for (std::size_t at = 0; at != std::string::npos;) {
    const std::size_t end = line.find("...", at);
    const std::string part = plain(line.substr(at, end == std::string::npos ? end : end - at));
    const std::size_t found = text.find(part, from);
    if (found == std::string::npos) return false;
    from = found + part.size();
    at = end == std::string::npos ? end : end + 3;
  }
  return true;
}

/// A folder in which a page is followed: with the shipped records, and the program where the pages
/// have it.
class Desk {
 public:
  Desk() {
    const std::filesystem::path root = LACUNA_SOURCE_DIR;
    for (const char* shipped : {"data", "examples"})
      std::filesystem::create_directory_symlink(root / shipped, folder_.file(shipped));
    for (const char* place : {"bin", "build/demo"}) {
      std::filesystem::create_directories(folder_.file(place));
      std::filesystem::create_symlink(LACUNA_COMMAND, folder_.file(place) + "/lacuna");
    }
  }

  /// Runs a line of a shell, with nobody at the keyboard.
  CommandResult run(const std::string& line) const {
    const TemporaryFolder printed;
    const std::string script = folder_.write("line.sh", line + "\n");
    const std::string here = "cd '" + folder_.path().string() + "' && PATH=\"$PWD/bin:$PATH\" ";
    const std::string command = here + "sh " + script + " </dev/null >'" + printed.file("out") +
                                "' 2>'" + printed.file("err") + "'";
    const int status = std::system(command.c_str());
    return {exit_status(status), printed.read("out"), printed.read("err")};
  }

  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
};

/// Does what a page says. @return number of commands that were run.
int follow(const PageText& page, const Desk& desk) {
  std::optional<std::string> printed;
  int commands = 0;
  for (const Block& block : page.blocks) {
    if (block.kind.rfind("ode ", 0) == 0) {
      std::ofstream file(desk.folder().file(block.kind.substr(4)));
      for (const std::string& line : block.lines) file << line << "\n";
    } else if (block.kind == "sh") {
      printed.reset();
      for (const std::string& line : commands_of(page.path, block)) {
        const CommandResult result = desk.run(line);
        EXPECT_EQ(result.status, 0) << page.path << ": " << line << "\n" << result.err;
        printed = printed.value_or("") + " " + plain(result.out);
        ++commands;
      }
    } else if (block.kind == "text" && printed) {
      for (const std::string& line : block.lines)
        EXPECT_TRUE(shows(*printed, line)) << page.path << ": " << line << "\n" << *printed;
    }
  }
  return commands;
}

TEST(Pages, TheTutorialLeavesAReportAndAProgram) {
  const Desk desk;
  EXPECT_GE(follow(read_page("docs/tutorial.md"), desk), 7);
  EXPECT_THAT(desk.folder().read("pendulum.html"), ::testing::HasSubstr("coulomb-friction"));
  EXPECT_NE(desk.folder().read("pendulum.c"), "");
}

TEST(Pages, TheCookbookLeavesModels) {
  const Desk desk;
  EXPECT_GE(follow(read_page("docs/cookbook.md"), desk), 15);
  EXPECT_THAT(desk.folder().read("circuit.cir"), ::testing::HasSubstr("exp("));
  const std::string lynx = desk.folder().read("lynx.ode");
  for (const char* equation : {"dhare/dt = 0.", "dlynx/dt = -0."})
    EXPECT_THAT(lynx, ::testing::HasSubstr(equation));
  for (const char* cubic : {"hare^2", "lynx^2", "^3"})
    EXPECT_THAT(lynx, ::testing::Not(::testing::HasSubstr(cubic)));
}

TEST(Pages, TheLoopOfAPlanLeavesAnInput) {
  const Desk desk;
  EXPECT_GE(follow(read_page("docs/plan.md"), desk), 7);
  EXPECT_THAT(desk.folder().read("third.csv"), ::testing::HasSubstr("u [N]"));
}

/// The record is one of LACUNA_DATA.
TEST(Pages, TheHeaterIsFittedToItsRecord) {
  const char* data = std::getenv("LACUNA_DATA");
  if (data == nullptr) GTEST_SKIP() << "LACUNA_DATA is not set";
  const Desk desk;
  const std::string record = "tclab_sine_test_5min_period.csv";
  std::filesystem::copy_file(std::string(data) + "/devices/tclab/" + record,
                             desk.folder().file(record));
  EXPECT_EQ(follow(read_page("docs/fit/heater.md"), desk), 1);
}

/// Pages with commands to be run, but those above.
std::vector<PageText> pages_to_follow() {
  const std::set<std::string> above = {"docs/tutorial.md", "docs/cookbook.md", "docs/plan.md",
                                       "docs/fit/heater.md"};
  std::vector<PageText> pages;
  for (PageText& page : all_pages())
    if (!above.contains(page.path) &&
        std::any_of(page.blocks.begin(), page.blocks.end(), [&](const Block& block) {
          return !commands_of(page.path, block).empty();
        }))
      pages.push_back(std::move(page));
  return pages;
}

std::string name_of(const ::testing::TestParamInfo<PageText>& info) {
  std::string name = info.param.path;
  std::replace_if(name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

class PagesWithCommands : public ::testing::TestWithParam<PageText> {};

TEST_P(PagesWithCommands, RunAsTheyStand) {
  const Desk desk;
  EXPECT_GE(follow(GetParam(), desk), 1);
}

INSTANTIATE_TEST_SUITE_P(All, PagesWithCommands, ::testing::ValuesIn(pages_to_follow()), name_of);

TEST(Pages, SynopsesAreToldFromCommands) {
  for (const char* text : {"lacuna fit MODEL DATA... [--profile]", "lacuna bench DATA|SYSTEM",
                           "lacuna export m.ode [-o out]"})
    EXPECT_TRUE(is_synopsis(text)) << text;
  for (const char* text : {"lacuna check a.csv --map th=CH1,F=u  # LOOK", "lacuna model A.ode",
                           "lacuna identify a.csv --inputs F --degree 3",
                           "lacuna simulate a.ode --noise T=0.2"})
    EXPECT_FALSE(is_synopsis(text)) << text;
}

TEST(Pages, WhatIsShownMayLeaveOutParts) {
  EXPECT_TRUE(shows("one two three four", "one ... three"));
  EXPECT_FALSE(shows("one two three four", "three ... one"));
  EXPECT_FALSE(shows("one two", "one three"));
}

/// Pages whose C++ is compiled: programs by tests/CMakeLists.txt, parts by tests/consumer.
std::set<std::string> compiled_pages() {
  std::set<std::string> pages;
  const std::string root = LACUNA_SOURCE_DIR;
  for (const auto& [file, pattern] :
       {std::pair{"/tests/CMakeLists.txt", "lacuna_page_program\\(([^ ]+) "},
        std::pair{"/tests/consumer/CMakeLists.txt", "([A-Za-z_/-]+\\.md)=[a-z]+"}}) {
    std::ifstream stream(root + file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::regex call(pattern);
    for (std::sregex_iterator at(text.begin(), text.end(), call), end; at != end; ++at)
      if ((*at)[1].str().front() != '$') pages.insert((*at)[1]);
  }
  for (const PageText& page : all_pages())  // tests/consumer/run.sh: all of this folder
    if (page.path.rfind("docs/tutorial/", 0) == 0) pages.insert(page.path);
  return pages;
}

/// No block stays unread: shells run, models and configurations are read here, C++ is compiled
/// (compiled_pages()), Python run by python/tests; what is only indented nobody finds.
TEST(Pages, BlocksAreOfKindsThatTestsKnow) {
  const std::set<std::string> kinds = {"sh", "text", "ode", "json", "cpp", "c", "python"};
  std::set<std::string> with_cpp, with_json;
  int count = 0;
  for (const PageText& page : all_pages()) {
    for (const Block& block : page.blocks) {
      EXPECT_TRUE(kinds.contains(block.kind.substr(0, block.kind.find(' ')))) << page.path;
      if (block.kind == "cpp" || block.kind == "c") with_cpp.insert(page.path);
      if (block.kind == "json") with_json.insert(page.path);
      ++count;
    }
    for (std::size_t i = 1; i < page.prose.size(); ++i)
      EXPECT_FALSE(page.prose[i - 1].empty() && page.prose[i].rfind("   ", 0) == 0)
          << page.path << ": put it between lines of ```: " << page.prose[i];
  }
  EXPECT_GE(count, 120);
  EXPECT_EQ(with_cpp, compiled_pages());
  const std::set<std::string> read_below = {"docs/file-formats/configurations.md",
                                            "docs/file-formats/models.md"};
  EXPECT_EQ(with_json, read_below);
}

/// What is not run has a reason, is on its page, and is no plain command of the program.
TEST(Pages, WhatIsNotRunIsThere) {
  const auto entries = not_run();
  ASSERT_FALSE(entries.empty());
  const auto pages = all_pages();
  for (const NotRun& entry : entries) {
    int found = 0;
    for (const PageText& page : pages)
      for (const Block& block : page.blocks)
        for (const std::string& line : shell_lines(block))
          if (entry.covers(page.path, line)) {
            ++found;
            EXPECT_NE(line.rfind("lacuna ", 0), 0U) << page.path << ": " << line;
          }
    EXPECT_GT(found, 0) << entry.page << ": " << entry.start;
    EXPECT_GE(entry.reason.size(), 10U) << entry.page << ": " << entry.start;
  }
}

/// Programs of the tree that pages name are there, run or not.
TEST(Pages, ScriptsThatAreShownAreThere) {
  int count = 0;
  for (const PageText& page : all_pages())
    for (const Block& block : page.blocks)
      for (const std::string& line : shell_lines(block))
        for (std::istringstream words(line); words;) {
          std::string word;
          words >> word;
          if (word.rfind("scripts/", 0) != 0 && word.rfind("benchmarks/", 0) != 0) continue;
          EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(LACUNA_SOURCE_DIR) / word))
              << page.path << ": " << line;
          ++count;
        }
  EXPECT_GE(count, 4);
}

/// What stands behind the name of the program, in blocks and between single ` in the prose.
std::vector<std::string> shown_calls(const PageText& page) {
  std::vector<std::string> calls;
  const std::regex in_block("(?:^|.*[ /])lacuna(?:-mpi)? ([a-z].*)");
  const std::regex in_prose("`(?:\\$ )?lacuna(?:-mpi)? ([a-z][^`]*)`");
  for (const Block& block : page.blocks)
    for (const std::string& line : shell_lines(block))
      if (std::smatch found; std::regex_match(line, found, in_block))
        calls.push_back(found[1].str().substr(0, found[1].str().find(" # ")));
  for (const std::string& line : page.prose)
    for (std::sregex_iterator it(line.begin(), line.end(), in_prose), end; it != end; ++it)
      calls.push_back((*it)[1]);
  return calls;
}

TEST(Pages, CommandsOfAllPagesAndTheirOptionsAreThere) {
  std::map<std::string, std::string> help;
  int count = 0;
  for (const PageText& page : all_pages()) {
    for (const std::string& line : shown_calls(page)) {
      std::istringstream words(line);
      std::string command;
      words >> command;
      if (!help.contains(command)) help[command] = run_program(command + " --help-all").out;
      EXPECT_NE(help[command], "") << page.path << ": " << line;
      for (std::string word; words >> word;) {
        word.erase(0, word.find_first_not_of('['));
        if (word.rfind("--", 0) != 0) continue;
        const std::string option = word.substr(0, word.find_first_of("=]"));
        EXPECT_THAT(help[command], ::testing::ContainsRegex(option + "[ ,\n]")) << page.path;
      }
      ++count;
    }
  }
  EXPECT_GE(count, 110);
}

/// Parts that the prose says can be described or listed are there.
TEST(Pages, DescriptionsThatTheProseNamesAreThere) {
  const std::regex named("(?:describe|list) [a-z-]+");
  std::set<std::string> calls;
  for (const PageText& page : all_pages())
    for (const std::string& call : shown_calls(page))
      if (std::regex_match(call, named)) calls.insert(call);
  calls.erase("describe friction");  // the basis that bases/README.md shows how to add
  EXPECT_GE(calls.size(), 6U);
  for (const std::string& call : calls) EXPECT_EQ(run_program(call).status, 0) << call;
}

/// Blocks of a kind of a page, each as one text.
std::vector<std::string> texts_of(const std::string& page, const std::string& kind) {
  std::vector<std::string> texts;
  for (const Block& block : read_page(page).blocks) {
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
  const std::string page = "docs/file-formats/models.md";
  const auto models = texts_of(page, "json");
  ASSERT_EQ(models.size(), 2u) << "a model, and keys that it may have too";
  expect_read("m.json", models[0]);
  std::string whole = models[0];
  whole.insert(whole.rfind('}'), "," + models[1]);
  EXPECT_THAT(expect_read("whole.json", whole), ::testing::HasSubstr("k1"));
  int texts = 0;
  for (const PageText& any : all_pages())
    for (const std::string& text : texts_of(any.path, "ode")) {
      expect_read("m.ode", text);
      ++texts;
    }
  EXPECT_GE(texts, 2);
}

TEST(Pages, ConfigurationsOfFormatsAreTaken) {
  const TemporaryFolder folder;
  const auto configurations = texts_of("docs/file-formats/configurations.md", "json");
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

}  // namespace
}  // namespace lacuna::testing
