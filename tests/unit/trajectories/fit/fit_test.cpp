// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/fit/fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <chrono>
#include <cmath>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/report/reports.hpp"
#include "support/expect_error.hpp"
#include "support/grey_box.hpp"

namespace lacuna {
namespace {

using testing::expect_error;
using ::testing::HasSubstr;

const FittedParameter& number(const Fit& found, const std::string& name) {
  for (const FittedParameter& one : found.numbers)
    if (one.name == name) return one;
  throw std::out_of_range(name);
}

/// Two tanks of which the lower one is measured.
constexpr const char* kTanks = R"(input u hold linear
param k1 = 0.5 in 0..20
param k2 = 0.8 in 0..20
param k4 = 0.4 in 0..20
dx1/dt = -k1*sqrt(max(x1,0.0001)) + k4*u
dx2/dt = k1*sqrt(max(x1,0.0001)) - k2*sqrt(max(x2,0.0001))
y = x2
)";

Dataset tanks_record(std::uint64_t seed = 1) {
  return support::grey_box(
      parse_ode(kTanks, "t.ode"),
      {.start = (Vector(2) << 0.3, 0.1).finished(), .step = 0.1, .samples = 600, .seed = seed});
}

/// The same model with numbers off by a factor, alternately up and down.
SystemModel off_by(const SystemModel& system, double factor) {
  std::vector<Parameter> parameters = system.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    parameters[i].value *= i % 2 == 0 ? factor : 1.0 / factor;
  return {system.symbolic(), parameters};
}

TEST(Fit, FindsTheNumbersOfAModelWithAHiddenState) {
  const SystemModel truth = parse_ode_system(kTanks, "t.ode");
  const Fit found = fit(off_by(truth, 3.0), tanks_record(), {});
  EXPECT_TRUE(found.converged);
  EXPECT_TRUE(found.combinations.empty());
  for (const Parameter& parameter : truth.parameters()) {
    const FittedParameter& one = number(found, parameter.name);
    ASSERT_TRUE(one.standard_error) << parameter.name;
    EXPECT_LT(std::abs(one.value - parameter.value), 4.0 * *one.standard_error);
    EXPECT_LT(*one.standard_error, 0.05 * parameter.value);
  }
  EXPECT_NEAR(found.initial[0][0].value, 0.3, 5.0 * *found.initial[0][0].standard_error);
  EXPECT_TRUE(found.quality[0].white);
  EXPECT_NEAR(found.quality[0].rmse, found.quality[0].noise, 0.2 * found.quality[0].noise);
  EXPECT_NEAR(found.quality[0].fit_percent, 99.0, 0.2) << "1 % noise";
  const OdeModel model = found.model.model();
  EXPECT_NEAR(model.coefficient(0, "u"), 0.4, 0.02);
}

TEST(Fit, LevelsBeginAboveEmpty) {
  // From empty tanks, of which the model takes roots, the fit ends in exchanged time constants.
  const std::string text =
      "input u hold linear\ndx1/dt = u - 0.5*sqrt(x1)\ndx2/dt = 0.5*sqrt(x1) - 0.4*sqrt(x2)\n"
      "dx3/dt = 0.4*sqrt(x2) - 0.45*sqrt(x3)\ndx4/dt = 0.45*sqrt(x3) - 0.35*sqrt(x4)\n"
      "y2 = x2\ny4 = x4\n";
  const Vector start{{0.8, 1.0, 0.9, 1.2}};
  const Dataset record = support::grey_box(
      parse_ode(text, "t.ode"), {.start = start, .step = 0.1, .samples = 1500, .seed = 3});
  const Fit found = fit(parse_ode_system(text, "t.ode"), record, {});
  EXPECT_TRUE(found.quality[0].white && found.quality[1].white);
  EXPECT_NEAR(number(found, "x2: sqrt(x2)").value, -0.4, 0.02);
  EXPECT_NEAR(number(found, "x4: sqrt(x4)").value, -0.35, 0.02);
  EXPECT_FALSE(found.combinations.empty()) << "the scale of hidden levels";
}

TEST(Fit, IsTheSameWithTheSameSeed) {
  const SystemModel start = off_by(parse_ode_system(kTanks, "t.ode"), 2.0);
  EXPECT_EQ(format_json(fit(start, tanks_record(), {})),
            format_json(fit(start, tanks_record(), {})));
}

TEST(Fit, HeldOutRecordsAreRunFreely) {
  const SystemModel truth = parse_ode_system(kTanks, "t.ode");
  const Fit found = fit(off_by(truth, 1.5), tanks_record(), tanks_record(7));
  ASSERT_TRUE(found.gap);
  EXPECT_GT(found.gap->before, 10.0 * found.gap->after);
  EXPECT_LT(found.gap->after, 1.5 * found.gap->noise_floor);
}

TEST(Fit, NumbersThatActTogetherAreNamedAndGetNoInterval) {
  // x1 may have any scale: k12 and k21 are seen as a product.
  const SystemModel system = parse_ode_system(R"(input u hold linear
param k12 = 0.3
param k21 = 0.5
dx2/dt = -0.75*x2 + k12*x1 + 0.9*u
dx1/dt = k21*x2 - 0.3*x1
y = x2
)",
                                              "c.ode");
  const Dataset data =
      support::grey_box(system.model(), {.start = (Vector(2) << 0.3, 1.0).finished()});
  const Fit found = fit(off_by(system, 1.3), data, {});
  ASSERT_EQ(found.combinations.size(), 1u);
  EXPECT_EQ(found.combinations[0].message, "k12 and k21 only as k12*k21");
  EXPECT_FALSE(number(found, "k12").ci95);
  EXPECT_FALSE(number(found, "k21").ci95);
  EXPECT_NEAR(number(found, "k12").value * number(found, "k21").value, 0.15, 0.02);
  EXPECT_TRUE(number(found, "x1: x1").ci95);
  EXPECT_NEAR(number(found, "k12").value, 0.39, 0.06) << "as near as can be to the start";
  EXPECT_FALSE(found.initial[0][1].standard_error) << "known up to its scale only";
}

