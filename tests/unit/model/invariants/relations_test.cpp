// SPDX-License-Identifier: MIT
#include "lacuna/model/invariants/relations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "model/invariants/moments.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;

/// x = 2 cos t, y = -2 sin t over twelve turns.
Dataset orbit(double radius = 2.0) {
  constexpr Index kSamples = 3000;
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, 75.0);
  record.states.resize(kSamples, 2);
  record.states.col(0) = radius * record.time.array().cos();
  record.states.col(1) = -radius * record.time.array().sin();
  return support::one_record({{"x", ""}, {"y", ""}}, {}, std::move(record));
}

Dataset record_of_text(const std::string& text, const Vector& start, double step, Index n) {
  Dataset data = record_of(parse_ode(text, "test"), Dopri87{}, start, step, n);
  for (Trajectory& record : data.trajectories) record.derivatives.resize(0, 0);
  return data;
}

std::vector<std::string> names_of(const Relation& relation) {
  std::vector<std::string> names;
  for (const RelationTerm& term : relation.terms) names.push_back(term.term);
  return names;
}

TEST(Relations, AreHeldAgainstNoiseThatIsKnown) {
  const Dataset data = add_relative_noise(orbit(), 0.01, 5);
  std::vector<StateNoise> noise = analyse_noise(data);
  EXPECT_EQ(find_relations(data, {}, {}, noise).size(), 1U);
  for (StateNoise& state : noise) state.sigma *= 0.1;
  EXPECT_TRUE(find_relations(data, {}, {}, noise).empty()) << "more is left than this noise";
  noise.pop_back();
  EXPECT_THROW(find_relations(data, {}, {}, noise), ArgumentError);
}

TEST(Relations, OneOrbitOfAnOscillatorIsACircle) {
  for (const double noise : {0.0, 1e-4, 0.01}) {
    const std::vector<Relation> found =
        find_relations(noise > 0.0 ? add_relative_noise(orbit(), noise, 5) : orbit());
    ASSERT_EQ(found.size(), 1U) << noise;
    EXPECT_THAT(names_of(found[0]), ElementsAre("x^2", "y^2"));
    EXPECT_EQ(found[0].terms[0].coefficient, 1.0);
    EXPECT_NEAR(found[0].terms[1].coefficient, 1.0,
                std::max(4.0 * found[0].terms[1].error, 1e-9));
    EXPECT_NEAR(found[0].value, 4.0, std::max(0.1 * found[0].scatter, 1e-9));
    // 2 x n_x + 2 y n_y with a noise of `noise` times 2 / sqrt(2).
    EXPECT_NEAR(found[0].scatter, 4.0 * noise * std::sqrt(2.0), 0.1 * 4.0 * noise + 1e-9);
  }
}

TEST(Relations, OrbitsOfDifferentSizeHaveNone) {
  Dataset data = orbit(2.0);
  data.trajectories.push_back(orbit(1.0).trajectories[0]);
  EXPECT_TRUE(find_relations(add_relative_noise(data, 0.01, 5)).empty());
  EXPECT_TRUE(find_relations(data).empty());
}

TEST(Relations, AChaoticAttractorHasNone) {
  const TestSystem& lorenz = test_system("lorenz");
  Dataset data = record_of(lorenz.model, Dopri87{}, lorenz.start, 0.01, 4000);
  data.trajectories[0].derivatives.resize(0, 0);
  EXPECT_TRUE(find_relations(data).empty());
  EXPECT_TRUE(find_relations(add_relative_noise(data, 0.01, 1)).empty());
}

TEST(Relations, AConservedTotalIsFoundAndWhatFollowsFromItIsNot) {
  const std::string text =
      "state S\nstate I\nstate R\ndS/dt = -0.5*S*I\ndI/dt = 0.5*S*I - 0.1*I\ndR/dt = 0.1*I\n";
  const Dataset data = record_of_text(text, Eigen::Vector3d(0.99, 0.01, 0.0), 0.05, 2000);
  for (const double noise : {0.0, 0.005}) {
    const std::vector<Relation> found =
        find_relations(noise > 0.0 ? add_relative_noise(data, noise, 2) : data);
    ASSERT_FALSE(found.empty()) << noise;
    EXPECT_THAT(names_of(found[0]), ElementsAre("S", "I", "R"));
    EXPECT_NEAR(found[0].value, 1.0, 1e-3);
    for (const RelationTerm& term : found[0].terms) EXPECT_NEAR(term.coefficient, 1.0, 2e-3);
    EXPECT_EQ(found.size(), 1U) << noise;
  }
}

