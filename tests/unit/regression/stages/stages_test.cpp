// SPDX-License-Identifier: MIT
// What the stages check of what is asked of them and of what is answered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "lacuna/regression/stages/refiner.hpp"
#include "lacuna/regression/stages/solvers.hpp"
#include "support/one_record.hpp"
#include "systems.hpp"

namespace lacuna {
namespace {

struct ListedOptions {
  static constexpr StageInfo kInfo{"listed", "", ""};
  std::vector<std::string> terms = {};
  void describe(OptionVisitor& v) { v.field({"terms", "", ""}, terms); }
};

class Listed final : public Configured<Basis, ListedOptions> {
 public:
  using Configured::Configured;

 private:
  std::vector<Term> do_terms(const Variables& variables) const override {
    std::vector<Term> terms;
    for (const std::string& text : options().terms)
      terms.push_back(Term::parse(text, variables));
    return terms;
  }
};

const Variables kVariables{{"x", "y"}, {}};

TEST(Basis, TermsAreDistinctAndInOrder) {
  const Listed basis{{.terms = {"y", "x*y", "y*x", "y"}}};
  const TermLibrary library = basis.library(kVariables);
  EXPECT_THAT(library.names(), testing::ElementsAre("y", "x*y"));
  EXPECT_EQ(library.variables, kVariables);
}

TEST(Basis, NoTermsAreAnError) {
  try {
    Listed{}.library(kVariables);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.where(), "basis.listed");
  }
}

struct EchoOptions {
  static constexpr StageInfo kInfo{"echo", "", ""};
  int surplus = 0;  ///< coefficients too many
  void describe(OptionVisitor& v) { v.field({"surplus", "", ""}, surplus); }
};

class Echo final : public Configured<L1Solver, EchoOptions> {
 public:
  using Configured::Configured;

 private:
  L1Solution do_solve(const L1Problem& problem, const RunContext&) const override {
    return {Vector::Ones(problem.target.size() + options().surplus), 3, true};
  }
};

L1Problem problem_of(Index size) {
  return {Matrix::Identity(size, size), Vector::Ones(size), Vector::Ones(size),
          Vector::Zero(size)};
}

TEST(L1Solver, EmptyProblemIsSolved) {
  const L1Solution solution = Echo{}.solve(problem_of(0));
  EXPECT_EQ(solution.coefficients.size(), 0);
  EXPECT_TRUE(solution.converged);
}

TEST(L1Solver, ShapesAndNumbersAreChecked) {
  L1Problem problem = problem_of(3);
  problem.start.resize(2);
  EXPECT_THROW(Echo{}.solve(problem), ArgumentError);
  problem = problem_of(3);
  problem.penalty[1] = -1.0;
  EXPECT_THROW(Echo{}.solve(problem), ArgumentError);
  problem = problem_of(3);
  problem.target[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Echo{}.solve(problem), ArgumentError);
}

TEST(L1Solver, SolutionMustFitTheProblem) {
  EXPECT_THROW(Echo{{.surplus = 1}}.solve(problem_of(3)), ArgumentError);
}

struct ShiftOptions {
  static constexpr StageInfo kInfo{"echo", "Hands the model back", ""};
  void describe(OptionVisitor&) {}
};

class Shift final : public Configured<Refiner, ShiftOptions> {
 private:
  RefinedModel do_refine(const RefinerTask& task, const RunContext&) const override {
    return {.model = task.start};
  }
};

Dataset line() {
  Trajectory record;
  record.time = Vector::LinSpaced(5, 0.0, 4.0);
  record.states = record.time;
  return support::one_record({{"x", "m"}}, {}, record);
}

TEST(Refiner, RefusesModelsOfOtherStatesAndUnusableData) {
  const Dataset data = line();
  const OdeModel other({{"y", "m"}}, {}, {{}});
  EXPECT_THROW(Shift{}.refine({data, {{{"x"}, {}}, {}}, other}), ArgumentError);
  const OdeModel model(data.states, {}, {{}});
  EXPECT_THROW(Shift{}.refine({Dataset{}, {{{"x"}, {}}, {}}, model}), DataError);
}

TEST(Refiner, HonoursAStopRequest) {
  const Dataset data = line();
  const OdeModel model(data.states, {}, {{}});
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  EXPECT_THROW(Shift{}.refine({data, {{{"x"}, {}}, {}}, model}, context), Cancelled);
}

struct DirectOptions {
  static constexpr StageInfo kInfo{"direct", "", ""};
  bool forget_a_term = false;
  void describe(OptionVisitor& v) { v.field({"forget_a_term", "", ""}, forget_a_term); }
};

class Direct final : public Configured<Regressor, DirectOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem&, const Subproblem& problem, Effort,
                    const RunContext&) const override {
    Regression result{problem.active(), problem.solve(), problem.residual_norm()};
    if (options().forget_a_term) result.active.pop_back();
    return result;
  }
};

TEST(Regressor, EmptySetLeavesTheTarget) {
  const LeastSquaresSystem system = small_system();
  const Regression result = Direct{}.fit(system, system.subproblem(1, {}));
  EXPECT_TRUE(result.active.empty());
  EXPECT_EQ(result.coefficients.size(), 0);
  EXPECT_TRUE(result.converged);
  EXPECT_DOUBLE_EQ(result.residual_norm, system.factor().target_norms[1]);
}

