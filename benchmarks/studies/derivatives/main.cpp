// SPDX-License-Identifier: MIT
// Every differentiator on twelve signals with noise of 0.1 to 20 %: the error of the rate, and
// how near `auto` is to the best of the others. Usage:
// study_derivatives [OUTPUT_FOLDER] [DRAWS] [--cells FOLDER]
//                   (default build/studies/derivatives, 4)
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <tuple>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "signals.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

struct Case {
  const Signal* signal = nullptr;
  Index samples = 0;
  double noise = 0.0;  ///< fraction of the signal's standard deviation
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Signal& signal : signals())
    for (const Index samples : {Index{200}, Index{800}})
      for (const double noise : {0.001, 0.01, 0.05, 0.2}) all.push_back({&signal, samples, noise});
  return all;
}

double deviation(const Vector& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

/// rms of the rate's error over the rms of the rate, of all draws.
double rate_error(const Stage<Differentiator>& method, const Case& one, std::size_t draws) {
  const Vector time = Vector::LinSpaced(one.samples, 0.0, one.signal->length);
  const Matrix truth = one.signal->at(time);
  double sum = 0.0;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    Random random(100 + draw);
    Dataset data;
    data.states = {{"x", ""}};
    Matrix noisy = truth.col(0);
    const double sigma = one.noise * deviation(truth.col(0));
    for (Index i = 0; i < noisy.rows(); ++i) noisy(i, 0) += sigma * random.normal();
    data.trajectories.push_back({"", time, noisy, Matrix(time.size(), 0), Matrix()});
    const Matrix rate = fitted_to(method, data)->differentiate(time, noisy);
    sum += (rate.col(0) - truth.col(1)).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(draws)) / truth.col(1).norm();
}

struct RateError {
  double value = 0.0;
  auto fields() { return std::tie(value); }
};

std::string name_of(const Case& one, std::string_view method) {
  return one.signal->name + " " + std::to_string(one.samples) + " " + format_number(one.noise) +
         " " + std::string(method);
}

/// Fraction of cases in which `auto` is the best of the others or within a tenth of it.
double near_best(const std::vector<std::vector<double>>& errors, std::size_t automatic) {
  double near = 0.0;
  for (const std::vector<double>& row : errors) {
    double best = INFINITY;
    for (std::size_t m = 0; m < row.size(); ++m)
      if (m != automatic) best = std::min(best, row[m]);
    near += row[automatic] <= 1.1 * best ? 1.0 : 0.0;
  }
  return near / static_cast<double>(errors.size());
}

ResultTable table_of(const std::vector<Case>& all,
                     const std::vector<Stage<Differentiator>>& methods,
                     const std::vector<std::vector<double>>& errors) {
  ResultTable table{{"signal", "samples", "noise %"}, {}};
  for (const auto& method : methods) table.header.emplace_back(method->info().name);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::string> row{all[i].signal->name, std::to_string(all[i].samples),
                                 format_number(100.0 * all[i].noise)};
    const double best = *std::min_element(errors[i].begin(), errors[i].end());
    for (const double error : errors[i]) {
      const std::string text = format_number(100.0 * error, 3);
      row.push_back(error <= 1.1 * best ? "**" + text + "**" : text);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

int run(const StudyArguments& arguments) {
  const std::filesystem::path folder = arguments.folder_at(0);
  const std::size_t draws = arguments.count_at(1, 4);
  const auto methods = default_registry().make_all<Differentiator>();
  const std::vector<Case> all = cases();
  Cells<RateError> work;
  for (const Case& one : all)
    for (const auto& method : methods)
      work.add(name_of(one, method->info().name),
               [&, draws] { return RateError{rate_error(method, one, draws)}; });
  const auto finished = run_cells(arguments.store(std::to_string(draws)), work);
  if (!finished) return 0;
  std::size_t automatic = 0;
  std::vector<std::vector<double>> errors(all.size());
  for (std::size_t i = 0; i < finished->values.size(); ++i)
    errors[i / methods.size()].push_back(finished->values[i].value);
  for (std::size_t m = 0; m < methods.size(); ++m)
    if (methods[m]->info().name == "auto") automatic = m;
  const double near = near_best(errors, automatic);
  const ResultTable table = table_of(all, methods, errors);
  write_results(folder, "derivatives", table.csv(),
                "Error of the rate (rms, % of the rate's rms) over " + std::to_string(draws) +
                    " draws; bold: within a tenth of the best. `auto` is within a tenth of the "
                    "best of the others, or better, in " +
                    format_number(100.0 * near, 3) + " % of " + std::to_string(all.size()) +
                    " cells.\n\nMade by `study_derivatives` on " + finished->origin.day + ", " +
                    finished->origin.machine + ", in " +
                    format_number(finished->origin.seconds, 3) + " s.\n\n" + table.markdown());
  std::cout << "auto near the best in " << format_number(100.0 * near, 3) << " % of "
            << all.size() << " cells; tables in " << folder << '\n';
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"derivatives", "[OUTPUT_FOLDER] [DRAWS]", lacuna::benchmarks::run}, argc, argv);
}
