// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "data/derivatives/finite_differences.hpp"
#include "diagnose/hints/coefficient_pattern.hpp"
#include "diagnose/hints/slip_hints.hpp"
#include "diagnose/hints/slip_search.hpp"
#include "diagnose/hints/unit_hints.hpp"
#include "diagnose/hints/window_rates.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/embedding.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "support/driven_oscillator.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

using support::hidden_record;
using support::nothing;
using ::testing::HasSubstr;

// Slips, and rates over windows.
// Slips of units, signs and clocks: what is found and what is said of it.
const OdeModel kHinted = support::oscillator();  // q, v; F, time in s

Hint hint_for(const Slip& slip, const std::vector<Slip>& others = {}) {
  return hint_of(kHinted, {slip, Vector::Ones(2), Vector::Zero(2), others});
}

TEST(SlipHints, SayWhatWouldMendTheTime) {
  const Hint ms = hint_for({HintKind::TimeUnit, {}, 0.001});
  EXPECT_EQ(ms.kind, HintKind::TimeUnit);
  EXPECT_THAT(ms.message, HasSubstr("time looks 1000 times too large"));
  EXPECT_EQ(ms.remedy, "--time-unit ms");
  EXPECT_EQ(ms.withheld, Withheld::Answer);
  EXPECT_EQ(hint_for({HintKind::TimeUnit, {}, 3600.0}).remedy, "--time-unit h");
  EXPECT_EQ(hint_for({HintKind::TimeUnit, {}, 0.01}).remedy,
            "multiply the time column by 0.01");
}

TEST(SlipHints, SayThatItMayBeTheCoefficient) {
  const Hint sign = hint_for({HintKind::Sign, {2}, -1.0});
  EXPECT_THAT(sign.message, HasSubstr("the sign of F looks reversed"));
  EXPECT_THAT(sign.message, HasSubstr("the coefficient 1 of F in dv/dt may be wrong as well"));
  EXPECT_EQ(sign.withheld, Withheld::Names) << "the coefficient can be fitted";
  EXPECT_EQ(hint_for({HintKind::Sign, {0}, -1.0}).withheld, Withheld::Answer);
}

std::vector<Hint> identities(double factor, double offset = 0.0) {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  data.trajectories[0].states.col(1) *= factor;
  data.trajectories[0].states.col(1).array() += offset;
  const BoundRecords records = observed(std::move(data));
  return identity_hints(kHinted, records.data, rate_windows(records), {});
}

TEST(IdentityHints, TellAFactorThatIsNoGainOfASensor) {
  EXPECT_TRUE(identities(1.0).empty());
  EXPECT_TRUE(identities(1.3).empty());
  EXPECT_TRUE(identities(1.0, 5.0).empty()) << "an offset is no factor";
  const std::vector<Hint> hints = identities(3.6);
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_THAT(hints[0].message, HasSubstr("dq/dt is 0.27"));
  EXPECT_EQ(hints[0].withheld, Withheld::Answer);
  EXPECT_EQ(identities(-1.0).size(), 1u);
}

const OdeModel kSearched = support::oscillator();  // q, v; F

double friction(double, double, double v) { return v > 0.0 ? -0.5 : 0.5; }

/// What is found in a record to which something was done; `q`, `v`, `F` and time may be scaled.
std::optional<FoundSlip> found(double time, double q, double v, double force,
                               const support::Hidden& hidden = friction) {
  Dataset data = support::hidden_record(hidden, 0.01);
  Trajectory& record = data.trajectories[0];
  record.time *= time;
  record.states.col(0) *= q;
  record.states.col(1) *= v;
  record.inputs *= force;
  const BoundRecords records = observed(std::move(data));
  return find_slip(kSearched, records.data, rate_windows(records), {});
}

TEST(Misfit, IsZeroOneOrTwo) {
  const Matrix y = Vector{{1.0, -1.0, 2.0, -2.0}};
  const Matrix z = Vector{{1.0, 1.0, 2.0, 2.0}};
  EXPECT_LT(misfit(y, y)[0], 1e-12);
  EXPECT_DOUBLE_EQ(misfit(y, z)[0], 1.0) << "nothing to do with one another";
  EXPECT_DOUBLE_EQ(misfit(y, -y)[0], 2.0);
  EXPECT_NEAR(misfit(y, 3.0 * y)[0], 4.0 / 10.0, 1e-12);
  Matrix lost = y;
  lost(2, 0) = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(misfit(y, lost)[0], 2.0) << "a quarter is not finite";
}

TEST(FindSlip, FindsNoneWhereAnEffectIsMissing) {
  EXPECT_FALSE(found(1.0, 1.0, 1.0, 1.0));
  EXPECT_FALSE(found(1.0, 1.0, 1.0, 1.0, support::nothing));
  EXPECT_FALSE(found(1.0, 1.0, 1.0, 1.0, [](double, double q, double) { return -30 * q; }))
      << "a spring 8.5 times too soft is no unit";
}

