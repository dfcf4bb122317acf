// SPDX-License-Identifier: MIT
// Names, numbers and hints of records whose truth is known to the last digit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/effects/effects.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "support/driven_oscillator.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

constexpr double kDry = 0.5, kViscous = 0.03;

/// Wheels that run out: dw/dt = -0.5 sign(w) - 0.03 w, in closed form
/// |w| = (|w0| + 0.5/0.03) exp(-0.03 t) - 0.5/0.03, to 0.01 rad/s; none comes to rest.
Dataset run_out(const std::vector<double>& speeds, std::uint64_t seed) {
  Dataset data;
  data.states = {{"w", "rad/s"}};
  Random random(seed);
  for (const double speed : speeds) {
    const Vector time = Vector::LinSpaced(250, 0.0, 24.9);
    const Vector slow = (-kViscous * time.array()).exp();
    Matrix w = (std::abs(speed) + kDry / kViscous) * slow.array() - kDry / kViscous;
    w *= std::copysign(1.0, speed);
    for (double& value : w.reshaped()) value += 0.01 * random.normal();
    data.trajectories.push_back({"run", time, w, Matrix(250, 0), {}});
  }
  return data;
}

TEST(TrueNames, FrictionOfWhatTurnsOneWayIsPlain) {
  const OdeModel nominal = parse_ode("state w [rad/s]\ndw/dt = -0.08*w", "m");
  const Diagnosis found =
      diagnose(nominal, run_out({90.0, 45.0, -60.0}, 1), run_out({70.0, -35.0}, 2));
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_EQ(found.effects[0].name, "coulomb-friction");
  EXPECT_NEAR(found.effects[0].coefficient, -kDry, 0.01);
  EXPECT_NEAR(found.augmented.coefficient(0, "w"), -kViscous, 3e-4);
  EXPECT_EQ(found.verdict, Verdict::Explained);
  for (const Alternative& other : found.effects[0].alternatives)
    EXPECT_LE(other.probability, found.effects[0].probability) << other.name;
}

/// A vessel, dh/dt = 0.01 u - 0.008 sqrt(h), by Euler steps of a hundredth of a sample; its
/// level moves by 0.02 m about 0.6 m and is read 0.3 m too large.
Dataset vessel(std::uint64_t seed) {
  constexpr Index kRows = 500;
  constexpr int kParts = 100;
  Trajectory record{"vessel",
                    Vector::LinSpaced(kRows, 0.0, 998.0),
                    Matrix(kRows, 1),
                    Matrix(kRows, 1),
                    {}};
  Random random(seed);
  double h = 0.6, u = 0.62;
  for (Index i = 0; i < kRows; ++i) {
    if (i % 25 == 0) u = 0.62 + 0.06 * random.normal();
    record.states(i, 0) = h + 0.3 + 5e-4 * random.normal();
    record.inputs(i, 0) = u;
    for (int part = 0; part < kParts; ++part)
      h += 2.0 / kParts * (0.01 * u - 0.008 * std::sqrt(h));
  }
  return support::one_record({{"h", "m"}}, {{"u", "1"}}, std::move(record));
}

TEST(TrueNames, AnOffsetLargerThanTheSpreadOfItsChannel) {
  const OdeModel nominal =
      parse_ode("input u [1] hold zero\nstate h [m]\ndh/dt = 0.01*u - 0.008*sqrt(h)", "m");
  const Diagnosis found = diagnose(nominal, vessel(3), vessel(4));
  ASSERT_EQ(found.effects.size(), 1u) << ::testing::PrintToString(found.notes);
  EXPECT_EQ(found.effects[0].name, "sensor-offset");
  EXPECT_NEAR(found.effects[0].coefficient, 0.3, 0.01);
  EXPECT_EQ(found.verdict, Verdict::Explained) << ::testing::PrintToString(found.notes);
  ASSERT_TRUE(found.gap && found.gap->free_after);
  EXPECT_LT(found.gap->free_after->apart, 0.3);
  EXPECT_GT(found.gap->free_before->apart, 3.0);
  for (const Alternative& other : found.effects[0].alternatives)
    EXPECT_LE(other.probability, found.effects[0].probability) << other.name;
}

/// dx/dt = -5 x + 2 u with a sine, exact; times were written `slower` times too large.
Dataset slow_clock(double slower) {
  Dataset data;
  data.states = {{"x", "m"}};
  data.inputs = {{"u", "V"}};
  const Vector time = Vector::LinSpaced(800, 0.0, 15.98);
  const double w = 3.0;
  Random random(9);
  Matrix x =
      2.0 / (25.0 + w * w) * (5.0 * (w * time.array()).sin() - w * (w * time.array()).cos());
  for (double& value : x.reshaped()) value += 1e-4 * random.normal();
  data.trajectories = {{"r", slower * time, x, (w * time.array()).sin().matrix(), {}}};
  return data;
}

