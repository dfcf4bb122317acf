// SPDX-License-Identifier: MIT
#include "identify/journey/plain_terms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/identify/pipeline/presets.hpp"

namespace lacuna {
namespace {

using ::testing::UnorderedElementsAre;

/// dw/dt = -a w - b w u + 10 u under an input that is u0 for 200 samples and then jumps between 1
/// and u0 every `length`, solved exactly from sample to sample; noise 0.02.
Dataset record_of(double a, double b, double u0, Index length, std::uint64_t seed) {
  constexpr Index kSamples = 800;
  constexpr double kStep = 0.02;
  Random random(seed);
  Dataset data;
  data.states = {{"w", ""}};
  data.inputs = {{"u", "", Hold::Zero}};
  Trajectory record;
  record.time.resize(kSamples);
  record.states.resize(kSamples, 1);
  record.inputs.resize(kSamples, 1);
  double w = 0.0;
  for (Index i = 0; i < kSamples; ++i) {
    const double u = i < 200 || (i - 200) / length % 2 == 1 ? u0 : 1.0, rate = a + b * u;
    record.time[i] = kStep * static_cast<double>(i);
    record.states(i, 0) = w + 0.02 * random.normal();
    record.inputs(i, 0) = u;
    w = 10.0 * u / rate + (w - 10.0 * u / rate) * std::exp(-rate * kStep);
  }
  data.trajectories = {record};
  return data;
}

std::vector<std::string> terms_of(const OdeModel& model) {
  std::vector<std::string> names;
  for (const WeightedTerm& summand : model.equations()[0]) names.push_back(summand.term.name());
  return names;
}

/// The equation that is asked for, and what comes of it.
IdentificationResult plain(const Dataset& data, const std::vector<std::string>& terms) {
  Pipeline asked = algorithm1();
  asked.equations = {{"w", terms}};
  return with_plain_terms(algorithm1(), data, identify(data, asked), {});
}

/// One step from rest: where u is 0, w is 0 too.
TEST(PlainTerms, AProductThatTheRecordDoesNotDistinguishIsItsLowerTerm) {
  int tried = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Dataset data = record_of(2.0, 0.0, 0.0, 1000, seed);
    const IdentificationResult found = plain(data, {"u", "w*u"});
    EXPECT_THAT(terms_of(found.model), UnorderedElementsAre("u", "w")) << seed;
    ++tried;
  }
  EXPECT_EQ(tried, 3);
}

TEST(PlainTerms, AProductThatItDistinguishesStays) {
  const Dataset data = record_of(0.5, 2.0, 0.0, 60, 1);
  const IdentificationResult found = plain(data, {"u", "w", "w*u"});
  EXPECT_THAT(terms_of(found.model), UnorderedElementsAre("u", "w", "w*u"));
  EXPECT_NEAR(found.model.coefficient(0, "w*u"), -2.0, 0.1);
}

TEST(PlainTerms, EquationsThatTheUserWroteStay) {
  const Dataset data = record_of(2.0, 0.0, 0.0, 1000, 1);
  Pipeline own = algorithm1();
  own.equations = {{"w", {"u", "w*u"}}};
  const IdentificationResult found = with_plain_terms(own, data, identify(data, own), {});
  EXPECT_THAT(terms_of(found.model), UnorderedElementsAre("u", "w*u"));
}

}  // namespace
}  // namespace lacuna
