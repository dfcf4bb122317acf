// SPDX-License-Identifier: MIT
// The same questions put to two programs.
#pragma once

#include <sys/resource.h>

#include <filesystem>
#include <string>
#include <vector>

#include "questions.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {

/// Two programs `lacuna`, of two releases, that answer in turns.
struct TwoPrograms {
  std::string before, now;     ///< files
  std::size_t repeats = 1;     ///< of each question by each program
  std::filesystem::path work;  ///< folder for records and answers
};

/// CPU time of all threads, user and system, in seconds.
double cpu_time_of(const rusage& usage);

/// What an answer (JSON) says, without its numbers: terms of each equation, or the verdict and the
/// effects that were named; "none" where there is no answer.
std::string gist_of(const std::filesystem::path& answer);

/// Medians of CPU time (user and system, all threads), the largest memory, and whether both
/// say the same. What `--effort quick` answers is the first answer of the program of now.
/// @param questions of which the files are made one after another.
ResultTable compared(const TwoPrograms& programs, const std::vector<QuestionMaker>& questions);

}  // namespace lacuna::benchmarks
