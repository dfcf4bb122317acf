// SPDX-License-Identifier: MIT
#include "plain_terms.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "identify/pipeline/equation_terms.hpp"
#include "restricted_results.hpp"

namespace lacuna {
namespace {

/// The name of a product without its inputs; nothing where it is none of states and inputs.
std::optional<std::string> without_inputs(const Term& term, const Variables& variables) {
  auto exponents = term.exponents();
  if (!exponents) return std::nullopt;
  const auto states = static_cast<std::ptrdiff_t>(variables.states.size());
  const auto inputs = exponents->begin() + states;
  const auto time = inputs + static_cast<std::ptrdiff_t>(variables.inputs.size());
  const auto stands = [](int exponent) { return exponent > 0; };
  if (!std::any_of(exponents->begin(), inputs, stands) || !std::any_of(inputs, time, stands))
    return std::nullopt;
  std::fill(inputs, time, 0);
  return Term::monomial(*exponents, variables).name();
}

/// The terms of every equation of a model that is not an identity, with one in place of another.
std::vector<EquationTerms> terms_with(const IdentificationResult& found, std::size_t equation,
                                      const std::string& term, const std::string& other) {
  std::vector<EquationTerms> all;
  for (std::size_t k = 0; k < found.fit.size(); ++k) {
    const Equation& own = found.model.equations()[k];
    if (found.fit[k].identity || own.empty()) continue;
    EquationTerms terms{found.model.states()[k].name, {}};
    for (const WeightedTerm& summand : own) {
      const std::string name = summand.term.name();
      terms.terms.push_back(k == equation && name == term ? other : name);
    }
    std::sort(terms.terms.begin(), terms.terms.end());
    terms.terms.erase(std::unique(terms.terms.begin(), terms.terms.end()), terms.terms.end());
    all.push_back(std::move(terms));
  }
  return all;
}

std::size_t size_of(const OdeModel& model) {
  std::size_t size = 0;
  for (const Equation& equation : model.equations()) size += equation.size();
  return size;
}

/// The model with one product in its lower form, where it is as good a one.
std::optional<IdentificationResult> with_a_plain_term(const Pipeline& pipeline,
                                                      const RecordStream& records,
                                                      const IdentificationResult& found,
                                                      const RunContext& context) {
  const Variables variables = found.model.variables();
  for (std::size_t k = 0; k < found.fit.size(); ++k)
    for (const WeightedTerm& summand : found.model.equations()[k]) {
      const auto plain = without_inputs(summand.term, variables);
      if (!plain || found.fit[k].identity) continue;
      if (context.is_late()) return std::nullopt;  // a model in a hurry is no better one
      Pipeline other = pipeline;
      other.equations = terms_with(found, k, summand.term.name(), *plain);
      IdentificationResult result = identify(records, other, context);
      if (context.is_late()) return std::nullopt;
      const double most = std::log(static_cast<double>(std::max<Index>(found.fit[k].rows, 1)));
      const double more = chi_squared_over(result, found);
      if (size_of(result.model) > size_of(found.model) || !(more <= most)) continue;
      take_over_trail(found.trail, found.fit[k].equation, summand.term.name(), {more, most},
                      result.trail);
      result.stages = found.stages;
      return result;
    }
  return std::nullopt;
}

}  // namespace

IdentificationResult with_plain_terms(const Pipeline& pipeline, const RecordStream& records,
                                      IdentificationResult found, const RunContext& context) {
  if (found.library_alone || !pipeline.equations.empty() || !pipeline.constraints.empty())
    return found;
  while (auto other = with_a_plain_term(pipeline, records, found, context))
    found = std::move(*other);
  return found;
}

}  // namespace lacuna
