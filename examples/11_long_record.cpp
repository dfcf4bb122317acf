// SPDX-License-Identifier: MIT
// Equations from files that are read in pieces, as those that no memory holds.
#include <iostream>
#include <lacuna/lacuna.hpp>

int main() {
  using namespace lacuna;
  const TestSystem lorenz = test_system("lorenz");
  Dataset part =
      add_relative_noise(record_of(lorenz.model, rk4(), lorenz.start, 0.005, 300000), 1e-4, 1);
  const Trajectory whole = part.trajectories[0];
  for (Index k = 0; k < 3; ++k) {
    part.trajectories[0] = rows_of(whole, k * 100000, 100000);
    write_csv("part-" + std::to_string(k) + ".csv", part);
  }

  const RecordStream records = read_stream({"part-*.csv"});
  std::cout << records.samples() << " samples in " << records.records().size()
            << " records, an excerpt of " << records.excerpt().samples() << '\n';
  const Pipeline pipeline{monomials({.max_degree = 2}),
                          strong_form({finite_differences()}),
                          abm(),
                          ols(),
                          minor_terms(),
                          no_refiner()};
  std::cout << to_text(identify(records, pipeline, {.threads = 2}).model, 4) << '\n';
}