TEST(TrueNames, ACommonFactorOfAllRatesPointsToTheClock) {
  const OdeModel nominal = parse_ode("input u [V]\nstate x [m]\ndx/dt = -5*x + 2*u", "m");
  const Diagnosis found = diagnose(nominal, slow_clock(7.3));
  EXPECT_EQ(found.verdict, Verdict::CoefficientsOnly);
  ASSERT_EQ(found.hints.size(), 1u);
  EXPECT_EQ(found.hints[0].kind, HintKind::TimeUnit);
  EXPECT_THAT(found.hints[0].message, HasSubstr("all rates are 7.3 times too small"));
  EXPECT_THAT(found.hints[0].message, HasSubstr("a step of 0.02 s"));
  EXPECT_TRUE(diagnose(nominal, slow_clock(1.3)).hints.empty()) << "may be a mass";
}

/// What notes say of timing jitter where the clock scatters by a fraction of a step.
bool notes_tell_jitter(double steps) {
  Dataset data = support::hidden_record(support::nothing, 0.0);
  Trajectory& record = data.trajectories[0];
  const Matrix x = record.states;
  Random random(12);
  for (Index i = 1; i + 1 < record.samples(); ++i)
    record.states.row(i) += 0.5 * steps * random.normal() * (x.row(i + 1) - x.row(i - 1));
  const Diagnosis found = diagnose(support::oscillator(), data, {}, {.effects = {}});
  return std::any_of(found.notes.begin(), found.notes.end(), [](const std::string& note) {
    return note.find("timing jitter") != std::string::npos;
  });
}

TEST(TrueNames, ATimingJitterOfAThousandthOfAStepIsNotSaid) {
  EXPECT_TRUE(notes_tell_jitter(0.2));
  EXPECT_FALSE(notes_tell_jitter(0.004));
}

/// A drive, dn/dt = -4 n + 1200 y, whose voltage acts behind a lag of 0.03 s, dy/dt = (U -
/// y)/0.03, to 2 rpm; each level for 2 s.
Dataset drive(const std::vector<double>& levels, std::uint64_t seed) {
  constexpr Index kHeld = 200;
  constexpr int kParts = 20;
  const auto samples = kHeld * static_cast<Index>(levels.size());
  Trajectory record{"drive",
                    0.01 * Vector::LinSpaced(samples, 0.0, static_cast<double>(samples - 1)),
                    Matrix(samples, 1),
                    Matrix(samples, 1),
                    {}};
  Random random(seed);
  double n = 300.0 * levels.front(), y = levels.front();
  for (Index i = 0; i < samples; ++i) {
    const double u = levels[static_cast<std::size_t>(i / kHeld)];
    record.states(i, 0) = n + 2.0 * random.normal();
    record.inputs(i, 0) = u;
    for (int part = 0; part < kParts; ++part) {
      y += 0.01 / kParts * (u - y) / 0.03;
      n += 0.01 / kParts * (-4.0 * n + 1200.0 * y);
    }
  }
  return support::one_record({{"n", "rpm"}}, {{"U", "V"}}, std::move(record));
}

TEST(TrueNames, TheNoiseFloorOfWhatHasNoNameIsThatOfItsSamples) {
  const OdeModel nominal =
      parse_ode("input U [V] hold zero\nstate n [rpm]\ndn/dt = -5*n + 1500*U", "m");
  const Dataset other = drive({4.0, 4.0, 10.0, 10.0}, 2);
  const Diagnosis found =
      diagnose(nominal, drive({4.0, 4.0, 10.0, 10.0, 10.0, 10.0}, 1), other, {.effects = {}});
  EXPECT_EQ(found.verdict, Verdict::UnnamedStructure);
  ASSERT_TRUE(found.gap);
  const Vector n = other.trajectories[0].states.col(0);
  const double spread = std::sqrt((n.array() - n.mean()).square().mean());
  EXPECT_NEAR(found.gap->noise_floor * spread, 2.0, 0.2);
}

// A diagnosis that is asked for with no more than a model and records.
double rubbing(double, double, double v) { return v > 0.0 ? -0.3 : 0.3; }

void expect_friction(const Diagnosis& found) {
  EXPECT_EQ(found.verdict, Verdict::Explained);
  ASSERT_EQ(found.effects.size(), 1u);
  EXPECT_EQ(found.effects[0].name, "coulomb-friction");
  EXPECT_NEAR(found.effects[0].coefficient, -0.3, 0.02);
}

TEST(DefaultDiagnosis, TriesEveryEffectAndEveryHypothesis) {
  const DiagnosisOptions options{};
  EXPECT_EQ(options.effects.size(), standard_effects().size());
  EXPECT_EQ(options.hypotheses.size(), standard_hypotheses().size());
  EXPECT_GT(options.effects.size(), 20u);
  expect_friction(diagnose(support::oscillator(), support::hidden_record(rubbing, 0.01)));
}

TEST(DefaultDiagnosis, NoEffectsNameNone) {
  const Diagnosis found = diagnose(support::oscillator(), support::hidden_record(rubbing, 0.01),
                                   {}, {.effects = {}});
  EXPECT_TRUE(found.effects.empty());
  EXPECT_NE(found.verdict, Verdict::NoDiscrepancy);
}

