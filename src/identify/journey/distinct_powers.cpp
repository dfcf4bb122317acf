// SPDX-License-Identifier: MIT
#include "distinct_powers.hpp"

#include <algorithm>
#include <set>

#include "identify/pipeline/equation_terms.hpp"
#include "lacuna/bases/expressions.hpp"

namespace lacuna {
namespace {

/// How many values an input takes; nothing where there are more than so many.
std::optional<int> value_count(const Dataset& data, Index input, int most) {
  std::set<double> values;
  for (const Trajectory& record : data.trajectories)
    for (const double value : record.inputs.col(input)) {
      values.insert(value);
      if (static_cast<int>(values.size()) > most) return std::nullopt;
    }
  return static_cast<int>(values.size());
}

/// The exponents of all terms; nothing where one is no monomial.
std::optional<std::vector<std::vector<int>>> all_exponents(const TermLibrary& library) {
  std::vector<std::vector<int>> all;
  for (const Term& term : library.terms) {
    auto exponents = term.exponents();
    if (!exponents) return std::nullopt;
    all.push_back(*std::move(exponents));
  }
  return all;
}

int largest_power(const std::vector<std::vector<int>>& exponents, std::size_t slot) {
  int largest = 0;
  for (const std::vector<int>& term : exponents) largest = std::max(largest, term[slot]);
  return largest;
}

std::string sentence(const Quantity& input, int count) {
  return input.name + " takes " + std::to_string(count) +
         " values, at which its power " + std::to_string(count) +
         " is a sum of lower ones: those from there on are no candidates";
}

}  // namespace

Pipeline with_distinct_powers(Pipeline pipeline, const Dataset& data,
                              std::vector<std::string>& warnings) {
  if (!pipeline.equations.empty() || !pipeline.constraints.empty() ||
      pipeline.energy_preserving)
    return pipeline;
  const TermLibrary library = pipeline.basis->library(variables_of(data));
  const auto exponents = all_exponents(library);
  if (!exponents) return pipeline;
  std::vector<bool> left_out(exponents->size(), false);
  for (std::size_t j = 0; j < data.inputs.size(); ++j) {
    const std::size_t slot = data.states.size() + j;
    const int power = largest_power(*exponents, slot);
    const auto count = value_count(data, static_cast<Index>(j), power);
    if (!count || *count < 2) continue;
    for (std::size_t i = 0; i < exponents->size(); ++i)
      left_out[i] = left_out[i] || (*exponents)[i][slot] >= *count;
    warnings.push_back(sentence(data.inputs[j], *count));
  }
  if (std::none_of(left_out.begin(), left_out.end(), [](bool left) { return left; }))
    return pipeline;
  std::vector<std::string> terms;
  for (std::size_t i = 0; i < left_out.size(); ++i)
    if (!left_out[i]) terms.push_back(library.terms[i].name());
  pipeline.basis = Expressions{{.terms = std::move(terms)}};
  return pipeline;
}

}  // namespace lacuna