TEST(Regressor, SubproblemMustComeFromTheSystem) {
  const LeastSquaresSystem system = small_system();
  const LeastSquaresSystem other(make_row_source(Matrix::Random(9, 3), Matrix::Random(9, 2)),
                                 {"a", "b", "c"}, {"p", "q"});
  EXPECT_THROW(Direct{}.fit(other, system.subproblem(0, {0, 2})), ArgumentError);
}

TEST(Regressor, ResultMustBeComplete) {
  const LeastSquaresSystem system = small_system();
  const Direct broken{{.forget_a_term = true}};
  EXPECT_THROW(broken.fit(system, system.subproblem(0, {0, 2})), ArgumentError);
}

struct AnswerOptions {
  static constexpr StageInfo kInfo{"answer", "", ""};
  std::function<FilterResult()> answer = {};
  void describe(OptionVisitor&) {}
};

class Answer final : public Configured<TermFilter, AnswerOptions> {
 public:
  using Configured::Configured;

 private:
  FilterResult do_filter(const LeastSquaresSystem&, const RunContext&) const override {
    return options().answer();
  }
};

FilterResult filtered(FilterResult answer) {
  return Answer{{.answer = [&] { return answer; }}}.filter(small_system());
}

TEST(TermFilter, ColumnsOfZerosAreRemovedWhateverTheMethod) {
  const FilterResult result = filtered({{0, 1, 2}, {}});
  EXPECT_EQ(result.kept, (TermSet{0, 2}));
  ASSERT_EQ(result.removed.size(), 1u);
  EXPECT_EQ(result.removed[0].term, 1);
  EXPECT_EQ(result.removed[0].value, 0.0);
}

TEST(TermFilter, EveryTermMustBeAccountedFor) {
  EXPECT_THROW(filtered({{0, 2}, {}}), ArgumentError);
  EXPECT_THROW(filtered({{0, 1, 2}, {{1, "why", 0.0, 0.0, 1}}}), ArgumentError);
  EXPECT_THROW(filtered({{2, 1, 0}, {}}), ArgumentError);
}

TEST(TermFilter, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  const Answer filter{{.answer = [] { return FilterResult{{0, 1, 2}, {}}; }}};
  EXPECT_THROW(filter.filter(small_system(), {.stop = source.get_token()}), Cancelled);
}

inline constexpr StageInfo kIdle{"idle", "", ""};

class Idle final : public Configured<Regressor, NoOptions<kIdle>> {
  Regression do_fit(const LeastSquaresSystem&, const Subproblem& problem, Effort,
                    const RunContext&) const override {
    return {problem.active(), problem.solve(), problem.residual_norm()};
  }
};

struct KeepOptions {
  static constexpr StageInfo kInfo{"keep", "", ""};
  int lost = 0;  ///< terms that vanish without a reason
  void describe(OptionVisitor& v) { v.field({"lost", "", ""}, lost); }
};

class Keep final : public Configured<TermPruner, KeepOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem&, Index, const TermSet& active,
                       const Regressor&, const RunContext&) const override {
    return {TermSet(active.begin() + options().lost, active.end()), {}};
  }
};

TEST(TermPruner, NothingToChooseFromIsNotAskedFor) {
  EXPECT_TRUE(Keep{{.lost = 1}}.prune(small_system(), 0, {}, Idle{}).kept.empty());
}

TEST(TermPruner, ArgumentsMustFitTheSystem) {
  EXPECT_THROW(Keep{}.prune(small_system(), 2, {0}, Idle{}), ArgumentError);
  EXPECT_THROW(Keep{}.prune(small_system(), 0, {0, 3}, Idle{}), ArgumentError);
  EXPECT_THROW(Keep{}.prune(small_system(), 0, {2, 0}, Idle{}), ArgumentError);
}

TEST(TermPruner, EveryTermMustBeAccountedFor) {
  EXPECT_THROW(Keep{{.lost = 1}}.prune(small_system(), 0, {0, 2}, Idle{}), ArgumentError);
}

/// h(0,1) + 2 h(1,3) = 0 and h(2,0) = 5.
std::vector<CoefficientConstraint> example() {
  return {{{{0, 1, 1.0}, {1, 3, 2.0}}, 0.0}, {{{2, 0, 1.0}}, 5.0}};
}

TEST(CoefficientConstraint, AbsentCoefficientsAreNothing) {
  const ConstraintMatrix found = constraint_matrix(example(), {{1, 3}, {1, 4}, {2, 0}});
  Matrix expected(2, 3);
  expected << 2.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  EXPECT_EQ(found.a, expected);
  EXPECT_EQ(found.b, (Vector{{0.0, 5.0}}));
}

TEST(CoefficientConstraint, NamesEachCoefficientOnce) {
  EXPECT_EQ(constrained_coefficients(example()), (CoefficientPlaces{{0, 1}, {1, 3}, {2, 0}}));
}

TEST(CoefficientConstraint, AsksForThePartnersOfWhatIsAlone) {
  // h(2,0) = 5 is needed in any case; h(0,1) alone would have to be 0.
  EXPECT_EQ(closure(example(), {}), (CoefficientPlaces{{2, 0}}));
  EXPECT_EQ(closure(example(), {{0, 1}}), (CoefficientPlaces{{0, 1}, {1, 3}, {2, 0}}));
  const std::vector<CoefficientConstraint> three{{{{0, 0}, {1, 0}, {2, 0}}, 0.0}};
  EXPECT_EQ(closure(three, {{0, 0}, {2, 0}}), (CoefficientPlaces{{0, 0}, {2, 0}}));
}

}  // namespace
}  // namespace lacuna
