// SPDX-License-Identifier: MIT
#include "lacuna/candidates/explanation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "lacuna/candidates/candidate_column.hpp"

namespace lacuna {
namespace {

std::span<const double> as_span(const Vector& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

/// The start of an assimilation whose model has more states than the base has.
Assimilation widened(const Assimilation& base, const AugmentedProblem& problem) {
  Assimilation start = base;
  const Index m = problem.model.dimension();
  const Index old = base.noise.states();
  start.noise.disturbance.conservativeResize(m);
  start.noise.disturbance.tail(m - old).setZero();
  start.noise.measurement.resize(static_cast<std::size_t>(m));
  start.noise.coloured.resize(static_cast<std::size_t>(m));
  for (std::size_t r = 0; r < start.records.size(); ++r) {
    const Matrix& states = problem.data.trajectories[r].states;
    Matrix path(states.rows(), m);
    path << base.records[r].path.leftCols(old), states.rightCols(m - old);
    start.records[r].path = std::move(path);
    start.records[r].bridge = problem.bridges[r];
    if (!start.omitted.empty() && start.omitted[r].size() > 0) {
      start.omitted[r].conservativeResize(states.rows(), m);
      start.omitted[r].rightCols(m - old).setZero();
    }
  }
  start.channel_terms = problem.channel_terms;
  return start;
}

/// The nominal part of a model that has effects behind it.
OdeModel nominal_part(const OdeModel& augmented, const OdeModel& nominal) {
  std::vector<Equation> equations;
  for (std::size_t k = 0; k < nominal.equations().size(); ++k)
    equations.emplace_back(augmented.equations()[k].begin(),
                           augmented.equations()[k].begin() +
                               static_cast<std::ptrdiff_t>(nominal.equations()[k].size()));
  for (Equation& equation : equations)
    for (WeightedTerm& summand : equation)
      summand.term = Term(summand.term.expression(), nominal.variables());
  return {nominal.states(), nominal.inputs(), std::move(equations), nominal.time_unit()};
}

std::vector<Matrix> nominal_paths(const Assimilation& fit, Index states) {
  std::vector<Matrix> paths;
  for (const LinearisedRecord& record : fit.records)
    paths.push_back(record.path.leftCols(states));
  return paths;
}

/// Whether an equation has a term more than once.
bool stands_twice(const OdeModel& nominal, const std::vector<FittedEffect>& effects) {
  std::set<std::pair<Index, std::string>> seen;
  for (Index k = 0; k < nominal.dimension(); ++k)
    for (const WeightedTerm& summand : nominal.equations()[static_cast<std::size_t>(k)])
      seen.insert({k, summand.term.name()});
  for (const FittedEffect& effect : effects) {
    if (effect.candidate.place == Place::Channel) continue;
    Variables variables = nominal.variables();
    for (const MemoryState& memory : effect.candidate.memory)
      variables.states.push_back(memory.name);
    const Term term(bind_form(effect.candidate, as_span(effect.shapes)), variables);
    if (!seen.insert({effect.candidate.equation, term.name()}).second) return true;
  }
  return false;
}

/// Spectral density of the disturbance that an equation has without the effect that cannot be
/// known: where a step is bridged already that of the bridge.
double bridging_density(const Assimilation& from, Index equation) {
  double density = from.noise.disturbance[equation] * from.noise.disturbance[equation];
  for (const LinearisedRecord& record : from.records)
    if (record.bridge.size() > 0)
      density = std::max(density, record.bridge.row(equation).maxCoeff());
  return density;
}

/// Where an effect is not known yet its equation has the disturbance that it has without it.
/// @return whether every effect is known in the second half of each record.
bool bridge(const Assimilation& from, const OdeModel& nominal,
            const std::vector<FittedEffect>& effects, AugmentedProblem& problem) {
  problem.bridges.assign(problem.data.trajectories.size(), Matrix());
  for (std::size_t r = 0; r < problem.bridges.size(); ++r) {
    const Trajectory& record = problem.data.trajectories[r];
    const LinearisedRecord grid =
        grid_of(nominal.inputs(), record, record.states.leftCols(nominal.dimension()));
    const double middle = 0.5 * (record.time[0] + record.time[record.samples() - 1]);
    for (const FittedEffect& effect : effects) {
      const Candidate& candidate = effect.candidate;
      if (candidate.place == Place::Channel || candidate.is_driven()) continue;
      const auto known =
          known_from(candidate, as_span(effect.shapes), nominal.variables(), grid);
      if (!known || *known > middle) return false;
      if (*known <= record.time[0]) continue;
      Matrix& bridge = problem.bridges[r];
      if (bridge.size() == 0)
        bridge = Matrix::Zero(problem.model.dimension(), record.samples() - 1);
      const double density = bridging_density(from, candidate.equation);
      for (Index i = 0; i < bridge.cols() && record.time[i] < *known; ++i)
        bridge(candidate.equation, i) = density;
    }
  }
  return true;
}

/// Fits with the shapes as they are.
class JointFit {
 public:
  explicit JointFit(const JointFitTask& task) : task_(task) {}

  Explanation at(const Assimilation& from, std::vector<FittedEffect> effects,
                 int passes) const {
    const auto& [data, nominal, given, context] = task_;
    const Index m = nominal.dimension();
    if (stands_twice(nominal, effects)) return unknown(from, effects);
    AugmentedProblem problem = augment(nominal_part(from.model, nominal), data, given.free,
                                       effects, nominal_paths(from, m));
    if (!bridge(from, nominal, effects, problem)) return unknown(from, effects);
    AssimilationOptions options = given;
    options.free = problem.free;
    if (options.held_among > 0) options.held_among = given.free.size();
    options.passes = passes;
    Assimilation start = widened(nominal_start(from, m), problem);
    set_drives(effects, m, start.noise.disturbance);
    Explanation result{std::move(effects),
                       assimilate_from(problem.model, problem.data, start, options, context)};
    read_coefficients(result);
    return result;
  }

  /// Moves the shapes and fits again until the likelihood rises no more.
  Explanation with_shapes(Explanation best) const {
    constexpr int kSteps = 3;
    constexpr int kHiddenSteps = 12;  // a hidden path moves with the shapes
    const bool hidden = !task_.options.hidden.empty();
    for (int step = 0; step < (hidden ? kHiddenSteps : kSteps); ++step) {
      std::vector<FittedEffect> moved = best.effects;
      if (!move_shapes(best, moved)) break;
      Explanation next = at(best.fit, moved, 3);
      if (hidden) next = in_reach(best, std::move(moved), std::move(next));
      const double drop = best.fit.deviance - next.fit.deviance;
      if (!(drop > 0.0)) break;
      best = std::move(next);
      if (drop < kUnnoticedDeviance) break;
    }
    return best;
  }

 private:
  /// The step, or a part of it that raises the likelihood: where states are hidden the problem
  /// is far from linear.
  Explanation in_reach(const Explanation& best, std::vector<FittedEffect> moved,
                       Explanation next) const {
    constexpr int kHalvings = 4;
    for (int halving = 0; halving < kHalvings && !(next.fit.deviance < best.fit.deviance);
         ++halving) {
      for (std::size_t e = 0; e < moved.size(); ++e)
        moved[e].shapes = 0.5 * (moved[e].shapes + best.effects[e].shapes);
      next = at(best.fit, moved, 3);
    }
    return next;
  }

  /// Noise that moves the free inputs, to begin with such that they take over from the
  /// disturbance of their equation.
  static void set_drives(const std::vector<FittedEffect>& effects, Index next,
                         Vector& disturbance) {
    constexpr double kLeft = 0.1;
    for (const FittedEffect& effect : effects)
      for (const MemoryState& memory : effect.candidate.memory) {
        if (memory.driven) {
          double& own = disturbance[effect.candidate.equation];
          disturbance[next] = own / effect.shapes[0];
          own *= kLeft;
        }
        ++next;
      }
  }

  /// An effect that the records do not show explains nothing.
  static Explanation unknown(const Assimilation& from,
                             const std::vector<FittedEffect>& effects) {
    Explanation result{effects, from};
    result.fit.deviance = std::numeric_limits<double>::infinity();
    return result;
  }

  /// The fit without its memory states.
  Assimilation nominal_start(const Assimilation& from, Index m) const {
    Assimilation start = from;
    start.noise.disturbance.conservativeResize(m);
    start.noise.measurement.resize(static_cast<std::size_t>(m));
    start.noise.coloured.resize(static_cast<std::size_t>(m));
    for (LinearisedRecord& record : start.records)
      record.path = Matrix(record.path.leftCols(m));
    for (Matrix& omitted : start.omitted)
      if (omitted.size() > 0) omitted.conservativeResize(Eigen::NoChange, m);
    return start;
  }

  void read_coefficients(Explanation& result) const {
    const Assimilation& fit = result.fit;
    auto place = static_cast<Index>(task_.options.free.size());
    auto channel = static_cast<Index>(fit.free.size());
    std::size_t term = 0;
    for (FittedEffect& effect : result.effects) {
      if (effect.candidate.is_driven()) continue;
      const bool in_equation = effect.candidate.place == Place::Rate;
      const Index row = in_equation ? place++ : channel++;
      if (in_equation) {
        const CoefficientPlace& where = fit.free[static_cast<std::size_t>(row)];
        effect.coefficient = fit.model
                                 .equations()[static_cast<std::size_t>(where.equation)]
                                             [static_cast<std::size_t>(where.term)]
                                 .coefficient;
      } else {
        effect.coefficient = fit.channel_terms[term++].coefficient;
      }
      if (row < fit.covariance.rows())
        effect.deviation = std::sqrt(std::max(0.0, fit.covariance(row, row)));
    }
  }

  /// One Gauss-Newton step of all shapes; false when there are none or it promises nothing.
  /// `at` gets the standard errors of its shapes.
  bool move_shapes(Explanation& at, std::vector<FittedEffect>& effects) const;

  const JointFitTask& task_;
};

/// d(column)/d(shape) times the coefficient, by central differences inside the range.
std::optional<Vector> shape_column(const FittedEffect& effect, Index shape,
                                   const Assimilation& fit, const InnovationSystem& system) {
  const ShapeParameter& range = effect.candidate.shapes[static_cast<std::size_t>(shape)];
  const double value = effect.shapes[shape];
  const double reach =
      1e-3 * (range.logarithmic ? std::abs(value) : std::abs(range.high - range.low));
  Vector low = effect.shapes, high = effect.shapes;
  low[shape] = std::max(range.low, value - reach);
  high[shape] = std::min(range.high, value + reach);
  if (!(high[shape] > low[shape])) return std::nullopt;
  const auto size = static_cast<std::size_t>(low.size());
  const auto below = candidate_column(effect.candidate, {low.data(), size}, fit, system);
  const auto above = candidate_column(effect.candidate, {high.data(), size}, fit, system);
  if (!below || !above) return std::nullopt;
  return Vector(effect.coefficient / (high[shape] - low[shape]) * (*above - *below));
}

/// The joint least-squares problem of everything that is fitted; the shapes are its last
/// columns.
struct ShapeSystem {
  std::vector<std::pair<std::size_t, Index>> places;  ///< effect and shape
  Vector step, deviation;                             ///< one entry each
  double promised = 0.0;                              ///< drop of the deviance by the step
};

ShapeSystem solve_shapes(const Matrix& fitted, const std::vector<Vector>& shapes,
                         const Vector& innovations) {
  const auto count = static_cast<Index>(shapes.size());
  Matrix columns(fitted.rows(), fitted.cols() + count);
  columns.leftCols(fitted.cols()) = fitted;
  for (Index j = 0; j < count; ++j)
    columns.col(fitted.cols() + j) = shapes[static_cast<std::size_t>(j)];
  const Vector scale = columns.colwise().norm().cwiseMax(1e-300).cwiseInverse().transpose();
  columns = columns * scale.asDiagonal();
  const Eigen::LDLT<Matrix> factor(Matrix(columns.transpose() * columns));
  const Vector inner = columns.transpose() * innovations;
  const Vector step = factor.solve(inner);
  const Vector variance =
      factor.solve(Matrix::Identity(columns.cols(), columns.cols())).diagonal();
  return {{},
          scale.cwiseProduct(step).tail(count),
          scale.cwiseProduct(variance.cwiseMax(0.0).cwiseSqrt()).tail(count),
          inner.dot(step)};
}

ShapeSystem shape_system(const Explanation& at) {
  const InnovationSystem system(at.fit);
  std::vector<Vector> columns;
  std::vector<std::pair<std::size_t, Index>> places;
  for (std::size_t e = 0; e < at.effects.size(); ++e) {
    if (at.effects[e].candidate.is_driven()) continue;
    for (Index s = 0; s < at.effects[e].shapes.size(); ++s)
      if (auto column = shape_column(at.effects[e], s, at.fit, system)) {
        columns.push_back(std::move(*column));
        places.emplace_back(e, s);
      }
  }
  if (columns.empty()) return {};
  ShapeSystem result = solve_shapes(system.fitted_columns(), columns, system.innovations());
  result.places = std::move(places);
  return result;
}

bool JointFit::move_shapes(Explanation& at, std::vector<FittedEffect>& effects) const {
  const ShapeSystem found = shape_system(at);
  if (found.places.empty() || !found.step.allFinite()) return false;
  for (std::vector<FittedEffect>* all : {&at.effects, &effects})
    for (FittedEffect& effect : *all)
      effect.shape_deviations = Vector::Zero(effect.shapes.size());
  for (std::size_t j = 0; j < found.places.size(); ++j) {
    const auto [effect, shape] = found.places[j];
    const auto row = static_cast<Index>(j);
    at.effects[effect].shape_deviations[shape] = found.deviation[row];
    effects[effect].shape_deviations[shape] = found.deviation[row];
    const ShapeParameter& range =
        effects[effect].candidate.shapes[static_cast<std::size_t>(shape)];
    const double moved = effects[effect].shapes[shape] + found.step[row];
    effects[effect].shapes[shape] = std::clamp(moved, range.low, range.high);
  }
  return found.promised >= kUnnoticedDeviance;
}

}  // namespace

Index Explanation::parameters() const noexcept {
  Index count = 0;
  for (const FittedEffect& effect : effects) count += 1 + effect.shapes.size();
  return count;
}

Explanation explain_roughly(const JointFitTask& task, const Assimilation& start,
                            const std::vector<FittedEffect>& effects) {
  constexpr int kFew = 3;
  constexpr int kFewWithHidden = 8;  // a step may lead far from what it promises
  return JointFit(task).at(start, effects, task.options.hidden.empty() ? kFew : kFewWithHidden);
}

Explanation explain(const JointFitTask& task, const Assimilation& start,
                    const std::vector<FittedEffect>& effects) {
  const JointFit fit(task);
  const int passes = task.options.passes;
  Explanation best = fit.with_shapes(fit.at(start, effects, passes));
  if (const auto again = with_seen_noise(best.fit)) {
    Explanation other = fit.with_shapes(fit.at(*again, best.effects, passes));
    if (other.fit.deviance < best.fit.deviance) return other;
  }
  return best;
}

}  // namespace lacuna
