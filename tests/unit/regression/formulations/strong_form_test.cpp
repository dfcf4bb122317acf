// SPDX-License-Identifier: MIT
// Rates as they are projected on test functions or stand at samples.
#include "regression/formulations/strong_form.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "data/derivatives/savitzky_golay.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "regression/formulations/integral_form.hpp"
#include "regression/formulations/projection.hpp"
#include "regression/formulations/test_functions.hpp"
#include "regression/formulations/weak_form.hpp"
#include "support/oscillation.hpp"
#include "unit/data/long_records/long_records.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TermLibrary rate_library(const std::vector<std::string>& texts) {
  TermLibrary library{{{"x", "v"}, {"u"}}, {}};
  for (const std::string& text : texts)
    library.terms.push_back(Term::parse(text, library.variables));
  return library;
}

StrongForm with_differences(int order = 8) {
  return StrongForm{{.differentiator = FiniteDifferences{{.order = order}}}};
}

/// Message of the DataError that assembling raises.
std::string problem_with(const Dataset& data, const TermLibrary& library) {
  try {
    with_differences().assemble(data, library);
  } catch (const DataError& error) {
    return error.what();
  }
  return "no error";
}

TEST(StrongForm, FindsAnOscillatorsCoefficients) {
  const auto system =
      with_differences().assemble(oscillation_data(), rate_library({"x", "v", "u"}));
  EXPECT_EQ(system.rows(), 400 - 2 * 4);
  EXPECT_THAT(system.target_names(), ElementsAre("dx/dt", "dv/dt"));
  const Vector first = system.subproblem(0, {0, 1, 2}).solve();
  const Vector second = system.subproblem(1, {0, 1, 2}).solve();
  EXPECT_LT((first - Eigen::Vector3d(0, 1, 0)).norm(), 1e-8);
  EXPECT_LT((second - Eigen::Vector3d(-4, 0, 0)).norm(), 1e-8);
}

TEST(StrongForm, GivenDerivativesAreTheTargets) {
  Dataset data = oscillation_data();
  give_derivatives(data.trajectories[0]);
  data.trajectories[0].derivatives.col(1) *= 2.0;
  const auto system =
      StrongForm{{.differentiator = SavitzkyGolay{{.window = 51, .degree = 2}}}}.assemble(
          data, rate_library({"x", "v"}));
  EXPECT_LT((system.subproblem(1, {0, 1}).solve() - Eigen::Vector2d(-8, 0)).norm(), 1e-12);
}

TEST(StrongForm, SmoothingOfStatesCanBeTurnedOff) {
  const Stage<Differentiator> wide = SavitzkyGolay{{.window = 51, .degree = 2}};
  const Dataset data = oscillation_data();
  const auto norm = [&](bool smooth) {
    const StrongForm form{{.differentiator = wide, .smooth_states = smooth}};
    return form.assemble(data, rate_library({"x"})).factor().column_norms[0];
  };
  const Vector position = data.trajectories[0].states.col(0);
  EXPECT_NEAR(norm(false), position.segment(25, position.size() - 50).norm(), 1e-10);
  EXPECT_GT(std::abs(norm(true) - norm(false)), 1e-6);
}

TEST(StrongForm, EndsWithOneSidedDerivativesHaveNoRow) {
  const auto rows = [](Index samples) {
    return with_differences(8).assemble(oscillation_data(samples), rate_library({"x"})).rows();
  };
  EXPECT_EQ(rows(16), 8);
  EXPECT_EQ(rows(15), 15);
}

TEST(StrongForm, TermThatIsNotFiniteIsNamedWithItsSample) {
  Dataset data = oscillation_data();
  data.trajectories[0].states(6, 0) = 0.0;
  const std::string problem = problem_with(data, rate_library({"v", "x^-1"}));
  EXPECT_NE(problem.find("term 'x^-1'"), std::string::npos) << problem;
  EXPECT_NE(problem.find("sample 7 of run.csv (t = 0.06, x = 0)"), std::string::npos)
      << problem;
}

