// SPDX-License-Identifier: MIT
// Equations with terms and constraints of their own, and in little time.
#include "identify/pipeline/equation_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "bases/monomials.hpp"
#include "core/base/random.hpp"
#include "identify/pipeline/equation_terms.hpp"
#include "identify/pipeline/given_rates.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "solvers/ols.hpp"
#include "trajectories/refiners/no_refiner.hpp"
#include "unit/identify/pipeline/records.hpp"

namespace lacuna {
namespace {

using testing::expect_same_model;
using testing::past_the_deadline;
using testing::random_points;

/// Random samples with random derivatives of so many states.
Dataset random_record(Index samples, Index states) {
  Random random(4);
  Dataset data;
  Trajectory record;
  record.source = "random";
  record.time = Vector::LinSpaced(samples, 0.0, 1.0);
  record.states.resize(samples, states);
  record.derivatives.resize(samples, states);
  record.inputs.resize(samples, 0);
  for (Index k = 0; k < states; ++k) {
    data.states.push_back({"x" + std::to_string(k), ""});
    for (Index i = 0; i < samples; ++i) record.states(i, k) = random.normal();
    for (Index i = 0; i < samples; ++i) record.derivatives(i, k) = random.normal();
  }
  data.trajectories.push_back(std::move(record));
  return data;
}

EquationProblem problem_of(const Dataset& data, const Pipeline& pipeline,
                           const RunContext& context) {
  return equation_problem(
      data, pipeline,
      equation_libraries(pipeline.basis->library(variables_of(data)), data, pipeline), context);
}

TEST(EquationProblem, PastTheDeadlineALargeLibraryLosesItsHighestDegrees) {
  // 1.01e9 products of 286 candidates and 10 targets; those up to degree 2 are 66.
  const Dataset data = random_record(11500, 10);
  const EquationProblem problem = problem_of(data, algorithm1(), past_the_deadline());
  EXPECT_EQ(problem.system.terms(), 66);
  EXPECT_EQ(problem.libraries.library.size(), 66);
  EXPECT_EQ(problem.left_out, 220);
  EXPECT_FALSE(problem.is_filtered);
  EXPECT_EQ(problem.filtered.kept.size(), 66U);
}

TEST(EquationProblem, WhatCannotBeReadInTimeIsNotBegun) {
  RunContext context;  // ends long before 1e12 products, and long after 1e9
  context.deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  Pipeline pipeline = algorithm1();
  pipeline.basis = Monomials{{.max_degree = 4}};
  const EquationProblem problem = problem_of(random_record(40000, 15), pipeline, context);
  EXPECT_EQ(problem.system.terms(), 136);
  EXPECT_EQ(problem.left_out, 3876 - 136);
  EXPECT_TRUE(problem.is_filtered);
}

TEST(EquationProblem, PastTheDeadlineTooFewSamplesAreAnError) {
  EXPECT_THROW(problem_of(random_record(19, 3), algorithm1(), past_the_deadline()), DataError);
  EXPECT_THROW(problem_of(random_record(11500, 40), algorithm1(), past_the_deadline()), DataError);
}

/// A circle: x' = -y, y' = x.
Dataset circle() {
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}};
  Trajectory& record = data.trajectories.emplace_back();
  record.time = Vector::LinSpaced(400, 0.0, 10.0);
  record.states.resize(400, 2);
  record.states << record.time.array().cos(), record.time.array().sin();
  record.inputs.resize(400, 0);
  return data;
}

TermLibrary linear_library() {
  return Stage<Basis>(Monomials{{.max_degree = 1}})->library({{"x", "y"}, {}});
}

EquationLibraries libraries(std::vector<EquationTerms> equations) {
  Pipeline pipeline = algorithm1();
  pipeline.equations = std::move(equations);
  return equation_libraries(linear_library(), circle(), pipeline);
}

TEST(EquationTerms, WidenTheLibraryAndKeepToTheirEquation) {
  const EquationLibraries found = libraries({{"dx", {"sin(y)", "y"}}});
  EXPECT_EQ(found.library.names(), (std::vector<std::string>{"1", "x", "y", "sin(y)"}));
  EXPECT_EQ(found.allowed[0], (TermSet{2, 3}));
  EXPECT_EQ(found.allowed[1], (TermSet{0, 1, 2}));
  EXPECT_EQ(found.own, (std::vector<bool>{true, false}));
}

TEST(EquationTerms, ErrorsNameTheEquation) {
  EXPECT_THROW(libraries({{"z", {"x"}}}), ConfigError);
  EXPECT_THROW(libraries({{"x", {}}}), ConfigError);
  EXPECT_THROW(libraries({{"x", {"y"}}, {"dx/dt", {"x"}}}), ConfigError);
  EXPECT_THROW(libraries({{"x", {"q"}}}), ModelError);
}