TEST(FindSlip, ListsWhatIsNotToldApart) {
  // x' = u alone, and x a hundred times too small.
  const Variables variables{{"x"}, {"u"}};
  const OdeModel integrator({{"x", ""}}, {{"u", ""}}, {{{Term::parse("u", variables), 1.0}}});
  Trajectory record;
  record.time = Vector::LinSpaced(801, 0.0, 40.0);
  record.states = 0.01 * record.time.array().sin().matrix();
  record.inputs = record.time.array().cos().matrix();
  Dataset data = support::one_record({{"x", ""}}, {{"u", ""}}, record);
  const BoundRecords records = observed(std::move(data));
  const auto slip = find_slip(integrator, records.data, rate_windows(records), {});
  ASSERT_TRUE(slip);
  EXPECT_EQ(slip->slip.kind, HintKind::TimeUnit);
  ASSERT_EQ(slip->others.size(), 2u) << "x or u";
  EXPECT_DOUBLE_EQ(slip->others[0].correction * slip->others[1].correction, 1.0);
}

/// A small swing of an angle whose speed was made from it: degrees are as good as any smaller
/// number.
TEST(FindSlip, SeesDegreesInASwingThatIsNearlyLinear) {
  const Variables variables{{"th", "w"}, {}};
  const OdeModel pendulum(
      {{"th", "rad"}, {"w", "rad/s"}}, {},
      {{{Term::parse("w", variables), 1.0}}, {{Term::parse("sin(th)", variables), -25.0}}});
  for (const double factor : {1.0, 180.0 / std::numbers::pi}) {
    Trajectory record;
    record.time = Vector::LinSpaced(1001, 0.0, 10.0);
    record.states = factor * 0.1 * (5.0 * record.time.array()).sin().matrix();
    Dataset angles;
    angles.states = {{"th", ""}};
    angles.trajectories = {record};
    angles.rate_of = {std::nullopt};
    const BoundRecords records = observed(embed(angles, {{"th", 2}}, FiniteDifferences{}));
    const auto slip = find_slip(pendulum, records.data, rate_windows(records), {});
    EXPECT_EQ(slip.has_value(), factor > 1.0);
    EXPECT_NEAR(slip ? slip->slip.correction : std::numbers::pi / 180.0,
                std::numbers::pi / 180.0, 1e-12);
  }
}

const OdeModel kModel = support::oscillator();  // q, v; F

/// A stop so hard that it makes up most of dv/dt.
double stop(double, double q, double) { return q > 0.3 ? -60.0 * (q - 0.3) : 0.0; }

BoundRecords record(double time, double q, double v, const support::Hidden& hidden) {
  Dataset data = support::hidden_record(hidden, 0.002);
  Trajectory& run = data.trajectories[0];
  run.time *= time;
  run.states.col(0) *= q;
  run.states.col(1) *= v;
  return observed(std::move(data));
}

std::optional<FoundSlip> found(double time, double q, double v,
                               const support::Hidden& hidden = stop) {
  const BoundRecords records = record(time, q, v, hidden);
  return slip_of_coefficients(kModel, records.data, rate_windows(records), {});
}

TEST(SlipOfCoefficients, IsSeenBesideALargeEffect) {
  const auto time = found(1000.0, 1.0, 1.0);
  ASSERT_TRUE(time);
  EXPECT_EQ(time->slip.kind, HintKind::TimeUnit);
  EXPECT_DOUBLE_EQ(time->slip.correction, 1e-3);
  const auto unit = found(1.0, 1.0, 100.0);
  ASSERT_TRUE(unit) << "v too large, or q too small where the effect hides the rest";
  std::vector<Slip> all = unit->others;
  all.push_back(unit->slip);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Slip& slip) {
    return slip.channels == std::vector<Index>{1} && slip.correction == 0.01;
  }));
}

TEST(SlipOfCoefficients, IsNoneWhereCoefficientsAreBentOrAFactorIsSmall) {
  EXPECT_FALSE(found(1.0, 1.0, 1.0));
  EXPECT_FALSE(found(1.0, 1.0, 1.0, support::nothing));
  EXPECT_FALSE(found(10.0, 1.0, 1.0)) << "an effect may do that";
}

