// SPDX-License-Identifier: MIT
// The questions of an ordinary afternoon.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/stages_done.hpp"

namespace lacuna::benchmarks {

/// The reply to a question.
struct Reply {
  std::string answer;    ///< terms of each equation, or a verdict and what was named
  std::string left_out;  ///< stages; empty where all were done
};

/// A question with its data in memory.
struct Question {
  std::string name;  ///< "identify lorenz 1e4"
  std::string size;  ///< "10000 x 3"
  std::function<Reply(Thoroughness, const RunContext&)> ask;

  /// Writes what the command needs into a folder. @return its arguments, without --json.
  std::function<std::vector<std::string>(const std::filesystem::path& folder)> write;
};

/// What makes a question; its data are made when it is asked for.
struct QuestionMaker {
  std::string name;
  std::function<Question()> make;
};

/// All twelve, in the order of the table. @param data folder with measured records; questions
/// about those that are not there are left out.
std::vector<QuestionMaker> everyday_questions(const std::filesystem::path& data);

/// A diagnosis of each simulated case at 1 % noise: "own case beam-offset".
std::vector<QuestionMaker> own_cases();

}  // namespace lacuna::benchmarks