TEST(Fit, TheErrorOfAStartHasThoseOfTheParametersInIt) {
  // x = a exp(-k t): standard errors by the normal equations of dx/da and dx/dk.
  const SystemModel system =
      parse_ode_system("input u\nparam k = 1\ndx/dt = -k*x\ny = x\n", "m.ode");
  const Dataset data = support::grey_box(
      system.model(), {.start = Vector::Constant(1, 2.0), .step = 0.01, .samples = 200});
  const Vector t = data.trajectories[0].time, x = 2.0 * (-t.array()).exp();
  Matrix slopes(200, 2);
  slopes << x / 2.0, -x.cwiseProduct(t);
  const double sigma = 0.01 * std::sqrt((x.array() - x.mean()).square().mean());
  const Matrix covariance = (slopes.transpose() * slopes).inverse() * sigma * sigma;
  const Fit found = fit(system, data, {});
  ASSERT_TRUE(found.initial[0][0].standard_error);
  EXPECT_NEAR(*found.initial[0][0].standard_error / std::sqrt(covariance(0, 0)), 1.0, 0.2);
  EXPECT_NEAR(*number(found, "k").standard_error / std::sqrt(covariance(1, 1)), 1.0, 0.2);
}

TEST(Fit, AStateThatNothingShowsIsNamed) {
  const SystemModel system = parse_ode_system(
      "input u hold linear\ndx/dt = -0.4*x + 0.9*u\ndz/dt = -2*z + 0.5*x\ny = x\n", "z.ode");
  const Dataset data =
      support::grey_box(system.model(), {.start = (Vector(2) << 2.0, 1.0).finished()});
  const Fit found = fit(system, data, {});
  std::string all;
  for (const FitCombination& one : found.combinations) all += one.message + "\n";
  EXPECT_THAT(all, HasSubstr("the state z cannot be determined from what is measured"));
  EXPECT_THAT(all, HasSubstr("z: z: the records do not determine it"));
  EXPECT_FALSE(number(found, "z: x").ci95);
  EXPECT_TRUE(number(found, "x: x").ci95);
  EXPECT_EQ(number(found, "z: z").value, -2.0) << "as it was";
}

