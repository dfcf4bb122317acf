// SPDX-License-Identifier: MIT
#include "plain_structure.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/text.hpp"
#include "core/numerics/qr.hpp"
#include "identify/free_runs/averaged_records.hpp"
#include "identify/pipeline/equation_terms.hpp"
#include "trajectories/windows/window_gap.hpp"

namespace lacuna {
namespace {

/// A term that may come into an equation, with the coefficient that the rows give it beside the
/// others.
struct Ranked {
  Index equation = 0;
  Term term;
  std::optional<Parameter> width =
      {};  ///< of dry friction, in the place of the number in the term
  double coefficient = 0.0;
  double gain = 0.0;  ///< n ln of the residual without it over that with it, squared
};

/// Values of terms at the samples of all records, one after the other.
Matrix columns_of(const std::vector<Term>& terms, const Dataset& data) {
  const TermLibrary library{variables_of(data), terms};
  const Program program = library.compile();
  Matrix columns(data.samples(), library.size());
  Index row = 0;
  for (const Trajectory& record : data.trajectories) {
    Matrix slots(record.samples(), data.state_count() + data.input_count() + 1);
    slots << record.states, record.inputs, record.time;
    Matrix values(record.samples(), library.size());
    Program::Workspace workspace;
    program.evaluate(slots, values, workspace);
    columns.middleRows(row, record.samples()) = values;
    row += record.samples();
  }
  return columns;
}

Vector rates_of(const Dataset& data, Index state) {
  Vector rates(data.samples());
  Index row = 0;
  for (const Trajectory& record : data.trajectories) {
    rates.segment(row, record.samples()) = record.derivatives.col(state);
    row += record.samples();
  }
  return rates;
}

/// A term that free runs may have, and its shape where it has one.
struct Law {
  Term term;
  std::optional<Parameter> width = {};
};

/// The laws of machines that are no polynomials, of every state.
/// @param means averaged(), whose ranges are those of the motion and not of noise.
std::vector<Law> laws_of_machines(const Dataset& data, const Dataset& means) {
  const Variables variables = variables_of(data);
  std::vector<Law> laws;
  const auto add = [&](const std::string& text) {
    laws.push_back({Term::parse(text, variables)});
  };
  for (Index k = 0; k < data.state_count(); ++k) {
    double least = INFINITY, most = -INFINITY;
    for (const Trajectory& record : means.trajectories) {
      least = std::min(least, record.states.col(k).minCoeff());
      most = std::max(most, record.states.col(k).maxCoeff());
    }
    const std::string& x = data.states[static_cast<std::size_t>(k)].name;
    if (least >= 0.0) {
      add("sqrt(" + x + ")");
      continue;
    }
    const double range = most - least;
    const Parameter width{.name = "width_of_" + x,
                          .value = 0.01 * range,  // where fits begin
                          .min = 1e-3 * range,    // narrower slopes are jumps within a step
                          .max = range};
    add("tanh(" + x + "/" + format_number(width.value, 2) + ")");
    laws.back().width = width;
    add(x + "*abs(" + x + ")");
    add("sin(" + x + ")");
  }
  for (std::size_t j = 0; j < data.inputs.size(); ++j) {
    const auto is_below = [&](const Trajectory& record) {
      return record.inputs.col(static_cast<Index>(j)).minCoeff() < 0.0;
    };
    if (std::any_of(data.trajectories.begin(), data.trajectories.end(), is_below))
      add("abs(" + data.inputs[j].name + ")");
  }
  return laws;
}

std::vector<Term> affine_terms(const Variables& variables) {
  std::vector<Term> terms{Term::parse("1", variables)};
  for (const auto* names : {&variables.states, &variables.inputs})
    for (const std::string& name : *names) terms.push_back(Term::parse(name, variables));
  return terms;
}

/// What is searched in.
class PlainSearch {
 public:
  PlainSearch(const Dataset& data, const TermLibrary& library, double least,
              const KnownNoise& noise, const RunContext& context)
      : data_(data), context_(context), least_(least), noise_(noise), pool_(library.terms) {
    constexpr double kRatio = 4.0;  // of one width to the next; a bound of the work
    for (Index half = 2; 8 * half < longest_record(data).samples();
         half = static_cast<Index>(kRatio * static_cast<double>(half)))
      if (Dataset means = averaged(data, half); means.samples() > 0)
        means_.push_back({half, std::move(means)});
    if (means_.empty()) return;
    widths_.resize(pool_.size());
    for (Law& law : laws_of_machines(data, means_[means_.size() / 2].data)) {
      if (std::find(pool_.begin(), pool_.end(), law.term) != pool_.end()) continue;
      pool_.push_back(std::move(law.term));
      widths_.push_back(std::move(law.width));
    }
    for (const Means& means : means_) columns_.push_back(columns_of(pool_, means.data));
  }

