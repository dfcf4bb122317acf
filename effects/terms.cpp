// SPDX-License-Identifier: MIT
#include "lacuna/effects/terms.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lacuna/core/text.hpp"

namespace lacuna {
namespace {

const Equation& terms_of(const OdeModel& model, Index equation) {
  return model.equations()[static_cast<std::size_t>(equation)];
}

bool is_variable(const Term& term) {
  return term.expression().operation() == Operation::Variable;
}

bool is_difference_of_variables(const Term& term) {
  const Expression& whole = term.expression();
  return whole.operation() == Operation::Subtract &&
         std::all_of(whole.operands().begin(), whole.operands().end(),
                     [](const Expression& x) { return x.operation() == Operation::Variable; });
}

bool is_whole_power(const Expression& x) {
  return x.operation() == Operation::Power &&
         x.operands()[1].operation() == Operation::Number && x.operands()[1].value() >= 2.0 &&
         x.operands()[1].value() == std::floor(x.operands()[1].value());
}

/// The factors of a product one by one, those of a power with what is left of it.
void collect_factors(const Expression& product, const std::vector<std::string>& beside,
                     std::vector<Factor>& result) {
  const auto with = [&](const std::string& more) {
    std::vector<std::string> all = beside;
    all.push_back("(" + more + ")");
    return all;
  };
  if (product.operation() == Operation::Multiply) {
    const Expression &a = product.operands()[0], &b = product.operands()[1];
    collect_factors(a, with(b.to_string()), result);
    collect_factors(b, with(a.to_string()), result);
  } else if (is_whole_power(product)) {
    const Expression& x = product.operands()[0];
    const double less = product.operands()[1].value() - 1.0;
    const std::string power = less > 1.0 ? "^" + format_number(less) : "";
    const std::string rest = "(" + x.to_string() + ")" + power;
    result.push_back({x.to_string(), join(with(rest), "*")});
  } else if (!product.variables().empty() && !beside.empty()) {
    result.push_back({product.to_string(), join(beside, "*")});
  }
}

}  // namespace

bool has_term(const Scope& scope, Index equation, const std::string& term) {
  const std::string name = Term::parse(term, scope.model.variables()).name();
  const Equation& terms = terms_of(scope.model, equation);
  return std::any_of(terms.begin(), terms.end(),
                     [&](const WeightedTerm& summand) { return summand.term.name() == name; });
}

double slope(const OdeModel& model, Index equation, const std::string& argument) {
  const double whole = model.coefficient(equation, argument);
  const auto minus = argument.find('-');
  if (whole != 0.0 || minus == std::string::npos) return whole;
  const std::string a = argument.substr(0, minus), b = argument.substr(minus + 1);
  const double reversed = model.coefficient(equation, b + "-" + a);
  if (reversed != 0.0) return -reversed;
  // What a has more than b acts on it alone: a spring to the ground.
  const double own = model.coefficient(equation, a), other = model.coefficient(equation, b);
  const bool opposite = own * other < 0.0;
  return opposite ? std::copysign(std::min(std::abs(own), std::abs(other)), own) : own;
}

bool is_velocity(const Scope& scope, Index equation) {
  return scope.integral_of(equation).has_value();
}

bool in_other_part(const Scope& scope, Index equation, const std::string& state) {
  const Index m = scope.model.dimension();
  std::vector<Index> part(static_cast<std::size_t>(m));
  for (Index k = 0; k < m; ++k) part[static_cast<std::size_t>(k)] = k;
  const auto join_parts = [&](Index a, Index b) {
    const Index from = part[static_cast<std::size_t>(a)],
                to = part[static_cast<std::size_t>(b)];
    std::replace(part.begin(), part.end(), from, to);
  };
  for (Index k = 0; k < m; ++k)
    for (const WeightedTerm& summand : terms_of(scope.model, k))
      for (Index j = 0; j < m; ++j)
        if (summand.term.expression().variables().contains(scope.state(j).name))
          join_parts(k, j);
  for (Index j = 0; j < m; ++j)
    if (scope.state(j).name == state)
      return part[static_cast<std::size_t>(j)] != part[static_cast<std::size_t>(equation)];
  return false;
}

std::vector<std::string> variable_names(const Scope& scope) {
  std::vector<std::string> names;
  for (const VariableRange& variable : scope.variables) names.push_back(variable.name);
  return names;
}

namespace {

const std::string& unit_of(const Scope& scope, const std::string& variable) {
  static const std::string none;
  const auto found =
      std::find_if(scope.variables.begin(), scope.variables.end(),
                   [&](const VariableRange& range) { return range.name == variable; });
  return found != scope.variables.end() ? found->unit : none;
}

bool are_opposite(const WeightedTerm& one, const WeightedTerm& other) {
  constexpr double kEqual = 0.01;
  const double a = one.coefficient, b = other.coefficient;
  return is_variable(one.term) && is_variable(other.term) &&
         std::abs(a + b) <= kEqual * std::abs(a - b);
}

/// Whether two terms of an equation are those of a difference: variables with opposite
/// coefficients, or with coefficients of opposite sign and like size where they are of one
/// kind, as those of a body that is held by another one and by the ground.
bool make_a_difference(const Scope& scope, const WeightedTerm& one, const WeightedTerm& other) {
  constexpr double kLike = 3.0;
  if (are_opposite(one, other)) return true;
  if (!is_variable(one.term) || !is_variable(other.term)) return false;
  const double a = one.coefficient, b = other.coefficient;
  const std::string& unit = unit_of(scope, one.term.name());
  return !unit.empty() && unit == unit_of(scope, other.term.name()) && a * b < 0.0 &&
         std::abs(a) <= kLike * std::abs(b) && std::abs(b) <= kLike * std::abs(a);
}

}  // namespace

std::vector<std::string> differences(const Scope& scope, Index equation) {
  std::vector<std::string> result;
  const auto add = [&](const std::string& a, const std::string& b) {
    const bool own_last = b == scope.state(equation).name;
    result.push_back(own_last ? b + "-" + a : a + "-" + b);
  };
  const Equation& terms = terms_of(scope.model, equation);
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (is_difference_of_variables(terms[i].term)) {
      const auto operands = terms[i].term.expression().operands();
      add(operands[0].to_string(), operands[1].to_string());
    }
    for (std::size_t j = i + 1; j < terms.size(); ++j)
      if (make_a_difference(scope, terms[i], terms[j]))
        add(terms[i].term.name(), terms[j].term.name());
  }
  return result;
}

