// SPDX-License-Identifier: MIT
#include "lacuna/identify/alternatives/alternatives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bases/monomials.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "unit/identify/pipeline/records.hpp"

namespace lacuna {
namespace {

Pipeline cubic() {
  Pipeline pipeline = algorithm1();
  pipeline.basis = Monomials{{.max_degree = 3}};
  return pipeline;
}

/// dx/dt = -x over a quarter of x, with noise: x^2 and others do as well.
Dataset short_decay() {
  Dataset data;
  data.states = {{"x", ""}};
  Trajectory& record = data.trajectories.emplace_back();
  record.source = "decay";
  record.time = Vector::LinSpaced(150, 0.0, 0.3);
  record.states = (-record.time.array()).exp().matrix();
  record.inputs.resize(150, 0);
  return add_relative_noise(data, 0.2, 2);
}

std::set<std::string> structure_of(const OdeModel& model) {
  std::set<std::string> terms;
  for (std::size_t k = 0; k < model.equations().size(); ++k)
    for (const WeightedTerm& summand : model.equations()[k])
      terms.insert(std::to_string(k) + ": " + summand.term.name());
  return terms;
}

TEST(Alternatives, AreDistinctStructuresThatTheRecordDoesNotDistinguish) {
  const Dataset data = short_decay();
  const Pipeline pipeline = cubic();
  const IdentificationResult best = identify(data, pipeline);
  const auto found = find_alternatives(data, best, pipeline, {.count = 4});
  ASSERT_GE(found.size(), 2u);
  EXPECT_LE(found.size(), 4u);
  std::set<std::set<std::string>> structures{structure_of(best.model)};
  double weights = 0.0, before = -1e300;
  for (const AlternativeModel& one : found) {
    EXPECT_TRUE(structures.insert(structure_of(one.model)).second) << to_text(one.model, 4);
    EXPECT_LE(one.criterion, AlternativeOptions{}.difference);
    EXPECT_GE(one.criterion, before);
    EXPECT_FALSE(one.with.empty() && one.without.empty());
    EXPECT_TRUE(one.held_out);
    before = one.criterion;
    weights += one.weight;
  }
  EXPECT_GT(weights, 0.05);
  EXPECT_LT(weights, 1.0);
  const double between = 0.5 * (found.front().criterion + found.back().criterion);
  const auto nearer = find_alternatives(data, best, pipeline, {.count = 4, .difference = between});
  EXPECT_GE(nearer.size(), 1u);
  EXPECT_LT(nearer.size(), found.size()) << "the others are distinguished by that much";
  // Each is how much less likely than the next as their criteria say.
  EXPECT_NEAR(found[1].weight / found[0].weight,
              std::exp(0.5 * (found[0].criterion - found[1].criterion)), 1e-9);
}

TEST(Alternatives, SayWhatTheyHaveInstead) {
  const Dataset data = short_decay();
  const IdentificationResult best = identify(data, cubic());
  const std::vector<AlternativeModel> found = find_alternatives(data, best, cubic());
  ASSERT_FALSE(found.empty());
  for (const AlternativeModel& one : found) {
    const std::set<std::string> other = structure_of(one.model), own = structure_of(best.model);
    const auto lacks = [](const auto& of, const auto& in) {
      std::size_t count = 0;
      for (const std::string& term : of) count += in.contains(term) ? 0 : 1;
      return count;
    };
    EXPECT_EQ(one.without.size(), lacks(own, other));
    EXPECT_EQ(one.with.size(), lacks(other, own));
    for (const std::string& term : one.with) EXPECT_TRUE(term.starts_with("dx/dt: ")) << term;
  }
}

TEST(Alternatives, ARecordThatDeterminesItsTermsHasNone) {
  const TestSystem& lorenz = test_system("lorenz");
  const Dataset data = add_relative_noise(
      testing::without_derivatives(record_of(lorenz.model, Dopri87{}, lorenz.start, 0.01, 1500)),
      0.005, 3);
  Pipeline pipeline = algorithm1();
  pipeline.basis = Monomials{{.max_degree = 2}};
  const IdentificationResult best = identify(data, pipeline);
  ASSERT_EQ(structure_of(best.model).size(), 7u);
  for (const AlternativeModel& one : find_alternatives(data, best, pipeline, {.count = 3}))
    EXPECT_TRUE(one.without.empty()) << "every true term is needed: " << one.without.front();
  EXPECT_TRUE(find_alternatives(data, best, pipeline, {.count = 0}).empty());
}

}  // namespace
}  // namespace lacuna
