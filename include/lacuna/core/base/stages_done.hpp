// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"

namespace lacuna {

/// How much of the search for an answer is done. Every one ends with a whole answer.
enum class Thoroughness {
  Quick,   ///< the stages that an answer needs
  Normal,  ///< all stages, each as far as something can be gained by it
  Full,    ///< all stages to their end, whatever can be gained by it
};

/// A stage of a run, and whether its result is in the answer.
struct StageDone {
  std::string name;      ///< "equations", "trajectories", "forms", ...
  bool done = true;      ///< or left out
  std::string why = {};  ///< it was left out; empty where it was done
};

/// Why what a deadline ends is left out.
inline constexpr const char* kTimeIsUp = "the time limit came first";

/// Why what a quick run does not do is left out.
inline constexpr const char* kIsQuick = "--effort quick";

/// The last stage in a list that was done: the one that the answer comes from; "" without one.
std::string answer_from(const std::vector<StageDone>& stages);

/// "left out: forms, relations (the time limit came first)": all stages that were left out for
/// want of time or of effort; empty where none was.
std::string left_out_line(const std::vector<StageDone>& stages);

/// Runs a stage and enters in the list whether its time was enough.
/// @param work throws OutOfTime where it was not; nothing of it is kept then.
/// @return whether the stage was done.
template <class Work>
bool run_stage(std::vector<StageDone>& stages, const char* name, Work work) {
  try {
    work();
  } catch (const OutOfTime&) {
    stages.push_back({name, false, kTimeIsUp});
    return false;
  }
  stages.push_back({name});
  return true;
}

}  // namespace lacuna
