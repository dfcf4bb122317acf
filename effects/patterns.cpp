// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

/// Whether a slope that is the difference of two is as good as 0.
bool agree(double a, double b, double deviation, const NamingOptions& options) {
  const double larger = std::max(std::abs(a), std::abs(b));
  return std::abs(a - b) <=
         std::max(options.equal_slopes * larger, options.standard_errors * deviation);
}

}  // namespace

bool has_form(const Candidate& candidate, std::string_view pattern) {
  static constexpr std::array kShapes{"a", "b", "c"};
  const Expression whole = parse_expression(pattern);
  std::map<std::string, Expression> parts{{"x", candidate.argument}};
  if (candidate.shapes.size() > kShapes.size() || candidate.memory.size() > 1) return false;
  for (std::size_t i = 0; i < candidate.shapes.size(); ++i)
    parts.emplace(kShapes[i], Expression::variable(candidate.shapes[i].name));
  for (const MemoryState& memory : candidate.memory)
    parts.emplace("m", Expression::variable(memory.name));
  const std::set<std::string> names = whole.variables();
  const auto is_part = [&](const std::string& name) {
    return name == "t" || parts.contains(name);
  };
  if (!std::all_of(names.begin(), names.end(), is_part)) return false;
  return candidate.form == substitute(whole, parts);
}

bool is_at_upper_end(const ShapeParameter& shape, double value) {
  constexpr double kAtTheEnd = 0.99;  // a fact: fits stop there
  return value > shape.low + kAtTheEnd * (shape.high - shape.low);
}

VariableRange range_of_argument(const FittedForm& fitted) {
  return fitted.scope.range_of(fitted.candidate.argument);
}

double nominal_slope(const FittedForm& fitted) {
  return slope(fitted.nominal, fitted.candidate.equation, fitted.candidate.argument);
}

std::optional<Bend> bend_of(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (fitted.shapes.size() != 1 || !candidate.memory.empty()) return std::nullopt;
  const double slope = nominal_slope(fitted), c = fitted.coefficient, edge = fitted.shapes[0];
  const double error = fitted.deviation;
  if (has_form(candidate, "clip(x,-a,a)")) return Bend{slope + c, slope, edge, error, true};
  if (has_form(candidate, "x-clip(x,-a,a)")) return Bend{slope, slope + c, edge, error, true};
  if (has_form(candidate, "x-a*tanh(x/a)")) return Bend{slope, slope + c, edge, error, false};
  if (has_form(candidate, "tanh(x/a)"))
    return Bend{slope + c / edge, slope, edge, error / edge, false};
  return std::nullopt;
}

bool is_flat_inside(const Bend& bend, const NamingOptions& options) {
  return agree(bend.outside, bend.outside - bend.inside, bend.deviation, options);
}

bool is_flat_outside(const Bend& bend, const NamingOptions& options) {
  return agree(bend.inside, bend.inside - bend.outside, bend.deviation, options);
}

bool is_part_of_term(const FittedForm& fitted) {
  return is_part_of(fitted, fitted.candidate.argument);
}

bool is_part_of(const FittedForm& fitted, const Expression& term) {
  const double whole = slope(fitted.nominal, fitted.candidate.equation, term);
  const bool is_part = std::abs(fitted.coefficient) < std::abs(whole);
  return whole * fitted.coefficient > 0.0 &&
         (is_part || agree(whole, fitted.coefficient, fitted.deviation, fitted.options));
}

bool is_whole_term(const FittedForm& fitted) {
  return agree(nominal_slope(fitted), fitted.coefficient, fitted.deviation, fitted.options);
}

bool opposes(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  return fitted.coefficient < 0.0 ||
         !is_own_speed(fitted.scope, candidate.equation, candidate.argument);
}

}  // namespace lacuna