TEST(DefaultDiagnosis, FindsColumnsByTheirNames) {
  const Dataset record = support::hidden_record(rubbing, 0.01);
  Dataset reversed = record;
  std::swap(reversed.states[0], reversed.states[1]);
  reversed.trajectories[0].states = record.trajectories[0].states.rowwise().reverse();
  reversed.rate_of.clear();
  expect_friction(diagnose(support::oscillator(), reversed));
  reversed.states = {{"other", ""}, {"another", ""}};
  EXPECT_THROW(diagnose(support::oscillator(), reversed, record), DataError);
}

// A part that hangs on a spring and that nobody measured.
constexpr double kSpring = 30.0, kDamper = 0.4, kMass = 0.3;

/// q, v of support::oscillator() with a mass p, w on a spring and a damper, levels for the
/// force.
Dataset with_a_mass(std::uint64_t seed) {
  Dataset data = support::hidden_record(support::nothing, 0.0);
  Trajectory& record = data.trajectories[0];
  Random random(seed);
  std::array<double, 4> at{0.0, 0.0, 0.0, 0.0};  // q, v, p, w
  double force = 1.0;
  for (Index i = 0; i < record.samples(); ++i) {
    if (i % 40 == 0) force = random.uniform(-2.0, 2.0);
    record.states.row(i) << at[0] + 2e-3 * random.normal(), at[1] + 4e-3 * random.normal();
    record.inputs(i, 0) = force;
    constexpr int kParts = 400;  // of a step: semi-implicit Euler
    for (int part = 0; part < kParts; ++part) {
      const double h = 0.02 / kParts;
      const double pull = kSpring * (at[2] - at[0]) + kDamper * (at[3] - at[1]);
      at[1] += h * (-4.0 * at[0] - 0.2 * at[1] + force + pull);
      at[3] -= h * pull / kMass;
      at[0] += h * at[1];
      at[2] += h * at[3];
    }
  }
  data.states.resize(1);  // v is not measured
  record.states = Matrix(record.states.leftCols(1));
  return model_view(support::oscillator(), data, FiniteDifferences{});
}

TEST(FlexibleMass, IsNamedWithItsFrequency) {
  Configuration configuration;
  configuration.set(
      "effects=[\"extra-state\",\"delay\",\"lag\",\"cubic-stiffness\",\"linear-term\"]");
  const Diagnosis found =
      diagnose(support::oscillator(), with_a_mass(3), with_a_mass(8),
               diagnosis_options(configuration, default_registry()), RunContext{});
  EXPECT_EQ(found.verdict, Verdict::Explained);
  ASSERT_EQ(found.effects.size(), 1u);
  const NamedEffect& effect = found.effects[0];
  EXPECT_EQ(effect.name, "extra-state");
  EXPECT_NEAR(effect.coefficient, kSpring, 0.1 * kSpring);
  const double frequency = std::sqrt(kSpring / kMass) / (2.0 * std::numbers::pi);
  const double damping = 0.5 * kDamper / std::sqrt(kSpring * kMass);
  ASSERT_EQ(effect.parameters.size(), 2u);
  EXPECT_NEAR(effect.parameters[0].value, frequency, 0.02 * frequency);
  EXPECT_NEAR(effect.parameters[1].value, damping, 0.5 * damping);  // small beside a spring
}

// A new form is one value and one line on a copy of the registry.
constexpr const char* kPower = "sign(x)*abs(x)^1.5";

std::vector<Candidate> forms(const Scope& scope, Index) {
  std::vector<Candidate> result;
  for (const Expression& x : all_variables(scope))
    result.push_back(plain_candidate(formula(scope, kPower, {{"x", x}}), x));
  return result;
}

std::optional<Reading> reading(const FittedForm& fitted) {
  if (!has_form(fitted.candidate, kPower)) return std::nullopt;
  return Reading{"power 3/2 of " + fitted.candidate.argument.to_string()};
}

const EffectFamily kThreeHalves{{"three-halves", "A term in the power 3/2", ""},
                                "a sphere that is pressed",
                                forms,
                                reading};

double hidden(double, double q, double) {
  return -1.5 * std::copysign(std::pow(std::abs(q), 1.5), q);
}

TEST(OwnForm, IsFoundAndNamedAmongAllOthers) {
  Registry registry = default_registry();
  registry.add<FamilyEffect<kThreeHalves>>();
  DiagnosisOptions options;
  options.effects = registry.make_all<Effect>();
  const Diagnosis diagnosis =
      diagnose(support::oscillator(), support::hidden_record(hidden, 0.001, 3),
               support::hidden_record(hidden, 0.001, 4, -0.7), options, RunContext{});
  EXPECT_EQ(diagnosis.verdict, Verdict::Explained);
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects[0].name, "three-halves");
  EXPECT_EQ(diagnosis.effects[0].description, "power 3/2 of q");
  EXPECT_EQ(diagnosis.effects[0].cause, "a sphere that is pressed");
  EXPECT_NEAR(diagnosis.effects[0].coefficient, -1.5, 0.02);
}

}  // namespace
}  // namespace lacuna
