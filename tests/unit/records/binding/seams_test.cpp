// SPDX-License-Identifier: MIT
#include "records/binding/seams.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace lacuna {
namespace {

using Firsts = std::vector<Index>;

/// Records of the given states (a column each) and one input; times 0.05 apart.
Firsts seams_of(const Matrix& states, const Vector& input) {
  Dataset data;
  for (Index k = 0; k < states.cols(); ++k) data.states.push_back({"x" + std::to_string(k), ""});
  data.inputs = {{"u", ""}};
  Trajectory record;
  const double end = 0.05 * static_cast<double>(states.rows() - 1);
  record.time = Vector::LinSpaced(states.rows(), 0.0, end);
  record.states = states;
  record.inputs = input;
  data.trajectories = {record};
  return seams(data, data.trajectories.front());
}

Firsts seams_of(const Matrix& states) { return seams_of(states, Vector::Zero(states.rows())); }

/// cos and its rate from a phase on.
Matrix swing(Index samples, double phase) {
  Matrix states(samples, 2);
  for (Index i = 0; i < samples; ++i) {
    const double t = phase + 0.05 * static_cast<double>(i);
    states.row(i) << std::cos(t), -std::sin(t);
  }
  return states;
}

TEST(SeamsOfARecord, ADeviceThatStandsStillHasNone) {
  for (const Index at : {60, 83, 100, 131}) {
    Matrix states = swing(200, 0.3);
    states.bottomRows(200 - at).rowwise() = states.row(at - 1).eval();
    EXPECT_EQ(seams_of(states), Firsts{}) << at;
  }
}

TEST(SeamsOfARecord, AnImpactChangesNoPosition) {
  Matrix states(200, 2);  // a ball that bounces each second
  for (Index i = 0; i < states.rows(); ++i) {
    const double t = std::fmod(0.05 * static_cast<double>(i) + 0.013, 1.0);
    states.row(i) << 5.0 * t * (1.0 - t), 5.0 - 10.0 * t;
  }
  EXPECT_EQ(seams_of(states), Firsts{});
}

}  // namespace
}  // namespace lacuna
