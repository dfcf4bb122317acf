// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"

namespace lacuna {

/// By what functions that are no polynomials are sought, and when they are the answer. What
/// half and double of each changes is in docs/decisions.md.
struct FormOptions {
  static constexpr StageInfo kInfo{
      "forms", "When functions that are no polynomials stand beside a library or in its place",
      ""};

  double worth_asking = 1e-5;
  int most_forms = 3;
  int fewest_parameters = 3;
  double same = 0.1;
  double mostly_noise = 2.0;
  double significance = 4.0;

  int rough_fits = 100;
  int exact_fits = 6;
  int thinned = 60;
  double takes = 0.5;
  int denominators = 8;

  double alike = 0.99;
  double jump_samples = 0.15;
  double jump_far = 0.1;
  double jump_varies = 0.3;

  void describe(OptionVisitor& v);
};

}  // namespace lacuna