TEST(StrongForm, AValueThatIsNotFiniteIsNamedInALongRecordToo) {
  // No candidate has x or the input u in it.
  const TermLibrary library = rate_library({"1", "v"});
  for (const bool given : {false, true}) {
    Dataset whole = testing::long_oscillation(200000, 97.3);
    whole.inputs = {{"u", ""}};
    Trajectory& record = whole.trajectories[0];
    record.inputs = Matrix::Random(record.samples(), 1);
    if (given) record.derivatives = Matrix::Random(record.samples(), 2);
    ASSERT_EQ(problem_with(whole, library), "no error");
    const std::vector<std::pair<Matrix*, std::string>> places{
        {&record.states, "state 'x'"},
        {&record.inputs, "input 'u'"},
        {&record.derivatives, "derivative of 'x'"}};
    for (const auto& [values, name] : places) {
      if (values->size() == 0) continue;
      const double before = std::exchange((*values)(150007, 0), kNan);
      const std::string problem = problem_with(whole, library);
      EXPECT_NE(problem.find("swing, row 150008: " + name + " is nan"), std::string::npos)
          << problem;
      (*values)(150007, 0) = before;
    }
  }
}

TEST(StrongForm, NoiseOfTheTargetIsTheNoiseOfDifferences) {
  const Dataset data = oscillation_data();
  const auto noise = with_differences(2).target_noise(data, Eigen::Vector2d(1e-3, 2e-3));
  ASSERT_TRUE(noise);
  // (x[i+1] - x[i-1]) / (2 h) has the variance sigma^2 / (2 h^2).
  EXPECT_NEAR((*noise)[0], 1e-3 / (std::sqrt(2.0) * 0.01), 1e-6);
  EXPECT_NEAR((*noise)[1], 2.0 * (*noise)[0], 1e-12);
}

TEST(StrongForm, NoiseOfTheTargetIsMeasuredOnAnyGrid) {
  Dataset data = oscillation_data(4000);
  Vector& time = data.trajectories[0].time;
  Random random(11);
  for (Index i = 1; i + 1 < time.size(); ++i) time[i] += random.uniform(-0.001, 0.001);
  const StrongForm form = with_differences(4);
  const Vector expected = *form.target_noise(data, Eigen::Vector2d(1.0, 1.0));
  Matrix noise(time.size(), 1);
  for (Index i = 0; i < time.size(); ++i) noise(i, 0) = random.normal();
  const Matrix rate = FiniteDifferences{{.order = 4}}.differentiate(time, noise);
  EXPECT_NEAR(rate.norm() / std::sqrt(static_cast<double>(time.size())) / expected[0], 1.0,
              0.1);
}

TEST(StrongForm, NoiseOfGivenDerivativesIsNotKnown) {
  Dataset data = oscillation_data();
  give_derivatives(data.trajectories[0]);
  EXPECT_FALSE(with_differences().target_noise(data, Eigen::Vector2d(1.0, 1.0)));
}

TEST(StrongForm, FittedToRecordsItGivesTheSameSystem) {
  const Dataset data = oscillation_data();
  const TermLibrary library = rate_library({"x", "v"});
  const Stage<Formulation> form = StrongForm{{.differentiator = FiniteDifferences{}}};
  const Stage<Formulation> fitted = fitted_to(form, data);
  EXPECT_EQ(fitted->assemble(data, library).subproblem(1, {0, 1}).solve(),
            form->assemble(data, library).subproblem(1, {0, 1}).solve());
  EXPECT_EQ(*fitted->target_noise(data, Vector::Ones(2)),
            *form->target_noise(data, Vector::Ones(2)));
}

TEST(StrongForm, PiecesTooShortForDifferencesAreLeftOut) {
  Dataset data = oscillation_data();
  data.trajectories.push_back(oscillation(8, 10.0));
  const auto system = with_differences(8).assemble(data, rate_library({"x", "v"}));
  EXPECT_EQ(system.rows(), 400 - 2 * 4);
}

TEST(StrongForm, RecordTooShortForTheDifferentiatorIsNamed) {
  const std::string problem = problem_with(oscillation_data(7), rate_library({"x"}));
  EXPECT_NE(problem.find("run.csv"), std::string::npos) << problem;
  EXPECT_NE(problem.find("at least 9 samples and has 7"), std::string::npos) << problem;
}

TermLibrary oscillator_terms() {
  TermLibrary library{{{"x", "v"}, {"u"}}, {}};
  for (const char* text : {"x", "v", "u"})
    library.terms.push_back(Term::parse(text, library.variables));
  return library;
}

Dataset noisy(double sigma, Index n = 2000) {
  Dataset data = oscillation_data(n);
  Random random(5);
  for (Index i = 0; i < data.trajectories[0].states.size(); ++i)
    data.trajectories[0].states.data()[i] += sigma * random.normal();
  return data;
}

