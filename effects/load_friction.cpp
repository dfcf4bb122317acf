// SPDX-License-Identifier: MIT
#include <algorithm>

#include "lacuna/effects/families.hpp"
#include "lacuna/effects/forms.hpp"
#include "lacuna/effects/patterns.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// From where one of two torques rubs alone to where the other one does.
constexpr double kLeastRatio = 0.02, kLargestRatio = 50.0;

constexpr std::string_view kAlways = "abs(load)*sign(v)";
constexpr std::string_view kNearStandstill = "abs(load)*exp(-abs(v/speed)^exponent)*sign(v)";

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
  slow.shapes.push_back(rise_speed(scope, v));
  slow.shapes.push_back({"exponent", "", 0.5, 4.0, true});
  slow.starts.clear();
  for (const Vector& start : starts.empty() ? std::vector<Vector>{Vector{}} : starts)
    for (const double part : {0.1, 0.4}) {
      Vector more(start.size() + 2);
      more << start, part * rise_speed(scope, v).high, 2.0;
      slow.starts.push_back(more);
    }
  result.push_back(std::move(always));
  result.push_back(std::move(slow));
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
  const Expression ratio = Expression::variable(scope.free_name("ratio"));
  add_friction(scope, v, *loads.weight * ratio - *loads.drive, carried,
               {{"ratio", "", kLeastRatio, kLargestRatio, true}}, starts_at({0.2, 1.0, 5.0}),
               result);
  return result;
}

/// The first factor of a product.
const Expression& first_factor(const Expression& product) {
  return product.operation() == Operation::Multiply ? first_factor(product.operands()[0])
                                                    : product;
}

std::optional<Reading> load_friction_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const Expression& carried = first_factor(candidate.form);
  if (carried.operation() != Operation::Abs || candidate.form == carried) return std::nullopt;
  const Expression v = own_state(fitted.scope, candidate.equation);
  std::map<std::string, Expression> parts{{"load", carried.operands()[0]}, {"v", v}};
  const std::size_t count = candidate.shapes.size();
  const bool always = candidate.form == substitute(parse_expression(kAlways), parts);
  if (!always && count >= 2) {
    parts.emplace("speed", Expression::variable(candidate.shapes[count - 2].name));
    parts.emplace("exponent", Expression::variable(candidate.shapes[count - 1].name));
    if (!(candidate.form == substitute(parse_expression(kNearStandstill), parts)))
      return std::nullopt;
  } else if (!always) {
    return std::nullopt;
  }
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
