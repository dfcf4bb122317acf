// SPDX-License-Identifier: MIT
#include "records/binding/other_records.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

Dataset record(const std::string& source, double phase) {
  const Vector time = Vector::LinSpaced(100, 0.0, 9.9);
  Dataset data{"s", {{"x", ""}}, {}, {}, {}};
  data.trajectories.push_back(
      {source, time, (time.array() + phase).cos().matrix(), Matrix(100, 0), {}});
  return data;
}

void expect_refused(const Dataset& used, const Dataset& held_out) {
  expect_error<DataError>([&] { check_are_others(used, held_out); },
                          held_out.trajectories[0].source, "the samples of a.csv", "not used");
}

TEST(OtherRecords, TheSameSamplesAreRefusedByBothNames) {
  const Dataset used = record("a.csv", 0.0);
  expect_refused(used, record("b.csv", 0.0));
  Dataset part = record("b.csv", 0.0);
  part.trajectories[0] = rows_of(part.trajectories[0], 40, 30);
  expect_refused(used, part);
  Dataset later = record("b.csv", 0.0);
  later.trajectories[0].time.array() += 100.0;
  expect_refused(used, later);
}

TEST(OtherRecords, OneOtherValueMakesAnotherRecord) {
  const Dataset used = record("a.csv", 0.0);
  Dataset other = used;
  other.trajectories[0].states(50, 0) += 1e-9;
  EXPECT_NO_THROW(check_are_others(used, other));
  other = used;
  other.trajectories[0].states(50, 0) = std::nan("");
  EXPECT_NO_THROW(check_are_others(used, other));
  expect_refused(other, other);
}

}  // namespace
}  // namespace lacuna
