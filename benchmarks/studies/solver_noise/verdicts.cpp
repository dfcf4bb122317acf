// SPDX-License-Identifier: MIT
#include "verdicts.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <span>
#include <vector>

#include "core/base/text.hpp"
#include "identify/validation/validate.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "records.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

constexpr std::array<double, 3> kFloors{1e-4, 2e-4, 4e-4};

/// A model of one record as it is judged.
struct Judged {
  bool done = false;
  bool exact = false;
  std::array<ValidationVerdict, kFloors.size()> verdicts{};
  double step = 0.0, window = 0.0;  ///< largest errors of both tests, of the motion
  double noise = 0.0;               ///< the most that the noise can be, of the motion

  auto fields() { return std::tie(done, exact, verdicts, step, window, noise); }
};

double largest_fraction(const PredictionTest& test) {
  double fraction = 0.0;
  for (const PredictionError& state : test.states)
    if (state.freedom >= 1.0) fraction = std::max(fraction, state.fraction());
  return fraction;
}

double largest_noise(const PredictionTest& test) {
  double fraction = 0.0;
  for (const PredictionError& state : test.states)
    if (state.freedom >= 1.0) fraction = std::max(fraction, state.noise / state.motion);
  return fraction;
}

Judged judged(const Flow& flow, const Making& making) {
  Judged outcome;
  try {
    const Dataset record = solver_record(flow, making);
    const Pipeline pipeline = algorithm1();
    const IdentificationResult found = identify(record, pipeline);
    outcome.exact = compare_models(found.model, flow.model).exact_structure;
    for (std::size_t i = 0; i < kFloors.size(); ++i) {
      const Validation validation =
          validate({found, record, pipeline}, {.resolution = kFloors[i]});
      outcome.verdicts[i] = validation.verdict;
      outcome.step = largest_fraction(validation.one_step);
      outcome.window = largest_fraction(validation.windows);
      outcome.noise = largest_noise(validation.windows);
    }
    outcome.done = true;
  } catch (const Error& error) {
    std::cerr << flow.name << ", " << making.name << ": " << error.what() << '\n';
  }
  return outcome;
}

/// Counts of the models that hold a predicate.
struct Counts {
  int models = 0;
  std::array<int, kFloors.size()> fit{};
  double least = 1e300, most = 0.0;

  void add(const Judged& one) {
    ++models;
    for (std::size_t i = 0; i < kFloors.size(); ++i)
      fit[i] += one.verdicts[i] == ValidationVerdict::FitsToNoise ? 1 : 0;
    least = std::min(least, one.window);
    most = std::max(most, one.window);
  }

  void write(bool largest, std::vector<std::string>& row) const {
    row.push_back(std::to_string(models));
    for (const int count : fit) row.push_back(std::to_string(count));
    row.push_back(models > 0 ? format_number(largest ? most : least, 2) : "");
  }
};

std::vector<std::string> header() {
  std::vector<std::string> names{"records by", "exact"};
  const auto add_floors = [&](const std::string& last) {
    for (const double floor : kFloors) names.push_back("fit, floor " + format_number(floor));
    names.push_back(last);
  };
  add_floors("largest error");
  names.push_back("wrong");
  add_floors("least error");
  return names;
}

}  // namespace

int write_verdicts(const StudyArguments& arguments) {
  std::vector<Flow> all = flows();
  const std::size_t polynomial = all.size();
  for (Flow& flow : flows_beyond_polynomials()) all.push_back(std::move(flow));
  const std::vector<Making> ways = makings();
  Cells<Judged> cells;
  for (const Making& making : ways) {
    cells.begin_group(making.name);
    for (const Flow& flow : all) cells.add(flow.name, [&] { return judged(flow, making); });
  }
  const auto finished = run_cells(arguments.store("verdicts"), cells);
  if (!finished) return 0;
  ResultTable summary{header(), {}};
  ResultTable details{{"records by", "flow", "exact", "verdict", "error of a step",
                       "error of a period", "noise at most"},
                      {}};
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const Making& making = ways[k];
    const std::span<const Judged> outcomes = finished->group(k);
    Counts exact, wrong;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Judged& one = outcomes[i];
      if (!one.done) continue;
      if (i >= polynomial)
        wrong.add(one);
      else if (one.exact)
        exact.add(one);
      details.rows.push_back({making.name, all[i].name, one.exact ? "1" : "0",
                              to_string(one.verdicts[1]), format_number(one.step, 3),
                              format_number(one.window, 3), format_number(one.noise, 3)});
    }
    std::vector<std::string> row{making.name};
    exact.write(true, row);
    wrong.write(false, row);
    summary.rows.push_back(std::move(row));
  }
  write_results(
      arguments.folder_at(1), "verdicts", details.csv(),
      "# Verdicts on records without noise\n\n`study_solver_noise verdicts FOLDER`, " +
          finished->origin.day + ", " + finished->origin.machine +
          ". Models that monomials up to degree 3 give. *Exact*: exactly the true terms of one "
          "of twelve polynomial flows; *wrong*: flows whose right-hand sides are no "
          "polynomials. *Fit*: the verdict is \"fits to noise\", by the floor of the verdict "
          "(`validation.resolution`). Errors: the largest of all states over windows of a mean "
          "period, as a share of the motion.\n\n" +
          summary.markdown());
  std::cout << summary.markdown();
  return 0;
}

}  // namespace lacuna::benchmarks
