// SPDX-License-Identifier: MIT
#include "identify/journey/distinct_powers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/bases/expressions.hpp"
#include "lacuna/bases/monomials.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/regression/formulations/next_sample.hpp"
#include "lacuna/trajectories/refiners/no_refiner.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

/// dw/dt = -2 w + 10 u under an input that is held for `length` samples at one of these values,
/// solved exactly from sample to sample.
Dataset step_test(const std::vector<double>& values, Index length, double noise,
                  std::uint64_t seed, double step = 0.02) {
  constexpr Index kSamples = 600;
  Random random(seed);
  Dataset data;
  data.states = {{"w", ""}};
  data.inputs = {{"u", ""}};
  Trajectory record;
  record.time.resize(kSamples);
  record.states.resize(kSamples, 1);
  record.inputs.resize(kSamples, 1);
  double w = 0.0, u = values.front();
  for (Index i = 0; i < kSamples; ++i) {
    if (i > 0 && i % length == 0)
      u = values.size() == 2 ? values[static_cast<std::size_t>(i / length) % 2]
                             : values[random.below(values.size())];
    record.time[i] = step * static_cast<double>(i);
    record.states(i, 0) = w + noise * random.normal();
    record.inputs(i, 0) = u;
    w = 5.0 * u + (w - 5.0 * u) * std::exp(-2.0 * step);
  }
  data.trajectories = {record};
  return data;
}

std::vector<std::string> names(const Pipeline& pipeline) {
  return pipeline.basis->library({{"w"}, {"u"}}).names();
}

Pipeline of_powers_to(int degree) {
  Pipeline pipeline = algorithm1();
  pipeline.basis = Monomials{{.max_degree = degree}};
  return pipeline;
}

TEST(DistinctPowers, OfTwoValuesOnlyTheFirst) {
  std::vector<std::string> warnings;
  const Pipeline pipeline =
      with_distinct_powers(of_powers_to(3), step_test({0.0, 1.0}, 100, 0.0, 1), warnings);
  EXPECT_THAT(names(pipeline), UnorderedElementsAre("1", "w", "u", "w^2", "w*u", "w^3", "w^2*u"));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("u takes 2 values"));
}

/// What somebody wrote down stays.
TEST(DistinctPowers, AUsersOwnLibraryStays) {
  std::vector<std::string> warnings;
  Pipeline own = algorithm1();
  own.basis = Expressions{{.terms = {"w", "u", "u^2", "sin(w)"}}};
  const Dataset data = step_test({0.0, 1.0}, 100, 0.0, 1);
  EXPECT_EQ(names(with_distinct_powers(own, data, warnings)).size(), 4u);
  Pipeline constrained = of_powers_to(3);
  constrained.constraints = {EquationConstraint{}};
  EXPECT_EQ(names(with_distinct_powers(constrained, data, warnings)).size(), 10u);
  EXPECT_THAT(warnings, IsEmpty());
}

/// The commonest experiment in four shapes, three draws of noise each. A term that is not there
/// comes in as often as the criterion lets it: in one draw of twelve at most.
TEST(StepTest, HasTwoTermsWhateverTheSteps) {
  struct Shape {
    std::vector<double> values;
    Index length;
    double noise;
  };
  int tried = 0, exact = 0;
  for (const Shape& shape : {Shape{{0.0, 1.0}, 300, 0.02}, Shape{{-1.0, 1.0}, 40, 0.02},
                             Shape{{0.0, 0.25, 0.5, 0.75, 1.0}, 50, 0.02},
                             Shape{{0.0, 0.3, 1.0}, 60, 0.05}})
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const Identification found =
          identify_records(step_test(shape.values, shape.length, shape.noise, seed));
      const OdeModel& model = found.result.model;
      SCOPED_TRACE(to_text(model));
      exact += model.equations()[0].size() == 2 ? 1 : 0;
      EXPECT_NEAR(model.coefficient(0, "w"), -2.0, 0.06);
      EXPECT_NEAR(model.coefficient(0, "u"), 10.0, 0.3);
      ++tried;
    }
  EXPECT_EQ(tried, 12);
  EXPECT_GE(exact, 11);
}

/// A map's next sample follows from the input that is there.
TEST(StepTest, AMapKeepsItsInputs) {
  Dataset data = step_test({0.0, 1.0, 2.0, 3.0}, 5, 0.0, 4, 1.0);
  Trajectory& record = data.trajectories[0];
  for (Index i = 1; i < record.samples(); ++i)
    record.states(i, 0) = 0.5 * record.states(i - 1, 0) + record.inputs(i - 1, 0);
  IdentificationTask task;
  task.pipeline = of_powers_to(1);
  task.pipeline.formulation = NextSample{};
  task.pipeline.refiner = NoRefiner{};
  const OdeModel model = identify_records(data, task).result.model;
  EXPECT_NEAR(model.coefficient(0, "w"), 0.5, 1e-9);
  EXPECT_NEAR(model.coefficient(0, "u"), 1.0, 1e-9);
}

}  // namespace
}  // namespace lacuna
