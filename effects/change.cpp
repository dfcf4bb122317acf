// SPDX-License-Identifier: MIT
#include <algorithm>

#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// A fact of the search: parts of the record from whose ends it begins. An instant is found from
// as far as the states remember it.
constexpr int kStarts = 16;

/// A term that is there from an instant on: within one sampling step, so that the instant can
/// be estimated between samples.
Expression from_instant(const Scope& scope, const Expression& term, const std::string& time) {
  return substitute(parse_expression("x*clip(pace*(t-time)+0.5,0,1)"),
                    {{"x", term},
                     {"pace", Expression::number(1.0 / scope.step)},
                     {"time", Expression::variable(time)}});
}

/// The term with an instant that has a period of the motion on either side: before the motion
/// has come back what happens in time is not distinguished from what happens along the way.
Candidate changing(const Scope& scope, const Expression& term) {
  const double period = std::max(shortest_period(scope), scope.step);
  const double begin = scope.start + period, end = scope.start + scope.duration - period;
  const std::string time = scope.free_name("time");
  Candidate candidate = plain_candidate(from_instant(scope, term, time), term);
  candidate.shapes = {{time, scope.model.time_unit(), begin, end, false}};
  for (int i = 1; i < kStarts; ++i)
    candidate.starts.push_back(Vector::Constant(1, begin + (end - begin) * i / kStarts));
  return candidate;
}

std::vector<Candidate> change_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  if (!determines_time(scope)) return result;
  for (const Expression& term : nonlinear_terms(scope, equation))
    result.push_back(changing(scope, term));
  for (const Expression& x : all_variables(scope))
    if (has_term(scope, equation, x)) result.push_back(changing(scope, x));
  result.push_back(changing(scope, Expression::number(1.0)));
  return result;
}

std::optional<Reading> change_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  if (candidate.shapes.size() != 1 || !candidate.memory.empty() ||
      !(candidate.form ==
        from_instant(fitted.scope, candidate.argument, candidate.shapes.front().name)))
    return std::nullopt;
  const ShapeParameter& time = candidate.shapes.front();
  const double step = fitted.scope.step;
  if (!(fitted.shapes[0] > time.low + step && fitted.shapes[0] < time.high - step))
    return std::nullopt;  // it would be beyond
  const std::string of = candidate.argument.variables().empty()
                             ? "constant rate"
                             : "coefficient of " + candidate.argument.to_string();
  return Reading{"another " + of + " from an instant on", Precedence::Plain, {"time"}};
}

}  // namespace

const EffectFamily kChange{
    {"change", "A coefficient or a constant that has another value from an instant on", ""},
    "a load that comes on, a leak that begins, a pump that loses a stage",
    change_forms,
    change_reading};

}  // namespace lacuna
