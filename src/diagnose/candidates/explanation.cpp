// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/candidates/explanation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "diagnose/candidates/candidate_column.hpp"
#include "shape_step.hpp"
#include "trajectories/smoother/unseen_changes.hpp"

namespace lacuna {
namespace {

/// Whether a model has a memory state at a place, in an equation of it.
bool is_driven_by(const OdeModel& model, Index equation, Index place,
                  const MemoryState& memory) {
  if (place >= model.dimension() ||
      model.states()[static_cast<std::size_t>(place)].name != memory.name)
    return false;
  const Equation& terms = model.equations()[static_cast<std::size_t>(equation)];
  return std::any_of(terms.begin(), terms.end(), [&](const WeightedTerm& summand) {
    return summand.term.expression().variables().contains(memory.name);
  });
}

/// Where the fit of a problem begins: another fit of the same records with other memory states.
/// @param nominal how many states, the first ones, both have; the others begin as columns of
/// the problem's records, undisturbed.
Assimilation start_of(const Assimilation& from, Index nominal,
                      const AugmentedProblem& problem) {
  Assimilation start = from;
  const Index m = problem.model.dimension(), memory = m - nominal;
  start.noise.disturbance = Vector::Zero(m);
  start.noise.disturbance.head(nominal) = from.noise.disturbance.head(nominal);
  for (const Index states : {nominal, m}) {
    start.noise.measurement.resize(static_cast<std::size_t>(states));
    start.noise.coloured.resize(static_cast<std::size_t>(states));
  }
  for (std::size_t r = 0; r < start.records.size(); ++r) {
    const Matrix& states = problem.data.trajectories[r].states;
    Matrix path(states.rows(), m);
    path << from.records[r].path.leftCols(nominal), states.rightCols(memory);
    start.records[r].path = std::move(path);
    start.records[r].bridge = problem.bridges[r];
    if (start.omitted.empty() || start.omitted[r].size() == 0) continue;
    start.omitted[r].conservativeResize(Eigen::NoChange, m);
    start.omitted[r].rightCols(memory).setZero();
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
  return nominal.with_equations(std::move(equations));
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

/// Where an effect is not known yet its equation has the disturbance that it has without it, to
/// the middle of a record at most: what a memory that forgets slowly, as a store that fills,
/// still keeps of its start is estimated by the smoother.
/// @return whether every effect is known at last in each record.
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
      if (!known) return false;
      if (*known <= record.time[0]) continue;
      Matrix& bridge = problem.bridges[r];
      if (bridge.size() == 0)
        bridge = Matrix::Zero(problem.model.dimension(), record.samples() - 1);
      const double density = bridging_density(from, candidate.equation);
      const double end = std::min(*known, middle);
      for (Index i = 0; i < bridge.cols() && record.time[i] < end; ++i)
        bridge(candidate.equation, i) = density;
    }
  }
  return true;
}

/// How rates change with the numbers of effects: coefficients of forms and their shapes.
/// @param next number of the first memory state.
std::vector<NumberChange> numbers_of(const std::vector<FittedEffect>& effects, Index next) {
  std::vector<NumberChange> numbers;
  for (const FittedEffect& effect : effects) {
    const Candidate& candidate = effect.candidate;
    const auto bound = [&](const Expression& formula) {
      return bind_formula(candidate, formula, as_span(effect.shapes));
    };
    const bool in_equation = candidate.place == Place::Rate;
    if (in_equation) numbers.push_back({{candidate.equation, bound(candidate.form)}});
    for (const ShapeParameter& shape : candidate.shapes) {
      NumberChange number;
      if (in_equation)
        number.push_back(
            {candidate.equation, bound(differentiate(candidate.form, shape.name))});
      for (std::size_t j = 0; j < candidate.memory.size(); ++j)
        number.push_back({next + static_cast<Index>(j),
                          bound(differentiate(candidate.memory[j].rate, shape.name))});
      numbers.push_back(std::move(number));
    }
    next += static_cast<Index>(candidate.memory.size());
  }
  return numbers;
}

/// Standard errors of the coefficients of effects, as the covariance of the fit has them.
void read_deviations(const JointFitTask& task, Explanation& result) {
  auto place = static_cast<Index>(task.options.free.size());
  auto channel = static_cast<Index>(result.fit.free.size());
  for (FittedEffect& effect : result.effects) {
    if (effect.candidate.is_driven()) continue;
    const Index row = effect.candidate.place == Place::Rate ? place++ : channel++;
    if (row < result.fit.covariance.rows())
      effect.deviation = std::sqrt(std::max(0.0, result.fit.covariance(row, row)));
  }
}

/// Whether the memory of the effects has finite values along the paths.
bool remembers(const Dataset& data) {
  return std::all_of(data.trajectories.begin(), data.trajectories.end(),
                     [](const Trajectory& record) { return record.states.allFinite(); });
}

/// Turns of a fit with moved shapes: a fact of the search.
constexpr int kStepPasses = 3;

/// Fits with the shapes as they are.
class JointFit {
 public:
  explicit JointFit(const JointFitTask& task) : task_(task) {}