TEST(WindowRates, HaveTheSlopeOfALineAndNoneOfAConstant) {
  Dataset data = support::oscillator_record();
  Trajectory& record = data.trajectories[0];
  record.time[7] += 0.004;  // a grid that is not uniform
  record.states.col(0) = 3.0 * record.time.array() + 1e6;
  record.states.col(1).setConstant(-5.0);
  const RateWindows windows{4, {{0, 2}, {0, 100}, {0, 900}}};
  const Matrix rates = window_rates(data, windows);
  EXPECT_LT((rates.col(0).array() - 3.0).abs().maxCoeff(), 1e-7);
  EXPECT_LT(rates.col(1).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(WindowRates, AreTheWeightedMeansOfTheRate) {
  const Dataset data = support::oscillator_record();  // q = sin 2t, v = 2 cos 2t
  const RateWindows windows{6, {{0, 0}, {0, 333}, {0, 988}}};
  const Matrix rates = window_rates(data, windows);
  const Matrix means = window_means(
      data, windows, 1,
      [](const Trajectory& record, Index i, double* out) { *out = record.states(i, 1); });
  EXPECT_LT((rates.col(0) - means).norm(), 1e-5 * means.norm());
}

TEST(RateWindows, AreLongerWhereThereIsMoreNoise) {
  const RateWindows quiet = rate_windows(observed(hidden_record(nothing, 1e-4)));
  const RateWindows loud = rate_windows(observed(hidden_record(nothing, 0.05)));
  EXPECT_EQ(quiet.half_width, 4);
  EXPECT_GT(loud.half_width, 12);
  const BoundRecords records = observed(hidden_record(nothing, 0.05));
  const Vector noise = rate_noise(records, loud);
  const Matrix rest =
      window_rates(records.data, loud) - window_rates(hidden_record(nothing, 0.0), loud);
  const Vector found = rest.colwise().squaredNorm() / static_cast<double>(rest.rows());
  EXPECT_NEAR(found[0] / noise[0], 1.0, 0.4);
  EXPECT_NEAR(found[1] / noise[1], 1.0, 0.4);
}

TEST(RateWindows, LeaveOutOutliersGapsAndMissingValues) {
  BoundRecords records = observed(hidden_record(nothing, 0.01));
  Trajectory& record = records.data.trajectories[0];
  records.outliers[0](200, 1) = 1.0;
  record.states(400, 0) = std::numeric_limits<double>::quiet_NaN();
  record.time.tail(900).array() += 0.5;  // between samples 600 and 601
  const RateWindows windows = rate_windows(records);
  const auto holds = [&](Index sample) {
    return std::any_of(windows.windows.begin(), windows.windows.end(),
                       [&](const RateWindow& w) {
                         return w.first <= sample && sample < w.first + windows.samples();
                       });
  };
  EXPECT_TRUE(holds(150) && holds(300) && holds(500) && holds(700));
  EXPECT_FALSE(holds(200));
  EXPECT_FALSE(holds(400));
  EXPECT_FALSE(holds(601) && std::any_of(windows.windows.begin(), windows.windows.end(),
                                         [&](const RateWindow& w) {
                                           return w.first <= 600 &&
                                                  w.first + windows.samples() > 601;
                                         }));
}

// Angles in the counts of an encoder.
/// Hints for a pendulum whose angle is written in so many steps of a turn, from so far up.
std::vector<Hint> hints_for_pendulum(const std::string& unit, double steps, double amplitude,
                                     bool in_counts) {
  const double turn = unit == "rad" ? 2.0 * std::numbers::pi : 360.0;
  const std::string to_rad = unit == "rad" ? "th" : "pi/180*th";
  const std::string gain = unit == "rad" ? "-7" : "-401.07";
  const OdeModel model =
      parse_ode("time s\nstate th [" + unit + "]\nstate w [" + unit +
                    "/s]\ndth/dt = w\ndw/dt = " + gain + "*sin(" + to_rad + ") - 0.2*w\n",
                "made");
  Dataset data = record_of(model, Rk4{{.substeps = 4}}, Eigen::Vector2d(amplitude * turn, 0.0),
                           0.01, 1500);
  data.states.resize(1);
  data.trajectories[0].derivatives.resize(0, 0);
  Matrix& states = data.trajectories[0].states;
  states = (states.leftCols(1) * (steps / turn)).array().round().matrix().eval();
  if (!in_counts) states *= turn / steps;
  const BoundRecords records = observed(model_view(model, data, FiniteDifferences{}));
  return unit_hints(model, records, rate_windows(records), {});
}

TEST(UnitHints, WholeNumbersForAnAngleAreCountsWhereAFactorUndoesTheMisfit) {
  for (const std::string unit : {"rad", "deg"}) {
    const std::vector<Hint> hints = hints_for_pendulum(unit, 5000.0, 0.3, true);
    ASSERT_EQ(hints.size(), 1u) << unit;
    EXPECT_EQ(hints[0].kind, HintKind::ChannelUnit);
    EXPECT_THAT(hints[0].message, HasSubstr("th is whole numbers in the records"));
    EXPECT_THAT(hints[0].remedy, HasSubstr(unit == "rad" ? "th by 2*pi/N" : "th by 360/N"));
    const std::string about = "about ";
    const std::size_t number = hints[0].message.find(about) + about.size();
    EXPECT_NEAR(std::stod(hints[0].message.substr(number)), 5000.0, 500.0);
    EXPECT_TRUE(hints_for_pendulum(unit, 5000.0, 0.3, false).empty()) << unit;
  }
  EXPECT_TRUE(hints_for_pendulum("deg", 360.0, 0.3, true).empty()) << "degrees are whole, too";
}

}  // namespace
}  // namespace lacuna