TEST(Fit, ABoundIsSaidAndHasNoInterval) {
  const std::string model =
      "input u hold linear\nparam k = 0.3 in 0..0.4\n"
      "dx/dt = -k*x + 0.7*u\ny = x\n";
  const OdeModel truth =
      parse_ode("input u hold linear\ndx/dt = -0.5*x + 0.7*u\ny = x\n", "t.ode");
  const Dataset data = support::grey_box(truth, {.start = Vector::Constant(1, 2.0)});
  const Fit found = fit(parse_ode_system(model, "m.ode"), data, {});
  EXPECT_EQ(number(found, "k").bound, "max");
  EXPECT_EQ(number(found, "k").value, 0.4);
  EXPECT_FALSE(number(found, "k").ci95);
  ASSERT_TRUE(number(found, "k").at_least);
  EXPECT_GT(*number(found, "k").at_least, 0.3);
  EXPECT_TRUE(number(found, "x: u").ci95);
  EXPECT_FALSE(found.notes.empty());
}

TEST(Fit, ParametersPerRecordAreGivenForEach) {
  std::string text = kTanks;
  text.replace(text.find("param k4 = 0.4 in 0..20"), 23, "param k4 = 0.4 per_record");
  Dataset data = tanks_record();
  std::string other = kTanks;
  other.replace(other.find("k4 = 0.4"), 8, "k4 = 0.6");
  data.trajectories.push_back(
      support::grey_box(parse_ode(other, "t.ode"),
                        {.start = (Vector(2) << 0.3, 0.1).finished(), .step = 0.1, .seed = 3})
          .trajectories[0]);
  const Fit found = fit(parse_ode_system(text, "t.ode"), data, {});
  const FittedParameter& k4 = number(found, "k4");
  ASSERT_EQ(k4.per_record.size(), 2u);
  EXPECT_NEAR(k4.per_record[0], 0.4, 0.02);
  EXPECT_NEAR(k4.per_record[1], 0.6, 0.03);
  EXPECT_NEAR(number(found, "k1").value, 0.5, 0.03);
}

TEST(Fit, AWrongStructureShowsInTheResiduals) {
  const SystemModel linear = parse_ode_system(R"(input u hold linear
dx1/dt = -0.5*x1 + 0.4*u
dx2/dt = 0.5*x1 - 0.8*x2
y = x2
)",
                                              "l.ode");
  const Fit found = fit(linear, tanks_record(), {});
  EXPECT_FALSE(found.quality[0].white);
  EXPECT_THAT(found.notes[0], HasSubstr("not white"));
}

TEST(Fit, LongPastTheDeadlineTheAnswerIsWhatThereWasByThen) {
  RunContext late;
  late.deadline = std::chrono::steady_clock::now() - std::chrono::seconds(1);
  const SystemModel truth = parse_ode_system(kTanks, "t.ode");
  const Fit found = fit(off_by(truth, 1.2), tanks_record(), {}, {}, late);
  EXPECT_NEAR(number(found, "k1").value, 0.6, 1e-12) << "as given: a search takes longer";
  ASSERT_EQ(found.stages.size(), 3u);
  for (const StageDone& stage : found.stages) EXPECT_FALSE(stage.done) << stage.name;
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(standing_of(found).admission.standing, Standing::Incomplete);
  EXPECT_THAT(sentence_of(standing_of(found)), HasSubstr("Incomplete, left out: fit"));
  EXPECT_TRUE(std::isfinite(found.quality[0].rmse));

  const SystemModel linear = parse_ode_system(R"(input u hold linear
param k = 0.5
dx1/dt = -k*x1 + 0.4*u
dx2/dt = k*x1 - 0.8*x2
fixed dx1/dt: u
fixed dx2/dt: x2
y = x2
)",
                                       "l.ode");
  const Fit wrong = fit(linear, tanks_record(), {}, {}, late);
  ASSERT_EQ(wrong.stages.size(), 3u);
  EXPECT_FALSE(wrong.stages[1].done) << "residuals above the noise ask for other starts";
  EXPECT_EQ(wrong.starts, 1);
}