TEST(EquationTerms, OnlyTheyStandInTheModel) {
  for (const char* name : {"algorithm1", "robust", "sindy"}) {
    Pipeline pipeline = preset(name);
    pipeline.equations = {{"x", {"y", "y^3"}}, {"y", {"x", "x^2"}}};
    const IdentificationResult result = identify(circle(), pipeline);
    ASSERT_EQ(result.model.equations()[0].size(), 1U) << name;
    EXPECT_NEAR(result.model.coefficient(0, "y"), -1.0, 1e-3) << name;
    ASSERT_EQ(result.model.equations()[1].size(), 1U) << name;
    EXPECT_NEAR(result.model.coefficient(1, "x"), 1.0, 1e-3) << name;
    for (const TrailEntry& entry : result.trail)
      if (entry.equation == "x" && entry.term == "x") {
        EXPECT_EQ(entry.stage, "library") << name;
      }
  }
}

TEST(EquationTerms, ABoundAdmitsWhatItsInequalityDoes) {
  for (const auto relation : {ConstraintRelation::AtMost, ConstraintRelation::AtLeast}) {
    Pipeline pipeline = algorithm1();
    pipeline.constraints = {{{{"x", "x", 2.0}, {"x", "y", 3.0}}, 5.0, relation}};
    const auto bounds = equation_libraries(linear_library(), circle(), pipeline).bounds;
    ASSERT_EQ(bounds.size(), 1U);
    ASSERT_EQ(bounds[0].summands.size(), 2U);
    for (const double a : {-2.0, 0.0, 4.0})
      for (const double b : {-1.5, 0.5, 2.0}) {
        const bool admitted =
            bounds[0].summands[0].factor * a + bounds[0].summands[1].factor * b <=
            bounds[0].value;
        const double sum = 2.0 * a + 3.0 * b;
        EXPECT_EQ(admitted, relation == ConstraintRelation::AtMost ? sum <= 5.0 : sum >= 5.0);
      }
  }
}

/// x = cos t with dx/dt = -sin t, both with noise.
Dataset turning(double state_noise, double rate_noise) {
  constexpr Index kSamples = 4000;
  Random random(7);
  Trajectory run{"run", Vector::LinSpaced(kSamples, 0.0, 40.0), Matrix(kSamples, 1),
                 Matrix(kSamples, 0), Matrix(kSamples, 1)};
  for (Index n = 0; n < kSamples; ++n) {
    run.states(n, 0) = std::cos(run.time[n]) + state_noise * random.normal();
    run.derivatives(n, 0) = -std::sin(run.time[n]) + rate_noise * random.normal();
  }
  return {"s", {{"x", ""}}, {}, {run}, {}, {}};
}

TEST(GivenRates, LeaveTheirNoiseAndThatOfTheStatesThroughTheRates) {
  const OdeModel model = parse_ode("dx/dt = -2*x + x^2", "model");
  const Vector exact = noise_of_given_rates(model, turning(0.0, 0.0), Vector::Zero(1));
  EXPECT_NEAR(exact[0], kRoundingOfRates * std::sqrt(0.5), 0.05 * kRoundingOfRates);
  const Vector own = noise_of_given_rates(model, turning(0.0, 0.03), Vector::Zero(1));
  EXPECT_NEAR(own[0], 0.03, 0.003);
  // (2 x - 2)^2 is 6 on average over turns.
  const Vector both = noise_of_given_rates(model, turning(0.01, 0.03), Vector{{0.01}});
  EXPECT_NEAR(both[0], std::hypot(0.03, 0.01 * std::sqrt(6.0)), 0.004);
}

TEST(GivenRates, DecideOnlyFarAboveTheirNoiseAndAtRounding) {
  const OdeModel model = parse_ode("dx/dt = -2*x + x^2", "model");
  const Dataset data = turning(0.0, 0.03);
  std::vector<EquationFit> fits(1);
  const auto has_floor = [&](double residual) {
    fits[0] = {.equation = "x", .residual_rms = residual};
    note_floors_of_given_rates(model, data, Vector::Zero(1), fits);
    return fits[0].noise_floor.has_value();
  };
  EXPECT_TRUE(has_floor(0.1));
  EXPECT_FALSE(has_floor(0.03));
  EXPECT_TRUE(has_floor(1e-10));
}

// What identify() does past its time limit.
/// Least squares that something looks at before each fit.
class Watched final : public Regressor {
 public:
  using Watch = std::function<void(const Subproblem&, const RunContext&)>;

  explicit Watched(Watch watch) : watch_(std::move(watch)) {}
  const StageInfo& info() const override {
    static constexpr StageInfo kInfo{"watched", "", ""};
    return kInfo;
  }
  void visit_options(OptionVisitor&) const override {}

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override {
    watch_(problem, context);
    return Ols{}.fit(system, problem, effort, context);
  }

