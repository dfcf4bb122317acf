// SPDX-License-Identifier: MIT
// A record in, equations out: six stages find them, and samples that took no part judge them.
#include <iostream>
#include <lacuna/lacuna.hpp>

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
  const Dataset record = read_dataset({"data/tl072_record.csv.gz"});
  std::cout << to_text(identify(record, pipeline).model, 3) << '\n';

  // The whole way, with algorithm1() and its monomials of degree 3.
  const Identification found = identify_records(record);
  for (const Equation& equation : found.result.model.equations())
    std::cout << equation.size() << " terms\n";
  if (found.verification) std::cout << found.verification->verdict.sentence << '\n';
  if (found.result.validation) std::cout << found.result.validation->sentence << '\n';
}
