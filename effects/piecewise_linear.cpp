// SPDX-License-Identifier: MIT
#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

void add_bend(const Scope& scope, const std::string& x, std::vector<Candidate>& result) {
  const VariableRange range = range_of(scope, x);
  const auto at = [&](double level) { return range.quantile(level); };
  result.push_back(shaped_candidate(
      "max(" + x + "-$edge,0)", x, "bend in the characteristic of " + x,
      {"edge", range.unit, at(0.05), at(0.95), false}, starts_at({at(0.2), at(0.5), at(0.8)})));
  result.back().plainer = "one-sided-stop";  // where the bend lies at the rim
}

void add_two_bends(const Scope& scope, const std::string& x, std::vector<Candidate>& result) {
  if (!range_of(scope, x).changes_sign()) return;
  const auto at = [&](double level) { return magnitude_quantile(scope, x, level); };
  result.push_back(shaped_candidate(
      "clip(" + x + ",-$edge,$edge)", x, "two bends in the characteristic of " + x,
      {"edge", range_of(scope, x).unit, at(0.02), at(0.98), false},
      starts_at({at(0.15), at(0.4), at(0.7)})));
}

std::vector<Candidate> make(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  std::vector<std::string> arguments = variable_names(scope);
  for (const std::string& difference : differences(scope, equation))
    arguments.push_back(difference);
  for (const std::string& x : arguments) {
    add_bend(scope, x, result);
    add_two_bends(scope, x, result);
    if (!has_term(scope, equation, x) && range_of(scope, x).changes_sign())
      result.push_back(plain_candidate("abs(" + x + ")", x, "absolute value of " + x));
  }
  return result;
}

}  // namespace

const EffectFamily kPiecewiseLinear{
    {"piecewise-linear", "A characteristic of straight lines with one bend or two", ""},
    "a nonlinear resistor, a spring that lifts off, a rectifier",
    {},
    make};

}  // namespace lacuna
