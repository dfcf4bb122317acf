// SPDX-License-Identifier: MIT
#include "diagnose/candidates/fit_memory.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "core/base/parallel.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

/// What decides a fit of an oscillator with a stop.
struct Asked {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  Assimilation start = support::assimilated(data);
  OdeModel nominal = start.model;
  AssimilationOptions options = support::oscillator_fit_options();
  std::vector<FittedEffect> effects = {
      {support::stop_candidate(0.0), Vector::Constant(1, -0.1), -2.0}};
  std::string kind = "exact";

  std::string key() const {
    return fit_key(kind, {data, nominal, options, RunContext{}}, start, effects);
  }
};

TEST(FitKey, TellsWhateverDecides) {
  const std::vector<std::function<void(Asked&)>> changes{
      [](Asked&) {},
      [](Asked& a) { a.kind = "rough"; },
      [](Asked& a) { a.data.trajectories[0].states(5, 1) += 1e-15; },
      [](Asked& a) { a.data.trajectories[0].inputs(5, 0) += 1e-15; },
      [](Asked& a) { a.data.trajectories[0].time[5] += 1e-9; },
      [](Asked& a) { a.data.inputs[0].hold = Hold::Zero; },
      [](Asked& a) {
        a.data.reconstructed = {false, true};
      },
      [](Asked& a) {
        a.data.rate_of = {Index{1}, std::nullopt};
      },
      [](Asked& a) { a.start.records[0].grid.stride = 3; },
      [](Asked& a) { a.nominal = support::oscillator(); },
      [](Asked& a) { a.options.passes += 1; },
      [](Asked& a) { a.options.free.pop_back(); },
      [](Asked& a) {
        a.options.priors.push_back({a.options.free[0], 1.0, 0.1});
      },
      [](Asked& a) { a.start.deviance += 1.0; },
      [](Asked& a) { a.start.records[0].path(7, 0) += 1e-12; },
      [](Asked& a) { a.start.noise.disturbance[1] *= 1.0 + 1e-15; },
      [](Asked& a) { a.start.noise.measurement[0] = 0.02; },
      [](Asked& a) { a.effects[0].coefficient = -2.1; },
      [](Asked& a) { a.effects[0].shapes[0] = -0.11; },
      [](Asked& a) { a.effects[0].candidate.equation = 0; },
      [](Asked& a) { a.effects[0].candidate.place = Place::Channel; },
      [](Asked& a) { a.effects[0].candidate.form = parse_expression("q^2"); },
      [](Asked& a) { a.effects[0].candidate.shapes[0].high += 1.0; },
      [](Asked& a) { a.effects[0].candidate.least = 0.0; },
      [](Asked& a) { a.effects.push_back(a.effects[0]); },
      [](Asked& a) { a.effects.clear(); }};
  std::set<std::string> keys;
  for (const auto& change : changes) {
    Asked asked;
    change(asked);
    keys.insert(asked.key());
  }
  EXPECT_EQ(keys.size(), changes.size());
}

/// An explanation that takes 10 numbers.
Explanation explanation_of(double deviance) {
  Explanation explanation{{}, {support::oscillator()}};
  explanation.fit.measured = {Matrix::Zero(5, 2)};
  explanation.fit.deviance = deviance;
  return explanation;
}

/// Asks for an explanation. @return its deviance, and whether it was fitted now.
std::pair<double, bool> asked_for(FitMemory& memory, const std::string& key, double deviance) {
  bool fitted = false;
  const Explanation found = memory.explanation(key, [&] {
    fitted = true;
    return explanation_of(deviance);
  });
  return {found.fit.deviance, fitted};
}

TEST(FitMemory, KeepsWhatThereIsRoomFor) {
  FitMemory memory(10 * FitMemory::kFewest + 5);
  for (Index i = 0; i <= FitMemory::kFewest; ++i) asked_for(memory, std::to_string(i), 1.0);
  for (Index i = 0; i < FitMemory::kFewest; ++i)
    EXPECT_FALSE(asked_for(memory, std::to_string(i), 2.0).second) << i;
  EXPECT_EQ(asked_for(memory, std::to_string(FitMemory::kFewest), 2.0), std::pair(2.0, true));
}

TEST(FitMemory, AFitThatFailsIsNotKept) {
  FitMemory memory;
  EXPECT_THROW(memory.explanation("a", []() -> Explanation { throw Cancelled(); }), Cancelled);
  EXPECT_TRUE(asked_for(memory, "a", 1.0).second);
}

}  // namespace
}  // namespace lacuna
