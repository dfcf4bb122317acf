// SPDX-License-Identifier: MIT
// What the records of a fit already determine.
#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/trajectories/design/plan.hpp"
#include "trajectories/fit/fit_solver.hpp"

namespace lacuna {
namespace {

/// Where the fit ended: numbers and initial states of each record.
FitPoint end_of(const Fit& fit, const ParametrisedModel& model) {
  const auto records = static_cast<Index>(fit.initial.size());
  FitPoint point{model.values().transpose().replicate(records, 1),
                 Matrix::Zero(records, model.symbolic().dimension())};
  for (Index r = 0; r < records; ++r)
    for (Index k = 0; k < point.starts.cols(); ++k)
      point.starts(r, k) =
          fit.initial[static_cast<std::size_t>(r)][static_cast<std::size_t>(k)].value;
  return point;
}

}  // namespace

Matrix information_of(const Fit& fit, const Dataset& data) {
  const ParametrisedModel model = fit.model.parametrised();
  FitEngine engine = fit_engine(model, fit_records(model, data));
  if (engine.records.records() != static_cast<Index>(fit.initial.size()) ||
      engine.count() != static_cast<Index>(fit.quality.size()))
    throw ArgumentError("information_of", "the records are not those of the fit",
                        "give the records that were fitted");
  for (Index c = 0; c < engine.count(); ++c) {
    const double rmse = fit.quality[static_cast<std::size_t>(c)].rmse;
    // Residuals that are rounding would make all numbers exact.
    if (std::isfinite(rmse)) engine.sigma[c] = std::max(rmse, 1e-9 * engine.sigma[c]);
  }
  if (fit.substeps > 0) set_substeps(engine, fit.substeps);
  const FitPoint point = end_of(fit, model);
  if (fit.substeps == 0) choose_method(engine, point);
  const FitUnknowns unknowns = fit_unknowns(model, {});
  const FitPath path = follow(engine, point, {});
  if (!std::isfinite(path.cost))
    throw DataError("records", "the fitted model has no finite path along them",
                    "give the records that were fitted");
  const FitLinear linear = linearise(engine, unknowns, point, path, {});
  const Index g = static_cast<Index>(unknowns.global.size());
  const Matrix root = linear.reduced.leftCols(g);
  return root.transpose() * root;
}

std::vector<Experiment> experiments_of(const Fit& fit, const Dataset& data,
                                       const PlanProblem& problem) {
  std::vector<Experiment> made;
  for (std::size_t r = 0; r < data.trajectories.size(); ++r) {
    const Trajectory& run = data.trajectories[r];
    Experiment one{run.time.array() - run.time[0],
                   Matrix(run.samples(), static_cast<Index>(problem.inputs.size())),
                   Matrix::Ones(run.samples(), static_cast<Index>(problem.channels.size()))};
    for (std::size_t i = 0; i < problem.inputs.size(); ++i) {
      const std::vector<std::string> names = names_of(data.inputs);
      const auto column = std::find(names.begin(), names.end(), problem.inputs[i].name);
      if (column == names.end())
        throw ArgumentError("input " + problem.inputs[i].name, "the records lack it",
                            suggestion(problem.inputs[i].name, names));
      one.inputs.col(static_cast<Index>(i)) = run.inputs.col(column - names.begin());
    }
    if (r < fit.initial.size())
      for (const FittedStart& start : fit.initial[r])
        one.starts.push_back({start.state, start.value, start.value,
                              start.fixed ? 0.0 : start.standard_error.value_or(0.0)});
    made.push_back(std::move(one));
  }
  return made;
}

}  // namespace lacuna