  Watch watch_;
};

Stage<Regressor> watched(Watched::Watch watch) {
  return Stage<Regressor>(std::make_shared<Watched>(std::move(watch)));
}

bool is_left_out(const IdentificationResult& result, const std::string& name) {
  return std::any_of(result.stages.begin(), result.stages.end(), [&](const StageDone& stage) {
    return stage.name == name && !stage.done && stage.why == kTimeIsUp;
  });
}

/// Exact derivatives of Lorenz' system at random points, and a library of so high a degree.
Dataset lorenz_points() { return random_points(test_system("lorenz").model, 400, 20.0, 3); }

Pipeline wide(Stage<Regressor> regressor) {
  Pipeline pipeline = algorithm1();
  pipeline.basis = Monomials{{.max_degree = 5}};
  pipeline.regressor = std::move(regressor);
  pipeline.refiner = NoRefiner{};
  return pipeline;
}

TEST(HurriedEquations, ComeFromTheTermsThatExplainMost) {
  Index most = 0;  // terms of a fit
  const auto count = [&](const Subproblem& problem, const RunContext&) {
    most = std::max(most, problem.size());
  };
  const IdentificationResult result =
      identify(lorenz_points(), wide(watched(count)), past_the_deadline());
  expect_same_model(result.model, test_system("lorenz").model, 1e-6);
  EXPECT_LE(most, 32);  // of 56 candidates
  EXPECT_GT(most, 0);
  EXPECT_EQ(result.trail.size(), 3U * 56U);
  EXPECT_TRUE(is_left_out(result, kFilterStage));
  EXPECT_TRUE(is_left_out(result, kEliminationStage));
}

TEST(HurriedEquations, ComeByACheaperRuleWhereTheirOwnTakesTooLong) {
  const auto is_never_ready = [](const Subproblem&, const RunContext& context) {
    if (context.deadline) throw OutOfTime();
  };
  const IdentificationResult result =
      identify(lorenz_points(), wide(watched(is_never_ready)), past_the_deadline());
  expect_same_model(result.model, test_system("lorenz").model, 1e-6);
  EXPECT_TRUE(is_left_out(result, kEliminationStage));
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_NE(result.warnings.back().find("every equation"), std::string::npos)
      << result.warnings.back();
}

TEST(HurriedEquations, AreTheirOwnWhereTheCandidatesAreFew) {
  Pipeline pipeline = algorithm1();
  pipeline.refiner = NoRefiner{};
  const IdentificationResult result = identify(lorenz_points(), pipeline, past_the_deadline());
  expect_same_model(result.model, identify(lorenz_points(), pipeline).model, 1e-12);
  EXPECT_FALSE(is_left_out(result, kEliminationStage));
}

TEST(HurriedEquations, AStopRequestEndsThem) {
  std::stop_source source;
  source.request_stop();
  RunContext context = past_the_deadline();
  context.stop = source.get_token();
  EXPECT_THROW(identify(lorenz_points(), algorithm1(), context), Cancelled);
}

TEST(HurriedEquations, AllThreadsGiveTheSame) {
  RunContext context = past_the_deadline();
  context.threads = 3;
  expect_same_model(identify(lorenz_points(), wide(Ols{}), context).model,
                    identify(lorenz_points(), wide(Ols{}), past_the_deadline()).model, 0.0);
}

Dataset lorenz_record(double noise) {
  const TestSystem& lorenz = test_system("lorenz");
  const Dataset clean = testing::without_derivatives(
      record_of(lorenz.model, Dopri87{}, lorenz.start, 0.01, 2000));
  return noise > 0.0 ? add_relative_noise(clean, noise, 5) : clean;
}

Pipeline quadratic(const std::string& name) {
  Pipeline pipeline = preset(name);
  pipeline.basis = Monomials{{.max_degree = 2}};
  return pipeline;
}

TEST(ConstrainedEquations, KeepTheEnergyOfTheQuadraticPart) {
  for (const char* name : {"algorithm1", "robust", "sindy"}) {
    Pipeline pipeline = quadratic(name);
    pipeline.energy_preserving = true;
    const OdeModel model =
        identify(lorenz_record(name == std::string("sindy") ? 0.0 : 0.01), pipeline).model;
    EXPECT_NEAR(model.coefficient(1, "x*z"), -1.0, 0.02) << name;
    EXPECT_NEAR(
        model.coefficient(0, "y*z") + model.coefficient(1, "x*z") + model.coefficient(2, "x*y"),
        0.0, 1e-12)
        << name;
    EXPECT_NEAR(model.coefficient(0, "x^2"), 0.0, 1e-12) << name;
  }
}

