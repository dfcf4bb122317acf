// SPDX-License-Identifier: MIT
// Terms of a library that are written otherwise, left out or taken in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bases/expressions.hpp"
#include "bases/monomials.hpp"
#include "core/base/random.hpp"
#include "identify/journey/centred_library.hpp"
#include "identify/journey/fitting_library.hpp"
#include "identify/journey/lower_terms.hpp"
#include "identify/journey/plain_terms.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "regression/formulations/next_sample.hpp"
#include "support/one_record.hpp"
#include "trajectories/refiners/no_refiner.hpp"
#include "unit/identify/pipeline/records.hpp"

namespace lacuna {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

/// Prey and predator, shifted; noise of a thousandth of each deviation.
Dataset shifted_record(double prey, double predator) {
  const OdeModel model =
      parse_ode("dx/dt = 0.7*x - 0.5*x*y\ndy/dt = -0.6*y + 0.4*x*y\n", "prey");
  Dataset data =
      add_relative_noise(testing::without_derivatives(
                             record_of(model, Dopri87{}, Eigen::Vector2d(1.0, 1.0), 0.05, 600)),
                         1e-3, 5);
  data.trajectories[0].states.col(0).array() += prey;
  data.trajectories[0].states.col(1).array() += predator;
  return data;
}

Pipeline of_degree(int degree) {
  Pipeline pipeline = algorithm1();
  pipeline.basis = Monomials{{.max_degree = degree}};
  return pipeline;
}

TEST(CentredLibrary, WhatAShiftDoesNotLeaveAsItIsStays) {
  const Dataset data = shifted_record(1000.0, 0.0);
  const auto stays = [&](const Pipeline& pipeline) {
    std::vector<std::string> warnings;
    const Pipeline centred = with_centred_library(pipeline, data, warnings);
    return warnings.empty() && centred.basis->library({{"x", "y"}, {}}).names() ==
                                   pipeline.basis->library({{"x", "y"}, {}}).names();
  };
  EXPECT_FALSE(stays(of_degree(2)));
  EXPECT_TRUE(stays(of_degree(1))) << "a line is a line from anywhere";
  Pipeline given = of_degree(2);
  for (const std::vector<std::string>& terms : {std::vector<std::string>{"1", "x^2"},
                                                {"1", "x", "x^2", "sin(x)"},
                                                {"x", "x^2", "1/x"}}) {
    given.basis = Expressions{{.terms = terms}};
    EXPECT_TRUE(stays(given));
  }
  given.basis = Expressions{{.terms = {"1", "x", "x^2", "y^3"}}};
  EXPECT_FALSE(stays(given)) << "y is where it was";
  given = of_degree(2);
  given.equations = {{"x", {"x", "x*y"}}};
  EXPECT_TRUE(stays(given));
  given = of_degree(2);
  given.energy_preserving = true;
  EXPECT_TRUE(stays(given));
}

TEST(CentredLibrary, AnOffsetChangesNothingButWhereTheStateIsCountedFrom) {
  const auto equations = [](double prey) {
    IdentificationTask task;
    task.pipeline = of_degree(2);
    return identify_records(shifted_record(prey, 0.0), task).result;
  };
  const IdentificationResult near = equations(0.0);
  ASSERT_EQ(near.model.equations()[0].size(), 2u);
  for (const double prey : {1e3, -1e5, 1e7}) {
    const IdentificationResult far = equations(prey);
    CompiledModel model = far.model.compile();
    const Eigen::Vector2d place(2.0 + prey, 0.5);
    Eigen::Vector2d rate;
    model.evaluate(0.0, place.data(), nullptr, nullptr, rate.data());
    EXPECT_NEAR(rate[0], 0.7 * 2.0 - 0.5, 0.02) << prey;
    EXPECT_NEAR(rate[1], -0.3 + 0.4, 0.02) << prey;
    EXPECT_LE(far.model.equations()[0].size(), 4u) << "1, x - c, y, (x - c) y";
    EXPECT_THAT(far.warnings, ::testing::Contains(HasSubstr("terms are powers of x")));
    EXPECT_EQ(far.adequacy.fits, near.adequacy.fits);
  }
}

/// A flow about (0, 0), moved to (1000, -500), with noise of a hundredth of each deviation.
class LowerTerms : public ::testing::Test {
 protected:
  void record(const std::string& text) {
    data_ = add_relative_noise(
        testing::without_derivatives(record_of(parse_ode(text, "flow"), Dopri87{},
                                               Eigen::Vector2d(1.0, 1.0), 0.05, 400)),
        0.01, 3);
    data_.trajectories[0].states.col(0).array() += 1000.0;
    data_.trajectories[0].states.col(1).array() -= 500.0;
    plain_ = algorithm1();
    plain_.basis = Monomials{{.max_degree = 2}};
    std::vector<std::string> warnings;
    centred_ = with_centred_library(plain_, data_, warnings);
    names_ = centred_.basis->library({{"x", "y"}, {}}).names();
    ASSERT_EQ(names_.size(), 6u);
  }

