// SPDX-License-Identifier: MIT
// What identify() does past its time limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/solvers/ols.hpp"
#include "lacuna/trajectories/refiners/no_refiner.hpp"
#include "unit/identify/pipeline/records.hpp"

namespace lacuna {
namespace {

using testing::expect_same_model;
using testing::past_the_deadline;
using testing::random_points;

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
Dataset lorenz_points() {
  return random_points(test_system("lorenz").model, 400, 20.0, 3);
}

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

}  // namespace
}  // namespace lacuna
