// SPDX-License-Identifier: MIT
#include "plain_terms.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fitting_library.hpp"
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

/// The terms of every equation of a model that is not an identity, with one in place of
/// another.
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

/// The first term of an equation in which an input with two values multiplies a state.
std::optional<std::string> switched_term(const Equation& equation, const Dataset& data,
                                         const Variables& variables) {
  for (const WeightedTerm& summand : equation) {
    const auto exponents = summand.term.exponents();
    if (!without_inputs(summand.term, variables)) continue;
    for (std::size_t j = 0; j < data.inputs.size(); ++j)
      if ((*exponents)[data.states.size() + j] > 0 &&
          value_count(data, static_cast<Index>(j), 2) == 2)
        return summand.term.name();
  }
  return std::nullopt;
}

/// The constant and all variables but time.
std::vector<std::string> affine_terms(const Variables& variables) {
  std::vector<std::string> terms{"1"};
  terms.insert(terms.end(), variables.states.begin(), variables.states.end());
  terms.insert(terms.end(), variables.inputs.begin(), variables.inputs.end());
  return terms;
}

/// The model with an affine equation in the place of one in which a product with an input of
/// two values stands, where it leaves as little: at a single step Q from rest, T*Q is T but for
/// a constant.
std::optional<IdentificationResult> with_an_affine_law(const Pipeline& pipeline,
                                                       const RecordStream& records,
                                                       const IdentificationResult& found,
                                                       const RunContext& context) {
  const Dataset* data = records.in_memory();
  if (data == nullptr) return std::nullopt;
  const Variables variables = found.model.variables();
  for (std::size_t k = 0; k < found.fit.size(); ++k) {
    const auto term = switched_term(found.model.equations()[k], *data, variables);
    if (!term || found.fit[k].identity || context.is_late()) continue;
    Pipeline other = pipeline;
    other.equations = terms_with(found, k, "", "");
    for (EquationTerms& equation : other.equations)
      if (equation.state == found.model.states()[k].name)
        equation.terms = affine_terms(variables);
    IdentificationResult result = identify(records, other, context);
    if (context.is_late()) return std::nullopt;
    const double most = std::log(static_cast<double>(std::max<Index>(found.fit[k].rows, 1)));
    if (!(chi_squared_over(result, found) <= most)) continue;
    result.warnings.push_back(left_hand_side(found.fit[k].equation, Evolution::Flow) +
                              ": at two values of an input " + *term +
                              " cannot be distinguished from a linear law, which was taken");
    result.stages = found.stages;
    return result;
  }
  return std::nullopt;
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
  while (auto other = with_an_affine_law(pipeline, records, found, context))
    found = std::move(*other);
  return found;
}

}  // namespace lacuna
