// SPDX-License-Identifier: MIT
// A pipeline of one's own: five stages, each with its options.
#include <iostream>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/data/derivatives/savitzky_golay.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/regression/filters/abm.hpp"
#include "lacuna/regression/formulations/strong_form.hpp"
#include "lacuna/regression/pruners/keep_all.hpp"
#include "lacuna/solvers/stlsq.hpp"
#include "lacuna/trajectories/refiners/no_refiner.hpp"

int main() {
  using namespace lacuna;
  const Pipeline pipeline{
      .basis = Monomials{{.max_degree = 2}},
      .formulation = StrongForm{{.differentiator = SavitzkyGolay{{.window = 11, .degree = 4}}}},
      .filter = Abm{},
      .regressor = Stlsq{{.threshold = 0.02}},
      .pruner = KeepAll{},
      .refiner = NoRefiner{},
  };
  const auto result = identify(read_dataset({"data/tl072_record.csv.gz"}), pipeline);
  std::cout << to_text(result.model, 4) << '\n';
}