TEST(Fit, QuickIsTheGivenStartWithoutProfiles) {
  const SystemModel truth = parse_ode_system(kTanks, "t.ode");
  const Fit found =
      fit(off_by(truth, 1.2), tanks_record(), {}, {.effort = Thoroughness::Quick});
  EXPECT_EQ(found.starts, 1);
  EXPECT_NEAR(number(found, "k1").value, 0.5, 0.03);
  EXPECT_EQ(left_out_line(found.stages), "left out: starts, profiles (--effort quick)");
}

TEST(Fit, ARoughOneHasTheNumbersWithoutProfiles) {
  const SystemModel truth = parse_ode_system(kTanks, "t.ode");
  const Fit found = fit(off_by(truth, 1.2), tanks_record(), {}, {.rough = true});
  EXPECT_NEAR(number(found, "k1").value, 0.5, 0.03);
  ASSERT_EQ(found.stages.size(), 2u);
  EXPECT_EQ(found.stages[1].name, "starts");
  EXPECT_TRUE(left_out_line(found.stages).empty()) << "nobody asked for profiles";
}

TEST(Fit, MoreUnknownsThanValuesAreAnError) {
  Dataset data = tanks_record();
  data.trajectories[0] = rows_of(data.trajectories[0], 0, 5);
  expect_error<DataError>([&] { fit(parse_ode_system(kTanks, "t.ode"), data, {}); }, "records",
                          "5 unknowns (parameters and initial states) for 5 measured values",
                          "fixed");
}

TEST(Fit, ModelsThatAlwaysDivergeAreAnError) {
  const SystemModel system = parse_ode_system(
      "input u hold linear\nparam k = 900 in 800..1000\ndx/dt = k*x^3 + 1000*u\ny = x\n",
      "d.ode");
  const Dataset data =
      support::grey_box(parse_ode("input u hold linear\ndx/dt = -x + u\ny = x\n", "e.ode"),
                        {.start = Vector::Constant(1, 1.0)});
  expect_error<DataError>([&] { fit(system, data, {}, {.restarts = 1}); }, "model",
                          "no free run", "ranges");
}

/// A slow decay with noise of 1 %.
Dataset decay_record() {
  return support::grey_box(parse_ode("dx/dt = -0.1*x\ny = x\n", "d.ode"),
                           {.start = Vector::Constant(1, 1.0), .step = 0.1, .samples = 100});
}

TEST(Fit, AnIntervalThatReachesTheEndOfTheRangeIsNone) {
  const SystemModel system =
      parse_ode_system("param k = 0.1 in 0.0999..0.1001\ndx/dt = -k*x\ny = x\n", "d.ode");
  const FittedParameter k = number(fit(system, decay_record(), {}), "k");
  EXPECT_FALSE(k.ci95) << "only the range knows it";
  const SystemModel wide =
      parse_ode_system("param k = 0.09 in 0.05..0.1005\ndx/dt = -k*x\ny = x\n", "d.ode");
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Dataset record = support::grey_box(
        parse_ode("dx/dt = -0.1*x\ny = x\n", "d.ode"),
        {.start = Vector::Constant(1, 1.0), .step = 0.1, .samples = 100, .seed = seed});
    const FittedParameter one = number(fit(wide, record, {}), "k");
    EXPECT_TRUE(one.ci95.has_value() != one.at_least.has_value()) << seed;
    if (one.ci95) {
      EXPECT_LT((*one.ci95)[1], 0.1005) << seed;
      EXPECT_LE(one.value, (*one.ci95)[1]) << seed;
    }
  }
}