  Explanation at(const Assimilation& from, std::vector<FittedEffect> effects,
                 int passes) const {
    const auto& [data, nominal, given, context, bare] = task_;
    const Index m = nominal.dimension();
    if (stands_twice(nominal, effects)) return unknown(from, effects);
    AugmentedProblem problem = augment(nominal_part(from.model, nominal), data, given.free,
                                       effects, nominal_paths(from, m));
    if (!bridge(from, nominal, effects, problem) || !remembers(problem.data))
      return unknown(from, effects);
    AssimilationOptions options = given;
    options.free = problem.free;
    if (options.held_among > 0) {
      options.held_among = given.free.size();
      see_changes(effects, problem, options);
    }
    options.passes = passes;
    Assimilation start = start_of(from, m, problem);
    set_drives(effects, m, from, start);
    Explanation result{std::move(effects),
                       assimilate_from(problem.model, problem.data, start, options, context)};
    read_coefficients(result);
    return result;
  }

  /// Moves the shapes and fits again until the likelihood rises no more, unless the fit has lost
  /// its path: no step of shapes brings it back.
  Explanation with_shapes(Explanation best) const {
    if (is_lost(best.fit)) return best;
    // Facts of the search: a hidden path moves with the shapes, and so does one whose noise is
    // far below what the shapes do, as that of an encoder is. Where a part of a step had to do,
    // the next one begins with twice that part.
    constexpr int kShapeSteps = 12;
    constexpr double kLonger = 2.0;
    double part = 1.0;
    for (int step = 0; step < kShapeSteps; ++step) {
      std::vector<FittedEffect> moved = best.effects;
      if (!move_shapes(best, moved)) break;
      auto [next, taken] = in_reach(best, moved, part);
      const double drop = best.fit.deviance - next.fit.deviance;
      if (!(drop > 0.0)) break;
      best = std::move(next);
      part = std::min(1.0, kLonger * taken);
      if (drop < kUnnoticedDeviance && taken == 1.0) break;
    }
    return best;
  }

 private:
  /// Whether a fit is so much less likely than that of the nominal model alone, to which it may
  /// always come, that it follows its records no more.
  bool is_lost(const Assimilation& fit) const {
    // A decision (docs/decisions/numbers.md).
    constexpr double kLostPerValue = 10.0;
    return fit.deviance - task_.bare_deviance > kLostPerValue * static_cast<double>(fit.used);
  }

  /// A fit with shapes between two, and where.
  struct Moved {
    Explanation fit;
    double part = 1.0;
  };

  /// The part of a step that is given, or a smaller one that raises the likelihood: the problem
  /// may be far from linear.
  Moved in_reach(const Explanation& best, const std::vector<FittedEffect>& moved,
                 double part) const {
    // A fact of the search: to a sixteenth of the step. Where half a step is hardly better than
    // the whole, a smaller part may still be (a rule that gave up there led to a false name).
    constexpr int kHalvings = 4;
    const auto at_part = [&](double fraction) {
      std::vector<FittedEffect> effects = moved;
      for (std::size_t e = 0; e < effects.size(); ++e)
        effects[e].shapes = best.effects[e].shapes +
                            fraction * (moved[e].shapes - best.effects[e].shapes);
      return at(best.fit, std::move(effects), kStepPasses);
    };
    Moved result{at_part(part), part};
    const double noticed = best.fit.deviance + kUnnoticedDeviance;
    for (int halving = 0; halving < kHalvings && !(result.fit.fit.deviance <= noticed);
         ++halving) {
      part *= 0.5;
      result = {at_part(part), part};
    }
    return result;
  }

