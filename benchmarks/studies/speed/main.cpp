// SPDX-License-Identifier: MIT
// Time to the first and to the final answer of everyday questions. Usage:
// study_speed [OUTPUT_FOLDER] [PART_OF_A_NAME] [REPEATS] [DATA_FOLDER] [quick|normal|full|limit]
//             (default build/studies/speed, all, 1, $LACUNA_DATA, all of them)
// study_speed OUTPUT_FOLDER PART_OF_A_NAME REPEATS DATA_FOLDER '' PROGRAM_BEFORE PROGRAM_NOW
// asks two programs `lacuna`, in turns, and writes the table two_programs. Parts of names are
// separated by semicolons; 'own case' stands for the simulated cases of study_hidden.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <sstream>

#include "core/base/text.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "questions.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"
#include "two_programs.hpp"

namespace lacuna::benchmarks {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLimit = 1.0;  // seconds of a run with a time limit

/// CPU time of all threads, seconds.
double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return cpu_time_of(usage);
}

/// Of the process so far, MB.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// A reply and what it took.
struct Timed {
  Reply reply;
  double wall = 0.0, cpu = 0.0;  ///< seconds
};

Timed timed(const Question& question, Thoroughness effort, std::optional<double> limit) {
  RunContext context;
  context.threads = static_cast<int>(cores());
  const auto begin = Clock::now();
  if (limit)
    context.deadline =
        begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*limit));
  const double before = cpu_seconds();
  Timed result;
  try {
    result.reply = question.ask(effort, context);
  } catch (const std::exception& error) {
    result.reply.answer = error.what();
  }
  result.wall = std::chrono::duration<double>(Clock::now() - begin).count();
  result.cpu = cpu_seconds() - before;
  return result;
}

/// The run with the median CPU time of so many.
Timed median_of(const Question& question, Thoroughness effort, std::optional<double> limit,
                std::size_t repeats) {
  std::vector<Timed> runs;
  for (std::size_t k = 0; k < repeats; ++k) runs.push_back(timed(question, effort, limit));
  std::sort(runs.begin(), runs.end(),
            [](const Timed& a, const Timed& b) { return a.cpu < b.cpu; });
  return runs[runs.size() / 2];
}

/// CPU seconds of what does not change with the library's searches: 2e6 steps of Lorenz' system.
double calibration() {
  constexpr Index kSamples = 500000;
  constexpr double kStep = 0.01;
  const TestSystem& lorenz = test_system("lorenz");
  const double before = cpu_seconds();
  record_of(lorenz.model, rk4(), lorenz.start, kStep, kSamples);
  return cpu_seconds() - before;
}

struct Way {
  std::string name;
  Thoroughness effort;
  std::optional<double> limit;
};

std::vector<Way> ways_of(const std::string& wanted) {
  std::vector<Way> ways;
  for (const Way& way : {Way{"quick", Thoroughness::Quick, {}},
                         Way{"normal", Thoroughness::Normal, {}},
                         Way{"full", Thoroughness::Full, {}},
                         Way{"limit", Thoroughness::Normal, kLimit}})
    if (wanted.empty() || wanted.find(way.name) != std::string::npos) ways.push_back(way);
  return ways;
}

/// Questions whose names have one of the wanted parts; without any, those of everyday.
std::vector<QuestionMaker> wanted_questions(const std::string& data, const std::string& wanted) {
  std::vector<QuestionMaker> all = everyday_questions(data), questions;
  if (wanted.empty()) return all;
  for (QuestionMaker& maker : own_cases()) all.push_back(std::move(maker));
  for (QuestionMaker& maker : all) {
    std::istringstream parts(wanted);
    bool is_wanted = false;
    for (std::string part; std::getline(parts, part, ';');)
      is_wanted = is_wanted || maker.name.find(part) != std::string::npos;
    if (is_wanted) questions.push_back(std::move(maker));
  }
  return questions;
}

void compare_programs(const StudyArguments& arguments,
                      const std::vector<QuestionMaker>& questions, std::size_t repeats) {
  const std::filesystem::path folder = arguments.folder_at(0);
  const ResultTable table = compared(
      {arguments.at(5), arguments.at(6), repeats, folder / "two_programs"}, questions);
  write_results(folder, "two_programs", table.csv(),
                "# Everyday questions to two programs\n\n" + machine_description() + ", " +
                    today() +
                    ". CPU seconds of the command, with reading of the files, medians of " +
                    std::to_string(repeats) +
                    "; the programs take turns.\nThe first answer is that of `--effort quick`. "
                    "Answers are compared by their terms, verdicts and names.\nCommand: "
                    "`study_speed FOLDER '" +
                    arguments.at(1) + "' " + std::to_string(repeats) +
                    " DATA '' PROGRAM_BEFORE PROGRAM_NOW`\n\n" + table.markdown());
}

int run(const StudyArguments& arguments) {
  const char* given = std::getenv("LACUNA_DATA");
  const std::string data = arguments.at(3, given != nullptr ? given : "");
  const std::size_t repeats = std::max<std::size_t>(1, arguments.count_at(2, 1));
  const std::vector<QuestionMaker> questions = wanted_questions(data, arguments.at(1));
  if (!arguments.at(6).empty()) {
    compare_programs(arguments, questions, repeats);
    return 0;
  }
  const double kernel = calibration();
  ResultTable table{{"question", "samples", "way", "wall s", "CPU s", "CPU / kernel", "peak MB",
                     "left out", "answer"},
                    {}};
  for (const QuestionMaker& maker : questions) {
    const Question question = maker.make();
    for (const Way& way : ways_of(arguments.at(4))) {
      const Timed one = median_of(question, way.effort, way.limit, repeats);
      table.rows.push_back({question.name, question.size, way.name, format_number(one.wall, 3),
                            format_number(one.cpu, 3), format_number(one.cpu / kernel, 3),
                            format_number(peak_memory(), 3), one.reply.left_out,
                            one.reply.answer});
      std::cerr << join(table.rows.back(), " | ") << std::endl;
    }
  }
  write_results(arguments.folder_at(0), "speed", table.csv(),
                "# Everyday questions\n\n" + machine_description() + ", " + today() +
                    "; calibration kernel (2e6 evaluations of Lorenz' system by steps of "
                    "Runge and Kutta) " +
                    format_number(kernel, 3) +
                    " s. Medians of " + std::to_string(repeats) +
                    ".\n`quick` is the first answer, `normal` the final one, `full` what a run "
                    "that looks everywhere takes, `limit` a run of at most " +
                    format_number(kLimit) + " s.\nCommand: `study_speed FOLDER '' " +
                    std::to_string(repeats) + "`\n\n" + table.markdown());
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"speed", "[OUTPUT_FOLDER] [PART_OF_A_NAME] [REPEATS] [DATA_FOLDER] [WAYS] "
       "[PROGRAM_BEFORE PROGRAM_NOW]",
       lacuna::benchmarks::run},
      argc, argv);
}
