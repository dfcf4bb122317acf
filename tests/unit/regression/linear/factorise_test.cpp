// SPDX-License-Identifier: MIT
// Factors of rows.
#include "regression/linear/factorise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lacuna/core/base/error.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "regression/linear/column_range.hpp"
#include "regression/linear/weighted_rows.hpp"
#include "support/monomials.hpp"
#include "support/rossler_data.hpp"
#include "support/thread_team.hpp"

namespace lacuna {
namespace {

using testing::make_monomials;
using testing::make_rossler_data;
using testing::Monomials;
using testing::RosslerData;

const auto name_of_column = [](Index column) { return "column " + std::to_string(column); };

Factor factor_of(const Matrix& theta, const Matrix& targets,
                 Folding folding = Folding::Automatic) {
  return factorise(*make_row_source(theta, targets), folding, name_of_column);
}

// |R - R'| for factors that may differ in rounding only.
double distance(const Factor& a, const Factor& b) {
  return (a.triangle - b.triangle).cwiseAbs().maxCoeff();
}

TEST(Factorise, BothFoldingsGiveTheSameFactor) {
  const Matrix theta = Matrix::Random(2000, 7);
  const Matrix targets = Matrix::Random(2000, 2);
  const Factor gram = factor_of(theta, targets, Folding::Gram);
  const Factor orthogonal = factor_of(theta, targets, Folding::Orthogonal);
  EXPECT_EQ(gram.folding, Folding::Gram);
  EXPECT_EQ(orthogonal.folding, Folding::Orthogonal);
  EXPECT_LT(distance(gram, orthogonal), 1e-12);
  EXPECT_LT((gram.column_norms - theta.colwise().norm().transpose()).norm(), 1e-11);
  EXPECT_LT((gram.target_norms - targets.colwise().norm().transpose()).norm(), 1e-11);
  EXPECT_EQ(gram.rows, 2000);
}

TEST(Factorise, KeepsTheGramOfWideRowsThatWereFoldedByIt) {
  const Matrix theta = Matrix::Random(600, kWideTerms + 1), y = Matrix::Random(600, 1);
  const Factor factor = factor_of(theta, y);
  Matrix all(600, theta.cols() + 1);
  all << theta, y;
  ASSERT_EQ(factor.gram.rows(), all.cols());
  EXPECT_LT((factor.gram - all.transpose() * all).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_EQ(factor_of(theta, y, Folding::Orthogonal).gram.size(), 0);
  EXPECT_EQ(factor_of(theta.leftCols(kWideTerms), y).gram.size(), 0);
}

TEST(Factorise, AutomaticSwitchesForDependentColumns) {
  Matrix theta = Matrix::Random(500, 4);
  theta.col(2) = theta.col(1);
  const Factor factor = factor_of(theta, Matrix::Random(500, 1));
  EXPECT_EQ(factor.folding, Folding::Orthogonal);
  EXPECT_TRUE(factor.triangle.allFinite());
}

TEST(Factorise, AutomaticSwitchesForIllConditionedColumns) {
  Matrix theta = Matrix::Random(500, 4);
  theta.col(2) = theta.col(1) + 2e-8 * theta.col(2);
  EXPECT_EQ(factor_of(theta, Matrix::Random(500, 1)).folding, Folding::Orthogonal);
}

TEST(Factorise, AutomaticSwitchesForExactTargets) {
  const Matrix theta = Matrix::Random(500, 4);
  Matrix targets = Matrix::Random(500, 2);
  targets.col(1) = theta.col(0) - theta.col(3) + 1e-8 * targets.col(0);
  EXPECT_EQ(factor_of(theta, targets).folding, Folding::Orthogonal);
}

// Powers of a variable, condition about 1e3; exact targets beside one with noise and one of
// which nothing is left.
struct ExactProblem {
  Matrix theta = Matrix(4000, 6);
  Matrix truth = Matrix::Random(6, 3);
  Matrix targets;

  ExactProblem() {
    const Vector x = 1.2 + Vector::Random(4000).array();
    for (Index j = 0; j < 6; ++j) theta.col(j) = x.array().pow(double(j));
    truth.col(2) = Vector::Unit(6, 1);
    targets = theta * truth;
    targets.col(2) = theta.col(1);
  }
};

TEST(Factorise, DeflatedIsAsAccurateAsOrthogonal) {
  ExactProblem problem;
  problem.targets.col(1) += 1e-2 * Vector::Random(4000);
  const Factor deflated = factor_of(problem.theta, problem.targets, Folding::Deflated);
  const Factor orthogonal = factor_of(problem.theta, problem.targets, Folding::Orthogonal);
  ASSERT_EQ(deflated.folding, Folding::Deflated);
  EXPECT_LT((deflated.triangle - orthogonal.triangle).topRows(6).cwiseAbs().maxCoeff(), 1e-7);
  const auto residual = [](const Factor& factor) {
    return factor.triangle.col(7).tail(3).norm();
  };
  EXPECT_NEAR(residual(deflated), residual(orthogonal), 1e-10);
  EXPECT_LT((deflated.target_norms - orthogonal.target_norms).norm(), 1e-10);
  const auto left = [](const Factor& factor) { return factor.triangle(6, 6); };
  EXPECT_LT(left(deflated), 1e-14 * deflated.target_norms[0]);
  const Vector h = deflated.triangle.topLeftCorner(6, 6)
                       .triangularView<Eigen::Upper>()
                       .solve(deflated.triangle.col(6).head(6))
                       .cwiseQuotient(deflated.column_norms);
  EXPECT_LT((h - problem.truth.col(0)).cwiseAbs().maxCoeff(), 1e-11);
}

// Behind the first of some rows, and before the next ones.
constexpr Index kBetween = 2500;

TEST(Factorise, DeflatedSeesWhatOtherRowsLeave) {
  ExactProblem problem;
  Matrix theta(40'000, 6), targets(40'000, 3);
  theta << problem.theta.replicate(10, 1);
  targets << problem.targets.replicate(10, 1);
  targets.middleRows(kBetween, 2000) += 1e-9 * Matrix::Random(2000, 3);
  const Factor deflated = factor_of(theta, targets, Folding::Deflated);
  const Factor orthogonal = factor_of(theta, targets, Folding::Orthogonal);
  ASSERT_EQ(deflated.folding, Folding::Deflated);
  const Factor gram = factor_of(theta, targets, Folding::Gram);
  for (Index k = 0; k < 3; ++k) {
    const auto left = [&](const Factor& factor) {
      return factor.triangle.col(6 + k).tail(3).norm();
    };
    EXPECT_NEAR(left(deflated), left(orthogonal), 1e-3 * left(orthogonal));
    EXPECT_GT(std::abs(left(gram) - left(orthogonal)), 0.5 * left(orthogonal));  // too little
  }
}

TEST(Factorise, DeflatedGivesWayWhereSomeRowsDoNotDetermineTheTerms) {
  ExactProblem problem;
  Matrix theta(70'000, 6);
  theta << problem.theta.replicate(18, 1).topRows(70'000);
  const Vector between = theta.col(5).segment(kBetween, 2000);
  theta.col(5).setZero();
  theta.col(5).segment(kBetween, 2000) = between;
  const Factor factor = factor_of(theta, theta * problem.truth, Folding::Deflated);
  EXPECT_EQ(factor.folding, Folding::Orthogonal);
}

// Some rows hardly tell two terms from each other, so that what their fit leaves of the others
// is little, and all of it explained.
TEST(Factorise, DeflatedTakesAFitThatIsNotExact) {
  Matrix theta = Matrix::Random(60'000, 4);
  const Vector between = theta.col(3).segment(kBetween, 2000);
  theta.col(3) = theta.col(2) + 1e-6 * theta.col(3);
  theta.col(3).segment(kBetween, 2000) = between;
  const Vector truth = Vector::LinSpaced(4, 1.0, 2.0);
  const Factor factor = factor_of(theta, theta * truth, Folding::Deflated);
  ASSERT_EQ(factor.folding, Folding::Deflated);
  EXPECT_LT(factor.triangle(4, 4), 1e-14 * factor.target_norms[0]);
  const Vector h = factor.triangle.topLeftCorner(4, 4)
                       .triangularView<Eigen::Upper>()
                       .solve(factor.triangle.col(4).head(4))
                       .cwiseQuotient(factor.column_norms);
  EXPECT_LT((h - truth).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Factorise, AutomaticDeflatesVeryManyRowsOfExactTargets) {
  const Matrix theta = Matrix::Random(kManyRows, 3);
  const Matrix exact = theta * Matrix::Random(3, 2);
  EXPECT_EQ(factor_of(theta, exact).folding, Folding::Deflated);
  EXPECT_EQ(factor_of(theta, exact + 1e-3 * Matrix::Random(kManyRows, 2)).folding,
            Folding::Gram);
}

class FactoriseExtremes : public ::testing::TestWithParam<Folding> {};

TEST_P(FactoriseExtremes, ScaleDropsOutOfTheTriangle) {
  const Matrix theta = Matrix::Random(500, 3);
  const Matrix targets = Matrix::Random(500, 1);
  Matrix extreme = theta;
  extreme.col(0) *= 1e-280;
  extreme.col(2) *= 1e280;
  const Factor plain = factor_of(theta, targets, GetParam());
  const Factor scaled = factor_of(extreme, targets * 1e-200, GetParam());
  EXPECT_LT((plain.triangle.leftCols(3) - scaled.triangle.leftCols(3)).norm(), 1e-12);
  EXPECT_LT((plain.triangle.col(3) - 1e200 * scaled.triangle.col(3)).norm(), 1e-12);
  EXPECT_NEAR(scaled.column_norms[0] * 1e280, plain.column_norms[0], 1e-11);
  EXPECT_NEAR(scaled.column_norms[2] / 1e280, plain.column_norms[2], 1e-11);
  EXPECT_NEAR(scaled.target_norms[0] * 1e200, plain.target_norms[0], 1e-11);
}

TEST_P(FactoriseExtremes, TakesNoRows) {
  const Factor factor = factor_of(Matrix(0, 3), Matrix(0, 1), GetParam());
  EXPECT_EQ(factor.rows, 0);
  EXPECT_TRUE(factor.triangle.isZero(0.0));
}

INSTANTIATE_TEST_SUITE_P(Foldings, FactoriseExtremes,
                         ::testing::Values(Folding::Automatic, Folding::Gram,
                                           Folding::Orthogonal, Folding::Deflated));

TEST(RowSource, ReadsTheRowsThatAreAskedFor) {
  const Matrix theta = Matrix::Random(50, 3);
  const Matrix targets = Matrix::Random(50, 2);
  const auto rows = make_row_source(theta, targets);
  EXPECT_EQ(rows->rows(), 50);
  EXPECT_EQ(rows->terms(), 3);
  EXPECT_EQ(rows->targets(), 2);
  Matrix read_theta(7, 3);
  Matrix read_targets(7, 2);
  rows->open()->read(20, read_theta, read_targets);
  EXPECT_EQ(read_theta, theta.middleRows(20, 7));
  EXPECT_EQ(read_targets, targets.middleRows(20, 7));
}

TEST(RowSource, RejectsDifferentNumbersOfRows) {
  EXPECT_THROW(make_row_source(Matrix(3, 1), Matrix(4, 1)), ArgumentError);
}

TEST(KeptInMemory, HoldsTheSameRows) {
  const auto source = make_row_source(Matrix::Random(50, 3), Matrix::Random(50, 2));
  const auto kept = kept_in_memory(source, 50 * 5 * 8);
  ASSERT_NE(kept, source);
  Matrix theta(50, 3), targets(50, 2), kept_theta(50, 3), kept_targets(50, 2);
  source->open()->read(0, theta, targets);
  kept->open()->read(0, kept_theta, kept_targets);
  EXPECT_EQ(theta, kept_theta);
  EXPECT_EQ(targets, kept_targets);
}

TEST(KeptInMemory, LeavesRowsThatTakeTooMuchToTheirSource) {
  const auto source = make_row_source(Matrix::Random(50, 3), Matrix::Random(50, 2));
  EXPECT_EQ(kept_in_memory(source, 50 * 5 * 8 - 1), source);
}

TEST(WeightedRows, RefuseWeightsThatAreNegativeOrNotFinite) {
  const auto rows = make_row_source(Matrix::Ones(20, 1), Matrix::Ones(20, 1));
  for (const double bad : {-1.0, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    const auto weights = [bad](const Eigen::Ref<const Vector>&, Eigen::Ref<Vector> w) {
      w.setOnes();
      w[3] = bad;
    };
    const auto weighted = make_weighted_rows(*rows, {0, {0}, Vector::Ones(1)}, weights);
    Matrix theta(8, 1);
    Matrix target(8, 1);
    EXPECT_THROW(weighted->open()->read(8, theta, target), ArgumentError);
  }
}

// Passes over rows that a team divides give to the bit what one process gets.
constexpr Index kRows = 5 * 32768 + 100;

struct TeamRows {
  Matrix theta = Matrix::Random(kRows, 4);
  Matrix targets = Matrix::Random(kRows, 2);

  std::shared_ptr<const RowSource> source() const { return make_row_source(theta, targets); }
  LeastSquaresSystem system(const RunContext& context, Folding folding) const {
    return {source(), {"a", "b", "c", "d"}, {"p", "q"}, context, folding};
  }
};

TEST(TeamOfProcesses, FactorsRefinementsAndResidualsAreThoseOfOne) {
  const TeamRows rows;
  for (const Folding folding :
       {Folding::Gram, Folding::Orthogonal, Folding::Deflated, Folding::Automatic}) {
    const LeastSquaresSystem alone = rows.system({}, folding);
    const Subproblem problem = alone.subproblem(1, {0, 2, 3});
    const Vector h = problem.solve();
    testing::ThreadTeam(3).run(2, [&](const RunContext& context) {
      const LeastSquaresSystem system = rows.system(context, folding);
      EXPECT_EQ(system.factor().triangle, alone.factor().triangle);
      EXPECT_EQ(system.factor().target_norms, alone.factor().target_norms);
      EXPECT_EQ(system.refined(problem, h, context), alone.refined(problem, h));
      EXPECT_EQ(system.residuals(1, {0, 2, 3}, h, context), alone.residuals(1, {0, 2, 3}, h));
      const auto cauchy = [](const Eigen::Ref<const Vector>& r, Eigen::Ref<Vector> w) {
        w = (1.0 + r.array().square()).inverse();
      };
      EXPECT_EQ(system.reweighted(problem, h, cauchy, context).solve(),
                alone.reweighted(problem, h, cauchy).solve());
    });
  }
}

TEST(TeamOfProcesses, RangesOfColumnsAndWhatIsNotFiniteAreFoundByAll) {
  TeamRows rows;
  rows.theta.col(2) *= 1e150;
  const auto name = [](Index column) { return "column " + std::to_string(column); };
  const std::vector<int> expected = scan_columns(*rows.source(), name);
  testing::ThreadTeam(3).run(1, [&](const RunContext& context) {
    EXPECT_EQ(scan_columns(*rows.source(), name, context), expected);
  });
  rows.theta(100000, 3) = std::numeric_limits<double>::quiet_NaN();
  testing::ThreadTeam(3).run(1, [&](const RunContext& context) {
    try {
      scan_columns(*rows.source(), name, context);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const DataError& error) {
      EXPECT_EQ(error.where(), "column 3, row 100001");
    }
  });
}

// Accuracy of coefficients on noise-free Rossler data with exact derivatives, where libraries
// of high degree are ill conditioned.
double true_coefficient(Index equation, const std::string& name) {
  static const std::vector<std::vector<std::pair<std::string, double>>> kEquations{
      {{"010", -1.0}, {"001", -1.0}},
      {{"100", 1.0}, {"010", 0.2}},
      {{"000", 0.2}, {"001", -5.7}, {"101", 1.0}}};
  for (const auto& [term, value] : kEquations[static_cast<std::size_t>(equation)]) {
    if (term == name) return value;
  }
  return 0.0;
}

// Largest error of a coefficient of the whole library, relative to the largest coefficient,
// after one refinement; states are multiplied by `scale`.
double coefficient_error(Index n, int degree, double scale = 1.0) {
  const RosslerData data = make_rossler_data(n, 0.1);
  const Monomials terms = make_monomials(scale * data.states, degree);
  const LeastSquaresSystem system(make_row_source(terms.values, data.derivatives), terms.names,
                                  {"x", "y", "z"});
  double error = 0.0;
  for (Index k = 0; k < 3; ++k) {
    const Subproblem problem = system.subproblem(k, system.all_terms());
    const Vector h = system.refined(problem, problem.solve());
    for (Index j = 0; j < h.size(); ++j) {
      const std::string& name = terms.names[static_cast<std::size_t>(j)];
      const int power = (name[0] - '0') + (name[1] - '0') + (name[2] - '0');
      error =
          std::max(error, std::abs(h[j] * std::pow(scale, power) - true_coefficient(k, name)));
    }
  }
  return error / 5.7;
}

TEST(RosslerAccuracy, Degree3) { EXPECT_LT(coefficient_error(10'000, 3), 1e-13); }

TEST(RosslerAccuracy, Degree5) { EXPECT_LT(coefficient_error(10'000, 5), 1e-11); }

TEST(RosslerAccuracy, Degree5OfManyRows) { EXPECT_LT(coefficient_error(100'000, 5), 1e-11); }

TEST(RosslerAccuracy, Degree5OfScaledStates) {
  EXPECT_LT(coefficient_error(10'000, 5, 1e-3), 1e-11);
  EXPECT_LT(coefficient_error(10'000, 5, 1e4), 1e-11);
}

TEST(RosslerAccuracy, RefinementMakesUpForAGram) {
  const RosslerData data = make_rossler_data(10'000, 0.1);
  const Monomials terms = make_monomials(data.states, 5);
  const LeastSquaresSystem system(make_row_source(terms.values, data.derivatives), terms.names,
                                  {"x", "y", "z"}, {}, Folding::Gram);
  const Subproblem problem = system.subproblem(2, system.all_terms());
  const Vector h = system.refined(problem, problem.solve());
  ASSERT_GT(h.size(), 0);
  for (Index j = 0; j < h.size(); ++j) {
    EXPECT_NEAR(h[j], true_coefficient(2, terms.names[static_cast<std::size_t>(j)]), 5e-9);
  }
}

TEST(RosslerAccuracy, EliminationOfADegree7LibraryEqualsRefitting) {
  const RosslerData data = make_rossler_data(5'000, 0.1);
  const Monomials terms = make_monomials(data.states, 7);
  const LeastSquaresSystem system(make_row_source(terms.values, data.derivatives), terms.names,
                                  {"x", "y", "z"});
  Subproblem problem = system.subproblem(2, system.all_terms());
  while (problem.size() > 10) problem.remove(problem.size() - 1 - problem.size() % 3);
  const Vector refit = system.subproblem(2, problem.active()).solve();
  EXPECT_LT((problem.solve() - refit).norm(), 1e-11 * refit.norm());
}

}  // namespace
}  // namespace lacuna
