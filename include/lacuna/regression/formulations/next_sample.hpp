// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/formulation.hpp"

namespace lacuna {

/// Options of NextSample: none.
struct NextSampleOptions {
  static constexpr StageInfo kInfo{"next-sample",
                                   "Rows are samples, the target is the next sample: a map",
                                   "Brunton, Proctor & Kutz, PNAS 113 (2016) 3932"};

  void describe(OptionVisitor&) {}
};

/// The form of discrete time: for every sample n of every record but its last
///
///   sum_j h_kj tau_j(t[n], x[n], u[n]) ~ x_k[n+1],   k = 1..m.
///
/// Rows are white where the map is disturbed at random. Noise of the measurement is in the
/// target and in the terms: a residual is v[n+1] - Df v[n], coefficients are biased by its
/// square.
///
/// assemble() throws DataError for records with derivatives or with states that are derivatives
/// of others, and ConfigError for delayed terms.
class NextSample final : public Configured<Formulation, NextSampleOptions> {
 public:
  using Configured::Configured;

 private:
  LeastSquaresSystem do_assemble(const Dataset& data, const TermLibrary& library,
                                 const RunContext& context) const override;
  std::optional<Vector> do_target_noise(const Dataset& data,
                                        const Vector& state_noise) const override;
  Evolution do_evolution() const override { return Evolution::Map; }
};

}  // namespace lacuna
