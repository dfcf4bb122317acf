// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/term_filter.hpp"

namespace lacuna {

/// Options of Abm.
struct AbmOptions {
  /// In which units eps is understood.
  enum class Tolerances {
    Relative,  ///< columns scaled to unit norm: independent of n, of units and of time scale
    Paper,     ///< columns as they are, as published
  };

  static constexpr StageInfo kInfo{
      "abm", "Adds terms in library order unless the terms already there express them.",
      "Kera & Hasegawa, Nonlinear Dynamics 85 (2016) 675; Karimov et al. 2023, Sect. 2.1"};
  static constexpr std::array<std::string_view, 2> kTolerances{"relative", "paper"};

  Tolerances tolerances = Tolerances::Relative;
  std::optional<double> eps = {};

  /// eps, or the default of the chosen tolerances.
  double effective_eps() const {
    return eps.value_or(tolerances == Tolerances::Relative ? 1e-16 : 1e-5);
  }

  void describe(OptionVisitor& v) {
    v.field({"tolerances", "",
             "'relative': eps refers to columns of unit norm; 'paper': to raw data."},
            kTolerances, tolerances);
    v.field({"eps", "",
             "Smallest eigenvalue of E'E below which a term vanishes; 1e-16 (relative) or 1e-5 "
             "(paper) when not given.",
             0.0},
            eps);
  }
};

/// Approximate Buchberger-Moeller: goes through the candidates in library order and adds one to
/// E (n x k) when the smallest eigenvalue of E'E with it stays at least eps; else the term is
/// removed as vanishing (a combination of lower terms, up to eps).
///
/// With relative tolerances eps is dimensionless: the default 1e-16 is a singular value of 1e-8
/// of columns of unit norm, so only what is numerically dependent goes. E'E is never formed:
/// columns of the system's triangular factor are orthogonalised one by one and the smallest
/// singular value of the small triangle is found by inverse iteration, O(k^2) a step. Source:
/// Karimov et al. 2023, Sect. 2.1 (ABM).
class Abm final : public Configured<TermFilter, AbmOptions> {
 public:
  using Configured::Configured;

 private:
  FilterResult do_filter(const LeastSquaresSystem& system,
                         const RunContext& context) const override;
};

}  // namespace lacuna
