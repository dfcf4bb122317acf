// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// What forgets within a few samples cannot be distinguished from the noise of the rate, what
// takes longer than a tenth of the record not from a drift.
constexpr double kLeastMemory = 3.0, kMemoriesOfRecord = 10.0;

// A free input is a process of its own (Ornstein and Uhlenbeck's), moved by white noise.
std::vector<Candidate> unmeasured_input_forms(const Scope& scope, Index) {
  const double shortest = kLeastMemory * scope.step;
  const double longest = scope.duration / kMemoriesOfRecord;
  if (!(shortest < longest)) return {};
  Candidate candidate = plain_candidate(formula(scope, "drive"), Expression::variable("t"));
  candidate.shapes = {{"memory", scope.model.time_unit(), shortest, longest, true}};
  for (double time = shortest; time <= longest; time *= 3.0)
    candidate.starts.emplace_back(Vector::Constant(1, time));
  candidate.memory = {
      {"drive", formula(scope, "-drive/memory"), Expression::number(0.0), true}};
  return {candidate};
}

std::optional<Reading> unmeasured_input_reading(const FittedForm& fitted) {
  if (!fitted.candidate.is_driven()) return std::nullopt;
  return Reading{"input that is not measured in d" +
                 fitted.scope.state(fitted.candidate.equation).name + "/dt"};
}

}  // namespace

const EffectFamily kUnmeasuredInput{
    {"unmeasured-input", "Something acts from outside that was not recorded", ""},
    "wind, a load that changes, a neighbouring process, a person",
    unmeasured_input_forms,
    unmeasured_input_reading};

}  // namespace lacuna