  /// What no record determines of the model with effects: they show changes that nothing shows
  /// without them, and their own numbers make up for others.
  void see_changes(const std::vector<FittedEffect>& effects, const AugmentedProblem& problem,
                   AssimilationOptions& options) const {
    const auto is_delayed = [](const FittedEffect& effect) {
      return contains(effect.candidate.form, Operation::Delay);
    };
    if (std::any_of(effects.begin(), effects.end(), is_delayed)) return;
    std::vector<bool> hidden = options.hidden;
    hidden.resize(static_cast<std::size_t>(problem.model.dimension()), true);
    UnseenChanges unseen = unseen_changes(
        problem.model, problem.data, hidden,
        {task_.options.free, options.priors, numbers_of(effects, task_.nominal.dimension())});
    options.unseen = std::move(unseen.coefficients);
    options.units = std::move(unseen.units);
  }

  /// Free inputs begin as a fit that has them found them: nothing else says what they are. Else
  /// noise moves them, to begin with such that they take over from the disturbance of their
  /// equation.
  static void set_drives(const std::vector<FittedEffect>& effects, Index next,
                         const Assimilation& from, Assimilation& start) {
    constexpr double kFractionOfDisturbance = 0.1;  // a fact of the search: a start, no bound
    for (const FittedEffect& effect : effects)
      for (const MemoryState& memory : effect.candidate.memory) {
        double& own = start.noise.disturbance[effect.candidate.equation];
        double& moving = start.noise.disturbance[next];
        if (memory.driven && is_driven_by(from.model, effect.candidate.equation, next, memory)) {
          moving = from.noise.disturbance[next];
          for (std::size_t r = 0; r < start.records.size(); ++r)
            start.records[r].path.col(next) = from.records[r].path.col(next);
        } else if (memory.driven) {
          moving = own / effect.shapes[0];
          own *= kFractionOfDisturbance;
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

  void read_coefficients(Explanation& result) const {
    const Assimilation& fit = result.fit;
    std::size_t place = task_.options.free.size(), channel = 0;
    for (FittedEffect& effect : result.effects) {
      if (effect.candidate.is_driven()) continue;
      if (effect.candidate.place == Place::Channel) {
        effect.coefficient = fit.channel_terms[channel++].coefficient;
        continue;
      }
      const CoefficientPlace& where = fit.free[place++];
      effect.coefficient = fit.model
                               .equations()[static_cast<std::size_t>(where.equation)]
                                           [static_cast<std::size_t>(where.term)]
                               .coefficient;
    }
    read_deviations(task_, result);
  }

  /// One Gauss-Newton step of all shapes; false when there are none or it promises nothing.
  /// `at` gets the standard errors of its shapes.
  bool move_shapes(Explanation& at, std::vector<FittedEffect>& effects) const;

  const JointFitTask& task_;
};

bool JointFit::move_shapes(Explanation& at, std::vector<FittedEffect>& effects) const {
  const ShapeStep found = shape_step(at, task_.options);
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
  // Facts of the search: enough to rank fits, which are fitted again.
  constexpr int kRoughPasses = 3;
  constexpr int kRoughPassesWithHidden = 8;  // a step may lead far from what it promises
  return JointFit(task).at(start, effects,
                           task.options.hidden.empty() ? kRoughPasses : kRoughPassesWithHidden);
}

Explanation with_joint_errors(const JointFitTask& task, Explanation explanation) {
  ShapeStep found = shape_step(explanation, task.options);
  if (found.places.empty() || !found.covariance.allFinite()) return explanation;
  explanation.fit.covariance = std::move(found.covariance);
  read_deviations(task, explanation);
  for (std::size_t j = 0; j < found.places.size(); ++j) {
    FittedEffect& effect = explanation.effects[found.places[j].first];
    if (effect.shape_deviations.size() == 0)
      effect.shape_deviations = Vector::Zero(effect.shapes.size());
    effect.shape_deviations[found.places[j].second] = found.deviation[static_cast<Index>(j)];
  }
  return explanation;
}

Explanation explain(const JointFitTask& task, const Assimilation& start,
                    const std::vector<FittedEffect>& effects) {
  const JointFit fit(task);
  const int passes = task.options.passes;
  Explanation best = fit.with_shapes(fit.at(start, effects, passes));
  if (const auto again = with_estimated_noise(best.fit)) {
    Explanation other = fit.with_shapes(fit.at(*again, best.effects, passes));
    if (other.fit.deviance < best.fit.deviance) return other;
  }
  return best;
}

}  // namespace lacuna
