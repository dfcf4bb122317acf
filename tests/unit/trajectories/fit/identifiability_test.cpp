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

std::vector<std::string> said(const Matrix& seen, const Vector& values,
                              const std::vector<std::string>& names, bool is_sum = false) {
  const Matrix triangle = triangle_of(seen);
  const DeterminedBy problem{triangle, values, names};
  const Matrix open = undetermined_directions(problem);
  std::vector<std::string> messages;
  for (Index j = 0; j < open.cols(); ++j)
    messages.push_back(combination_of(problem, open.col(j), is_sum).message);
  return messages;
}

TEST(Identifiability, AProductIsNamed) {
  // k1 k4 and c are seen: d(k1 k4) = k4 dk1 + k1 dk4.
  const Vector values = (Vector(3) << 0.5, 4.0, -2.0).finished();
  const Matrix seen = (Matrix(2, 3) << 4.0, 0.5, 0.0, 0.0, 0.0, 1.0).finished();
  EXPECT_THAT(said(seen, values, {"k1", "k4", "c"}),
              ::testing::ElementsAre("k1 and k4 only as k1*k4"));
}

TEST(Identifiability, ALossIsNamedAsItWouldBeWithoutItsSign) {
  // -a b is seen of a loss a and a gain b: a db + b da.
  const Matrix seen = (Matrix(1, 2) << 4.0, -0.5).finished();
  EXPECT_THAT(said(seen, Vector{{-0.5, 4.0}}, {"a", "b"}),
              ::testing::ElementsAre("a and b only as a*b"));
  // u / b^2 and b c, of a store that nobody measured and its root.
  const Matrix store = (Matrix(2, 3) << 4.0, 4.0, 0.0, 0.0, 3.0, -0.5).finished();
  EXPECT_THAT(said(store, Vector{{0.25, -0.5, 3.0}}, {"u", "b", "c"}),
              ::testing::ElementsAre("u, b and c only as u/b^2 and b*c"));
}

TEST(Identifiability, AQuotientWithAPowerIsNamed) {
  // a / b^2: da / b^2 - 2 a / b^3 db.
  const Vector values = (Vector(2) << 3.0, 2.0).finished();
  const Matrix seen = (Matrix(1, 2) << 0.25, -0.75).finished();
  EXPECT_THAT(said(seen, values, {"a", "b"}), ::testing::ElementsAre("a and b only as a/b^2"));
}

TEST(Identifiability, ASumIsNamed) {
  const Vector values = (Vector(2) << 3.0, 2.0).finished();
  const Matrix triangle = triangle_of((Matrix(1, 2) << 1.0, 1.0).finished());
  const std::vector<std::string> names{"a", "b"};
  const DeterminedBy problem{triangle, values, names};
  const Matrix open = undetermined_directions(problem);
  ASSERT_EQ(open.cols(), 1);
  EXPECT_TRUE(may_be_sum(problem, open.col(0)));
  EXPECT_EQ(combination_of(problem, open.col(0), true).message, "a and b only as a + b");
}

TEST(Identifiability, TheScaleOfAHiddenStateGivesTwoProducts) {
  // a b and b c are seen.
  const Vector values = (Vector(3) << 2.0, 5.0, 0.1).finished();
  const Matrix seen = (Matrix(2, 3) << 5.0, 2.0, 0.0, 0.0, 0.1, 5.0).finished();
  EXPECT_THAT(said(seen, values, {"a", "b", "c"}),
              ::testing::ElementsAre("a, b and c only as a*b and c/a"));
}

TEST(Identifiability, WhatHasNoInfluenceIsNamedAlone) {
  const Vector values = (Vector(2) << 3.0, 2.0).finished();
  EXPECT_THAT(said((Matrix(1, 2) << 1.0, 0.0).finished(), values, {"a", "b"}),
              ::testing::ElementsAre("b: the records do not determine it"));
}

TEST(Identifiability, WhatIsSeenIsNotNamed) {
  const Vector values = (Vector(2) << 3.0, 1e-9).finished();
  EXPECT_TRUE(said(Matrix::Identity(2, 2), values, {"a", "b"}).empty()) << "a number may be 0";
}

TEST(Identifiability, NumbersKnownOnlyTogetherInPracticeAreNamed) {
  const Vector values = (Vector(2) << 3.0, 2.0).finished();
  const Matrix seen = (Matrix(2, 2) << 1.0, -1.5, 1e-4, 0.0).finished();
  EXPECT_THAT(said(seen, values, {"a", "b"}), ::testing::ElementsAre("a and b only as b/a"));
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
