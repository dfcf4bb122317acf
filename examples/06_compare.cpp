// SPDX-License-Identifier: MIT
// Regressors compared on Rossler's system under rising noise, as a table that gnuplot draws.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <lacuna/lacuna.hpp>

int main() {
  using namespace lacuna;
  const TestSystem rossler = test_system("rossler");
  BenchTask task{.data = record_of(rossler.model, rk4(), rossler.start, rossler.step, 2000),
                 .truth = rossler.model,
                 .kinds = {"regressor"},
                 .noise = {1e-4, 3e-4, 1e-3, 3e-3, 1e-2},
                 .draws = 3};
  for (const Stage<Regressor>& regressor :
       {ols(), stlsq(), frols(), best_subset(), irls_l1({coordinate_descent()})})
    task.compositions.push_back({{std::string(regressor->info().name)},
                                 {monomials({.max_degree = 2}), strong_form({savitzky_golay()}),
                                  abm(), regressor, keep_all(), no_refiner()}});
  const BenchResult result = bench(task);

  std::cout << std::setw(12) << "noise";
  for (const auto& parts : result.parts) std::cout << std::setw(12) << parts[0];
  std::cout << std::setprecision(2);
  for (std::size_t level = 0; level < result.noise.size(); ++level) {
    std::cout << '\n' << std::setw(12) << result.noise[level];
    for (std::size_t c = 0; c < result.parts.size(); ++c) {
      const BenchSummary all = summary_of(result.cell(c, level));
      // Where no draw gave a model there is no error, and gnuplot leaves out the point.
      std::cout << std::setw(12) << all.coefficient_error.value_or(NAN);
    }
  }
  std::cout << '\n';
}