  bool is_open(Index equation) const { return !data_.rate_state(equation); }

  /// The affine law, fitted to the rows of the widest means.
  SystemModel affine() const {
    const std::vector<Term> terms = affine_terms(variables_of(data_));
    std::vector<Equation> equations;
    for (Index k = 0; k < data_.state_count(); ++k) {
      Equation equation;
      if (const auto rate = data_.rate_state(k)) {
        equation.push_back({terms[static_cast<std::size_t>(1 + *rate)], 1.0});
      } else {
        const Dataset& means = means_[means_.size() / 2].data;
        const Vector values = PivotedQr(columns_of(terms, means)).solve(rates_of(means, k));
        for (std::size_t i = 0; i < terms.size(); ++i)
          equation.push_back({terms[i], values[static_cast<Index>(i)]});
      }
      equations.push_back(std::move(equation));
    }
    return SystemModel(
        OdeModel(data_.states, data_.inputs, std::move(equations), data_.time_unit));
  }

  bool has_rows() const { return !means_.empty(); }

  /// Terms beside those of a model, the one that explains most first.
  std::vector<Ranked> ranked(const OdeModel& model) const {
    std::vector<Ranked> all;
    for (Index k = 0; k < model.dimension(); ++k)
      if (is_open(k)) rank_in(model, k, all);
    std::sort(all.begin(), all.end(),
              [](const Ranked& a, const Ranked& b) { return a.gain > b.gain; });
    return all;
  }

  FreeRun run(const SystemModel& system, bool rough = true) const {
    return free_run(system, data_, noise_, context_, rough);
  }
  bool is_late() const { return context_.is_late(); }
  bool are_worth(const FreeRun& more, const FreeRun& fewer) const {
    return is_worth(more, fewer, least_);
  }

 private:
  struct Means {
    Index half;
    Dataset data;
  };

  /// By the width of means at which each explains most.
  void rank_in(const OdeModel& model, Index k, std::vector<Ranked>& all) const {
    const Equation& equation = model.equations()[static_cast<std::size_t>(k)];
    std::vector<Term> present;
    for (const WeightedTerm& summand : equation) present.push_back(summand.term);
    std::vector<Ranked> own;
    for (std::size_t i = 0; i < pool_.size(); ++i) own.push_back({k, pool_[i], widths_[i]});
    for (std::size_t w = 0; w < means_.size(); ++w) {
      const auto& [half, means] = means_[w];
      const Vector rates = rates_of(means, k);
      if (rates.size() <= static_cast<Index>(present.size()) + 1) continue;
      const Matrix basis = present.empty() ? Matrix(rates.size(), 0)
                                           : PivotedQr(columns_of(present, means)).basis();
      const Vector left = rates - basis * (basis.transpose() * rates);
      const Matrix beside = columns_[w] - basis * (basis.transpose() * columns_[w]);
      const double independent =
          static_cast<double>(data_.samples()) / static_cast<double>(half);
      for (std::size_t i = 0; i < own.size(); ++i) {
        const auto column = beside.col(static_cast<Index>(i));
        constexpr double kIndependent = 1e-8;  // a fact of rounding, squared
        const double size = column.squaredNorm(), product = column.dot(left);
        // A root has no value where means over fewer samples are below 0.
        if (!(size > kIndependent * columns_[w].col(static_cast<Index>(i)).squaredNorm()))
          continue;
        const double rest =
            std::max(1e-12, 1.0 - product * product / (size * left.squaredNorm()));
        const double gain = -independent * std::log(rest);
        if (gain > own[i].gain) {
          own[i].gain = gain;
          own[i].coefficient = product / size;
        }
      }
    }
    for (Ranked& one : own)
      if (one.gain > 0.0 &&
          std::find(present.begin(), present.end(), one.term) == present.end())
        all.push_back(std::move(one));
  }

