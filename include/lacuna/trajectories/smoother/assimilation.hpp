// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/records/binding/bound_records.hpp"
#include "lacuna/trajectories/smoother/innovation_filter.hpp"

namespace lacuna {

/// A summand of what is measured of a state: coefficient x form, with the form taken on the
/// path.
struct ChannelTerm {
  Index state = 0;
  Expression form;
  double coefficient = 0.0;
};

/// A change of the deviance that no test would notice: where iterations end.
inline constexpr double kUnnoticedDeviance = 0.1;

/// How a model is brought onto records.
struct AssimilationOptions {
  std::vector<CoefficientPlace> free = {};    ///< coefficients that are fitted
  std::vector<CoefficientPrior> priors = {};  ///< tolerances of fitted coefficients
  /// Equations that may be disturbed; nothing: all but identities.
  std::optional<std::vector<bool>> disturbed = {};
  /// Noise with a memory per state, where the fit of its size begins; empty: none.
  std::vector<std::optional<ColouredNoise>> coloured = {};
  int passes = 12;  ///< at most so many linearisations
  /// States that nobody measured (hidden_states()); empty: there are none.
  std::vector<bool> hidden = {};
  /// With hidden states: of the first so many free coefficients, directions of which the
  /// records determine nothing are held.
  std::size_t held_among = 0;
  /// held_among x h, orthonormal: relative changes of these that no record determines
  /// (UnseenChanges); empty: none.
  Matrix unseen = {};
  /// Free coefficients that are kept as they are, so that these changes do not happen.
  std::vector<Index> units = {};
};

/// A model brought onto records: its coefficients, the path, and what separates the two.
///
/// Path, coefficients and variances are the maximum of the likelihood of the linearised model,
/// found by taking turns: linearise along the path, variances by the BFGS method with the
/// gradient from the smoother's sums, coefficients by least squares on the whitened
/// innovations, path by the smoother.
struct Assimilation {
  OdeModel model;
  std::vector<LinearisedRecord> records = {};
  std::vector<Matrix> measured = {};  ///< per record n x m
  std::vector<Matrix> omitted = {};   ///< per record n x m, or 0 x 0
  NoiseModel noise = {};
  Vector least_noise = {};        ///< m: what white measurement noise cannot be less than
  Vector estimated_noise = {};    ///< m: of samples beside their neighbours; 0: none
  NoiseCurvature curvature = {};  ///< of the deviance over the noise model
  double deviance = 0.0;          ///< -2 log likelihood
  Index used = 0;                 ///< samples of all channels
  std::vector<CoefficientPlace> free = {};
  std::vector<ChannelTerm> channel_terms = {};  ///< their coefficients are always fitted
  Matrix covariance = {};  ///< of the free coefficients, then of those of the channel terms
  /// As rows of `covariance` x h: relative changes of the coefficients of which the records
  /// determine nothing, and which were held; 0 columns where every state is known.
  Matrix held = {};
  std::vector<Index> units = {};  ///< of the coefficients: those that were kept as they are
};

/// Standard deviations of the measurement noise below which nothing can be said: rounding of
/// the numbers in the record. m entries.
Vector resolution_of(const Dataset& data);

/// All coefficients of equations that are not identities (dq/dt = v).
std::vector<CoefficientPlace> free_coefficients(const OdeModel& model);

/// Sizes of everything that is fitted where directions may be undetermined, one entry each: of
/// the first `count` free coefficients; 0, free to be anything, of the others and of the
/// channel terms.
Vector sizes_of(const Assimilation& fit, std::size_t count);

/// Adds what is known beforehand to a least-squares problem of everything that is fitted.
/// @param normal, right k x k and k: normal matrix and right side, perhaps of more behind the
///   coefficients.
void add_priors(const Assimilation& fit, const std::vector<CoefficientPrior>& priors,
                Matrix& normal, Vector& right);

/// What was measured of a record (n x m), without the summands that the measurement has; these
/// are taken on the record's path.
Matrix without_channel_terms(Matrix measured, const LinearisedRecord& record,
                             const Variables& variables, const std::vector<ChannelTerm>& terms);

/// A start with the noise that samples show, where an assimilation has much less. Beside
/// disturbances that explain all, the noise shrinks to where the likelihood hardly depends on
/// it, and stays there when they are gone.
std::optional<Assimilation> with_estimated_noise(const Assimilation& fit);

/// An assimilation, or one that begins where it ended but with_estimated_noise(), if that is
/// better.
Assimilation settled(Assimilation found, const Dataset& data,
                     const AssimilationOptions& options, const RunContext& context);

/// Brings a model onto records, their outliers left out (see run_filter); the noise is
/// settled().
Assimilation assimilate(const OdeModel& model, const BoundRecords& records,
                        const AssimilationOptions& options, const RunContext& context);

/// assimilate() that begins where another one ended; its records' paths and noise are the
/// start.
Assimilation assimilate_from(const OdeModel& model, const Dataset& data,
                             const Assimilation& start, const AssimilationOptions& options,
                             const RunContext& context);

}  // namespace lacuna