std::vector<std::string> felt_speeds(const Scope& scope, Index equation) {
  std::vector<std::string> speeds{scope.state(equation).name};
  for (const std::string& slip : differences(scope, equation))
    if (is_own_speed(scope, equation, slip)) speeds.push_back(slip);
  for (Index k = 0; k < scope.model.dimension(); ++k)
    if (k != equation && is_velocity(scope, equation) && is_velocity(scope, k))
      speeds.push_back(scope.state(k).name);
  return speeds;
}

bool is_own_speed(const Scope& scope, Index equation, const std::string& speed) {
  return speed.substr(0, speed.find('-')) == scope.state(equation).name;
}

std::vector<std::string> linear_arguments(const Scope& scope, Index equation) {
  std::vector<std::string> result;
  for (const WeightedTerm& summand : terms_of(scope.model, equation))
    if (is_variable(summand.term)) result.push_back(summand.term.name());
  for (std::string& difference : differences(scope, equation))
    result.push_back(std::move(difference));
  return result;
}

bool is_transmission(const Scope& scope, const std::string& argument) {
  if (argument.find('-') != std::string::npos) return true;
  for (Index j = 0; j < scope.model.dimension(); ++j) {
    if (scope.state(j).name != argument) continue;
    const Equation& rate = terms_of(scope.model, j);
    return (rate.size() == 1 && is_difference_of_variables(rate[0].term)) ||
           (rate.size() == 2 && are_opposite(rate[0], rate[1]));
  }
  return false;
}

std::vector<std::string> nonlinear_terms(const Scope& scope, Index equation) {
  std::vector<std::string> result;
  for (const WeightedTerm& summand : terms_of(scope.model, equation))
    if (!is_variable(summand.term) && !summand.term.expression().variables().empty())
      result.push_back(summand.term.name());
  return result;
}

