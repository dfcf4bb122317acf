// SPDX-License-Identifier: MIT
// A pipeline of one's own: five stages, each with its options.
#include <iostream>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/data/read.hpp"
#include "lacuna/differentiators/savitzky_golay.hpp"
#include "lacuna/filters/abm.hpp"
#include "lacuna/formulations/strong_form.hpp"
#include "lacuna/pipeline/pipeline.hpp"
#include "lacuna/pruners/keep_all.hpp"
#include "lacuna/selection/no_refiner.hpp"
#include "lacuna/solvers/stlsq.hpp"

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