TEST(Relations, AChainOfMassesHasNone) {
  const std::string text =
      "dx1/dt = v1\ndv1/dt = -2*x1 + x2 - 0.05*v1\ndx2/dt = v2\ndv2/dt = x1 - 2*x2 - 0.05*v2\n";
  const Dataset data = record_of_text(text, Eigen::Vector4d(1.0, 0.0, -0.3, 0.5), 0.05, 2000);
  EXPECT_TRUE(find_relations(data).empty());
  EXPECT_TRUE(find_relations(add_relative_noise(data, 0.01, 3)).empty());
}

TEST(Relations, AStateThatDoesNotMoveIsAConstant) {
  Dataset data = orbit();
  data.states.push_back({"z", ""});
  Matrix& states = data.trajectories[0].states;
  states.conservativeResize(Eigen::NoChange, 3);
  states.col(2).setConstant(3.0);
  const Dataset noisy = add_noise(data, Eigen::Vector3d(0.02, 0.02, 0.02), 4);
  const std::vector<Relation> found = find_relations(noisy);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_THAT(names_of(found[0]), ElementsAre("z"));
  EXPECT_NEAR(found[0].value, 3.0, 0.002);
  EXPECT_NEAR(found[0].scatter, 0.02, 0.002);
  EXPECT_THAT(names_of(found[1]), ElementsAre("x^2", "y^2"));
}

TEST(Relations, ErrorsAreTheSpreadOverDrawsOfTheNoise) {
  constexpr int kDraws = 40;
  Vector coefficients(kDraws), errors(kDraws);
  for (int draw = 0; draw < kDraws; ++draw) {
    const std::vector<Relation> found =
        find_relations(add_relative_noise(orbit(), 0.01, static_cast<std::uint64_t>(draw)));
    ASSERT_EQ(found.size(), 1U) << draw;
    coefficients[draw] = found[0].terms[1].coefficient;
    errors[draw] = found[0].terms[1].error;
  }
  const double spread =
      std::sqrt((coefficients.array() - coefficients.mean()).square().sum() / (kDraws - 1.0));
  EXPECT_NEAR(spread / errors.mean(), 1.0, 0.45);
}

TEST(Relations, EachIsSolvedForItsLastMonomial) {
  // y = 1 - x and z = 3 - x; that y and z differ by 2 follows.
  Dataset data = orbit();
  data.states = {{"x", ""}, {"y", ""}, {"z", ""}};
  Matrix& states = data.trajectories[0].states;
  states.conservativeResize(Eigen::NoChange, 3);
  states.col(1) = 1.0 - states.col(0).array();
  states.col(2) = 3.0 - states.col(0).array();
  const std::vector<Relation> found = find_relations(add_relative_noise(data, 0.01, 5));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_THAT(names_of(found[0]), ElementsAre("x", "y"));
  EXPECT_THAT(names_of(found[1]), ElementsAre("x", "z"));
  EXPECT_NEAR(found[1].value, 3.0, 0.01);
}

TEST(Relations, AConstantThatDriftsBelowItsNoiseIsNone) {
  // In means of 150 samples a noise of 0.02 is 0.0016: a drift of 0.008 shows there.
  for (const double drift : {0.0, 0.008}) {
    Dataset data = orbit();
    data.states = {{"z", ""}};
    Trajectory& record = data.trajectories[0];
    record.states = (3.0 + drift * (0.1 * record.time.array()).sin()).matrix();
    const Dataset noisy = add_noise(data, Vector::Constant(1, 0.02), 4);
    EXPECT_EQ(find_relations(noisy).size(), drift > 0.0 ? 0U : 1U);
  }
}

TEST(Relations, TheSquareOfASmallMotionIsNone) {
  // z moves by less than its noise, about different means; w moves for itself.
  for (const double mean : {0.0, 1.0, 3.0, -20.0})
    for (const double drift : {0.006, 0.012}) {
      Dataset data = orbit();
      data.states = {{"w", ""}, {"z", ""}};
      Trajectory& record = data.trajectories[0];
      record.states.col(1) = mean + drift * (0.1 * record.time.array()).sin();
      const Dataset noisy = add_noise(data, Vector::Constant(2, 0.02), 4);
      EXPECT_TRUE(find_relations(noisy).empty()) << mean << ", " << drift;
    }
}

TEST(Relations, AProductWithASmallMotionIsNone) {
  // z moves by less than its noise and shows it in means only; in (z - 3) x, which oscillates,
  // and in (z - 3) (x + y) it is averaged out there too.
  for (const double drift : {0.006, 0.008, 0.01})
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Dataset data = orbit();
      data.states.push_back({"z", ""});
      Trajectory& record = data.trajectories[0];
      record.states.conservativeResize(Eigen::NoChange, 3);
      record.states.col(2) = 3.0 + drift * (0.1 * record.time.array()).sin();
      const auto found = find_relations(add_noise(data, Vector::Constant(3, 0.02), seed));
      ASSERT_EQ(found.size(), 1U) << drift << ", " << seed;
      EXPECT_THAT(names_of(found[0]), ElementsAre("x^2", "y^2"));
    }
}

