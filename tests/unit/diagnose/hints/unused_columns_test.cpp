// SPDX-License-Identifier: MIT
#include "diagnose/hints/unused_columns.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

/// The records with one further column, a function of a sample, as their only input.
template <class Column>
Dataset with_column(Dataset data, const Column& column) {
  data.inputs = {{"G", ""}};
  Trajectory& record = data.trajectories[0];
  for (Index i = 0; i < record.samples(); ++i) record.inputs(i, 0) = column(record, i);
  return data;
}

template <class Column>
std::vector<Hint> hints_for(const support::Hidden& hidden, const Column& column) {
  const Dataset data = support::hidden_record(hidden, 0.01);
  const BoundRecords records = observed(data);
  return unused_column_hints(support::oscillator(), records, with_column(data, column),
                             rate_windows(records), {});
}

TEST(UnusedColumns, SayNothingOfCopiesOfWhatTheModelKnows) {
  const auto cubic = [](double, double q, double) { return -0.6 * q * q * q; };
  Random random(5);
  EXPECT_TRUE(
      hints_for(cubic, [&](const Trajectory& record,
                           Index i) { return record.states(i, 0) + 1e-3 * random.normal(); })
          .empty())
      << "q again";
  EXPECT_TRUE(hints_for(cubic,
                        [](const Trajectory& record, Index i) {
                          const double q = record.states(i, 0), v = record.states(i, 1);
                          return -4.0 * q - 0.2 * v - 0.6 * q * q * q + record.inputs(i, 0);
                        })
                  .empty())
      << "the acceleration";
  EXPECT_TRUE(
      hints_for(cubic, [](const Trajectory& record, Index i) { return 7.0 * record.time[i]; })
          .empty())
      << "another clock";
}

}  // namespace
}  // namespace lacuna
