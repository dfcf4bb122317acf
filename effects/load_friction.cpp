// SPDX-License-Identifier: MIT
#include <algorithm>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// Facts of the search: from where one of two torques rubs alone to where the other one does.
constexpr double kLeastRatio = 0.02, kLargestRatio = 50.0;

constexpr std::string_view kAlways = "abs(load)*sign(v)";
constexpr std::string_view kNearStandstill = "abs(load)*exp(-abs(v/speed)^exponent)*sign(v)";
constexpr std::string_view kBesideBase = "(abs(load)+base)*exp(-abs(v/speed)^exponent)*sign(v)";

// Facts of the search: from where friction without a load is lost in that of the load to where
// it is all of it.
constexpr double kLeastBase = 0.01, kLargestBase = 100.0;

/// What the equation of a speed v says that drives it and that weighs on it, each as a sum of
/// nominal terms; empty where there is none.
struct Loads {
  std::optional<Expression> drive;   ///< has inputs
  std::optional<Expression> weight;  ///< is of states alone: gravity, a spring
};

Loads loads_of(const Scope& scope, Index equation) {
  Loads loads;
  const std::string& speed = scope.state(equation).name;
  for (const WeightedTerm& one : scope.model.equations()[static_cast<std::size_t>(equation)]) {
    const std::set<std::string> names = one.term.expression().variables();
    if (names.empty() || names.contains(speed) || one.coefficient == 0.0) continue;
    const bool drives = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return is_input(scope, Expression::variable(name));
    });
    std::optional<Expression>& sum = drives ? loads.drive : loads.weight;
    const Expression part = Expression::number(one.coefficient) * one.term.expression();
    sum = sum ? *sum + part : part;
  }
  return loads;
}

/// Friction of a load at all speeds, and of one near standstill alone.
/// @param argument of what the load is a function, without shape parameters
void add_friction(const Scope& scope, const Expression& v, const Expression& load,
                  const Expression& argument, const std::vector<ShapeParameter>& shapes,
                  const std::vector<Vector>& starts, std::vector<Candidate>& result) {
  Candidate always =
      plain_candidate(formula(scope, kAlways, {{"load", load}, {"v", v}}), argument);
  always.shapes = shapes;
  always.starts = starts;
  always.most = 0.0;
  Candidate slow = always;
  slow.form = formula(scope, kNearStandstill, {{"load", load}, {"v", v}});
  const std::vector<ShapeParameter> rise = rise_shapes(scope, v);
  slow.shapes.insert(slow.shapes.end(), rise.begin(), rise.end());
  slow.starts.clear();
  for (const Vector& start : starts.empty() ? std::vector<Vector>{Vector{}} : starts)
    for (const double part : {0.1, 0.4}) {
      Vector more(start.size() + 2);
      more << start, part * rise.front().high, 2.0;
      slow.starts.push_back(more);
    }
  result.push_back(std::move(always));
  result.push_back(std::move(slow));
}

/// Friction near standstill with a part that needs no load.
Candidate with_base(const Scope& scope, Candidate slow, const Expression& v,
                    const Expression& load) {
  const double usual = magnitude_quantile(scope, load, 0.5);
  slow.form = formula(scope, kBesideBase, {{"load", load}, {"v", v}});
  slow.shapes.insert(slow.shapes.begin(),
                     {"base", "", kLeastBase * usual, kLargestBase * usual, true});
  for (Vector& start : slow.starts) {
    Vector more(start.size() + 1);
    more << usual, start;
    start = more;
  }
  return slow;
}

std::vector<Candidate> load_friction_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  if (!scope.state(equation).changes_sign() || !is_velocity(scope, equation)) return result;
  const Expression v = own_state(scope, equation);
  const Loads loads = loads_of(scope, equation);
  for (const std::optional<Expression>& load : {loads.drive, loads.weight})
    if (load) add_friction(scope, v, *load, *load, {}, {}, result);
  if (!loads.drive || !loads.weight) return result;
  // A gear that holds a weight carries it on both sides.
  const Expression carried = *loads.weight - *loads.drive;
  add_friction(scope, v, carried, carried, {}, {}, result);
  result.push_back(with_base(scope, result.back(), v, carried));
  const Expression ratio = Expression::variable(scope.free_name("ratio"));
  add_friction(scope, v, *loads.weight * ratio - *loads.drive, carried,
               {{"ratio", "", kLeastRatio, kLargestRatio, true}}, starts_at({0.2, 1.0, 5.0}),
               result);
  return result;
}

/// Friction near standstill with the names of a candidate's shape parameters.
Expression near_standstill(std::string_view pattern, const Candidate& candidate,
                           std::map<std::string, Expression> parts) {
  const std::size_t count = candidate.shapes.size();
  const auto shape = [&](std::size_t from_end) {
    return Expression::variable(candidate.shapes[count - from_end].name);
  };
  parts.emplace("speed", shape(2));
  parts.emplace("exponent", shape(1));
  if (count > 2) parts.emplace("base", shape(3));
  return substitute(parse_expression(pattern), parts);
}

/// The load of a product whose first factor is its size, alone or with a base.
std::optional<Expression> load_in(const Expression& product) {
  if (product.operation() == Operation::Multiply) return load_in(product.operands()[0]);
  if (product.operation() == Operation::Add) return load_in(product.operands()[0]);
  if (product.operation() != Operation::Abs) return std::nullopt;
  return product.operands()[0];
}

std::optional<Reading> load_friction_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const std::optional<Expression> load = load_in(candidate.form);
  if (!load) return std::nullopt;
  const Expression v = own_state(fitted.scope, candidate.equation);
  const std::map<std::string, Expression> parts{{"load", *load}, {"v", v}};
  const bool always = candidate.form == substitute(parse_expression(kAlways), parts);
  const bool has_shapes = candidate.shapes.size() >= 2;
  const bool slow =
      has_shapes && (candidate.form == near_standstill(kNearStandstill, candidate, parts) ||
                     (candidate.shapes.size() > 2 &&
                      candidate.form == near_standstill(kBesideBase, candidate, parts)));
  if (!always && !slow) return std::nullopt;
  return Reading{"dry friction opposing " + v.to_string() + " that grows with the load" +
                 (always ? "" : ", near standstill")};
}

}  // namespace

const EffectFamily kLoadFriction{
    {"load-friction", "Dry friction that grows with the torque or force that a joint carries",
     "Duclusaud, Passault et al., arXiv 2410.08650 (2024)"},
    "gears, worms, screws, belts",
    load_friction_forms,
    load_friction_reading};

}  // namespace lacuna
