// SPDX-License-Identifier: MIT
// What identify() does past its time limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

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

/// Least squares that notes how many fits there were, and of how many terms at most.
class Counting final : public Regressor {
 public:
  struct Counts {
    int fits = 0;
    Index most = 0;
  };

  explicit Counting(std::shared_ptr<Counts> counts) : counts_(std::move(counts)) {}
  const StageInfo& info() const override {
    static constexpr StageInfo kInfo{"counting", "", ""};
    return kInfo;
  }
  void visit_options(OptionVisitor&) const override {}

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override {
    ++counts_->fits;
    counts_->most = std::max(counts_->most, problem.size());
    return Ols{}.fit(system, problem, effort, context);
  }

  std::shared_ptr<Counts> counts_;
};

/// A regressor that is never ready before a deadline.
class Endless final : public Regressor {
 public:
  const StageInfo& info() const override {
    static constexpr StageInfo kInfo{"endless", "", ""};
    return kInfo;
  }
  void visit_options(OptionVisitor&) const override {}

 private:
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort effort,
                    const RunContext& context) const override {
    if (context.deadline) throw OutOfTime();
    return Ols{}.fit(system, problem, effort, context);
  }
};

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
  const auto counts = std::make_shared<Counting::Counts>();
  const IdentificationResult result =
      identify(lorenz_points(), wide(Stage<Regressor>(std::make_shared<Counting>(counts))),
               past_the_deadline());
  expect_same_model(result.model, test_system("lorenz").model, 1e-6);
  EXPECT_LE(counts->most, 32);  // of 56 candidates
  EXPECT_GT(counts->fits, 0);
  EXPECT_EQ(result.trail.size(), 3U * 56U);
  EXPECT_TRUE(is_left_out(result, kFilterStage));
  EXPECT_TRUE(is_left_out(result, kEliminationStage));
}

TEST(HurriedEquations, ComeByACheaperRuleWhereTheirOwnTakesTooLong) {
  const Stage<Regressor> endless(std::make_shared<Endless>());
  const IdentificationResult result =
      identify(lorenz_points(), wide(endless), past_the_deadline());
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
