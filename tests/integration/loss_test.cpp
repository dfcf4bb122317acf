// SPDX-License-Identifier: MIT
// Nothing is lost, nothing hangs: full disks, no memory, no threads, pipes, links, odd bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <csignal>

#include "integration/program.hpp"
#include "support/sanitizers.hpp"

namespace lacuna::testing {
namespace {

using ::testing::HasSubstr;

/// `lacuna` behind a shell's preparation ("ulimit -f 1"); standard output may go elsewhere.
CommandResult run_in_shell(const std::string& before, const std::string& arguments,
                           const std::string& out = "") {
  const TemporaryFolder folder;
  const std::string command = before + "; '" + LACUNA_COMMAND + "' " + arguments + " > '" +
                              (out.empty() ? folder.file("out") : out) + "' 2> '" +
                              folder.file("err") + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, folder.read("out"), folder.read("err")};
}

void expect_one_error(const CommandResult& result, const std::vector<std::string>& parts) {
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_EQ(result.err.rfind("lacuna: error: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts) EXPECT_THAT(result.err, HasSubstr(part));
}

/// n samples of an oscillation under a header.
std::string oscillation(int n, const std::string& header = "t,x,y") {
  std::string text = header + "\n";
  for (int i = 0; i < n; ++i)
    text += std::to_string(0.01 * i) + "," + std::to_string(std::cos(0.01 * i)) + "," +
            std::to_string(-std::sin(0.01 * i)) + "\n";
  return text;
}

TEST(Output, AFullStandardOutputIsAnError) {
  const TemporaryFolder folder;
  const std::string record = folder.write("r.csv", oscillation(300));
  for (const std::string& arguments :
       {std::string("simulate lorenz --x0 1,1,1 --t-end 10 --dt .1"), "identify " + record,
        "identify " + record + " --json -", std::string("list"), std::string("--help"),
        std::string("describe stlsq")})
    expect_one_error(run_in_shell("true", arguments, "/dev/full"), {"standard output", "; "});
}

TEST(Output, AReaderThatLeavesEndsTheProgramWithoutAWord) {
  const TemporaryFolder folder;
  // More than a pipe holds, so that the program still writes when its reader has gone.
  const std::string command = "bash -c \"'" LACUNA_COMMAND
                              "' simulate lorenz --x0 1,1,1 --t-end 1000 --dt .01 2> '" +
                              folder.file("err") + "' | head -1 > '" + folder.file("out") +
                              "'; exit \\${PIPESTATUS[0]}\"";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGPIPE);
  EXPECT_EQ(folder.read("out"), "t,x,y,z\n");
  EXPECT_EQ(folder.read("err"), "");
}

TEST(Output, AFileThatGrowsTooLargeLeavesNothing) {
  const TemporaryFolder folder;
  const std::string orbit = folder.file("o.csv");
  expect_one_error(run_in_shell("ulimit -f 1",
                                "simulate lorenz --x0 1,1,1 --t-end 10 --dt .01"
                                " -o " +
                                    orbit),
                   {"o.csv", "cannot be written"});
  EXPECT_EQ(folder.count(), 0);
}

TEST(Memory, EndsWithAnErrorWhereverItRunsOut) {
  if (run_in_shell("ulimit -v 100000", "list").status != 0)
    GTEST_SKIP() << "this build needs more memory to start";
  const TemporaryFolder folder;
  const std::string record = folder.write("r.csv", oscillation(20000));
  for (int kilobytes = 20000; kilobytes <= 80000; kilobytes += 3000) {
    const std::string limit = "ulimit -v " + std::to_string(kilobytes);
    if (run_in_shell(limit, "--version").status != 0) continue;  // a library ends it before
    const CommandResult result = run_in_shell(limit, "identify " + record);
    if (result.status != 0) expect_one_error(result, {"memory"});
  }
}

TEST(Memory, IsBoundedForWhatAnInputExpandsTo) {
  if (kIsSanitized) GTEST_SKIP() << "the sanitizer's allocator ends the program itself";
  const TemporaryFolder folder;
  const std::string zeros = folder.file("zeros.gz");
  ASSERT_EQ(std::system(("head -c 400000000 /dev/zero | gzip -1 > " + zeros).c_str()), 0);
  for (const std::string& source : {zeros, std::string("/dev/zero")})
    expect_program_error("identify " + source + " --max-memory 200M", 2,
                         {source, "memory", "--max-memory"});
  expect_program_error("simulate lorenz --x0 1,1,1 --t-end 1e8 --dt 1 --max-memory 200M", 2,
                       {"simulate lorenz", "memory", "--max-memory"});
  for (const char* size : {"1", "-1", "x", "1e9", "99999999999T"})
    expect_program_error("identify " + zeros + " --max-memory " + size, 2, {"--max-memory"});
}

TEST(Threads, AreNotNeeded) {
  if (kIsSanitized) GTEST_SKIP() << "the sanitizer needs more memory and a thread itself";
  // Stacks of 4 GB do not fit into an address space of 3 GB: no thread can be started.
  const std::string none = "ulimit -s 4194304; ulimit -v 3000000";
  const CommandResult list = run_in_shell(none, "list");
  EXPECT_EQ(list.status, 0) << list.err;
  const TemporaryFolder folder;
  const std::string record = folder.write("r.csv", oscillation(300));
  const std::string expected = run_program("identify " + record + " --json -").out;
  const CommandResult alone =
      run_in_shell(none, "identify " + record + " --json - --threads 4");
  EXPECT_EQ(alone.status, 0) << alone.err;
  EXPECT_EQ(alone.out, expected);
}

/// Interrupted after some seconds it ends by itself: one that does not is killed 5 s later.
void expect_interrupted(const std::string& arguments, const std::string& seconds) {
  const CommandResult result =
      run_program(arguments, "timeout --preserve-status -k 5 -s INT " + seconds);
  EXPECT_EQ(result.status, 130) << arguments << ": " << result.err;
  EXPECT_THAT(result.err, HasSubstr("interrupted")) << arguments;
}

TEST(Interrupt, EndsAReadThatBlocks) {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string record = folder.write("r.csv", oscillation(300));
  for (const std::string& arguments :
       {"identify " + pipe, "identify --memory 16MB " + pipe, "sync " + pipe + " " + record,
        "identify " + record + " --config " + pipe, "check " + pipe, "fit lorenz " + pipe,
        "diagnose --model lorenz " + pipe, "diagnose --model " + pipe + " " + record,
        "compare lorenz " + pipe, "export " + pipe + " --format c", "model " + pipe,
        "simulate " + pipe + " --x0 1 --t-end 1 --dt .1",
        "simulate lorenz --x0 1,1,1 --t-end 1 --dt .1 -o " + pipe})
    expect_interrupted(arguments, "0.3");
}

/// A record of Lorenz' system that takes every command that looks at it longer than a second.
TEST(Interrupt, EndsWhateverIsComputed) {
  const TemporaryFolder folder;
  const std::string orbit = folder.file("o.csv");
  const CommandResult made = run_program_well(
      "simulate lorenz --x0 1,1,20 --t-end 2000 --dt 0.002 --noise x=0.1 --seed 1 -o " + orbit);
  for (const std::string& arguments :
       {"identify " + orbit + " --json " + folder.file("i.json"),
        "diagnose --model rossler " + orbit + " --json " +
            folder.file("d.json"),
        "fit lorenz " + orbit + " --json " + folder.file("f.json"),
        "compare lorenz " + orbit + " --json " + folder.file("c.json"),
        "sync lorenz " + orbit + " --integrator dopri87"})
    expect_interrupted(arguments, "1");
  EXPECT_EQ(folder.count(), 1);
}

/// Oscillators in a row, each coupled to its neighbours; cubic springs.
std::string chain_model(int n) {
  std::string states, equations;
  for (int i = 0; i < n; ++i) {
    const std::string q = "q" + std::to_string(i), v = "v" + std::to_string(i);
    states += (i > 0 ? ", " : "") + ("{\"name\": \"" + q + "\"}, {\"name\": \"" + v + "\"}");
    equations +=
        (i > 0 ? ", " : "") +
        ("{\"state\": \"" + q + "\", \"terms\": [{\"term\": \"" + v +
         "\", \"coefficient\": 1}]}, {\"state\": \"" + v + "\", \"terms\": [{\"term\": \"" + q +
         "\", \"coefficient\": -2}, {\"term\": \"" + q + "^3\", \"coefficient\": -0.5}");
    for (const int k : {i - 1, i + 1})
      if (k >= 0 && k < n)
        equations += ", {\"term\": \"q" + std::to_string(k) + "\", \"coefficient\": 0.7}";
    equations += "]}";
  }
  return "{\"format\": \"lacuna.model/1\", \"states\": [" + states + "], \"equations\": [" +
         equations + "]}";
}

TEST(Interrupt, EndsALongSearchAtOnce) {
  const TemporaryFolder folder;
  constexpr int kMasses = 12;
  const std::string model = folder.write("m.json", chain_model(kMasses));
  std::string start = "1";
  for (int i = 1; i < 2 * kMasses; ++i) start += i % 3 == 0 ? ",0.5" : ",-0.3";
  const std::string orbit = folder.file("o.csv");
  run_program_well("simulate " + model + " --x0 " + start + " --t-end 60 --dt 0.02 -o " +
                   orbit);
  expect_interrupted("identify " + orbit, "7");
}

TEST(Names, OfOtherEncodingsAreRead) {
  const TemporaryFolder folder;
  const std::string record = folder.write("r\xe4.csv", oscillation(300,
                                                                   "t [s],\xfc"
                                                                   "ber [\xb0"
                                                                   "C],y"));
  const CommandResult result = run_program_well("identify " + record + " --json -");
  EXPECT_THAT(result.out, HasSubstr("\"unit\": \"\xc2\xb0"
                                    "C\""));
}

TEST(Names, CannotActOnTheTerminal) {
  const TemporaryFolder folder;
  const std::string record =
      folder.write("r.csv", oscillation(300, "t,x [\x1b[31mV],y\x1b]0;gone\x07 [V\x9b]"));
  const CommandResult result = run_program_well("identify " + record);
  for (const char* code : {"\x1b", "\x07", "\x9b"})
    EXPECT_EQ((result.out + result.err).find(code), std::string::npos);
  const std::string absent = folder.file("a\x1b[31m.csv");
  EXPECT_EQ(run_program("identify '" + absent + "'").err.find('\x1b'), std::string::npos);
}

TEST(Options, EmptyAndWrappedValuesAreRefused) {
  const TemporaryFolder folder;
  const std::string identify = "identify " + folder.write("r.csv", oscillation(300));
  for (const std::string option : {"--seed -1", "--seed 18446744073709551616", "--seed ''",
                                   "--dt ''", "--states ''", "--threads ''"})
    expect_program_error(identify + " " + option, 2, {option.substr(0, option.find(' '))});
  run_program_well(identify + " --seed 18446744073709551615");
}

TEST(Links, ALoopOfThemIsOneError) {
  const TemporaryFolder folder;
  const std::string loop = folder.file("a");
  std::filesystem::create_symlink("b", loop);
  std::filesystem::create_symlink("a", folder.file("b"));
  expect_program_error("simulate " + loop + " --x0 1 --t-end 1 --dt .1", 2, {loop, "; "});
  expect_program_error("identify " + loop, 2, {loop, "; "});
  expect_program_error("simulate lorenz --x0 1,1,1 --t-end 1 --dt .1 -o " + loop, 2,
                       {loop, "circle"});
}

/// A record of n columns, half of them called derivatives of the others, and a model of n terms.
std::pair<std::string, std::string> wide_files(const TemporaryFolder& folder, int n) {
  std::string header = "t", row, terms;
  for (int i = 0; i < n; ++i) {
    const std::string number = std::to_string(i);
    header.append(i % 2 == 0 ? ",a" : ",da").append(std::to_string(i / 2));
    row += ",1";
    terms.append(i > 0 ? "," : "").append(R"x({"term": "sin()x").append(number);
    terms += R"x(*x)", "coefficient": 1})x";
  }
  const std::string model =
      R"({"format": "lacuna.model/1", "states": [{"name": "x"}], "equations": [
          {"state": "x", "terms": [)" +
      terms + "]}]}";
  return {folder.write("r.csv", header + "\n0" + row + "\n1" + row + "\n"),
          folder.write("m.json", model)};
}

/// Seconds of the processor, spent in the program itself, that children have taken so far.
double seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// Seconds of reading a record, of looking at it and of simulating a model that are n wide.
std::array<double, 3> seconds_of_width(int n) {
  const TemporaryFolder folder;
  const auto [record, model] = wide_files(folder, n);
  const std::array commands{
      "identify " + record, "check " + record,
      "simulate " + model + " --x0 1 --t-end 0.1 --dt 0.1 --integrator rk4"};
  std::array<double, 3> seconds{};
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const double begin = seconds_of_children();
    // There is nothing to identify in two samples.
    EXPECT_EQ(run_program(commands[i]).status == 0, i > 0) << commands[i];
    seconds[i] = seconds_of_children() - begin;
  }
  return seconds;
}

// Four times the input takes 4 times as long where all is linear, 16 times where anything is
// quadratic.
TEST(Time, GrowsNoFasterThanTheInput) {
  const auto seconds = seconds_of_width(25000), longer = seconds_of_width(100000);
  ASSERT_FALSE(seconds.empty());
  for (std::size_t i = 0; i < seconds.size(); ++i)
    EXPECT_LT(longer[i], 9 * seconds[i] + 0.1) << i;
}

}  // namespace
}  // namespace lacuna::testing
