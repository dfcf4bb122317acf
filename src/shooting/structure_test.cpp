// SPDX-License-Identifier: MIT
#include "lacuna/shooting/structure_test.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "lacuna/core/error.hpp"

namespace lacuna {
namespace {

using TermKey = std::pair<Index, std::string>;

/// The two-sided normal quantile of a small probability, by bisection of erfc.
double normal_bound(double probability) {
  double low = 0.0, high = 40.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > probability ? low : high) = middle;
  }
  return high;
}

const Equation& equation_of(const ParametrisedModel& model, Index equation) {
  return model.symbolic().equations()[static_cast<std::size_t>(equation)];
}

const WeightedTerm& summand_of(const ParametrisedModel& model, const FreeCoefficient& c) {
  return equation_of(model, c.equation)[static_cast<std::size_t>(c.summand)];
}

ParametrisedModel rebuilt(const ParametrisedModel& model, std::vector<Equation> equations,
                          std::vector<FreeCoefficient> free) {
  return {OdeModel(model.symbolic().states(), model.symbolic().inputs(), std::move(equations),
                   model.symbolic().time_unit()),
          std::move(free), model.shapes()};
}

ParametrisedModel without_coefficient(const ParametrisedModel& model, std::size_t number) {
  std::vector<Equation> equations = model.symbolic().equations();
  std::vector<FreeCoefficient> free = model.coefficients();
  const FreeCoefficient gone = free[number];
  Equation& equation = equations[static_cast<std::size_t>(gone.equation)];
  equation.erase(equation.begin() + gone.summand);
  free.erase(free.begin() + static_cast<std::ptrdiff_t>(number));
  for (FreeCoefficient& c : free)
    if (c.equation == gone.equation && c.summand > gone.summand) --c.summand;
  return rebuilt(model, std::move(equations), std::move(free));
}

/// The candidate becomes the last free coefficient.
ParametrisedModel with_candidate(const ParametrisedModel& model, const CandidateTerm& candidate,
                                 double coefficient) {
  std::vector<Equation> equations = model.symbolic().equations();
  std::vector<FreeCoefficient> free = model.coefficients();
  Equation& equation = equations[static_cast<std::size_t>(candidate.equation)];
  free.push_back({candidate.equation, static_cast<Index>(equation.size())});
  const Term term(candidate.term.expression(), model.symbolic().variables());
  equation.push_back({term, coefficient});
  return rebuilt(model, std::move(equations), std::move(free));
}

bool uses_shape(const ParametrisedModel& model, const FreeCoefficient& c) {
  const auto names = summand_of(model, c).term.expression().variables();
  return std::any_of(model.shapes().begin(), model.shapes().end(),
                     [&](const FreeShape& s) { return names.contains(s.name); });
}

/// Changes the structure step by step.
class Tester {
 public:
  Tester(const ParametrisedModel& model, const Dataset& record,
         const std::vector<CandidateTerm>& candidates, const StructureOptions& options,
         const RunContext& context)
      : record_(record),
        candidates_(candidates),
        options_(options),
        context_(context),
        result_{refine(model, record, options.refine, context), {}} {}

  StructureTest run() {
    while (result_.refinement.status != RefineStatus::Diverged) {
      if (static_cast<int>(result_.changes.size()) >= options_.max_changes) {
        result_.settled = false;
        break;
      }
      context_.report("testing the structure", 0.5);
      if (!remove() && !add()) break;
    }
    return std::move(result_);
  }

 private:
  const ParametrisedModel& model() const { return result_.refinement.model; }

  double score(std::size_t number) const {
    const auto i = static_cast<Index>(number);
    return std::abs(model().values()[i]) / result_.refinement.standard_errors[i];
  }

  bool may_go(std::size_t number) const {
    const FreeCoefficient& c = model().coefficients()[number];
    const auto i = static_cast<Index>(number);
    const bool contains_zero =
        !(result_.refinement.ci95(i, 0) > 0.0) && !(result_.refinement.ci95(i, 1) < 0.0);
    return contains_zero && !c.prior && !uses_shape(model(), c) &&
           equation_of(model(), c.equation).size() > 1;
  }