  const Dataset& data_;
  const RunContext& context_;
  double least_;
  const KnownNoise& noise_;
  std::vector<Term> pool_;
  std::vector<std::optional<Parameter>> widths_;  ///< of each of these
  std::vector<Means> means_;
  std::vector<Matrix> columns_;  ///< of the pool, for each width
};

/// A system with these equations and those of the parameters that stand in them.
SystemModel system_with(const SystemModel& frame, std::vector<Equation> equations,
                        const std::vector<Parameter>& parameters) {
  const auto stands = [&](const Parameter& parameter) {
    for (const Equation& equation : equations)
      for (const WeightedTerm& summand : equation)
        if (summand.term.expression().variables().contains(parameter.name)) return true;
    return false;
  };
  std::vector<Quantity> inputs = frame.inputs();
  std::vector<Parameter> used;
  for (const Parameter& parameter : parameters)
    if (stands(parameter)) {
      used.push_back(parameter);
      inputs.push_back({parameter.name, ""});
    }
  const OdeModel& symbolic = frame.symbolic();
  const OdeModel empty(symbolic.states(), inputs,
                       std::vector<Equation>(symbolic.states().size()), symbolic.time_unit());
  for (Equation& equation : equations)
    for (WeightedTerm& summand : equation)
      summand.term = Term(summand.term.expression(), empty.variables());
  return {empty.with_equations(std::move(equations)), std::move(used)};
}

SystemModel without(const SystemModel& system, std::size_t equation, std::size_t summand) {
  std::vector<Equation> equations = system.symbolic().equations();
  equations[equation].erase(equations[equation].begin() + static_cast<std::ptrdiff_t>(summand));
  return system_with(system, std::move(equations), system.parameters());
}

SystemModel with(const SystemModel& system, const Ranked& ranked) {
  std::vector<Parameter> parameters = system.parameters();
  Term term = ranked.term;
  if (ranked.width) {
    const auto same = [&](const Parameter& one) { return one.name == ranked.width->name; };
    if (std::none_of(parameters.begin(), parameters.end(), same))
      parameters.push_back(*ranked.width);
    const Expression quotient = term.expression().operands()[0];
    const Expression width = Expression::variable(ranked.width->name);
    Variables variables = system.symbolic().variables();
    variables.inputs.push_back(ranked.width->name);
    term = Term(Expression::make(
                    Operation::Tanh,
                    {Expression::make(Operation::Divide, {quotient.operands()[0], width})}),
                variables);
  }
  std::vector<Equation> equations = system.symbolic().equations();
  equations[static_cast<std::size_t>(ranked.equation)].push_back({term, ranked.coefficient});
  return system_with(system, std::move(equations), parameters);
}

/// One term of an equation.
struct Place {
  std::size_t equation = 0, summand = 0;
  double significance = 0.0;
};

/// The terms that are least significant, in this order.
std::vector<Place> least_significant(const PlainSearch& search, const FreeRun& run) {
  constexpr std::size_t kTried = 3;  // a bound of the work
  std::vector<Place> places;
  for (std::size_t k = 0; k < run.system.symbolic().equations().size(); ++k)
    if (search.is_open(static_cast<Index>(k)))
      for (std::size_t i = 0; i < run.system.symbolic().equations()[k].size(); ++i)
        if (places.size() < run.significance.size())
          places.push_back({k, i, run.significance[places.size()]});
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.significance < b.significance; });
  if (places.size() > kTried) places.resize(kTried);
  return places;
}

/// Takes out terms that are not worth it, one after the other.
FreeRun pruned(const PlainSearch& search, FreeRun best) {
  for (bool changed = true; changed && !search.is_late();) {
    changed = false;
    for (const auto& [k, i, significance] : least_significant(search, best)) {
      FreeRun fewer = search.run(without(best.system, k, i));
      if (!fewer.is_finite() || search.are_worth(best, fewer)) continue;
      best = std::move(fewer);
      changed = true;
      break;
    }
  }
  return best;
}

/// Whether an equation has dry friction already, with whatever width, or none.
bool has_width(const SystemModel& system, const Ranked& ranked) {
  if (!ranked.width) return false;
  const Equation& equation =
      system.symbolic().equations()[static_cast<std::size_t>(ranked.equation)];
  const Expression speed = ranked.term.expression().operands()[0].operands()[0];
  return std::any_of(equation.begin(), equation.end(), [&](const WeightedTerm& summand) {
    const Expression& form = summand.term.expression();
    return form.variables().contains(ranked.width->name) ||
           form == Expression::make(Operation::Sign, {speed});
  });
}