/// Twelve rows of an oral dose: the sample times of a first study in man.
Dataset oral_dose(const std::string& text, const Vector& start, double noise,
                  std::uint64_t seed) {
  const OdeModel truth = parse_ode(text, "t.ode");
  const Vector times{{0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 24.0}};
  const Matrix none(times.size(), 0);
  const Solution orbit = simulate(truth, Rk4({.substeps = 200}), start, times);
  Matrix values = output_values(truth, times, orbit.states, none);
  Random random(seed);
  for (double& value : values.col(0)) value += noise * random.normal();
  Dataset data{"h", {{"y", ""}}, {}, {}, {}};
  data.trajectories = {{"dose", times, values, none, Matrix()}};
  return data;
}

constexpr const char* kOneCompartment =
    "time h\nparam ka = 1 in 0.01..10\nparam ke = 0.1 in 0.001..5\nparam V = 15 in 1..100\n"
    "dg/dt = -ka*g\ndc/dt = ka*g - ke*c\ny = c/V\ninitial g = 100 fixed\n"
    "initial c = 0 fixed\n";

TEST(Fit, OneCompartmentIsRefusedByTwelveRowsOfTwo) {
  const SystemModel one = parse_ode_system(kOneCompartment, "one.ode");
  const std::string two =
      "time h\ndg/dt = -1.2*g\ndc/dt = 1.2*g - 1.1*c + 0.25*p\ndp/dt = 0.8*c - 0.25*p\n"
      "y = 0.05*c\n";
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Dataset data = oral_dose(two, Vector{{100.0, 0.0, 0.0}}, 0.03, seed);
    const Fit found = fit(one, model_view(one.model(), data, FiniteDifferences{}), {});
    EXPECT_EQ(found.adequacy.fits, Adequate::No) << seed;
    EXPECT_FALSE(found.quality[0].white) << seed;
    EXPECT_FALSE(standing_of(found).is_sound()) << seed;
  }
}

TEST(Fit, TwelveRowsOfTheRightModelAreSaidToBeFew) {
  const SystemModel one = parse_ode_system(kOneCompartment, "one.ode");
  const Dataset data = oral_dose(
      "time h\ndg/dt = -1.2*g\ndc/dt = 1.2*g - 0.15*c\ny = 0.05*c\n", Vector{{100.0, 0.0}},
      0.05, 2);
  const Fit found = fit(one, model_view(one.model(), data, FiniteDifferences{}), {});
  EXPECT_EQ(found.adequacy.fits, Adequate::Undetermined);
  EXPECT_FALSE(found.quality[0].white);
  EXPECT_TRUE(standing_of(found).open.empty());
  EXPECT_THAT(sentence_of(standing_of(found)), HasSubstr("too few to show"));
  EXPECT_THAT(found.notes[0], HasSubstr("13 samples of y are too few"));
}

