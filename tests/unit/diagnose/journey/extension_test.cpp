// SPDX-License-Identifier: MIT
// A criterion and a hypothesis of one's own are one class each and a line that registers them.
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/report/reports.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

inline constexpr StageInfo kAicc{"aicc", "Akaike's criterion, corrected for small samples",
                                 "Hurvich and Tsai, Biometrika 76 (1989)"};

/// 2 p + 2 p (p + 1) / (n - p - 1).
class Aicc final : public Configured<Criterion, NoOptions<kAicc>> {
 public:
  using Configured::Configured;

 private:
  double do_penalty(const Evidence& evidence) const override {
    const double p = evidence.parameters;
    return 2.0 * p + 2.0 * p * (p + 1.0) / std::max(1.0, evidence.samples - p - 1.0);
  }
};

TEST(Extension, ACriterionIsOneClassAndOneLine) {
  Registry registry = default_registry();
  registry.add<Aicc>();
  Configuration configuration;
  configuration.set("criterion=aicc");
  configuration.set("effects=[\"coulomb-friction\"]");
  const Diagnosis diagnosis =
      diagnose(support::oscillator(), support::hidden_record(support::dry_friction, 0.01, 3),
               support::hidden_record(support::dry_friction, 0.01, 4, -0.7),
               diagnosis_options(configuration, registry), RunContext{});
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects[0].name, "coulomb-friction");
  const auto bare =
      std::find_if(diagnosis.rivals.begin(), diagnosis.rivals.end(),
                   [](const Rival& rival) { return rival.hypothesis == "coefficients-only"; });
  ASSERT_NE(bare, diagnosis.rivals.end());
  EXPECT_EQ(bare->quantity, "aicc");
}

inline constexpr StageInfo kSamplingTime{"sampling-time",
                                         "The clock of the record is off by a factor", ""};

Dataset with_clock(Dataset data, double factor) {
  for (Trajectory& record : data.trajectories) record.time *= factor;
  return data;
}

/// The nominal model as it is, on records whose time is multiplied by the likeliest factor.
class SamplingTime final : public Configured<Hypothesis, NoOptions<kSamplingTime>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Assumptions; }

  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override {
    const std::vector<Matrix>& omitted = best.base->given.omitted;
    const auto on = [&](const Dataset& data) {
      return assimilate(problem.nominal, as_measured(data, omitted), AssimilationOptions{},
                        problem.context);
    };
    double likeliest = 1.0, least = best.base->given.deviance;
    for (const double step : {0.05, 0.01, 0.002, 0.0004})
      for (const double centre = likeliest;
           const double away : {-5, -4, -3, -2, -1, 1, 2, 3, 4, 5}) {
        const double factor = centre + step * away;
        const double deviance = on(with_clock(problem.records.data, factor)).deviance;
        if (!(deviance < least)) continue;
        least = deviance;
        likeliest = factor;
      }
    const BoundRecords corrected = observed(with_clock(problem.records.data, likeliest));
    const Problem same{problem.nominal, corrected, problem.options, problem.context};
    Baseline base = fitted_baseline(same, on(corrected.data), {});
    base.parameters = 1.0;
    base.correct = [likeliest](const Dataset& data) { return with_clock(data, likeliest); };
    CompositeModel composite = bare_composite(
        same, "sampling-time", std::make_shared<const Baseline>(std::move(base)));
    composite.findings.push_back({.name = "sampling-time", .coefficient = likeliest});
    return {{{std::move(composite)}}, {}};
  }
};

TEST(Extension, AHypothesisIsOneClassAndOneLine) {
  Registry registry = default_registry();
  registry.add<SamplingTime>();
  Configuration configuration;
  configuration.set("effects=[\"coulomb-friction\",\"linear-term\"]");
  const Dataset slow = with_clock(support::hidden_record(support::nothing, 0.01, 3), 1.1);
  const Dataset other =
      with_clock(support::hidden_record(support::nothing, 0.01, 4, -0.7), 1.1);
  const Diagnosis diagnosis =
      diagnose(support::oscillator(), slow, other, diagnosis_options(configuration, registry),
               RunContext{});
  ASSERT_EQ(diagnosis.effects.size(), 1u) << format_trail(diagnosis);
  EXPECT_EQ(diagnosis.effects[0].name, "sampling-time");
  EXPECT_NEAR(diagnosis.effects[0].coefficient, 1.0 / 1.1, 0.01);
  EXPECT_EQ(diagnosis.verdict, Verdict::Explained);
  ASSERT_TRUE(diagnosis.gap.has_value());
  EXPECT_LT(diagnosis.gap->after, 1.1 * diagnosis.gap->noise_floor);
  EXPECT_GT(diagnosis.gap->before, 2.0 * diagnosis.gap->noise_floor);
}

}  // namespace
}  // namespace lacuna