TEST(Relations, AProductWithASmallMotionOfASumIsNone) {
  // y - 3 x moves by less than its noise.
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Dataset data = orbit();
    Matrix& states = data.trajectories[0].states;
    const auto& time = data.trajectories[0].time.array();
    states.col(0) = time.cos() + 0.3 * (2.3 * time).sin();
    states.col(1) = (3.0 * states.col(0).array() + 1.0 + 0.02 * (0.1 * time).sin()).matrix();
    EXPECT_TRUE(find_relations(add_noise(data, Vector::Constant(2, 0.02), seed)).empty())
        << seed;
  }
}

TEST(Relations, TheOptionsAreWhatDecides) {
  const Dataset data = add_relative_noise(orbit(), 0.01, 5);
  EXPECT_EQ(find_relations(data).size(), 1U);
  EXPECT_TRUE(find_relations(data, {.most_terms = 1}).empty());
  EXPECT_TRUE(find_relations(data, {.strength = 1000.0}).empty());
  EXPECT_TRUE(find_relations(data, {.noise_slack = 0.0, .scatter = -5.0}).empty());
  EXPECT_TRUE(find_relations(data, {.most_states = 1}).empty()) << "linear ones only";
  EXPECT_TRUE(find_relations(data, {.most_sets = 1.0}).empty());
  EXPECT_TRUE(find_relations(data, {.fewest_samples = 100000}).empty());
}

/// Two sines with white noise of 0.1 and 0.2.
Dataset noisy_pair(Index n, double noise) {
  Random random(11);
  Trajectory record;
  record.time = Vector::LinSpaced(n, 0.0, 0.02 * static_cast<double>(n));
  record.states.resize(n, 2);
  record.states.col(0) = (1.3 * record.time).array().sin();
  record.states.col(1) = 2.0 + (0.7 * record.time).array().cos();
  for (Index i = 0; i < n; ++i) {
    record.states(i, 0) += noise * random.normal();
    record.states(i, 1) += 2.0 * noise * random.normal();
  }
  return support::one_record({{"x", ""}, {"y", ""}}, {}, std::move(record));
}

TEST(MonomialMoments, NoiseIsThatOfTheMonomials) {
  const Index n = 4000;
  const MonomialMoments noisy = monomial_moments(noisy_pair(n, 0.1), 2, 0.0);
  const Dataset clean = noisy_pair(n, 0.0);
  const Matrix& x = clean.trajectories[0].states;
  // var(x y) = x^2 var(y) + y^2 var(x), var(y^2) = 4 y^2 var(y), first order in the variances.
  const double xx = x.col(0).squaredNorm() / double(n), yy = x.col(1).squaredNorm() / double(n);
  EXPECT_NEAR(noisy.white(0, 0), 0.01, 0.001);
  EXPECT_NEAR(noisy.white(3, 3), 0.04 * xx + 0.01 * yy, 0.15 * noisy.white(3, 3));
  EXPECT_NEAR(noisy.white(4, 4), 4.0 * 0.04 * yy, 0.15 * noisy.white(4, 4));
  EXPECT_NEAR(noisy.mean[4], yy, 0.01 * yy);  // without the 0.04 that the noise adds
}

TEST(MonomialMoments, TheSecondOrderOfTheNoiseIsThatOfHessians) {
  const MonomialMoments moments = monomial_moments(noisy_pair(4000, 0.1), 2, 0.0);
  EXPECT_EQ(moments.second(0, 0), 0.0);
  EXPECT_NEAR(moments.second(3, 3), 2.0 * 0.01 * 0.04, 0.2 * moments.second(3, 3));
  EXPECT_NEAR(moments.second(4, 4), 4.0 * 0.04 * 0.04, 0.2 * moments.second(4, 4));
  EXPECT_EQ(moments.second(3, 4), 0.0) << "x*y has no second derivative by y";
}

TEST(MonomialMoments, BlocksAreMeansOfSamples) {
  const MonomialMoments moments = monomial_moments(noisy_pair(1000, 0.1), 1, 1e-4);
  EXPECT_EQ(moments.block, 50);
  ASSERT_EQ(moments.block_means.rows(), 20);
  EXPECT_NEAR(moments.block_means.col(0).mean(), 0.0, 1e-12);
  EXPECT_NEAR(moments.lasting(0, 0), 1e-8 * moments.covariance(0, 0), 1e-12);
}

}  // namespace
}  // namespace lacuna