/// A second way out that is not there: its rate is 0, and the first one no better known for
/// that.
TEST(Fit, ARateOfNothingHasAnUpperLimitOnly) {
  const Dataset data = support::grey_box(
      parse_ode("dx/dt = -0.5*x\ny = x\n", "d.ode"),
      {.start = Vector::Constant(1, 2.0), .step = 0.2, .samples = 40, .noise = 0.03});
  const std::string one = "param k = 0.5 in 0.01..20\n", ways = "dx/dt = -k*x - l*x^2\ny = x\n";
  const Fit found =
      fit(parse_ode_system(one + "param l = 0.01 in 0..20\n" + ways, "m.ode"), data, {});
  const FittedParameter& l = number(found, "l");
  EXPECT_FALSE(l.ci95 || l.at_least);
  ASSERT_TRUE(l.at_most);
  EXPECT_LT(*l.at_most, 0.2);
  std::string said;
  for (const FitCombination& combination : found.combinations) said += combination.message;
  EXPECT_THAT(said, HasSubstr("l at most")) << "with no lower limit";
  const FittedParameter alone =
      number(fit(parse_ode_system(one + "dx/dt = -k*x\ny = x\n", "m.ode"), data, {}), "k");
  const FittedParameter beside = number(found, "k");
  ASSERT_TRUE(alone.ci95 && beside.ci95);
  EXPECT_LT((*beside.ci95)[0], (*alone.ci95)[0] - 0.2 * (alone.value - (*alone.ci95)[0]));
}

TEST(Fit, ANumberOfWhichTheRecordsSayNothingHasNoInterval) {
  const SystemModel system = parse_ode_system(
      "param k = 0.1\nparam b = 1.02\ndx/dt = -k*x + 1e-12*b\ny = x\n", "d.ode");
  const Fit found = fit(system, decay_record(), {});
  EXPECT_FALSE(number(found, "b").ci95);
  EXPECT_TRUE(number(found, "k").ci95);
  ASSERT_EQ(found.combinations.size(), 1u);
  EXPECT_THAT(found.combinations[0].message, HasSubstr("b: the records do not determine it"));
  const SystemModel alone =
      parse_ode_system("param b = 1.02\ndx/dt = -0.1*x + 1e-12*b\ny = x\n", "d.ode");
  EXPECT_FALSE(number(fit(alone, decay_record(), {}), "b").ci95)
      << "nothing to compare it with";
}

TEST(StandingOf, SoundnessNeedsNoiseDeterminedNumbersAndRangesThatAreKept) {
  const SystemModel system = parse_ode_system("param k = 1\ndx/dt = -k*x\n", "m.ode");
  int sound = 0;
  for (const bool converged : {true, false})
    for (const Adequate fits : {Adequate::Yes, Adequate::No, Adequate::Undetermined})
      for (const bool known : {true, false})
        for (const bool bound : {true, false})
          for (const bool each : {true, false}) {
            Fit fit{.model = system};
            fit.converged = converged;
            fit.adequacy.fits = fits;
            FittedParameter number{.name = "k"};
            if (known && !each) number.ci95 = {{0.9, 1.1}};
            if (each) {
              number.per_record = {1.0, 2.0};
              number.per_record_errors = {0.1, known ? 0.2 : std::nan("")};
            }
            if (bound) number.bound = "max";
            fit.numbers = {number};
            const FitStanding standing = standing_of(fit);
            const bool expected = converged && fits == Adequate::Yes && known && !bound;
            EXPECT_EQ(standing.is_sound(), expected);
            const std::string sentence = sentence_of(standing);
            if (fits != Adequate::Yes) {
              EXPECT_EQ(sentence.find("and the residuals are noise"), std::string::npos)
                  << sentence;
            }
            if (converged && !expected && fits == Adequate::Yes) {
              EXPECT_THAT(sentence, HasSubstr("0 of 1 parameters are determined"));
            }
            sound += expected ? 1 : 0;
          }
  EXPECT_EQ(sound, 2);
}

TEST(Fit, AdequacyIsThatOfTheFreeRun) {
  const SystemModel right = parse_ode_system("param k = 0.2\ndx/dt = -k*x\ny = x\n", "d.ode");
  EXPECT_EQ(fit(right, decay_record(), {}).adequacy.fits, Adequate::Yes);
  const SystemModel wrong = parse_ode_system("param k = 0.2\ndx/dt = -k\ny = x\n", "d.ode");
  EXPECT_EQ(fit(wrong, decay_record(), {}).adequacy.fits, Adequate::No);
}

}  // namespace
}  // namespace lacuna
