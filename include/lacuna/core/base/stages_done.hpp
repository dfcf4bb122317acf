// SPDX-License-Identifier: MIT
// What an answer was made of, and whether its verdict may be given: all verdicts of identify,
// sync, fit and diagnose pass here.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"

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

/// What a verdict claims of a model, whatever the command calls it.
enum class Claim {
  Fits,             ///< nothing is missing: the model as it is fits to the noise
  CoefficientsOff,  ///< its structure fits to the noise, with other coefficients
  Named,            ///< what is missing has a name, and nothing else is missing
  StructureLeft,    ///< something that is missing has a name, and something has none
  WrongStructure,   ///< what is missing has no name, or no library that was tried has it
};

/// Whether a verdict may be given.
enum class Standing {
  Stands,        ///< as it is claimed
  Undetermined,  ///< the records allow neither it nor its opposite
  Incomplete,    ///< a limit cut the search, and a stage that it left out could change it
};

/// A number that a claim rests on, and the one beyond which it bears none.
struct Bounded {
  double value = 0.0;
  double bound = 0.0;
};

/// Why records allow neither a claim nor its opposite.
struct Doubt {
  std::string why;          ///< a phrase without a full stop
  std::string remedy = {};  ///< what would help, likewise
};

/// What a verdict rests on. Each command fills in what it knows; what is not given is no
/// question there. A new reason to refuse is a field here and a function in the list of
/// admit().
struct VerdictBasis {
  Claim claim = Claim::Fits;
  /// The stages of the search whose result could change the claim, done or left out. Left out
  /// is what left_out_line() lists; what had nothing to gain is not.
  std::vector<StageDone> stages = {};
  /// Coefficients, and named combinations of them, that are off beyond significance: something
  /// that CoefficientsOff can point at.
  std::optional<Index> changed = {};
  /// Numbers that the claim rests on and that the records do not determine.
  std::vector<std::string> open = {};
  /// Whether the records would show the opposite of the claim.
  bool shows_opposite = true;
  /// Nothing moves: what was measured never changes, or is noise.
  bool still = false;
  /// The longest memory of what the claim takes for noise, as a fraction of a record.
  std::optional<Bounded> memory = {};
  /// Stretches of the records in which a model was run, and those in which no run was found to
  /// begin with, although there are some: they are evidence for nothing.
  Index windows = 0, unstarted = 0;
  /// What a test has found that decides nothing: noise, motion, rest, too few samples.
  std::vector<Doubt> doubts = {};
};

/// The answer of admit().
struct Admission {
  Standing standing = Standing::Stands;
  std::string why = {};     ///< a phrase without a full stop; empty where it stands
  std::string remedy = {};  ///< what would help, likewise

  /// Whether the verdict may be given.
  bool stands() const noexcept { return standing == Standing::Stands; }
};

/// Whether a claim rests on what was searched, determined and shown. The first reason against
/// it counts: a search that was cut, before anything that it found is judged.
///
/// Refused are
/// - any claim that a stage could change that was left out: Incomplete;
/// - any claim that rests on numbers that the records do not determine: Undetermined;
/// - any claim of which the records would not show the opposite: Undetermined;
/// - any claim on records in which nothing moves: Undetermined;
/// - any claim that takes for noise what remembers more than a fraction of the record: noise as
///   slow as that is not distinguished from structure: Undetermined;
/// - CoefficientsOff with no coefficient and no combination to point at: Undetermined;
/// - any claim where runs did not start in half of the windows or more: Undetermined;
/// - any claim that a test leaves in doubt: Undetermined, for the first of the doubts.
Admission admit(const VerdictBasis& basis);

}  // namespace lacuna