std::vector<Factor> factors_of(const Scope& scope, const std::string& term) {
  const std::vector<std::string> names = scope.model.variables().names();
  std::vector<Factor> result;
  collect_factors(parse_expression(term, names), {}, result);
  std::erase_if(result, [&](const Factor& factor) {
    return parse_expression(factor.rest, names).variables().empty();
  });
  return result;
}

VariableRange range_of(const Scope& scope, const std::string& argument) {
  for (const VariableRange& variable : scope.variables)
    if (variable.name == argument) return variable;
  return scope.range_of(argument);
}

std::string right_hand_side(const Scope& scope, Index equation) {
  std::vector<std::string> summands;
  for (const WeightedTerm& summand : terms_of(scope.model, equation))
    summands.push_back("(" + format_number(summand.coefficient) + ")*(" + summand.term.name() +
                       ")");
  return summands.empty() ? "0" : join(summands, "+");
}

std::vector<Vector> geometric_starts(double low, double high, int count) {
  std::vector<Vector> starts;
  const double ratio = std::pow(high / low, 1.0 / std::max(1, count - 1));
  for (int i = 0; i < count; ++i)
    starts.push_back(Vector::Constant(1, std::min(high, low * std::pow(ratio, i))));
  return starts;
}

std::vector<Vector> starts_at(const std::vector<double>& values) {
  std::vector<Vector> starts;
  for (const double value : values) starts.push_back(Vector::Constant(1, value));
  return starts;
}

double magnitude_quantile(const Scope& scope, const std::string& argument, double level) {
  return scope.range_of("abs(" + argument + ")").quantile(level);
}

Candidate plain_candidate(const std::string& form, const std::string& argument,
                          const std::string& description) {
  Candidate candidate;
  candidate.form = form;
  candidate.argument = argument;
  candidate.description = description;
  return candidate;
}

Candidate shaped_candidate(const std::string& form, const std::string& argument,
                           const std::string& description, const ShapeParameter& shape,
                           std::vector<Vector> starts) {
  Candidate candidate = plain_candidate(form, argument, description);
  candidate.shapes = {shape};
  candidate.starts = std::move(starts);
  for (Vector& start : candidate.starts) start = start.cwiseMax(shape.low).cwiseMin(shape.high);
  return candidate;
}

MemoryState follower(const Scope& scope, const std::string& place) {
  const std::string distance = "((" + place + ")-$follower)";
  // As good as at once for what is sampled.
  const std::string pace = format_number(8.0 / scope.step);
  return {"follower", pace + "*(" + distance + "-clip(" + distance + ",-$gap,$gap))", place};
}

std::string follower_ahead_of(const std::string& place) {
  return "clip($follower-(" + place + "),-$gap,$gap)";
}

void bound_to_term(const Scope& scope, Index equation, const std::string& term,
                   Candidate& candidate) {
  constexpr double kWhole = 2.0;
  const double most = kWhole * slope(scope.model, equation, term);
  candidate.least = std::min(0.0, most);
  candidate.most = std::max(0.0, most);
}

bool is_part_of_term(const Candidate& candidate, const FittedCandidate& fitted) {
  const double whole = slope(fitted.nominal, candidate.equation, candidate.argument);
  const bool is_part = std::abs(fitted.coefficient) < std::abs(whole);
  return whole * fitted.coefficient > 0.0 &&
         (is_part || slopes_agree(whole, fitted.coefficient, fitted.deviation));
}

bool slopes_agree(double a, double b, double deviation) {
  const double larger = std::max(std::abs(a), std::abs(b));
  return std::abs(a - b) <= std::max(0.2 * larger, 3.0 * deviation);
}

bool bends_at_standstill(const Scope& scope, const Candidate& candidate, double edge) {
  // Below this share of the largest speed a change of slope is as good as a jump.
  constexpr double kStandstill = 0.1;
  const std::string& x = candidate.argument;
  const std::vector<std::string> speeds = felt_speeds(scope, candidate.equation);
  return std::find(speeds.begin(), speeds.end(), x) != speeds.end() &&
         edge < kStandstill * range_of(scope, x).magnitude();
}

bool opposes(const Scope& scope, const Candidate& candidate, const FittedCandidate& fitted) {
  return fitted.coefficient < 0.0 ||
         !is_own_speed(scope, candidate.equation, candidate.argument);
}

}  // namespace lacuna
