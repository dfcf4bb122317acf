// SPDX-License-Identifier: MIT
#include "trajectories/design/evidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/design/plan.hpp"
#include "support/one_record.hpp"
#include "trajectories/design/refit.hpp"

namespace lacuna {
namespace {

/// Models whose values are linear in their numbers, so that all is a Gaussian that can be
/// written out: y = a + b u, and y = c u^2.
PlanProblem gaussian_problem() {
  const std::string head = "input u hold zero\ndx/dt = -x\nfixed dx/dt: x\n"
                           "initial x = 0 fixed\n";
  PlanProblem all;
  all.models = {{"line", parse_ode_system(head + "param a = 1\nparam b = 2\ny = a + b*u\n", "l")},
                {"parabola", parse_ode_system(head + "param c = 3\ny = c*u^2\n", "p")}};
  all.models[0].information = Matrix::Identity(2, 2) * 4.0;
  all.models[1].information = Matrix::Identity(1, 1) * 9.0;
  all.inputs = {{"u", -1.0, 1.0}};
  all.channels = {{"y", 0.5}};
  return all;
}

Experiment levels() {
  Experiment one{Vector::LinSpaced(4, 0.0, 3.0), Matrix(4, 1), Matrix::Ones(4, 1)};
  one.inputs << -1.0, -0.2, 0.4, 1.0;
  return one;
}

constexpr double kWide = 1e6;  // what is taken of unknown numbers adds nothing

Rivals rivals(int draws) {
  const PlanProblem all = gaussian_problem();
  Rivals both;
  for (const PlanModel& model : all.models) {
    both.runs.push_back(model_run(model, all));
    both.knowledge.push_back(knowledge_of(model, kWide));
    both.weights.push_back(0.5);
    both.draws.push_back(draws_of(both.runs.back(), both.knowledge.back(), draws, 5));
  }
  return both;
}

/// Mean and covariance of the values in units of the noise.
struct Gaussian {
  Vector mean;
  Matrix covariance;
};

Gaussian line() {
  Matrix s(4, 2);
  s << Vector::Ones(4), levels().inputs.col(0);
  s /= 0.5;
  return {s * Eigen::Vector2d(1.0, 2.0), Matrix::Identity(4, 4) + s * s.transpose() / 4.0};
}

Gaussian parabola() {
  const Vector s = levels().inputs.col(0).cwiseAbs2() / 0.5;
  return {3.0 * s, Matrix::Identity(4, 4) + s * s.transpose() / 9.0};
}

/// The expected log ratio of the densities under the first (Kullback and Leibler).
double divergence(const Gaussian& p, const Gaussian& q) {
  const Matrix inverse = q.covariance.inverse();
  const Vector d = p.mean - q.mean;
  return 0.5 * ((inverse * p.covariance).trace() - 4.0 + d.dot(inverse * d) +
                std::log(q.covariance.determinant() / p.covariance.determinant()));
}

TEST(DistinctionOf, IsTheDivergenceOfTheGaussians) {
  Rivals both = rivals(4000);
  const DesignEvidence evidence = evidence_of(both, levels(), true);
  ASSERT_TRUE(evidence.is_finite);
  const double one = distinction_of(both, evidence, 0, 1, 3.0).log_bayes_factor;
  const double other = distinction_of(both, evidence, 1, 0, 3.0).log_bayes_factor;
  // The means of 4000 draws of quadratic forms are known to about 2 %.
  EXPECT_NEAR(one / divergence(line(), parabola()), 1.0, 0.06);
  EXPECT_NEAR(other / divergence(parabola(), line()), 1.0, 0.06);
}

TEST(RepeatedEvidence, IsThatOfTheExperimentMadeAgain) {
  Rivals both = rivals(6);
  const DesignEvidence once = evidence_of(both, levels(), true);
  DesignEvidence twice = once;
  twice += once;
  EXPECT_NEAR(distinction_of(both, twice, 0, 1, 3.0).log_bayes_factor,
              distinction_of(both, repeated(once, 2.0), 0, 1, 3.0).log_bayes_factor, 1e-9);
  EXPECT_GT(distinction_of(both, twice, 0, 1, 3.0).log_bayes_factor,
            distinction_of(both, once, 0, 1, 3.0).log_bayes_factor);
}

TEST(RefittedSquares, AreTheLinearOnesOfALinearModel) {
  Rivals both = rivals(4);
  const DesignEvidence evidence = evidence_of(both, levels(), true);
  const Vector squares = refitted_squares(both, {levels()}, 0, 1);
  ASSERT_EQ(squares.size(), 4);
  EXPECT_NEAR(squares.mean(), distinction_of(both, evidence, 0, 1, 3.0).distance, 1e-6);
}

TEST(LogEvidence, IsTheDensityOfTheGaussian) {
  Rivals both = rivals(1);
  Vector values(4);
  values << -1.0, 2.0, 3.5, 6.0;
  const Gaussian p = line();
  const Vector d = values - p.mean;
  const double expected =
      -0.5 * (d.dot(p.covariance.inverse() * d) + std::log(p.covariance.determinant()));
  EXPECT_NEAR(log_evidence(both.runs[0], both.knowledge[0], {levels()}, {values}), expected,
              1e-6);
}

TEST(DrawsOf, HaveTheCovarianceOfWhatIsKnown) {
  PlanProblem all = gaussian_problem();
  Matrix information(2, 2);
  information << 4.0, 1.0, 1.0, 2.0;
  all.models[0].information = information;
  const ModelRun run = model_run(all.models[0], all);
  const auto draws = draws_of(run, knowledge_of(all.models[0], kWide), 20000, 3);
  ASSERT_EQ(draws.size(), 20000u);
  Matrix covariance = Matrix::Zero(2, 2);
  Vector mean = Vector::Zero(2);
  for (const PathNumbers& draw : draws) {
    const Vector off = draw.parameters - run.values;
    covariance += off * off.transpose() / 20000.0;
    mean += off / 20000.0;
  }
  EXPECT_LT(mean.norm(), 1e-9) << "in pairs";
  EXPECT_LT((covariance * information - Matrix::Identity(2, 2)).cwiseAbs().maxCoeff(), 0.06);
}

TEST(KnowledgeOf, StandardErrorsCountWithoutInformation) {
  PlanModel model = gaussian_problem().models[1];
  model.information = Matrix();
  EXPECT_EQ(knowledge_of(model, 0.5).information(0, 0), 0.0);
  EXPECT_NEAR(knowledge_of(model, 0.5).proper(0, 0), 1.0 / (1.5 * 1.5), 1e-12) << "half of 3";
  std::vector<Parameter> parameters = model.system.parameters();
  parameters.at(0).standard_error = 0.1;
  model.system = SystemModel(model.system.symbolic(), parameters);
  EXPECT_NEAR(knowledge_of(model, 0.5).information(0, 0), 100.0, 1e-9);
  parameters.at(0).standard_error.reset();
  parameters.at(0).deviation = 0.2;
  model.system = SystemModel(model.system.symbolic(), parameters);
  EXPECT_NEAR(knowledge_of(model, 0.5).information(0, 0), 25.0, 1e-9) << "a prior";
}

/// What is taken of a parameter of value 0.01 in 0.01..10 beside so much that records have left.
double taken_beside(double information) {
  PlanModel model = gaussian_problem().models[1];
  std::vector<Parameter> parameters = model.system.parameters();
  parameters.at(0).value = 0.01;
  parameters.at(0).min = 0.01;
  parameters.at(0).max = 10.0;
  model.system = SystemModel(model.system.symbolic(), parameters);
  model.information = Matrix::Constant(1, 1, information);
  return 1.0 / std::sqrt(knowledge_of(model, 0.5).proper(0, 0) - information);
}

TEST(KnowledgeOf, AnEstimateBelowItsErrorIsNoSize) {
  EXPECT_NEAR(taken_beside(25.0), 0.5 * 0.2, 1e-9) << "the error is 0.2";
  EXPECT_NEAR(taken_beside(1e6), 0.5 * 0.01, 1e-6) << "the error is a tenth of the estimate";
  EXPECT_NEAR(taken_beside(0.0), 9.99 / std::sqrt(12.0), 1e-9) << "any value of the range";
}

// What records determine, and promised intervals against fits of simulated records.
/// x' = -k x + u from a known start, so that k is all that is estimated.
SystemModel decay(double k) {
  return parse_ode_system("input u hold zero\nparam k = " + std::to_string(k) +
                              " in 0.01..9\ndx/dt = -k*x + u\nfixed dx/dt: u\ny = x\n"
                              "initial x = 1 fixed\n",
                          "decay");
}

/// With u = 0: y = exp(-k t) with noise.
Dataset record(double k, double noise, std::uint64_t seed) {
  Random random(seed);
  Trajectory run{"r", Vector::LinSpaced(41, 0.0, 4.0), Matrix(41, 1), Matrix::Zero(41, 1),
                 Matrix()};
  for (Index i = 0; i < 41; ++i)
    run.states(i, 0) = std::exp(-k * run.time[i]) + noise * random.normal();
  return support::one_record({{"y", ""}}, {{"u", "", Hold::Zero}}, std::move(run));
}

TEST(InformationOf, IsThatOfTheFormula) {
  const Dataset data =
      model_view(decay(1.0).model(), record(0.7, 0.02, 3), FiniteDifferences{});
  const Fit found = fit(decay(1.0), data, {});
  const Matrix information = information_of(found, data);
  ASSERT_EQ(information.size(), 1);
  const double k = found.model.parameters().at(0).value, rmse = found.quality.at(0).rmse;
  double sum = 0.0;  // of (dy/dk)^2 = t^2 exp(-2 k t)
  for (const double t : data.trajectories[0].time) sum += t * t * std::exp(-2.0 * k * t);
  EXPECT_NEAR(information(0, 0) * rmse * rmse / sum, 1.0, 1e-3);
}

TEST(ExperimentsOf, AreTheRecords) {
  const Dataset data =
      model_view(decay(1.0).model(), record(0.7, 0.02, 3), FiniteDifferences{});
  const Fit found = fit(decay(1.0), data, {});
  PlanProblem problem;
  problem.inputs = {{"u", 0.0, 1.0}};
  problem.channels = {{"y", 0.02}};
  const std::vector<Experiment> made = experiments_of(found, data, problem);
  ASSERT_EQ(made.size(), 1u);
  EXPECT_EQ(made[0].time, data.trajectories[0].time);
  EXPECT_EQ(made[0].inputs.rows(), 41);
  ASSERT_EQ(made[0].starts.size(), 1u);
  EXPECT_EQ(made[0].starts[0].low, 1.0);
  problem.inputs[0].name = "w";
  EXPECT_THROW(experiments_of(found, data, problem), ArgumentError);
}

/// A run without input, so that it is known before it is planned.
PlanProblem free_decay(double information) {
  PlanProblem problem;
  problem.models = {{"decay", decay(0.7), Matrix::Constant(1, 1, information)}};
  problem.inputs = {{"u", 0.0, 1e-9}};
  problem.channels = {{"y", 0.02}};
  problem.duration = 4.0;
  problem.step = 0.1;
  return problem;
}

double promised_error(const PlanProblem& problem, int draws) {
  PlanOptions options;
  options.candidates = 1;
  options.searches = 1;
  options.evaluations = 1;
  options.draws = draws;
  const Plan plan = plan_experiment(problem, options);
  return plan.parameters.at(0).after.value_or(NAN);
}

TEST(ParameterPromise, IsTheSpreadOfFits) {
  constexpr double kKnown = 1e4;  // so that draws do not differ
  const double promised = promised_error(free_decay(kKnown), 8);
  constexpr int kDraws = 60;
  double squares = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Dataset data = model_view(
        decay(1.0).model(), record(0.7, 0.02, 100 + std::uint64_t(draw)), FiniteDifferences{});
    const Fit found = fit(decay(0.7), data, {}, {.restarts = 0});
    squares += std::pow(found.model.parameters().at(0).value - 0.7, 2);
  }
  // The record is added to what is known; the deviation of 60 draws is known to 9 %, 25 % are
  // nearly three times that.
  const double together = 1.0 / std::sqrt(kKnown + kDraws / squares);
  EXPECT_NEAR(together / promised, 1.0, 0.25);
}

/// d/dk of exp(-k t) at the 41 samples, over the noise.
double information_at(double k) {
  double sum = 0.0;
  for (int i = 0; i <= 40; ++i) sum += std::pow(0.1 * i * std::exp(-k * 0.1 * i) / 0.02, 2);
  return sum;
}

TEST(ParameterPromise, IsAMeanOverWhatIsPossible) {
  // A rate known to 0.2: a fast decay shows less of its rate than a slow one.
  constexpr double kKnown = 25.0;
  const double promised = promised_error(free_decay(kKnown), 4000);
  double sum = 0.0, weights = 0.0;
  for (double z = -4.0; z <= 4.0; z += 0.01) {
    // What is taken where nothing is known, half of 0.7, adds its part.
    const double k = 0.7 + z / std::sqrt(kKnown + 1.0 / (0.35 * 0.35));
    const double weight = std::exp(-0.5 * z * z);
    sum += weight / (kKnown + information_at(k));
    weights += weight;
  }
  const double expected = std::sqrt(sum / weights);
  EXPECT_NEAR(promised, expected, 0.02 * expected);
  EXPECT_GT(expected, 1.04 / std::sqrt(kKnown + information_at(0.7))) << "more than there";
}

}  // namespace
}  // namespace lacuna
