// SPDX-License-Identifier: MIT
#include "trajectories/fit/identifiability.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

/// R of random rows that see only the given combinations of changes (rows of `seen`).
Matrix triangle_of(const Matrix& seen) {
  Random random(3);
  Matrix rows(50, seen.cols());
  for (Index i = 0; i < rows.rows(); ++i) {
    rows.row(i).setZero();
    for (Index j = 0; j < seen.rows(); ++j)
      rows.row(i) += 100.0 * random.normal() * seen.row(j);
  }
  const Eigen::HouseholderQR<Matrix> qr(rows);
  return Matrix(qr.matrixQR().topRows(seen.cols()).triangularView<Eigen::Upper>());
}

/// What is said of numbers of which the records see these combinations.
std::vector<std::string> said(const Matrix& seen, const Vector& values,
                              const std::vector<std::string>& names, bool is_sum = false) {
  const Matrix triangle = triangle_of(seen);
  const DeterminedBy problem{triangle, values, names};
  const Matrix open = undetermined_directions(problem);
  std::vector<std::string> messages;
  for (Index j = 0; j < open.cols(); ++j) {
    messages.push_back(combination_of(problem, open.col(j), is_sum).message);
    if (is_sum) {
      EXPECT_TRUE(may_be_sum(problem, open.col(j)));
    }
  }
  return messages;
}

TEST(Identifiability, ProductsQuotientsAndPowersAreNamed) {
  // Rows are differentials: d(k1 k4) = k4 dk1 + k1 dk4.
  EXPECT_THAT(said(Matrix{{4.0, 0.5, 0.0}, {0.0, 0.0, 1.0}}, Vector{{0.5, 4.0, -2.0}},
                   {"k1", "k4", "c"}),
              ElementsAre("k1 and k4 only as k1*k4"));
  EXPECT_THAT(said(Matrix{{0.25, -0.75}}, Vector{{3.0, 2.0}}, {"a", "b"}),
              ElementsAre("a and b only as a/b^2"));
  EXPECT_THAT(said(Matrix{{5.0, 2.0, 0.0}, {0.0, 0.1, 5.0}}, Vector{{2.0, 5.0, 0.1}},
                   {"a", "b", "c"}),
              ElementsAre("a, b and c only as a*b and c/a"))
      << "the scale of a hidden state";
}

TEST(Identifiability, ALossIsNamedAsItWouldBeWithoutItsSign) {
  // -a b is seen of a loss a and a gain b: a db + b da.
  EXPECT_THAT(said(Matrix{{4.0, -0.5}}, Vector{{-0.5, 4.0}}, {"a", "b"}),
              ElementsAre("a and b only as a*b"));
  // u / b^2 and b c, of a store that nobody measured and its root.
  EXPECT_THAT(said(Matrix{{4.0, 4.0, 0.0}, {0.0, 3.0, -0.5}}, Vector{{0.25, -0.5, 3.0}},
                   {"u", "b", "c"}),
              ElementsAre("u, b and c only as u/b^2 and b*c"));
}

TEST(Identifiability, ASumIsNamed) {
  EXPECT_THAT(said(Matrix{{1.0, 1.0}}, Vector{{3.0, 2.0}}, {"a", "b"}, true),
              ElementsAre("a and b only as a + b"));
}

TEST(Identifiability, WhatHasNoInfluenceIsNamedAloneAndWhatIsSeenIsNot) {
  EXPECT_THAT(said(Matrix{{1.0, 0.0}}, Vector{{3.0, 2.0}}, {"a", "b"}),
              ElementsAre("b: the records do not determine it"));
  EXPECT_TRUE(said(Matrix::Identity(2, 2), Vector{{3.0, 1e-9}}, {"a", "b"}).empty())
      << "a number may be 0";
  EXPECT_THAT(said(Matrix{{1.0, -1.5}, {1e-4, 0.0}}, Vector{{3.0, 2.0}}, {"a", "b"}),
              ElementsAre("a and b only as b/a"))
      << "known only together in practice";
}

TEST(Identifiability, ADirectionThatIsNotFiniteIsNoCrash) {
  const Matrix triangle = Matrix::Identity(2, 2);
  const Vector values = Vector::Ones(2);
  const std::vector<std::string> names{"a", "b"};
  const FitCombination found =
      combination_of({triangle, values, names}, Vector::Constant(2, std::nan("")));
  EXPECT_TRUE(found.members.empty());
  EXPECT_FALSE(found.message.empty());
}

}  // namespace
}  // namespace lacuna
