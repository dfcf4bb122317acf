// SPDX-License-Identifier: MIT
#include "evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>

#include "core/base/random.hpp"
#include "precision.hpp"

namespace lacuna {
namespace {

/// Standard errors, or prior deviations, of the free numbers in the model; 0: nothing is known.
Vector given_deviations(const SystemModel& system, const ParametrisedModel& model) {
  Vector given = Vector::Zero(model.values().size());
  Index p = 0;
  for (const FreeCoefficient& free : model.coefficients()) {
    const Equation& equation =
        model.symbolic().equations()[static_cast<std::size_t>(free.equation)];
    given[p++] =
        equation[static_cast<std::size_t>(free.summand)].standard_error.value_or(0.0);
  }
  for (const Parameter& parameter : system.parameters())
    if (parameter.free)
      given[p++] = parameter.standard_error.value_or(parameter.deviation.value_or(0.0));
  return given;
}

/// The deviation of each number that is taken where nothing is known: a fraction of its size,
/// at most that of a uniform distribution over its range. The estimate is the size, unless
/// records determine it no better than that.
/// @param errors of the numbers that records have left, NaN: any value; empty: no records.
Vector assumed_deviations(const SystemModel& system, const Vector& values, const Vector& errors,
                          double spread) {
  Vector sizes = sizes_of(values), most = Vector::Constant(values.size(), INFINITY);
  Index p = values.size() - std::count_if(system.parameters().begin(), system.parameters().end(),
                                          [](const Parameter& one) { return one.free; });
  for (const Parameter& parameter : system.parameters()) {
    if (!parameter.free) continue;
    if (parameter.min && parameter.max)
      most[p] = (*parameter.max - *parameter.min) / std::sqrt(12.0);
    ++p;
  }
  for (p = 0; p < errors.size(); ++p)
    sizes[p] = std::isfinite(errors[p])  ? std::max(sizes[p], errors[p])
               : std::isfinite(most[p]) ? most[p] / spread
                                        : sizes[p];
  return (spread * sizes).cwiseMin(most);
}

Matrix inverse_squares(const Vector& deviations) {
  Matrix information = Matrix::Zero(deviations.size(), deviations.size());
  for (Index p = 0; p < deviations.size(); ++p)
    if (deviations[p] > 0.0) information(p, p) = 1.0 / (deviations[p] * deviations[p]);
  return information;
}

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

}  // namespace

Matrix weighted(const Matrix& x, const Matrix& a) {
  // (1 + X X')^-1 = 1 - X (1 + X'X)^-1 X'.
  if (x.cols() == 0) return a;
  const Matrix inner = Matrix::Identity(x.cols(), x.cols()) + x.transpose() * x;
  return a - x * inner.ldlt().solve(x.transpose() * a);
}

PathNumbers in_experiment(const ModelRun& run, const Experiment& experiment,
                          const PathNumbers& draw) {
  return {draw.parameters, starts_in(run, experiment) + draw.starts};
}

ModelEvidence model_evidence(const LinearPrediction& linear) {
  const Matrix& x = linear.by_start;
  ModelEvidence evidence;
  evidence.information = linear.by_parameter.transpose() * weighted(x, linear.by_parameter);
  if (x.cols() == 0) return evidence;
  const Matrix cross = x.transpose() * x;
  const Matrix inner = Matrix::Identity(x.cols(), x.cols()) + cross;
  evidence.log_det = 2.0 * Matrix(inner.llt().matrixL()).diagonal().array().log().sum();
  evidence.freedom = inner.ldlt().solve(cross).trace();
  return evidence;
}

double log_det(const Matrix& symmetric) {
  return symmetric.ldlt().vectorD().cwiseMax(std::numeric_limits<double>::min()).array().log()
      .sum();
}

Knowledge knowledge_of(const PlanModel& model, double spread) {
  const ParametrisedModel parametrised = model.system.parametrised();
  const Vector values = parametrised.values();
  Knowledge knowledge;
  Vector errors;
  if (model.information.size() > 0) {
    knowledge.information = model.information;
    errors = standard_errors(model.information, sizes_of(values));
  } else {
    knowledge.information = inverse_squares(given_deviations(model.system, parametrised));
  }
  // Of a number of which nothing was measured the deviation that is taken is all there is; it
  // is small beside what is measured of the others.
  knowledge.proper =
      knowledge.information +
      inverse_squares(assumed_deviations(model.system, values, errors, spread));
  const Index p = knowledge.proper.rows();
  const Matrix lower = knowledge.proper.llt().matrixL();
  knowledge.factor =
      lower.transpose().triangularView<Eigen::Upper>().solve(Matrix::Identity(p, p));
  return knowledge;
}

std::vector<PathNumbers> draws_of(const ModelRun& run, const Knowledge& knowledge,
                                  int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<PathNumbers> draws;
  PathNumbers offset;
  for (int k = 0; k < count; ++k) {
    if (k % 2 == 0) {
      Vector normal(run.values.size());
      for (double& value : normal) value = random.normal();
      offset.parameters = knowledge.factor * normal;
      offset.starts.resize(run.deviations.size());
      for (Index j = 0; j < offset.starts.size(); ++j)
        offset.starts[j] = run.deviations[j] > 0.0 ? run.deviations[j] * random.normal() : 0.0;
    }
    const double sign = k % 2 == 0 ? 1.0 : -1.0;
    const Vector moved = run.values + sign * offset.parameters;
    draws.push_back({moved.cwiseMax(run.lower).cwiseMin(run.upper), sign * offset.starts});
  }
  return draws;
}

ModelEvidence& ModelEvidence::operator+=(const ModelEvidence& other) {
  information += other.information;
  log_det += other.log_det;
  freedom += other.freedom;
  return *this;
}

PairEvidence& PairEvidence::operator+=(const PairEvidence& other) {
  squares += other.squares;
  gradient += other.gradient;
  return *this;
}

DesignEvidence& DesignEvidence::operator+=(const DesignEvidence& other) {
  if (models.empty()) return *this = other;
  for (std::size_t i = 0; i < models.size(); ++i) models[i] += other.models[i];
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] += other.pairs[i];
  is_finite = is_finite && other.is_finite;
  return *this;
}

