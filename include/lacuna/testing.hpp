// SPDX-License-Identifier: MIT
// What every basis, differentiator, filter, regressor and pruner owes, as suites of GoogleTest
// that also parts of one's own can be put through:
//
//   #include <lacuna/testing.hpp>
//   namespace lacuna::contract {
//   INSTANTIATE_TEST_SUITE_P(Mine, RegressorContract,
//                            ::testing::Values(Stage<Regressor>(Ridge{})),
//                            name_of_stage<Regressor>);
//   }
//
// and, linked with GTest::gtest_main, the shapes, determinism, threads, units and cancelling of
// `Ridge` are tested. A suite that nobody instantiates is silent.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <ostream>
#include <random>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "lacuna/regression/stages/solvers.hpp"
#include "lacuna/solvers/least_squares.hpp"

namespace lacuna {

/// A stage in the output of a test: its name.
template <class Interface>
void PrintTo(const Stage<Interface>& stage, std::ostream* out) {
  *out << stage->info().name;
}

}  // namespace lacuna

namespace lacuna::contract {

/// "irls_l1_2" of the third stage, named irls-l1.
template <class Interface>
std::string name_of_stage(const ::testing::TestParamInfo<Stage<Interface>>& info) {
  std::string name(info.param->info().name);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name + "_" + std::to_string(info.index);
}

/// Standard normal numbers, the same with every compiler: Box and Muller's.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : engine_(seed) {}  ///< numbers follow from the seed
  double operator()() {                                   ///< the next number
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  /// The next number between 0 and 1, ends excluded.
  double uniform() { return (static_cast<double>(engine_() >> 11U) + 0.5) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

inline constexpr Index kRows = 400;
inline constexpr Index kTerms = 6;

/// Coefficients of the small good problem: terms 1 and 4 count.
inline Vector true_coefficients() {
  Vector h = Vector::Zero(kTerms);
  h[1] = 2.0;
  h[4] = -0.75;
  return h;
}

/// n x 6 standard normal entries.
inline Matrix good_columns() {
  Normal normal(7);
  Matrix theta(kRows, kTerms);
  for (double& entry : theta.reshaped()) entry = normal();
  return theta;
}

/// A system over the given columns with the target Theta h plus noise.
inline LeastSquaresSystem system_over(const Matrix& theta, double noise = 0.0,
                                      int threads = 1) {
  Normal normal(11);
  Matrix target = theta.leftCols(kTerms) * true_coefficients();
  for (double& entry : target.reshaped()) entry += noise * normal();
  std::vector<std::string> names;
  for (Index j = 0; j < theta.cols(); ++j) names.push_back("c" + std::to_string(j));
  RunContext context;
  context.threads = threads;
  return {make_row_source(theta, target), names, {"y"}, context};
}

/// Well-conditioned and without noise.
inline LeastSquaresSystem good_system() { return system_over(good_columns()); }

/// A context in which everything is asked to end.
inline RunContext stopped() {
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  return context;
}

/// Whether kept and removed are disjoint and together `all`, each removal with its reason.
template <class Result>
void expect_partition(const Result& result, const TermSet& all) {
  TermSet together = result.kept;
  EXPECT_TRUE(std::is_sorted(together.begin(), together.end()));
  for (const Removal& removal : result.removed) {
    together.push_back(removal.term);
    EXPECT_FALSE(removal.quantity.empty());
    EXPECT_GE(removal.step, 1);
  }
  std::sort(together.begin(), together.end());
  EXPECT_EQ(together, all);
}

/// Whether a term is one of those.
inline bool contains(const TermSet& terms, Index term) {
  return std::find(terms.begin(), terms.end(), term) != terms.end();
}

/// What a basis owes.
class BasisContract : public ::testing::TestWithParam<Stage<Basis>> {
 protected:
  /// The library; nothing for a basis that has no terms before it is given them and says so.
  std::optional<TermLibrary> library_of(const Variables& variables) const {
    try {
      return GetParam()->library(variables);
    } catch (const ConfigError& error) {
      EXPECT_FALSE(error.remedy().empty()) << error.what();
      return std::nullopt;
    }
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(BasisContract);

TEST_P(BasisContract, MakesDistinctTermsThatCanBeReadBack) {
  const Variables variables{{"x", "y"}, {"u"}};
  const auto library = library_of(variables);
  if (!library) return;
  std::set<std::string> names;
  for (const Term& term : library->terms) {
    EXPECT_TRUE(names.insert(term.name()).second) << term.name() << " twice";
    EXPECT_EQ(Term::parse(term.name(), variables), term);
  }
  EXPECT_EQ(library->variables, variables);
  EXPECT_EQ(library->compile().outputs(), library->size());
}

TEST_P(BasisContract, ContainsNoTermTwiceHoweverManyVariables) {
  for (const Variables& variables :
       {Variables{{"x"}, {}}, Variables{{"x", "y", "z"}, {}}, Variables{{"x"}, {"u", "w"}}}) {
    const auto library = library_of(variables);
    if (!library) continue;
    const std::vector<std::string> names = library->names();
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  }
}

/// What a differentiator owes.
class DifferentiatorContract : public ::testing::TestWithParam<Stage<Differentiator>> {
 protected:
  Matrix differentiate(const Vector& time, const Matrix& values, int order = 1) const {
    return GetParam()->differentiate(time, values, order);
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(DifferentiatorContract);

/// 101 times from 0 to 2.
inline Vector uniform_grid() { return Vector::LinSpaced(101, 0.0, 2.0); }

/// As many, with steps between 0.5 and 1.5 times the mean.
inline Vector uneven_grid() {
  Normal random(3);
  Vector time(101);
  time[0] = 0.0;
  for (Index i = 1; i < time.size(); ++i)
    time[i] = time[i - 1] + 0.01 + 0.02 * random.uniform();
  return time;
}

TEST_P(DifferentiatorContract, IsExactForParabolas) {
  for (const Vector& time : {uniform_grid(), uneven_grid()}) {
    Matrix values(time.size(), 2);
    values << time.array().square().matrix(), (1.0 - 3.0 * time.array()).matrix();
    const Matrix first = differentiate(time, values);
    const Matrix second = differentiate(time, values, 2);
    EXPECT_LT((first.col(0) - 2.0 * time).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((first.col(1).array() + 3.0).abs().maxCoeff(), 1e-9);
    EXPECT_LT((second.col(0).array() - 2.0).abs().maxCoeff(), 1e-6);
    EXPECT_LT(second.col(1).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST_P(DifferentiatorContract, OrderZeroIsTheSignal) {
  const Vector time = uniform_grid();
  const Matrix values = time.array().square().matrix();
  EXPECT_LT((differentiate(time, values, 0) - values).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(DifferentiatorContract, FollowsASineAlsoOverAGap) {
  const Vector all = uniform_grid();
  const Matrix rate = differentiate(all, all.array().sin().matrix());
  EXPECT_LT((rate.array() - all.array().cos()).abs().maxCoeff(), 1e-3);
  Vector time(91);
  time << all.head(45), all.tail(46);
  const Matrix over = differentiate(time, time.array().sin().matrix());
  EXPECT_LT((over.array() - time.array().cos()).abs().maxCoeff(), 0.01);
}

TEST_P(DifferentiatorContract, RefusesTooFewSamplesAndShapesThatDoNotFit) {
  const Vector two = Vector::LinSpaced(2, 0.0, 1.0);
  EXPECT_THROW(differentiate(two, Matrix(two)), DataError);
  EXPECT_THROW(differentiate(uniform_grid(), Matrix::Zero(5, 1)), ArgumentError);
  EXPECT_THROW(differentiate(uniform_grid(), Matrix(uniform_grid()), -1), ArgumentError);
}

TEST_P(DifferentiatorContract, StandardErrorsAreOfTheShapeAndOfTheSizeOfTheErrors) {
  const Vector time = Vector::LinSpaced(300, 0.0, 6.0);
  Normal normal(9);
  Matrix values(300, 2);
  values << time.array().sin().matrix(), time.array().cos().matrix();
  for (double& value : values.reshaped()) value += 0.05 * normal();
  const auto errors = GetParam()->standard_error(time, values);
  if (!errors) return;
  ASSERT_EQ(errors->rows(), 300);
  ASSERT_EQ(errors->cols(), 2);
  EXPECT_GT(errors->minCoeff(), 0.0);
  const Vector off = differentiate(time, values).col(0) - time.array().cos().matrix();
  const double ratio = off.norm() / errors->col(0).norm();
  EXPECT_GT(ratio, 0.2);
  EXPECT_LT(ratio, 5.0);
}

/// What a filter owes.
class FilterContract : public ::testing::TestWithParam<Stage<TermFilter>> {
 protected:
  FilterResult filter(const LeastSquaresSystem& system) const {
    return GetParam()->filter(system);
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(FilterContract);

TEST_P(FilterContract, KeepsEveryTermOfAGoodProblem) {
  const LeastSquaresSystem system = good_system();
  const FilterResult result = filter(system);
  EXPECT_EQ(result.kept, system.all_terms());
  EXPECT_TRUE(result.removed.empty());
}

TEST_P(FilterContract, RemovesColumnsOfZeros) {
  Matrix theta = good_columns();
  theta.col(3).setZero();
  const LeastSquaresSystem system = system_over(theta);
  const FilterResult result = filter(system);
  expect_partition(result, system.all_terms());
  ASSERT_EQ(result.removed.size(), 1u);
  EXPECT_EQ(result.removed[0].term, 3);
}

TEST_P(FilterContract, PartitionsDependentTerms) {
  Matrix theta(kRows, kTerms + 1);
  theta << good_columns(), good_columns().col(0) + 2.0 * good_columns().col(1);
  const LeastSquaresSystem system = system_over(theta);
  const FilterResult result = filter(system);
  expect_partition(result, system.all_terms());
  EXPECT_LE(result.removed.size(), 1u);
}

TEST_P(FilterContract, ThreadsDoNotChangeTheResult) {
  EXPECT_EQ(filter(system_over(good_columns(), 0.1, 1)).kept,
            filter(system_over(good_columns(), 0.1, 2)).kept);
}

/// What a regressor owes.
class RegressorContract : public ::testing::TestWithParam<Stage<Regressor>> {
 protected:
  Regression fit(const LeastSquaresSystem& system, const TermSet& active,
                 const RunContext& context = {}) const {
    return GetParam()->fit(system, system.subproblem(0, active), Effort::Final, context);
  }
  static Vector scattered(const Regression& regression) {
    Vector h = Vector::Zero(kTerms);
    for (std::size_t i = 0; i < regression.active.size(); ++i)
      h[regression.active[i]] = regression.coefficients[static_cast<Index>(i)];
    return h;
  }
  /// An l1 penalty shrinks coefficients by its own size even without noise: 1e-6 by default.
  static constexpr double kShrinkage = 1e-4;
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RegressorContract);

TEST_P(RegressorContract, FindsTheExactCoefficientsOfTheTrueTerms) {
  const Regression regression = fit(good_system(), {1, 4});
  EXPECT_LT((scattered(regression) - true_coefficients()).cwiseAbs().maxCoeff(), kShrinkage);
}

TEST_P(RegressorContract, LeavesNothingToSuperfluousTerms) {
  const LeastSquaresSystem system = good_system();
  const Regression regression = fit(system, system.all_terms());
  EXPECT_LT((scattered(regression) - true_coefficients()).cwiseAbs().maxCoeff(), kShrinkage);
}

TEST_P(RegressorContract, ResidualIsThatOfTheCoefficients) {
  const LeastSquaresSystem system = system_over(good_columns(), 0.3);
  const Regression regression = fit(system, system.all_terms());
  EXPECT_TRUE(regression.converged);
  const Vector residuals = system.residuals(0, regression.active, regression.coefficients);
  EXPECT_NEAR(regression.residual_norm, residuals.norm(), 1e-8 * residuals.norm());
  EXPECT_NEAR(residuals.norm() / std::sqrt(static_cast<double>(kRows)), 0.3, 0.05);
}

TEST_P(RegressorContract, NoTermsLeaveTheTargetAsResidual) {
  const LeastSquaresSystem system = good_system();
  const Regression regression = fit(system, {});
  EXPECT_TRUE(regression.active.empty());
  EXPECT_DOUBLE_EQ(regression.residual_norm, system.factor().target_norms[0]);
}

TEST_P(RegressorContract, RemovedTermsAreAccountedFor) {
  const LeastSquaresSystem system = system_over(good_columns(), 0.1);
  const Regression regression = fit(system, system.all_terms());
  TermSet together = regression.active;
  for (const Removal& removal : regression.removed) together.push_back(removal.term);
  std::sort(together.begin(), together.end());
  EXPECT_EQ(together, system.all_terms());
}

TEST_P(RegressorContract, ThreadsDoNotChangeTheResult) {
  RunContext two;
  two.threads = 2;
  const LeastSquaresSystem one_thread = system_over(good_columns(), 0.1, 1);
  const LeastSquaresSystem two_threads = system_over(good_columns(), 0.1, 2);
  const Regression a = fit(one_thread, one_thread.all_terms());
  const Regression b = fit(two_threads, two_threads.all_terms(), two);
  EXPECT_EQ(a.active, b.active);
  EXPECT_EQ(a.coefficients, b.coefficients);
}

TEST_P(RegressorContract, UnitsOfTheColumnsDoNotMatter) {
  const Matrix theta = good_columns();
  const LeastSquaresSystem plain = system_over(theta, 0.1);
  const Regression before = fit(plain, {1, 4});
  Vector scale(kTerms);
  scale << 1e-6, 1e3, 1.0, 1e6, 1e-3, 1.0;
  Normal normal(11);
  Matrix target = theta * true_coefficients();
  for (double& entry : target.reshaped()) entry += 0.1 * normal();
  const LeastSquaresSystem scaled(make_row_source(theta * scale.asDiagonal(), target),
                                  plain.term_names(), {"y"});
  const Regression after = fit(scaled, {1, 4});
  ASSERT_EQ(after.active, before.active);
  EXPECT_NEAR(after.coefficients[0] * scale[1], before.coefficients[0], 1e-8);
  EXPECT_NEAR(after.coefficients[1] * scale[4], before.coefficients[1], 1e-8);
}

TEST_P(RegressorContract, HonoursAStopRequest) {
  const LeastSquaresSystem system = system_over(good_columns(), 0.1);
  EXPECT_THROW(fit(system, system.all_terms(), stopped()), Cancelled);
}

/// What a pruner owes.
class PrunerContract : public ::testing::TestWithParam<Stage<TermPruner>> {
 protected:
  PruneResult prune(const LeastSquaresSystem& system, const TermSet& active) const {
    return GetParam()->prune(system, 0, active, ols());
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(PrunerContract);

TEST_P(PrunerContract, KeepsTheTrueTerms) {
  for (const double noise : {0.0, 0.05}) {
    const LeastSquaresSystem system = system_over(good_columns(), noise);
    const PruneResult result = prune(system, system.all_terms());
    expect_partition(result, system.all_terms());
    EXPECT_TRUE(contains(result.kept, 1) && contains(result.kept, 4)) << "noise " << noise;
  }
}

TEST_P(PrunerContract, ChoosesFromTheActiveTermsOnly) {
  const LeastSquaresSystem system = good_system();
  const TermSet active = {1, 2, 4};
  expect_partition(prune(system, active), active);
}

TEST_P(PrunerContract, NothingIsChosenFromNothing) {
  const PruneResult result = prune(good_system(), {});
  EXPECT_TRUE(result.kept.empty());
  EXPECT_TRUE(result.removed.empty());
}

TEST_P(PrunerContract, RefusesATargetThatIsNotThere) {
  const LeastSquaresSystem system = good_system();
  EXPECT_THROW(GetParam()->prune(system, 1, system.all_terms(), ols()), ArgumentError);
}

}  // namespace lacuna::contract