/// The best of the terms that the rows put first, where it is worth it.
std::optional<FreeRun> extended(const PlainSearch& search, const FreeRun& best) {
  constexpr std::size_t kTried = 6;  // a bound of the work
  FreeRun next = best;
  std::vector<Ranked> ranked = search.ranked(best.system.model());
  std::erase_if(ranked, [&](const Ranked& one) { return has_width(best.system, one); });
  for (std::size_t i = 0; i < std::min(kTried, ranked.size()) && !search.is_late(); ++i) {
    FreeRun one = search.run(with(best.system, ranked[i]));
    if (one.deviance < next.deviance) next = std::move(one);
  }
  return search.are_worth(next, best) && next.numbers > best.numbers
             ? std::optional(std::move(next))
             : std::nullopt;
}

/// An expression with dry friction of a width as a jump.
Expression with_jump(const Expression& form, const std::string& width) {
  if (form.operation() != Operation::Tanh || !form.variables().contains(width)) return form;
  return Expression::make(Operation::Sign, {form.operands()[0].operands()[0]});
}

/// The best of a structure and the same with jumps in the place of narrow slopes, which fits
/// only find from numbers that are nearly right.
FreeRun with_jumps(const PlainSearch& search, FreeRun best) {
  if (best.system.parameters().empty()) return best;
  if (FreeRun finer = search.run(best.system, false); finer.deviance < best.deviance)
    best = std::move(finer);
  for (const Parameter& width : std::vector<Parameter>(best.system.parameters())) {
    if (search.is_late()) break;
    std::vector<Equation> equations = best.system.symbolic().equations();
    for (Equation& equation : equations)
      for (WeightedTerm& summand : equation)
        summand.term = Term(with_jump(summand.term.expression(), width.name),
                            best.system.symbolic().variables());
    FreeRun jump = search.run(
        system_with(best.system, std::move(equations), best.system.parameters()), false);
    if (jump.is_finite() && !search.are_worth(best, jump)) best = std::move(jump);
  }
  return best;
}

/// The search from one structure; nothing where that has no finite run.
std::optional<FreeRun> searched_from(const PlainSearch& search, const SystemModel& start) {
  constexpr int kRounds = 4;  // a bound of the work: what takes more terms is not plain
  FreeRun best = search.run(start);
  if (!best.is_finite()) return std::nullopt;
  // Damping is worth little beside a wrong restoring force: nothing leaves before something
  // came.
  for (int round = 0; round < kRounds && !search.is_late(); ++round) {
    auto next = extended(search, best);
    if (!next) break;
    best = pruned(search, *std::move(next));
  }
  return with_jumps(search, pruned(search, std::move(best)));
}

}  // namespace

Dataset in_stretches(const Dataset& data) {
  constexpr Index kPeriods = 6;
  if (data.input_count() > 0) return data;
  std::vector<Matrix> paths;
  std::vector<bool> measured;
  for (const Trajectory& record : data.trajectories) paths.push_back(record.states);
  for (Index k = 0; k < data.state_count(); ++k) measured.push_back(data.is_measured(k));
  const Index length = kPeriods * window_samples(paths, measured);
  Dataset stretches = data;
  stretches.trajectories.clear();
  for (const Trajectory& record : data.trajectories) {
    const Index count = std::max<Index>(record.samples() / length, 1);
    for (Index i = 0; i < count; ++i) {
      const Index first = i * record.samples() / count,
                  end = (i + 1) * record.samples() / count;
      stretches.trajectories.push_back(rows_of(record, first, end - first));
    }
  }
  return stretches;
}

std::optional<FreeRun> plain_structure(const Dataset& data, const TermLibrary& library,
                                       const OdeModel& found, double least,
                                       const KnownNoise& noise, const RunContext& context) {
  const Dataset stretches = in_stretches(data);
  const PlainSearch search(stretches, library, least, noise, context);
  if (!search.has_rows()) return std::nullopt;
  const SystemModel law = search.affine();
  std::optional<FreeRun> best = searched_from(search, law);
  constexpr std::size_t kMore = 2;  // terms: what has more takes long to lose them
  std::size_t terms = 0, affine = 0;
  for (const Equation& equation : found.equations()) terms += equation.size();
  for (const Equation& equation : law.symbolic().equations()) affine += equation.size();
  if (terms > affine + kMore || search.is_late()) return best;
  std::optional<FreeRun> other = searched_from(search, SystemModel(found));
  if (!best || (other && is_better(*other, *best, least))) return other;
  return best;
}

}  // namespace lacuna
