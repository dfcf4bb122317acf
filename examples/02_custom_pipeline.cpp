// SPDX-License-Identifier: MIT
// A pipeline of one's own: five stages, each with its options.
#include <iostream>

#include "lacuna/bases/bases.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/regression/filters.hpp"
#include "lacuna/regression/formulations.hpp"
#include "lacuna/regression/pruners.hpp"
#include "lacuna/solvers/selection.hpp"
#include "lacuna/trajectories/refiners.hpp"

int main() {
  using namespace lacuna;
  const Pipeline pipeline{
      .basis = monomials({.max_degree = 2}),
      .formulation =
          strong_form({.differentiator = savitzky_golay({.window = 11, .degree = 4})}),
      .filter = abm(),
      .regressor = stlsq({.threshold = 0.02}),
      .pruner = keep_all(),
      .refiner = no_refiner(),
  };
  const auto result = identify(read_dataset({"data/tl072_record.csv.gz"}), pipeline);
  std::cout << to_text(result.model, 4) << '\n';
}