TEST(WeakForm, FindsCoefficientsOfACleanRecord) {
  const auto system = WeakForm{}.assemble(oscillation_data(), oscillator_terms());
  EXPECT_LT((system.subproblem(1, {0, 1, 2}).solve() - Eigen::Vector3d(-4, 0, 0)).norm(), 1e-6);
}

TEST(WeakForm, FindsThemInNoise) {
  const auto system = WeakForm{}.assemble(noisy(0.05), oscillator_terms());
  const Vector h = system.subproblem(1, {0, 1, 2}).solve();
  EXPECT_NEAR(h[0], -4.0, 0.1);
  EXPECT_NEAR(h[1], 0.0, 0.1);
}

TEST(WeakForm, ResidualIsTheNoiseOfTheState) {
  const double sigma = 0.01;
  Dataset data = noisy(sigma, 4000);
  data.trajectories[0].states.col(1) = 2.0 * (2.0 * data.trajectories[0].time.array()).cos();
  const auto system = WeakForm{}.assemble(data, oscillator_terms());
  const double rms = system.subproblem(0, {0, 1, 2}).residual_norm() /
                     std::sqrt(static_cast<double>(system.rows()));
  EXPECT_NEAR(rms, sigma, 0.2 * sigma);
  EXPECT_EQ((*WeakForm{}.target_noise(data, Eigen::Vector2d(sigma, 1.0)))[0], sigma);
}

TEST(ChooseTestFunction, WidensWithNoiseAndWithTheStep) {
  const double clean = choose_test_function(noisy(1e-4)).radius;
  EXPECT_GT(choose_test_function(noisy(0.1)).radius, clean);
  Dataset slow = noisy(1e-4);
  slow.trajectories[0].time *= 100.0;
  EXPECT_NEAR(choose_test_function(slow).radius, 100.0 * clean, 1e-6 * clean);
}

TEST(ChooseTestFunction, KeepsWhatIsGiven) {
  const TestFunction phi = choose_test_function(noisy(0.01), {.radius = 0.3, .order = 5});
  EXPECT_EQ(phi.radius, 0.3);
  EXPECT_EQ(phi.order, 5);
  EXPECT_LT(test_function_spacing(phi), 0.3);
}

TEST(ChooseTestFunction, FitsIntoShortRecords) {
  const TestFunction phi = choose_test_function(noisy(0.1, 30));
  EXPECT_LE(4.0 * phi.radius, 0.29 + 1e-12);
}

TermLibrary terms() {
  TermLibrary library{{{"x", "v"}, {"u"}}, {}};
  for (const char* text : {"x", "v"})
    library.terms.push_back(Term::parse(text, library.variables));
  return library;
}

TEST(IntegralForm, FindsAnOscillatorsCoefficients) {
  const auto system = IntegralForm{{.span = 20}}.assemble(oscillation_data(), terms());
  EXPECT_EQ(system.rows(), 38);
  EXPECT_LT((system.subproblem(1, {0, 1}).solve() - Eigen::Vector2d(-4, 0)).norm(), 1e-6);
}

TEST(IntegralForm, RefusesASpanBeyondTheRecord) {
  EXPECT_THROW(IntegralForm{{.span = 500}}.assemble(oscillation_data(), terms()), DataError);
}

Trajectory uneven(Index n) {
  Random random(3);
  Trajectory record = oscillation(n);
  for (Index i = 0; i < n; ++i) record.time[i] += 0.006 * random.uniform(-0.5, 0.5);
  record.states << (2.0 * record.time.array()).sin(), 2.0 * (2.0 * record.time.array()).cos();
  return record;
}

TEST(TestFunction, SlopeIsTheDerivativeAndBothVanishOutside) {
  const TestFunction phi{0.7, 4};
  const double h = 1e-6;
  for (const double t : {-0.5, 0.0, 0.3, 0.65})
    EXPECT_NEAR(phi.slope(t), (phi.value(t + h) - phi.value(t - h)) / (2 * h), 1e-8);
  EXPECT_EQ(phi.value(0.7), 0.0);
  EXPECT_EQ(phi.slope(-0.71), 0.0);
}

TEST(QuadratureWeights, IntegrateCubicsExactlyOnAnyGrid) {
  const Vector t = uneven(50).time;
  const Vector w = quadrature_weights(t);
  const double a = t[0], b = t[49];
  EXPECT_NEAR(w.dot(t.array().cube().matrix()), (std::pow(b, 4) - std::pow(a, 4)) / 4, 1e-14);
  EXPECT_NEAR(quadrature_weights(t.head(2)).sum(), t[1] - t[0], 1e-15);
}

