// SPDX-License-Identifier: MIT
// The formulations of lacuna. Each function makes one from its options;
// Registry has the same by name.
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/regression/stages/formulation.hpp"

namespace lacuna {

/// Options of strong_form().
struct StrongFormOptions {
  static constexpr StageInfo kInfo{
      "strong", "Rows are samples, the target is the derivative at the sample",
      "Karimov et al., Nonlinear Dyn. 111 (2023), Sect. 2.1"};

  Stage<Differentiator> differentiator;  ///< where the record brings no derivatives
  bool smooth_states = true;             ///< Theta from the differentiator's order 0

  void describe(OptionVisitor& v) {
    v.field({"differentiator", "", "Gives dx/dt where the record does not bring it."},
            differentiator);
    v.field({"smooth_states", "",
             "Whether terms are evaluated on the signals as the differentiator smooths them."},
            smooth_states);
  }
};

/// The strong form: for every sample i of every record
///
///   sum_j h_kj tau_j(t_i, x(t_i), u(t_i)) ~ dx_k/dt(t_i),   k = 1..m.
///
/// dx/dt is the record's own where it brings it (the states are then used as they are), else
/// the differentiator's. The states and inputs in Theta then are the differentiator's order 0:
/// the fit in a window gives signal and derivative of one and the same polynomial, and signals
/// that went through unequal filters would bias the coefficients. Finite differences smooth
/// nothing. Samples at the ends of a record, where the differentiator is one-sided, have no row
/// unless the record is shorter than four such ends. Long records are passed over in pieces.
Stage<Formulation> strong_form(const StrongFormOptions& options);

/// Options of weak_form().
struct WeakFormOptions {
  static constexpr StageInfo kInfo{
      "weak", "Rows are smooth test functions of compact support, no derivative is taken",
      "Messenger & Bortz, J. Comput. Phys. 443 (2021) 110525"};

  std::optional<double> radius = {};
  std::optional<int> order = {};

  void describe(OptionVisitor& v) {
    v.field(
        {"radius", "time units",
         "Half the support of a test function; chosen from the spectrum of the data when not "
         "given.",
         0.0},
        radius);
    v.field(
        {"order", "",
         "p of the test function (1 - (t/radius)^2)^p; chosen from the noise when not given.",
         2, 60},
        order);
  }
};

/// The weak form: for test functions phi_i that tile every record
///
///   sum_j h_kj int phi_i tau_j(t, x, u) dt ~ - int phi_i' x_k dt,   k = 1..m,
///
/// (6) of Messenger & Bortz 2021, whitened by the covariance that white noise gives the
/// right-hand side, so that noise sigma_k of a state is white noise sigma_k of its target.
/// Grids may be non-uniform. Where the dataset brings derivatives the target is int phi_i
/// dx_k/dt dt.
Stage<Formulation> weak_form(const WeakFormOptions& options = {});

/// Options of integral_form().
struct IntegralFormOptions {
  static constexpr StageInfo kInfo{"integral",
                                   "Rows are intervals, the target is the change of the state",
                                   "Schaeffer & McCalla, Phys. Rev. E 96 (2017) 023302"};

  int span = 10;

  void describe(OptionVisitor& v) {
    v.field({"span", "samples", "Length of an interval.", 1, 100000}, span);
  }
};

/// The integral form: for overlapping intervals of `span` samples
///
///   sum_j h_kj int_a^b tau_j(t, x, u) dt ~ x_k(b) - x_k(a),   k = 1..m,
///
/// whitened like the weak form. Intervals start every half span.
Stage<Formulation> integral_form(const IntegralFormOptions& options = {});

/// Options of next_sample(): none.
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
Stage<Formulation> next_sample(const NextSampleOptions& options = {});

}  // namespace lacuna
