// SPDX-License-Identifier: MIT
#include "trajectories/shooting/block_minimum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lacuna/core/base/error.hpp"
#include "regression/linear/row_fold.hpp"
#include "trajectories/shooting/shooting_fit.hpp"
#include "unit/trajectories/shooting/dense_problem.hpp"

namespace lacuna {
namespace {

using testing::ShootingCase;

/// y = a exp(-b t) in two records of ten samples: a of each, b in common.
class Decays final : public BlockProblem {
 public:
  Decays() {
    for (Index r = 0; r < 2; ++r)
      for (Index i = 0; i < 10; ++i)
        values_(i, r) = static_cast<double>(r + 1) * std::exp(-0.5 * time(i)) +
                        0.01 * std::sin(7.0 * time(i) + static_cast<double>(r));
  }

  static double time(Index i) { return 0.3 * static_cast<double>(i); }

  double cost(const BlockPoint& point) override {
    trial_ = point;
    if (point.common[0] < -5.0) return std::numeric_limits<double>::infinity();
    double sum = 0.0;
    for (Index r = 0; r < 2; ++r)
      for (Index i = 0; i < 10; ++i) sum += std::pow(residual(point, r, i), 2);
    return sum;
  }

  void keep() override { present_ = trial_; }

  BlockTriangles linearise() override {
    blocks_.clear();
    for (Index r = 0; r < 2; ++r) {
      RowFold fold(3);
      for (Index i = 0; i < 10; ++i) {
        const double decay = std::exp(-present_.common[0] * time(i));
        const double entries[] = {decay, -time(i) * present_.own(r, 0) * decay,
                                  residual(present_, r, i)};
        double* row = fold.next_row();
        for (Index j = 0; j < 3; ++j) row[j * fold.stride()] = entries[j];
      }
      blocks_.push_back(*fold.finish());
    }
    return {blocks_, rest_};
  }

  double residual(const BlockPoint& point, Index r, Index i) const {
    return values_(i, r) - point.own(r, 0) * std::exp(-point.common[0] * time(i));
  }

 private:
  Matrix values_{10, 2};
  BlockPoint trial_, present_;
  std::vector<Matrix> blocks_;
  Matrix rest_;
};

constexpr double kNone = std::numeric_limits<double>::infinity();

BlockTask task() {
  return {17.0, 1e-10, 100, Vector{{-kNone, -kNone}}, Vector{{kNone, kNone}}};
}

const BlockPoint kStart{Matrix::Constant(2, 1, 1.0), Vector{{3.0}}};

/// The best factor of a decay is a linear problem.
double best_factor(const Decays& decays, double rate, Index record) {
  double product = 0.0, square = 0.0;
  for (Index i = 0; i < 10; ++i) {
    const double decay = std::exp(-rate * Decays::time(i));
    product += decay * decays.residual({Matrix::Zero(2, 1), Vector{{rate}}}, record, i);
    square += decay * decay;
  }
  return product / square;
}

class BlockMinimumBy : public ::testing::TestWithParam<bool> {
 protected:
  BlockMinimum minimise(BlockProblem& problem, const BlockTask& task) const {
    return GetParam() ? minimise_blocks_by_ceres(problem, kStart, task, {})
                      : minimise_blocks(problem, kStart, task, {});
  }
  bool is_absent() const {
    if (!GetParam() || ceres_is_absent().empty()) return false;
    Decays decays;
    EXPECT_THROW(minimise(decays, task()), ConfigError);
    return true;
  }
};

TEST_P(BlockMinimumBy, HasTheBestFactorsAndNoBetterRateBesideIt) {
  if (is_absent()) return;
  Decays decays;
  const BlockMinimum found = minimise(decays, task());
  EXPECT_TRUE(found.converged);
  EXPECT_GT(found.iterations, 2);
  EXPECT_NEAR(found.point.common[0], 0.5, 0.02);
  for (Index r = 0; r < 2; ++r)
    EXPECT_NEAR(found.point.own(r, 0), best_factor(decays, found.point.common[0], r), 1e-6);
  for (const double moved : {-1e-3, 1e-3}) {
    const double rate = found.point.common[0] + moved;
    const Matrix own{{best_factor(decays, rate, 0)}, {best_factor(decays, rate, 1)}};
    EXPECT_GT(decays.cost({own, Vector{{rate}}}), found.cost);
  }
}

// Ceres puts the whole step back into the ranges, and ends beside the minimum of the others.
TEST(BlockMinimum, OthersMeetTheRecordsWhereOneIsAtTheEndOfItsRange) {
  Decays decays;
  BlockTask narrow = task();
  narrow.lower[1] = 0.8;
  const BlockMinimum found = minimise_blocks(decays, kStart, narrow, {});
  EXPECT_NEAR(found.point.common[0], 0.8, 1e-12);
  for (Index r = 0; r < 2; ++r)
    EXPECT_NEAR(found.point.own(r, 0), best_factor(decays, 0.8, r), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Minimisers, BlockMinimumBy, ::testing::Bool(),
                         [](const auto& one) { return one.param ? "Ceres" : "Own"; });

TEST(BlockMinimum, BothMinimisersOfWindowsMeet) {
  if (!ceres_is_absent().empty()) return;
  ShootingCase c;
  ShootingFit own{c.plan, c.point, {}}, by_ceres = own;
  minimise(c.problem, own, 1e-10, 50, {});
  minimise(c.problem, by_ceres, 1e-10, 50, {}, minimise_blocks_by_ceres);
  EXPECT_TRUE(by_ceres.converged);
  EXPECT_LT((own.point.parameters - by_ceres.point.parameters).norm(),
            1e-5 * own.point.parameters.norm());
  EXPECT_NEAR(own.point.cost, by_ceres.point.cost, 1e-8 * own.point.cost);
}

}  // namespace
}  // namespace lacuna