TEST(WeakProjection, RowsHoldWithoutADerivative) {
  for (const bool uniform : {true, false}) {
    const Trajectory record = uniform ? oscillation(300) : uneven(300);
    const Projection rows = weak_projection(record, {0.2, 6}, 0.05);
    EXPECT_GT(rows.rows(), 40);
    // dx/dt = v.
    const Vector left = rows.values * record.states.col(1);
    const Vector right = rows.rates * record.states.col(0);
    EXPECT_LT((left - right).cwiseAbs().maxCoeff(),
              (uniform ? 1e-5 : 1e-4) * left.cwiseAbs().maxCoeff());
  }
}

TEST(Projection, CovarianceIsThatOfTheRowsUnderNoiseOfTheSamples) {
  // Rows of dq/dt = q^2 + 3 q v: what noise on q and v does to them, by differences.
  const Trajectory record = uneven(60);
  const Projection rows = weak_projection(record, {0.1, 4}, 0.05);
  const auto left = [&](const Matrix& x) {
    const Vector f = x.col(0).array().square() + 3.0 * x.col(0).array() * x.col(1).array();
    return Vector(rows.values * f - rows.rates * x.col(0));
  };
  constexpr double kReach = 1e-6;
  const Vector noise = Vector{{0.1, 0.4}};
  Matrix response(rows.rows(), 120);
  for (Index j = 0; j < 120; ++j) {
    Matrix above = record.states, below = record.states;
    above.data()[j] += kReach;
    below.data()[j] -= kReach;
    response.col(j) = noise[j / 60] * (left(above) - left(below)) / (2.0 * kReach);
  }
  Matrix sensitivity(60, 2);
  sensitivity.col(0) = 2.0 * record.states.col(0) + 3.0 * record.states.col(1);
  sensitivity.col(1) = 3.0 * record.states.col(0);
  const Matrix expected = response * response.transpose();
  const Matrix found = rows.covariance(0, rows.rows(), sensitivity, noise, 0);
  EXPECT_LT((found - expected).norm(), 1e-7 * expected.norm());
  const Matrix part = rows.covariance(1, 2, sensitivity, noise, 0);
  EXPECT_LT((part - found.block(1, 1, 2, 2)).norm(), 1e-12);
}

TEST(IntegralProjection, RowsAreChangesOfTheState) {
  const Trajectory record = uneven(100);
  const Projection rows = integral_projection(record, 10, 5);
  EXPECT_EQ(rows.rows(), 18);
  EXPECT_LT((rows.values * record.states.col(1) - rows.rates * record.states.col(0)).norm(),
            1e-5);
}

TEST(Projection, CovarianceIsThatOfSimulatedNoise) {
  const Trajectory record = oscillation(60);
  const Projection rows = weak_projection(record, {0.15, 4}, 0.08);
  const Index count = rows.rows();
  Matrix sensitivity(60, 2);
  sensitivity << record.states.col(1), Vector::Constant(60, -4.0);
  const Vector sigma = Eigen::Vector2d(0.1, 0.2);
  Matrix sum = Matrix::Zero(count, count);
  Random random(7);
  constexpr int kDraws = 20000;
  for (int draw = 0; draw < kDraws; ++draw) {
    Matrix noise(60, 2);
    for (Index i = 0; i < noise.size(); ++i) noise.data()[i] = random.normal();
    noise.col(0) *= sigma[0];
    noise.col(1) *= sigma[1];
    const Vector residual = rows.values * sensitivity.cwiseProduct(noise).rowwise().sum() -
                            rows.rates * noise.col(0);
    sum += residual * residual.transpose() / kDraws;
  }
  const Matrix expected = rows.covariance(0, count, sensitivity, sigma, 0);
  EXPECT_LT((sum - expected).norm(), 0.05 * expected.norm());
}

TEST(Projection, TargetFactorMakesRowsWhite) {
  const Projection rows = weak_projection(oscillation(200), {0.15, 4}, 0.07);
  const Matrix factor(rows.target_factor(0, rows.rows()));
  const Matrix covariance = rows.covariance(0, rows.rows(), {}, Vector::Ones(1), 0);
  EXPECT_LT((factor * factor.transpose() - covariance).norm(), 1e-8 * covariance.norm());
}

}  // namespace
}  // namespace lacuna
