// SPDX-License-Identifier: MIT
#include <algorithm>

#include "lacuna/effects/families.hpp"
#include "lacuna/effects/terms.hpp"

namespace lacuna {
namespace {

// What forgets within a few samples cannot be told from the noise of the rate, what takes
// longer than a tenth of the record not from a drift.
constexpr double kFewSteps = 3.0, kFewTimes = 10.0;

// A free input is a process of its own (Ornstein and Uhlenbeck's), moved by white noise.
std::vector<Candidate> make(const Scope& scope, Index equation) {
  const double shortest = kFewSteps * scope.step;
  const double longest = scope.duration / kFewTimes;
  if (!(shortest < longest)) return {};
  const std::string& x = scope.state(equation).name;
  Candidate candidate =
      plain_candidate("$drive", "t", "input that is not measured in d" + x + "/dt");
  candidate.shapes = {{"memory", scope.model.time_unit(), shortest, longest, true}};
  for (double time = shortest; time <= longest; time *= 3.0)
    candidate.starts.emplace_back(Vector::Constant(1, time));
  candidate.memory = {{"drive", "-$drive/$memory", "0", true}};
  return {candidate};
}

}  // namespace

const EffectFamily kUnmeasuredInput{
    {"unmeasured-input", "Something acts from outside that was not recorded", ""},
    "wind, a load that changes, a neighbouring process, a person",
    {},
    make};

}  // namespace lacuna
