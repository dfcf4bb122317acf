// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "diagnose/candidates/candidate_column.hpp"
#include "lacuna/core/base/run_context.hpp"

namespace lacuna {

/// What a candidate explains.
struct Score {
  double gain = 0.0;  ///< drop of the sum of squares of the whitened innovations
  double coefficient = 0.0;
};

/// A candidate with the shape parameters at which it explains most.
struct ScreenedCandidate {
  Candidate candidate;
  Vector shapes;
  double coefficient = 0.0;
  double gain = 0.0;  ///< drop of the sum of squares of the whitened innovations
  Index tried = 0;    ///< shapes that were tried

  /// Takes these shapes when they explain more.
  void consider(const Vector& at, const Score& score);
};

/// Score tests of candidates against a model that was brought onto records.
///
/// With the innovations e, the nominal columns N and a candidate's column c, all whitened, and
/// P = I - N (N'N)^-1 N', the gain is (c'Pe)^2 / (c'Pc): the drop of the sum of squares when
/// the candidate comes in and all nominal coefficients are refitted. Under the model it is
/// chi-squared with one degree of freedom.
class Screening {
 public:
  /// The assimilation must outlive the screening.
  explicit Screening(const Assimilation& assimilation);

  /// Gain and coefficient (within the candidate's bounds) at given shapes; gain 0 where the
  /// candidate cannot be distinguished from the nominal terms or is not finite.
  Score score(const Candidate& candidate, std::span<const double> shapes) const;

  /// score() of several that are all in the same place and equation, which costs less.
  std::vector<Score> scores(std::span<const Probe> probes) const;

  /// Best of the starting points.
  ScreenedCandidate at_starts(const Candidate& candidate) const;

  /// Searches the shapes from where they are (nelder_mead()).
  void polish(ScreenedCandidate& screened) const;

  /// What stands for the assimilation.
  std::string key() const;

  const InnovationSystem& system() const noexcept { return system_; }

  /// Sum of squares of the innovations with the nominal coefficients refitted.
  double residual() const noexcept { return innovations_.squaredNorm(); }

 private:
  const Assimilation& assimilation_;
  InnovationSystem system_;
  Matrix nominal_;      ///< orthonormal columns of the nominal terms
  Vector innovations_;  ///< projected
};

/// What decides in a screening.
struct ScreeningOptions {
  double shape_penalty =
      0.0;  ///< gain that a shape parameter has to bring, as a criterion has it
  double worth_shaping = 0.0;  ///< of the best gain; shapes are not searched below it
};

/// What was found of candidates, for other screenings against the same assimilation. Several
/// threads may use it.
class ScreeningMemory {
 public:
  /// Takes what is known of a candidate. @return whether anything is.
  bool recall(const std::string& key, ScreenedCandidate& candidate);

  void keep(const std::string& key, const ScreenedCandidate& candidate);

 private:
  struct Found {
    Vector shapes;
    Score score;
    Index tried;
  };

  std::mutex guard_;
  std::unordered_map<std::string, Found> found_;
};

/// Screens all candidates: starting points of all, then the shapes of the best of each family
/// and equation. Uses the threads of the context.
/// @param memory of screenings, or null.
/// @return by falling gain less the penalty for the shapes.
std::vector<ScreenedCandidate> screen(const std::vector<Candidate>& candidates,
                                      const Screening& screening,
                                      const ScreeningOptions& options,
                                      const RunContext& context,
                                      ScreeningMemory* memory = nullptr);

}  // namespace lacuna
