// SPDX-License-Identifier: MIT
#include "refit.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>

namespace lacuna {
namespace {

/// Cost and normal equations at a point.
struct Normal {
  double cost = 0.0;
  Vector gradient;     ///< S' W d - M (p - estimate)
  Matrix information;  ///< S' W S
  double log_det = 0.0;
};

Normal normal_at(ModelRun& run, const Knowledge& knowledge,
                 const std::vector<Experiment>& experiments, const std::vector<Vector>& values,
                 const Vector& parameters) {
  const Vector moved = parameters - run.values;
  Normal normal{moved.dot(knowledge.proper * moved), -knowledge.proper * moved,
                Matrix::Zero(moved.size(), moved.size())};
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    load(run, experiments[e]);
    const LinearPrediction linear = linearise(run, experiments[e], {parameters, {}});
    if (!linear.is_finite) {
      normal.cost = std::numeric_limits<double>::infinity();
      return normal;
    }
    const Matrix d = values[e] - linear.values;
    const Matrix wd = weighted(linear.by_start, d);
    normal.cost += d.cwiseProduct(wd).sum();
    normal.gradient += linear.by_parameter.transpose() * wd;
    const ModelEvidence own = model_evidence(linear);
    normal.information += own.information;
    normal.log_det += own.log_det;
  }
  return normal;
}

Refit refit_from(ModelRun& run, const Knowledge& knowledge,
                 const std::vector<Experiment>& experiments, const std::vector<Vector>& values,
                 Vector parameters) {
  constexpr int kMostSteps = 40;
  // A decrease of the squares below this changes no log Bayes factor that is printed.
  constexpr double kUnnoticed = 1e-3;
  Normal here = normal_at(run, knowledge, experiments, values, parameters);
  double damping = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    Matrix hessian = knowledge.proper + here.information;
    hessian.diagonal() *= 1.0 + damping;
    const Vector next = (parameters + hessian.ldlt().solve(here.gradient))
                            .cwiseMax(run.lower)
                            .cwiseMin(run.upper);
    Normal there = normal_at(run, knowledge, experiments, values, next);
    if (!(there.cost < here.cost)) {
      damping = damping > 0.0 ? 10.0 * damping : 1e-2;
      continue;
    }
    const double gain = here.cost - there.cost;
    parameters = next;
    here = std::move(there);
    damping *= 0.1;
    if (gain < kUnnoticed) break;
  }
  return {parameters, here.cost, here.information, here.log_det};
}

/// The estimates of a rival, with the numbers of a draw where these have the same name: one that
/// contains the right model has its minimum there.
Vector with_same_names(const ModelRun& rival, const ModelRun& right, const Vector& draw) {
  Vector parameters = rival.values;
  const std::vector<std::string> own = rival.engine.model.names();
  const std::vector<std::string> others = right.engine.model.names();
  for (std::size_t i = 0; i < own.size(); ++i)
    for (std::size_t k = 0; k < others.size(); ++k)
      if (own[i] == others[k])
        parameters[static_cast<Index>(i)] = draw[static_cast<Index>(k)];
  return parameters.cwiseMax(rival.lower).cwiseMin(rival.upper);
}

}  // namespace

Refit refit(ModelRun& run, const Knowledge& knowledge,
            const std::vector<Experiment>& experiments, const std::vector<Vector>& values,
            const std::vector<Vector>& other_starts) {
  Refit best = refit_from(run, knowledge, experiments, values, run.values);
  for (const Vector& start : other_starts) {
    Refit other = refit_from(run, knowledge, experiments, values, start);
    if (other.squares < best.squares) best = std::move(other);
  }
  return best;
}

Vector refitted_squares(Rivals& rivals, const std::vector<Experiment>& experiments,
                        std::size_t right, std::size_t rival) {
  const auto& draws = rivals.draws[right];
  Vector squares(static_cast<Index>(draws.size()));
  for (std::size_t k = 0; k < draws.size(); ++k) {
    std::vector<Vector> values;
    ModelRun& truth = rivals.runs[right];
    for (const Experiment& experiment : experiments) {
      load(truth, experiment);
      values.push_back(
          predict(truth, experiment, in_experiment(truth, experiment, draws[k])).values);
    }
    ModelRun& own = rivals.runs[rival];
    squares[static_cast<Index>(k)] =
        refit(own, rivals.knowledge[rival], experiments, values,
              {with_same_names(own, truth, draws[k].parameters)})
            .squares;
  }
  return squares;
}

double log_evidence(ModelRun& run, const Knowledge& knowledge,
                    const std::vector<Experiment>& experiments,
                    const std::vector<Vector>& values) {
  const Refit found = refit(run, knowledge, experiments, values);
  return -0.5 * (found.squares + log_det(knowledge.proper + found.information) -
                 log_det(knowledge.proper) + found.log_det);
}

}  // namespace lacuna
