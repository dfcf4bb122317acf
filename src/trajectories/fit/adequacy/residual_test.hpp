// SPDX-License-Identifier: MIT
// Whether residuals of a fit are noise, by what a fit leaves of noise.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Rows of one channel in one record, in the order of time.
struct ResidualSequence {
  Index channel = 0;
  std::vector<Index> rows;
};

/// N residuals, each divided by the deviation of its noise.
struct FittedResiduals {
  Vector residual;  ///< N
  Vector model;     ///< N: the fitted values
  std::vector<ResidualSequence> sequences;
  Index channels = 0;
};

/// The directions in the space of the residuals that a fit takes from them: the columns of its
/// linear problem, of unknowns that each record has for itself and of those in common.
class FittedDirections {
 public:
  /// @param rows N x (own + common), rows of one record behind those of another.
  /// @param begins first row of each record, then N.
  FittedDirections(const Matrix& rows, std::vector<Index> begins, Index own);

  /// Takes them from values, N: v - Q Q'v.
  void remove(Vector& values) const;

  Index rank() const;  ///< how many there are

  /// N: which fraction of the variance of each value they take, the diagonal of Q Q'.
  Vector leverage() const;

 private:
  std::vector<Index> begins_;
  std::vector<Matrix> own_;  // of each record: orthonormal
  Matrix common_;            // orthonormal, orthogonal to those
};

/// What the residuals of one channel show.
struct ChannelStructure {
  double chance = 1.0;  ///< probability of residuals like these where the model is right
  double power = 0.0;   ///< probability that a deviation as large as the noise is seen
  std::string sign;     ///< what is most unlikely of them: "trend", "runs", ...
};

/// How the test is made.
struct StructureTestOptions {
  double level = 0.05;     ///< probability by which right models are called wrong
  Index draws = 1999;      ///< of noise; fewer where there are very many rows
  std::uint64_t seed = 1;  ///< of the draws
};

/// Tests of each channel: sign changes (runs), products of neighbours (von Neumann: the
/// residuals beside the noise that their differences show), correlation at lags to 20 (Ljung
/// and Box), offset and trend (the six slowest cosines), sums over blocks of 2, 4, 8, ...
/// samples, products of neighbours in the order of the fitted values (a wrong law), and what
/// records have in common at the same sample (lack of fit against replicates).
///
/// None of them has the distribution of a table, because a fit takes its directions from the
/// residuals, and with few samples these are many. So draws of noise lose the same directions,
/// and the least probability of all tests and channels is compared with its own distribution
/// in these draws (Westfall and Young, Resampling-based multiple testing (1993)): all together
/// have the stated level. The draws are the residuals with random signs, divided by the root of
/// 1 - leverage (the wild bootstrap: Wu, Annals of Statistics 14:1261-1295, 1986; Davidson and
/// Flachaire, J. Econometrics 146:162-169, 2008), so noise need be neither normal nor of one
/// size. Power is that against slow deviations, random sums of the four slowest cosines, with
/// the deviation of the noise after the fit.
/// @return for each channel; chance 1 and power 0 where nothing is left to be tested.
std::vector<ChannelStructure> test_structure(const FittedResiduals& fitted,
                                             const FittedDirections& directions,
                                             const StructureTestOptions& options = {});

}  // namespace lacuna
