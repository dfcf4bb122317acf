// SPDX-License-Identifier: MIT
#include "lacuna/regression/formulations/strong_form.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "core/base/random.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/data/derivatives/savitzky_golay.hpp"
#include "lacuna/regression/linear/subproblem.hpp"
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

}  // namespace
}  // namespace lacuna