TEST(ConstrainedEquations, ASharedParameterIsOneNumberWithOneInterval) {
  Pipeline pipeline = quadratic("algorithm1");
  pipeline.constraints = {{{{"x", "y", 1.0}, {"x", "x", 1.0}}, 0.0}};  // sigma (y - x)
  const OdeModel model = identify(lorenz_record(0.01), pipeline).model;
  const Equation& first = model.equations()[0];
  ASSERT_EQ(first.size(), 2U);
  EXPECT_NEAR(first[0].coefficient + first[1].coefficient, 0.0, 1e-11);
  EXPECT_NEAR(std::abs(first[0].coefficient), 10.0, 0.1);
  ASSERT_TRUE(first[0].standard_error && first[1].standard_error);
  EXPECT_NEAR(*first[0].standard_error, *first[1].standard_error, 1e-9);
}

TEST(ConstrainedEquations, AFixedCoefficientStays) {
  for (const char* name : {"algorithm1", "robust", "sindy"}) {
    Pipeline pipeline = quadratic(name);
    pipeline.constraints = {{{{"dy", "y"}}, -1.0}, {{{"dz/dt", "x*y"}}, 1.0}};
    const OdeModel model =
        identify(lorenz_record(name == std::string("sindy") ? 0.0 : 0.01), pipeline).model;
    EXPECT_NEAR(model.coefficient(1, "y"), -1.0, 1e-12) << name;
    EXPECT_NEAR(model.coefficient(2, "x*y"), 1.0, 1e-12) << name;
    EXPECT_NEAR(model.coefficient(1, "x"), 28.0, 0.2) << name;
    for (const WeightedTerm& summand : model.equations()[1])
      EXPECT_TRUE(summand.term.name() != "y" || !summand.ci95) << name;
  }
}

TEST(ConstrainedEquations, ABoundThatHoldsChangesNothing) {
  Pipeline pipeline = quadratic("algorithm1");
  const OdeModel free = identify(lorenz_record(0.01), pipeline).model;
  pipeline.constraints = {{{{"x", "x"}}, 0.0, ConstraintRelation::AtMost},
                          {{{"y", "x"}}, 20.0, ConstraintRelation::AtLeast}};
  const OdeModel bounded = identify(lorenz_record(0.01), pipeline).model;
  for (const char* term : {"x", "y", "x*z"})
    EXPECT_NEAR(bounded.coefficient(1, term), free.coefficient(1, term), 1e-4) << term;
}

TEST(ConstrainedEquations, ACoefficientStopsAtItsBound) {
  for (const char* name : {"algorithm1", "sindy"}) {
    Pipeline pipeline = quadratic(name);
    pipeline.constraints = {{{{"x", "y"}}, 9.0, ConstraintRelation::AtMost},
                            {{{"z", "z"}, {"y", "y"}}, -3.0, ConstraintRelation::AtLeast}};
    const OdeModel model = identify(lorenz_record(0.0), pipeline).model;
    EXPECT_NEAR(model.coefficient(0, "y"), 9.0, 1e-9) << name;  // 10 without
    EXPECT_NEAR(model.coefficient(2, "z") + model.coefficient(1, "y"), -3.0, 1e-9) << name;
  }
}

TEST(ConstrainedEquations, ATermOfTheWrongSignLeaves) {
  Pipeline pipeline = quadratic("algorithm1");
  pipeline.constraints = {{{{"x", "x"}}, 0.0, ConstraintRelation::AtLeast}};  // it is -10
  const IdentificationResult found = identify(lorenz_record(0.01), pipeline);
  EXPECT_EQ(found.model.coefficient(0, "x"), 0.0);
  EXPECT_FALSE(found.model.equations()[0].empty());
  for (const TrailEntry& entry : found.trail)
    EXPECT_FALSE(entry.kept && entry.equation == "x" && entry.term == "x");
}

TEST(ConstrainedEquations, WhatCannotBeIsOneError) {
  Pipeline pipeline = quadratic("algorithm1");
  pipeline.constraints = {{{{"x", "y"}}, 1.0}, {{{"x", "y"}}, 2.0}};
  EXPECT_THROW(identify(lorenz_record(0.0), pipeline), ConfigError);
  pipeline.constraints = {{{{"x", "y"}}, 1.0, ConstraintRelation::AtMost},
                          {{{"x", "y"}}, 2.0, ConstraintRelation::AtLeast}};
  EXPECT_THROW(identify(lorenz_record(0.0), pipeline), ConfigError);
  pipeline.constraints = {{{{"q", "y"}}, 1.0}};
  EXPECT_THROW(identify(lorenz_record(0.0), pipeline), ConfigError);
}

}  // namespace
}  // namespace lacuna