DesignEvidence evidence_of(Rivals& rivals, const Experiment& experiment, bool with_pairs) {
  const std::size_t count = rivals.runs.size();
  DesignEvidence evidence;
  std::vector<LinearPrediction> linear;
  std::vector<Matrix> drawn(count);  // values x K
  for (std::size_t i = 0; i < count; ++i) {
    ModelRun& run = rivals.runs[i];
    load(run, experiment);
    linear.push_back(linearise(run, experiment, {run.values, {}}));
    evidence.models.push_back(model_evidence(linear.back()));
    evidence.is_finite = evidence.is_finite && linear.back().is_finite;
    if (!with_pairs) continue;
    drawn[i].resize(linear.back().values.size(), static_cast<Index>(rivals.draws[i].size()));
    for (std::size_t k = 0; k < rivals.draws[i].size() && evidence.is_finite; ++k) {
      const Prediction one =
          predict(run, experiment, in_experiment(run, experiment, rivals.draws[i][k]));
      drawn[i].col(static_cast<Index>(k)) = one.values;
      evidence.is_finite = evidence.is_finite && one.is_finite;
    }
    if (!evidence.is_finite) return evidence;
  }
  if (!with_pairs) return evidence;
  evidence.pairs.resize(count * count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      if (i == j) continue;
      const Matrix d = drawn[i].colwise() - linear[j].values;
      const Matrix wd = weighted(linear[j].by_start, d);
      evidence.pairs[i * count + j] = {d.cwiseProduct(wd).colwise().sum().transpose(),
                                       linear[j].by_parameter.transpose() * wd};
    }
  return evidence;
}

DesignEvidence repeated(DesignEvidence evidence, double times) {
  for (ModelEvidence& model : evidence.models) {
    model.information *= times;
    model.log_det *= times;
    model.freedom *= times;
  }
  for (PairEvidence& pair : evidence.pairs) {
    pair.squares *= times;
    pair.gradient *= times;
  }
  return evidence;
}

Distinction distinction_of(const Rivals& rivals, const DesignEvidence& evidence, std::size_t right,
                           std::size_t rival, double decisive, const Vector& squares) {
  const PairEvidence& pair = evidence.pairs[right * rivals.runs.size() + rival];
  const ModelEvidence &own = evidence.models[right], &other = evidence.models[rival];
  const Matrix &own_known = rivals.knowledge[right].proper,
               &other_known = rivals.knowledge[rival].proper;
  const Matrix together = other_known + other.information;
  const auto solver = together.ldlt();
  Vector distances = squares;
  if (squares.size() == 0)
    distances = (pair.squares.transpose() -
                 pair.gradient.cwiseProduct(solver.solve(pair.gradient)).colwise().sum())
                    .transpose()
                    .cwiseMax(0.0);
  const double freedom = solver.solve(other.information).trace() + other.freedom;
  const double volume = log_det(together) - log_det(other_known) + other.log_det -
                        log_det(own_known + own.information) + log_det(own_known) -
                        own.log_det;
  Distinction found;
  found.distance = distances.mean();
  found.log_bayes_factor = 0.5 * (found.distance - freedom + volume);
  for (const double distance : distances) {
    const double mean = 0.5 * (distance - freedom + volume);
    // Given the numbers, the log ratio of normal densities d apart has the variance d^2.
    const double deviation = std::sqrt(std::max(distance, 1e-12));
    found.power += normal_cdf((mean - decisive) / deviation) / double(distances.size());
  }
  return found;
}

}  // namespace lacuna