  bool remove() {
    std::optional<std::size_t> least;
    for (std::size_t i = 0; i < model().coefficients().size(); ++i)
      if (may_go(i) && (!least || !(score(i) >= score(*least)))) least = i;
    if (!least) return false;
    const FreeCoefficient& c = model().coefficients()[*least];
    const std::string term = summand_of(model(), c).term.name();
    const auto i = static_cast<Index>(*least);
    const double half_width =
        0.5 * (result_.refinement.ci95(i, 1) - result_.refinement.ci95(i, 0));
    if (came_.contains({c.equation, term})) barred_.insert({c.equation, term});
    result_.changes.push_back({false, c.equation, term, score(*least),
                               half_width / result_.refinement.standard_errors[i]});
    result_.refinement =
        refine(without_coefficient(model(), *least), record_, options_.refine, context_);
    return true;
  }

  bool add() {
    const std::vector<CandidateTerm> open = open_candidates();
    if (open.empty()) return false;
    const auto scores =
        ScoreSystem(result_.refinement, record_, open, options_.refine).scores();
    const auto best = std::max_element(
        scores.begin(), scores.end(),
        [](const CandidateScore& a, const CandidateScore& b) { return a.gain < b.gain; });
    const double bound = normal_bound(options_.false_alarm / static_cast<double>(open.size()));
    if (!(best->gain > std::max(bound * bound, least_gain()))) return false;
    return adopt(open[static_cast<std::size_t>(best - scores.begin())], *best, bound);
  }

  /// Decrease of chi squared below which a term is not worth it, however significant.
  double least_gain() const {
    const Refinement& now = result_.refinement;
    return now.white ? 0.0 : options_.least_share * now.chi_squared;
  }

  /// Takes a candidate in, when it is significant after the refinement too.
  bool adopt(const CandidateTerm& candidate, const CandidateScore& score, double bound) {
    Refinement refined = refine(with_candidate(model(), candidate, score.coefficient), record_,
                                options_.refine, context_);
    const auto number = static_cast<Index>(refined.model.coefficients().size()) - 1;
    const double reached =
        std::abs(refined.model.values()[number]) / refined.standard_errors[number];
    const TermKey key{candidate.equation, candidate.term.name()};
    if (refined.status == RefineStatus::Diverged || !(reached > bound)) {
      barred_.insert(key);
      return add();
    }
    came_.insert(key);
    result_.changes.push_back({true, key.first, key.second, reached, bound});
    result_.refinement = std::move(refined);
    return true;
  }

  std::vector<CandidateTerm> open_candidates() const {
    std::set<TermKey> present = barred_;
    for (const FreeCoefficient& c : model().coefficients())
      present.insert({c.equation, summand_of(model(), c).term.name()});
    std::vector<CandidateTerm> open;
    for (const CandidateTerm& candidate : candidates_)
      if (!present.contains({candidate.equation, candidate.term.name()}))
        open.push_back(candidate);
    return open;
  }

  const Dataset& record_;
  const std::vector<CandidateTerm>& candidates_;
  const StructureOptions& options_;
  const RunContext& context_;
  std::set<TermKey> came_;    // since the begin
  std::set<TermKey> barred_;  // came and left, or did not keep what they promised
  StructureTest result_;
};

}  // namespace

StructureTest test_structure(const ParametrisedModel& model, const Dataset& record,
                             const std::vector<CandidateTerm>& candidates,
                             const StructureOptions& options, const RunContext& context) {
  if (!(options.false_alarm > 0.0 && options.false_alarm < 1.0))
    throw ArgumentError("test_structure", "the false alarm rate is not a probability",
                        "give a number between 0 and 1, e.g. 0.01");
  return Tester(model, record, candidates, options, context).run();
}

}  // namespace lacuna
