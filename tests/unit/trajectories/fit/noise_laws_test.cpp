// SPDX-License-Identifier: MIT
// Fits under laws of noise beside maxima of the likelihood that are known otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {
namespace {

/// Decay from 10 with a rate of 0.5, each value made by `noise`.
template <class Noise>
Dataset decay(const Noise& noise) {
  constexpr Index kSamples = 60;
  Random random(3);
  Dataset data{"s", {{"x", ""}}, {}, {}, {}};
  Trajectory record{"decay", sample_times(0.0, 0.1, kSamples), Matrix(kSamples, 1),
                    Matrix(kSamples, 0), Matrix()};
  for (Index i = 0; i < kSamples; ++i)
    record.states(i, 0) = noise(10.0 * std::exp(-0.5 * record.time[i]), random.normal());
  data.trajectories = {record};
  return data;
}

TEST(NoiseLaws, OfAnOutputThatIsJustAStateAreThoseOfItsColumn) {
  Dataset data = decay([](double y, double e) { return y * std::exp(0.3 * e); });
  const std::string model = "param k = 1\ndx/dt = -k*x\n";
  const Fit by_state =
      fit(parse_ode_system(model + "x = x noise lognormal\n", "m.ode"), data, {});
  data.states[0].name = "y";
  const SystemModel system = parse_ode_system(model + "y = x noise lognormal\n", "m.ode");
  const Fit by_output = fit(system, model_view(system.model(), data), {});
  ASSERT_TRUE(by_output.quality[0].law.has_value());
  EXPECT_NEAR(by_output.log_likelihood, by_state.log_likelihood, 1e-9);
  EXPECT_NEAR(by_output.numbers[0].value, by_state.numbers[0].value, 1e-9);
}

// Logarithms of a decay with lognormal noise are a straight line: linear regression is the
// maximum of the likelihood, with the exact standard error.
TEST(NoiseLaws, LognormalDecayIsTheRegressionOfLogarithms) {
  const Dataset data = decay([](double y, double e) { return y * std::exp(0.3 * e); });
  const Fit found = fit(parse_ode_system("param k = 1\ndx/dt = -k*x\nx = x noise lognormal\n",
                                         "m.ode"),
                        data, {});
  const Vector time = data.trajectories[0].time;
  const Vector logs = data.trajectories[0].states.col(0).array().log();
  const auto n = static_cast<double>(time.size());
  const Vector centred = time.array() - time.mean();
  const double slope = centred.dot(logs) / centred.squaredNorm();
  const double start = logs.mean() - slope * time.mean();
  const Vector residual = logs.array() - start - slope * time.array();
  const double sigma = std::sqrt(residual.squaredNorm() / (n - 2.0));
  ASSERT_EQ(found.numbers.size(), 1u);
  EXPECT_NEAR(found.numbers[0].value, -slope, 2e-5);
  EXPECT_NEAR(found.initial[0][0].value, std::exp(start), 1e-3);
  ASSERT_TRUE(found.numbers[0].standard_error);
  EXPECT_NEAR(*found.numbers[0].standard_error, sigma / centred.norm(),
              0.02 * sigma / centred.norm());
  ASSERT_TRUE(found.quality[0].law);
  EXPECT_NEAR(*found.quality[0].law->fraction, sigma, 1e-3 * sigma);
}

/// -2 log-likelihood of a decay from 10 that is measured down to a limit, by its definition.
double censored_loss(const Trajectory& record, double limit, double rate, double sigma) {
  double loss = 0.0;
  for (Index i = 0; i < record.samples(); ++i) {
    const double value = record.states(i, 0), y = 10.0 * std::exp(-rate * record.time[i]);
    const double z = (std::max(value, limit) - y) / sigma;
    loss += value <= limit ? -2.0 * std::log(0.5 * std::erfc(-z / std::sqrt(2.0))) : z * z;
  }
  return loss;
}

TEST(NoiseLaws, ValuesBelowALimitCountByTheirProbability) {
  constexpr double kLimit = 2.0, kSigma = 0.5;
  const Dataset data =
      decay([&](double y, double e) { return std::max(kLimit, y + kSigma * e); });
  const auto rate = [&](const std::string& limit) {
    return fit(parse_ode_system("param k = 1\ndx/dt = -k*x\ninitial x = 10 at 0 fixed\n"
                                "x = x noise constant 0.5" +
                                    limit + "\n",
                                "m.ode"),
               data, {});
  };
  const Fit found = rate(" below 2");
  double best = 0.0, least = std::numeric_limits<double>::infinity();
  for (double k = 0.3; k < 0.8; k += 1e-5)
    if (const double loss = censored_loss(data.trajectories[0], kLimit, k, kSigma);
        loss < least) {
      least = loss;
      best = k;
    }
  EXPECT_NEAR(found.numbers.at(0).value, best, 5e-5);
  EXPECT_GT(best - rate("").numbers.at(0).value, 0.02) << "the limits are no values";
  EXPECT_EQ(found.quality[0].censored,
            (data.trajectories[0].states.col(0).array() <= kLimit).count());
}

// Where only values above a limit are recorded, the largest likelihood of a constant is where the
// mean of the values is that of the truncated normal, y + sigma f(q) / (1 - F(q)), q = (L - y) /
// sigma.
TEST(NoiseLaws, TruncatedMeanIsThatOfTheMomentEquation) {
  constexpr double kLimit = 2.0, kSigma = 0.5;
  Random random(6);
  Dataset data = decay([](double, double) { return 0.0; });
  Matrix& values = data.trajectories[0].states;
  for (double& value : values.reshaped())
    do value = 2.2 + kSigma * random.normal();
    while (value < kLimit);
  data.states[0].name = "y";
  const SystemModel system =
      parse_ode_system("param a = 1\ndx/dt = 0*x\ny = a*x noise constant 0.5 truncated below 2\n"
                       "initial x = 1 fixed\n",
                       "m.ode");
  const Fit found = fit(system, model_view(system.model(), data, FiniteDifferences{}), {});
  const auto mean = [&](double y) {
    const double q = (kLimit - y) / kSigma;
    return y + kSigma * std::exp(-0.5 * q * q) / std::sqrt(2.0 * std::numbers::pi) /
                   (0.5 * std::erfc(q / std::sqrt(2.0)));
  };
  double low = 0.0, high = 4.0;
  while (high - low > 1e-9)
    (mean(0.5 * (low + high)) < values.mean() ? low : high) = 0.5 * (low + high);
  EXPECT_NEAR(found.numbers.at(0).value, low, 1e-3) << "a hundredth of its error";
  EXPECT_GT(values.mean() - low, 0.1) << "the limit matters";
  // The variance of the estimate is sigma^2 over the variance of a recorded value in sigma^2.
  const double step = 1e-4, slope = (mean(low + step) - mean(low - step)) / (2.0 * step);
  ASSERT_TRUE(found.numbers[0].standard_error);
  EXPECT_NEAR(*found.numbers[0].standard_error,
              kSigma / std::sqrt(slope * static_cast<double>(values.rows())), 2e-3);
  EXPECT_EQ(found.quality[0].samples, values.rows());
}

/// Least -2 log-likelihood over the deviation of normal values about y of which those below a
/// limit are not recorded, by its definition.
double least_truncated_loss(const Matrix& values, double y, double limit) {
  double least = std::numeric_limits<double>::infinity();
  for (double sigma = 0.3; sigma < 3.0; sigma *= 1.002) {
    const double tail = 0.5 * std::erfc((limit - y) / sigma / std::sqrt(2.0));
    double loss = 0.0;
    for (const double value : values.reshaped()) loss += std::pow((value - y) / sigma, 2);
    loss += 2.0 * static_cast<double>(values.size()) * std::log(sigma * tail);
    least = std::min(least, loss);
  }
  return least;
}

// The size of truncated noise depends on where the model is: held, it would make the interval
// shorter.
TEST(NoiseLaws, IntervalsUnderLimitsAreThoseOfTheLikelihoodLargestOverTheSize) {
  constexpr double kLimit = 2.0;
  Random random(6);
  Dataset data = decay([](double, double) { return 0.0; });
  Matrix& values = data.trajectories[0].states;
  for (double& value : values.reshaped())
    do value = 2.4 + 0.5 * random.normal();
    while (value < kLimit);
  data.states[0].name = "y";
  const auto fitted = [&](const std::string& size) {
    const SystemModel system = parse_ode_system(
        "param a = 1\ndx/dt = 0*x\ny = a*x noise constant " + size +
            "truncated below 2\ninitial x = 1 fixed\n",
        "m.ode");
    const Dataset view = model_view(system.model(), data, FiniteDifferences{});
    return fit(system, view, {}).numbers.at(0);
  };
  const FittedParameter found = fitted("");
  ASSERT_TRUE(found.ci95);
  const auto n = static_cast<double>(values.size());
  const double least = least_truncated_loss(values, found.value, kLimit);
  for (const double end : *found.ci95) {
    const double deviance = (least_truncated_loss(values, end, kLimit) - least) * (n - 1.0) / n;
    EXPECT_NEAR(std::sqrt(deviance), student_quantile_975(n - 1.0), 0.06) << end;
  }
  const FittedParameter held = fitted("0.5 ");
  ASSERT_TRUE(held.ci95);
  EXPECT_LT((*held.ci95)[1] - (*held.ci95)[0], 0.8 * ((*found.ci95)[1] - (*found.ci95)[0]));
}

TEST(NoiseLaws, TruncatedSizeIsEstimatedAndValuesBeyondTheLimitAreLeftOut) {
  Random random(9);
  Dataset data = decay([](double, double) { return 0.0; });
  Trajectory& record = data.trajectories[0];
  for (Index i = 0; i < record.samples(); ++i)
    do record.states(i, 0) = 10.0 * std::exp(-0.5 * record.time[i]) + 0.5 * random.normal();
    while (record.states(i, 0) < 1.0);
  record.states(7, 0) = 0.5;
  const auto rate = [&](const std::string& truncated) {
    return fit(parse_ode_system("param k = 1\ndx/dt = -k*x\ninitial x = 10 at 0 fixed\n"
                                "x = x noise constant" + truncated + "\n",
                                "m.ode"),
               data, {});
  };
  const Fit found = rate(" truncated below 1");
  EXPECT_EQ(found.quality[0].samples, record.samples() - 1);
  EXPECT_NEAR(found.numbers.at(0).value, 0.5, 3.0 * found.numbers[0].standard_error.value_or(0.0));
  EXPECT_NEAR(found.quality[0].law->constant.value_or(0.0), 0.5, 0.12);
  const auto said = std::find_if(found.notes.begin(), found.notes.end(), [](const auto& note) {
    return note.find("1 values of x are beyond the limits") != std::string::npos;
  });
  EXPECT_NE(said, found.notes.end());
}

TEST(NoiseLaws, StudentNoiseIsNotMovedByAFewWildValues) {
  Dataset data = decay([](double y, double e) { return y + 0.05 * e; });
  for (const Index wild : {5, 20, 41}) data.trajectories[0].states(wild, 0) += 8.0;
  const auto rate = [&](const std::string& law) {
    return fit(parse_ode_system("param k = 1\ndx/dt = -k*x\nx = x" + law + "\n", "m.ode"), data,
               {})
        .numbers.at(0)
        .value;
  };
  EXPECT_LT(std::abs(rate(" noise student 3") - 0.5), 0.01);
  EXPECT_GT(std::abs(rate("") - 0.5), 0.02);
}

TEST(NoiseLaws, ValuesThatLognormalNoiseCannotMakeAreLeftOutWithANote) {
  Dataset data = decay([](double y, double e) { return y * std::exp(0.1 * e); });
  data.trajectories[0].states(3, 0) = 0.0;
  const Fit found = fit(parse_ode_system("param k = 1\ndx/dt = -k*x\nx = x noise lognormal\n",
                                         "m.ode"),
                        data, {});
  EXPECT_EQ(found.quality[0].samples, 59);
  EXPECT_NEAR(found.numbers[0].value, 0.5, 0.05);
  const auto said = std::find_if(found.notes.begin(), found.notes.end(), [](const auto& note) {
    return note.find("1 values of x are not above 0") != std::string::npos;
  });
  EXPECT_NE(said, found.notes.end());
}

// A value that is 0 because the model is says nothing of the size of the noise.
TEST(NoiseLaws, ZerosAreNoValuesOfProportionalNoise) {
  Dataset data = decay([](double y, double e) { return y * (1.0 + 0.1 * e); });
  const SystemModel system =
      parse_ode_system("param k = 1\ndx/dt = -k*x\nx = x noise proportional\n", "m.ode");
  data.trajectories[0].states(3, 0) = 0.0;
  const Fit found = fit(system, data, {});
  EXPECT_EQ(found.quality[0].samples, 59);
  EXPECT_NEAR(found.quality[0].law->fraction.value_or(0.0), 0.1, 0.03);
  const auto said = std::find_if(found.notes.begin(), found.notes.end(), [](const auto& note) {
    return note.find("1 values of x are exactly 0") != std::string::npos;
  });
  EXPECT_NE(said, found.notes.end());
}

/// x = 2 t with a standard deviation of its own in each sample, in the input "sd".
Dataset line_with_deviations() {
  constexpr Index kSamples = 100;
  Random random(8);
  Dataset data{"s", {{"x", ""}}, {{"sd", ""}}, {}, {}};
  Trajectory record{"line", sample_times(0.0, 0.1, kSamples), Matrix(kSamples, 1),
                    Matrix(kSamples, 1), Matrix()};
  for (Index i = 0; i < kSamples; ++i) {
    record.inputs(i, 0) = i % 3 == 0 ? 0.05 : 2.0;
    record.states(i, 0) = 2.0 * record.time[i] + record.inputs(i, 0) * random.normal();
  }
  data.trajectories = {record};
  return data;
}

// Weighted linear regression with known deviations.
TEST(NoiseLaws, KnownDeviationsAreWeights) {
  const Dataset data = line_with_deviations();
  const Trajectory& record = data.trajectories[0];
  const SystemModel model =
      parse_ode_system("param a = 1\ndx/dt = a\ninitial x = 0 fixed\n", "m.ode");
  FitOptions options;
  options.deviations = {{"x", "sd"}};
  const Fit found = fit(model, data, {}, options);
  const Vector weight = record.inputs.col(0).array().square().inverse();
  const double information = record.time.cwiseAbs2().dot(weight);
  const double slope = record.time.cwiseProduct(record.states.col(0)).dot(weight) / information;
  EXPECT_NEAR(found.numbers.at(0).value, slope, 1e-6);
  ASSERT_TRUE(found.numbers[0].standard_error);
  EXPECT_NEAR(*found.numbers[0].standard_error, 1.0 / std::sqrt(information),
              0.01 / std::sqrt(information));
  const Vector residual = record.states.col(0) - slope * record.time;
  double log_likelihood = -0.5 * residual.cwiseAbs2().dot(weight);
  for (const double own : weight) log_likelihood += 0.5 * std::log(own / (2.0 * std::numbers::pi));
  EXPECT_NEAR(found.log_likelihood, log_likelihood, 1e-6);
}

TEST(NoiseLaws, DeviationsThatAreNoneAreAnError) {
  Dataset data = line_with_deviations();
  const SystemModel model = parse_ode_system("param a = 1\ndx/dt = a\n", "m.ode");
  const auto with = [&](KnownDeviation known) {
    FitOptions options;
    options.deviations = {std::move(known)};
    return fit(model, data, {}, options);
  };
  EXPECT_THROW(with({"y", "sd"}), DataError);
  EXPECT_THROW(with({"x", "error"}), DataError);
  data.trajectories[0].inputs(7, 0) = 0.0;
  EXPECT_THROW(with({"x", "sd"}), DataError);
}

}  // namespace
}  // namespace lacuna