  /// What is found where dx/dt may have these of 1, x, y, x^2, x*y, y^2 about the centre.
  IdentificationResult found_with(const std::vector<std::size_t>& places) {
    Pipeline restricted = centred_;
    EquationTerms own{"x", {}};
    for (const std::size_t place : places) own.terms.push_back(names_[place]);
    restricted.equations = {own};
    return identify(data_, restricted);
  }

  std::vector<std::string> terms_after(const IdentificationResult& found) {
    result_ = with_lower_terms(plain_, centred_, data_, found, {});
    std::vector<std::string> terms;
    for (const WeightedTerm& summand : result_->model.equations()[0])
      terms.push_back(summand.term.name());
    return terms;
  }

  Dataset data_;
  Pipeline plain_ = algorithm1(), centred_ = algorithm1();
  std::vector<std::string> names_;
  std::optional<IdentificationResult> result_;
};

TEST_F(LowerTerms, APowerThatStandsInForThemGoes) {
  record("dx/dt = 0.7*x - 0.5*x*y\ndy/dt = -0.6*y + 0.4*x*y\n");
  IdentificationResult odd = found_with({2, 4});
  std::vector<Equation> equations = odd.model.equations();
  equations[0].push_back({Term::parse(names_[3], {{"x", "y"}, {}}), 1e-3});
  odd.model = odd.model.with_equations(equations);
  EXPECT_THAT(terms_after(odd), Not(Contains(names_[3])));
  EXPECT_THAT(terms_after(odd), Contains(names_[4]));
  EXPECT_THAT(result_->trail,
              Contains(::testing::AllOf(::testing::Field(&TrailEntry::term, names_[3]),
                                        ::testing::Field(&TrailEntry::stage, "lower terms"))));
}

TEST_F(LowerTerms, ASquareAboutTheCentreStays) {
  // dx/dt of y only through (y - c)^2.
  record("dx/dt = y^2 - 1.2\ndy/dt = -x\n");
  const IdentificationResult found = found_with({0, 1, 2, 3, 4, 5});
  EXPECT_THAT(terms_after(found), Contains(names_[5]));
}

/// dw/dt = -2 w + 10 u under an input that is held for `length` samples at one of these values,
/// solved exactly from sample to sample.
Dataset step_test(const std::vector<double>& values, Index length, double noise,
                  std::uint64_t seed, double step = 0.02) {
  constexpr Index kSamples = 600;
  Random random(seed);
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
  return support::one_record({{"w", ""}}, {{"u", ""}}, record);
}

std::vector<std::string> names(const Pipeline& pipeline) {
  return pipeline.basis->library({{"w"}, {"u"}}).names();
}

TEST(DistinctPowers, OfTwoValuesOnlyTheFirst) {
  std::vector<std::string> warnings;
  const Pipeline pipeline =
      with_distinct_powers(of_degree(3), step_test({0.0, 1.0}, 100, 0.0, 1), warnings);
  EXPECT_THAT(names(pipeline),
              UnorderedElementsAre("1", "w", "u", "w^2", "w*u", "w^3", "w^2*u"));
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
  Pipeline constrained = of_degree(3);
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
  for (const Shape& shape :
       {Shape{{0.0, 1.0}, 300, 0.02}, Shape{{-1.0, 1.0}, 40, 0.02},
        Shape{{0.0, 0.25, 0.5, 0.75, 1.0}, 50, 0.02}, Shape{{0.0, 0.3, 1.0}, 60, 0.05}})
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
  task.pipeline = of_degree(1);
  task.pipeline.formulation = NextSample{};
  task.pipeline.refiner = NoRefiner{};
  const OdeModel model = identify_records(data, task).result.model;
  EXPECT_NEAR(model.coefficient(0, "w"), 0.5, 1e-9);
  EXPECT_NEAR(model.coefficient(0, "u"), 1.0, 1e-9);
}

/// dw/dt = -a w - b w u + 10 u under an input that is u0 for 200 samples and then jumps between
/// 1 and u0 every `length`, solved exactly from sample to sample; noise 0.02.
Dataset record_of(double a, double b, double u0, Index length, std::uint64_t seed) {
  constexpr Index kSamples = 800;
  constexpr double kStep = 0.02;
  Random random(seed);
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
  return support::one_record({{"w", ""}}, {{"u", "", Hold::Zero}}, record);
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
