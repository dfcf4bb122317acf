// SPDX-License-Identifier: MIT
#include "invariant_text.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include "core/base/text.hpp"
#include "core/statistics/determined.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "readable.hpp"

namespace lacuna {
namespace {

/// The plainest number within three errors: 1 for 1.0015 +- 0.0009.
std::string plainest(double value, double error) {
  // For people: the plainest number within the errors.
  constexpr int kDigits = 9;
  constexpr double kErrors = 3.0;
  for (int digits = 1; digits < kDigits; ++digits) {
    const std::string text = format_number(value, digits);
    const std::optional<double> number = parse_number(text);
    if (number && std::abs(*number - value) <= kErrors * error) return text;
  }
  return format_number(value, kDigits);
}

/// "+ ", "- 0.5*" before a monomial; nothing but a sign where the coefficient is 1.
std::string factor_text(const RelationTerm& term, bool first) {
  std::string text = term.coefficient < 0.0 ? "- " : first ? "" : "+ ";
  if (first && !text.empty()) text = "-";
  const double size = std::abs(term.coefficient);
  const std::string number = plainest(size, term.error);
  return number == "1" ? text : text + number + "*";
}

}  // namespace

std::string relation_text(const Relation& relation) {
  std::string text;
  for (const RelationTerm& term : relation.terms)
    text += (text.empty() ? "" : " ") + factor_text(term, text.empty()) + term.term;
  // Beside so much scatter a value is what rounding leaves of 0.
  const bool is_value = is_determined(relation.value, relation.scatter);
  return text + " = " +
         with_error(is_value ? relation.value : 0.0, kNormalQuantile975 * relation.scatter);
}

std::string relation_sentence(const Relation& relation) {
  const std::string holds = relation_text(relation) + " on these data: ";
  std::string names;
  for (const RelationTerm& term : relation.terms)
    names += (names.empty() ? "" : ", ") + term.term;
  return holds + names + " and a constant cannot be distinguished";
}

std::string trapping_sentence(const OdeModel& model, const TrappingRegion& region) {
  // A decision, for people: of centre, weights and radius.
  constexpr int kDigits = 3;
  const double spread = region.radius / std::sqrt(region.weights.minCoeff());
  std::vector<std::string> squares;
  for (Index k = 0; k < model.dimension(); ++k) {
    const std::string& name = model.states()[static_cast<std::size_t>(k)].name;
    const double centre = region.centre[k];
    const bool is_zero = std::abs(centre) < 0.5 * std::pow(10.0, -kDigits) * spread;
    const std::string distance =
        is_zero ? name
                : "(" + name + (centre < 0.0 ? " + " : " - ") +
                      format_number(std::abs(centre), kDigits) + ")";
    const std::string weight = format_number(region.weights[k], kDigits);
    squares.push_back((weight == "1" ? "" : weight + "*") + distance + "^2");
  }
  return "All paths come into " + join(squares, " + ") +
         " <= " + format_number(region.radius, kDigits) + "^2 and stay";
}

}  // namespace lacuna
