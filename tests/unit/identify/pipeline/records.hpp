// SPDX-License-Identifier: MIT
// Records of known systems for the tests of whole pipelines.
#pragma once

#include <gtest/gtest.h>

#include <chrono>

#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna::testing {

/// Rossler's attractor with exact derivatives.
inline Dataset rossler_record(Index samples, double step = 0.05) {
  const TestSystem& rossler = test_system("rossler");
  return record_of(rossler.model, Dopri87{}, rossler.start, step, samples);
}

/// A run whose time is up before it begins.
inline RunContext past_the_deadline() {
  RunContext context;
  context.deadline = std::chrono::steady_clock::now();
  return context;
}

/// The record with derivatives left out, as a measurement gives it.
inline Dataset without_derivatives(Dataset data) {
  for (Trajectory& trajectory : data.trajectories) trajectory.derivatives.resize(0, 0);
  return data;
}

/// Exact derivatives of a model at random points of a box [-size, size]^m.
inline Dataset random_points(const OdeModel& model, Index samples, double size,
                             std::uint64_t seed) {
  Random random(seed);
  CompiledModel compiled = model.compile();
  const Index m = model.dimension();
  Trajectory points;
  points.source = "random points";
  points.time = Vector::LinSpaced(samples, 0.0, static_cast<double>(samples - 1));
  points.states.resize(samples, m);
  points.derivatives.resize(samples, m);
  points.inputs.resize(samples, 0);
  for (Index i = 0; i < samples; ++i) {
    Vector x(m), rate(m);
    for (Index k = 0; k < m; ++k) x[k] = random.uniform(-size, size);
    compiled.evaluate(0.0, x.data(), nullptr, nullptr, rate.data());
    points.states.row(i) = x;
    points.derivatives.row(i) = rate;
  }
  Dataset data;
  data.states = model.states();
  data.trajectories.push_back(std::move(points));
  return data;
}

/// Same terms in every equation, and coefficients that differ by at most `tolerance` relative
/// to each true one.
inline void expect_same_model(const OdeModel& found, const OdeModel& truth, double tolerance) {
  ASSERT_EQ(found.dimension(), truth.dimension());
  for (Index k = 0; k < truth.dimension(); ++k) {
    const auto equation = static_cast<std::size_t>(k);
    EXPECT_EQ(found.equations()[equation].size(), truth.equations()[equation].size())
        << to_text(found);
    for (const WeightedTerm& term : truth.equations()[equation])
      EXPECT_NEAR(found.coefficient(k, term.term.name()), term.coefficient,
                  tolerance * std::abs(term.coefficient))
          << term.term.name() << " in equation " << k;
  }
}

}  // namespace lacuna::testing
