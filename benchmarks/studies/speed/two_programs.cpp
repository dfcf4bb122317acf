// SPDX-License-Identifier: MIT
#include "two_programs.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna::benchmarks {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// What one run took.
struct Cost {
  double cpu = 0.0;     ///< seconds
  double memory = 0.0;  ///< MB at most
};

/// Runs a program; what it prints goes nowhere.
/// @throws FileError where it cannot be started.
Cost run_program(std::vector<std::string> arguments) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failure =
      posix_spawnp(&child, pointers.front(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0)
    throw FileError(arguments.front(), "cannot be started", "give a program `lacuna`");
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0)
    if (errno != EINTR) break;
  return {cpu_time_of(usage), static_cast<double>(usage.ru_maxrss) / 1024.0};
}

std::string gist_of_model(const Json& model) {
  std::vector<std::string> equations;
  for (const Json& equation : model.at("equations")) {
    // In the order of the alphabet: programs may differ in it.
    std::set<std::string> terms;
    for (const Json& term : equation.at("terms")) terms.insert(term.at("term"));
    equations.push_back(equation.at("state").get<std::string>() + ": " +
                        join(std::vector<std::string>(terms.begin(), terms.end()), ", "));
  }
  return join(equations, "; ");
}

std::string gist_of_diagnosis(const Json& diagnosis) {
  std::string text = diagnosis.at("verdict");
  for (const Json& effect : diagnosis.at("effects"))
    text += "; " + effect.at("name").get<std::string>() + " in " +
            effect.at("equation").get<std::string>();
  return text;
}

/// Runs of one program with one question.
struct Runs {
  std::vector<double> cpu;
  double memory = 0.0;
  std::string gist = {};

  void add(const Cost& cost) {
    cpu.push_back(cost.cpu);
    memory = std::max(memory, cost.memory);
  }
  double median() const {
    std::vector<double> sorted = cpu;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

void ask(Runs& runs, const std::string& program, std::vector<std::string> arguments,
            const std::vector<std::string>& more, const fs::path& answer) {
  fs::remove(answer);
  arguments.insert(arguments.begin(), program);
  arguments.insert(arguments.end(), {"--json", answer.string()});
  arguments.insert(arguments.end(), more.begin(), more.end());
  runs.add(run_program(std::move(arguments)));
  runs.gist = gist_of(answer);
}

}  // namespace

double cpu_time_of(const rusage& usage) {
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string gist_of(const fs::path& answer) {
  std::ifstream file(answer);
  const Json json = Json::parse(file, nullptr, false);
  if (json.is_discarded()) return "none";
  return json.contains("effects") ? gist_of_diagnosis(json) : gist_of_model(json.at("model"));
}

ResultTable compared(const TwoPrograms& programs, const std::vector<QuestionMaker>& questions) {
  ResultTable table{{"question", "samples", "before s", "now s", "now / before", "first answer s",
                     "MB before", "MB now", "same", "answer now"},
                    {}};
  for (const QuestionMaker& maker : questions) {
    const Question question = maker.make();
    const fs::path folder = programs.work / question.name;
    fs::create_directories(folder);
    const std::vector<std::string> arguments = question.write(folder);
    Runs before, now, first;
    for (std::size_t k = 0; k < programs.repeats; ++k) {
      ask(before, programs.before, arguments, {}, folder / "before.json");
      ask(now, programs.now, arguments, {}, folder / "now.json");
      ask(first, programs.now, arguments, {"--effort", "quick"}, folder / "first.json");
    }
    table.rows.push_back({question.name, question.size, format_number(before.median(), 3),
                          format_number(now.median(), 3),
                          format_number(now.median() / before.median(), 3),
                          format_number(first.median(), 3), format_number(before.memory, 3),
                          format_number(now.memory, 3),
                          before.gist == now.gist ? "yes" : "no, before: " + before.gist,
                          now.gist});
    std::cerr << join(table.rows.back(), " | ") << std::endl;
  }
  return table;
}

}  // namespace lacuna::benchmarks
