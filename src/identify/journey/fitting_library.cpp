// SPDX-License-Identifier: MIT
#include "fitting_library.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "bases/expressions.hpp"
#include "identify/pipeline/equation_terms.hpp"

namespace lacuna {
namespace {

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
  return input.name + " takes " + std::to_string(count) + " values, at which its power " +
         std::to_string(count) +
         " is a sum of lower ones: those from there on are no candidates";
}

/// The pipeline with these terms of a library only.
Pipeline with_terms(Pipeline pipeline, const TermLibrary& library,
                    const std::vector<bool>& left_out) {
  std::vector<std::string> terms;
  for (std::size_t i = 0; i < left_out.size(); ++i)
    if (!left_out[i]) terms.push_back(library.terms[i].name());
  pipeline.basis = Expressions{{.terms = std::move(terms)}};
  return pipeline;
}

/// Whether terms of the basis may be left out: nobody named them, and nothing else does.
bool is_free(const Pipeline& pipeline) {
  return pipeline.equations.empty() && pipeline.constraints.empty() &&
         !pipeline.energy_preserving;
}

int degree_of(const std::vector<int>& exponents) {
  return std::accumulate(exponents.begin(), exponents.end(), 0);
}

}  // namespace

std::optional<int> value_count(const Dataset& data, Index input, int most) {
  std::set<double> values;
  for (const Trajectory& record : data.trajectories)
    for (const double value : record.inputs.col(input)) {
      values.insert(value);
      if (static_cast<int>(values.size()) > most) return std::nullopt;
    }
  return static_cast<int>(values.size());
}

Pipeline with_determined_terms(Pipeline pipeline, const Dataset& data, double samples_per_term,
                               std::vector<std::string>& warnings) {
  if (!is_free(pipeline)) return pipeline;
  const TermLibrary library = pipeline.basis->library(variables_of(data));
  const auto exponents = all_exponents(library);
  if (!exponents) return pipeline;
  const double most = static_cast<double>(data.samples()) / samples_per_term;
  std::vector<bool> left_out(exponents->size(), false);
  auto left = static_cast<double>(left_out.size());
  int degree = 0;
  for (const std::vector<int>& term : *exponents) degree = std::max(degree, degree_of(term));
  const int given = degree;
  for (; left > most && degree > 1; --degree)
    for (std::size_t i = 0; i < left_out.size(); ++i)
      if (degree_of((*exponents)[i]) == degree) {
        left_out[i] = true;
        left -= 1.0;
      }
  if (degree == given) return pipeline;
  warnings.push_back(std::to_string(data.samples()) + " samples do not determine " +
                     std::to_string(left_out.size()) +
                     " candidate terms: those of a degree above " + std::to_string(degree) +
                     " were left out");
  return with_terms(std::move(pipeline), library, left_out);
}

Pipeline with_distinct_powers(Pipeline pipeline, const Dataset& data,
                              std::vector<std::string>& warnings) {
  if (!is_free(pipeline)) return pipeline;
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
  return with_terms(std::move(pipeline), library, left_out);
}

}  // namespace lacuna
