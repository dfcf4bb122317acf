// SPDX-License-Identifier: MIT
#include "identify/forms_beside/identify_with_forms.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/options.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {
namespace {

/// A pendulum, identified with options.
IdentificationResult pendulum(const FormOptions& options) {
  const Dataset data = record_of(parse_ode("dx/dt = y\ndy/dt = -0.9*sin(x)", "pendulum"),
                                 Dopri87{}, Eigen::Vector2d(-1.9, 0.0), 0.02, 512);
  return identify_with_forms(data, algorithm1(), default_registry().make_all<Effect>(),
                             options);
}

TEST(FormOptions, WhatIsNotWorthAskingGetsNoForm) {
  EXPECT_TRUE(pendulum({}).library_alone);
  EXPECT_FALSE(pendulum({.worth_asking = 1.0}).library_alone);
}

TEST(FormOptions, StayInTheirRanges) {
  FormOptions options;
  EXPECT_NO_THROW(checked(options));
  options.alike = 1.5;
  EXPECT_THROW(checked(options), ConfigError);
  options = {.most_forms = -1};
  EXPECT_THROW(checked(options), ConfigError);
}

const std::vector<Stage<Effect>> kEffects = default_registry().make_all<Effect>();

std::vector<std::string> terms_of(const OdeModel& model, std::size_t equation) {
  std::vector<std::string> names;
  for (const WeightedTerm& summand : model.equations()[equation])
    names.push_back(summand.term.name());
  return names;
}

Dataset record_of_equations(
    const std::vector<std::vector<std::pair<double, std::string>>>& rows, const Vector& start,
    double step, Index samples, double noise) {
  Variables variables;
  std::vector<Quantity> states;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    states.push_back({std::string(1, "xyz"[k]), ""});
    variables.states.push_back(states.back().name);
  }
  std::vector<Equation> equations;
  for (const auto& row : rows) {
    equations.emplace_back();
    for (const auto& [coefficient, term] : row)
      equations.back().push_back({Term::parse(term, variables), coefficient});
  }
  const Dataset clean =
      record_of(OdeModel(states, {}, equations), Dopri87{}, start, step, samples);
  return add_relative_noise(clean, noise, 1);
}

TEST(IdentifyWithForms, FindsAPendulumAndShowsWhatPolynomialsGive) {
  const Dataset data = record_of_equations({{{1.0, "y"}}, {{-0.9, "sin(x)"}}},
                                           Eigen::Vector2d(-1.9, 0.0), 0.02, 512, 0.0);
  const IdentificationResult found = identify_with_forms(data, algorithm1(), kEffects);
  EXPECT_EQ(terms_of(found.model, 0), std::vector<std::string>{"y"});
  EXPECT_EQ(terms_of(found.model, 1), std::vector<std::string>{"sin(x)"});
  EXPECT_NEAR(found.model.coefficient(1, "sin(x)"), -0.9, 1e-6);
  ASSERT_TRUE(found.library_alone);
  EXPECT_GT(terms_of(*found.library_alone, 1).size(), 1u);
}

TEST(IdentifyWithForms, FindsARateThatSaturates) {
  const Dataset data = record_of_equations({{{0.6, "1"}, {-1.5, "x/(0.3+x)"}}},
                                           Vector::Constant(1, 2.0), 0.01, 1000, 0.0);
  const IdentificationResult found = identify_with_forms(data, algorithm1(), kEffects);
  // Two writings are one function: 0.6 - 1.5 x/(0.3+x) and -0.9 + 1.5/(1+x/0.3).
  ASSERT_EQ(found.model.equations()[0].size(), 2u);
  EXPECT_NEAR(found.model.coefficient(0, "1"), 0.6, 1e-4);
  CompiledModel rate = found.model.compile();
  for (const double x : {0.1, 0.3, 1.2, 2.0}) {
    double dxdt = 0.0;
    rate.evaluate(0.0, &x, nullptr, nullptr, &dxdt);
    EXPECT_NEAR(dxdt, 0.6 - 1.5 * x / (0.3 + x), 1e-6);
  }
}

/// A fraction of the rms of the rate of y that a model is off by, over a range of its own.
double error_of(const OdeModel& model, const std::function<double(double, double, double)>& f) {
  double off = 0.0, size = 0.0;
  CompiledModel compiled = model.compile();
  Vector rates(2);
  for (double t = 0.0; t < 20.0; t += 0.37)
    for (double x = -0.6; x < 0.7; x += 0.2)
      for (double y = -0.5; y < 0.6; y += 0.25) {
        const double truth = f(x, y, t);
        const Eigen::Vector2d at(x, y);
        compiled.evaluate(t, at.data(), nullptr, nullptr, rates.data());
        off += std::pow(rates[1] - truth, 2);
        size += truth * truth;
      }
  return off / size;
}

TEST(IdentifyWithForms, FindsForcingAndAFunctionThatAMonomialMultiplies) {
  const Dataset data = record_of_equations({{{1.0, "y"}},
                                            {{0.3, "sin(t)"},
                                             {-0.5, "y^3"},
                                             {-1.0, "x*y"},
                                             {-5.0, "x*exp(0.5*x)"}}},
                                           Eigen::Vector2d(0.2, 0.3), 0.01, 3000, 0.0);
  const IdentificationResult found = identify_with_forms(data, algorithm1(), kEffects);
  EXPECT_EQ(found.model.equations()[1].size(), 4u);
  EXPECT_LT(error_of(found.model,
                     [](double x, double y, double t) {
                       return 0.3 * std::sin(t) - 0.5 * y * y * y - x * y -
                              5.0 * x * std::exp(0.5 * x);
                     }),
            1e-6);
}

/// dy/dt of an oscillator, which x, x*y, x^3, y^3 and sin(x) follow closely.
double with_look_alikes(double x, double y, double) {
  return 0.8 * std::sin(x) - 0.5 * y * y * y - 0.2 * x * x * x - 0.5 * x * y - x * std::cos(x);
}

Dataset record_with_look_alikes() {
  return record_of_equations({{{1.0, "y"}},
                              {{0.8, "sin(x)"},
                               {-0.5, "y^3"},
                               {-0.2, "x^3"},
                               {-0.5, "x*y"},
                               {-1.0, "x*cos(x)"}}},
                             Eigen::Vector2d(0.3, 0.3), 0.01, 3000, 0.0);
}

TEST(IdentifyWithForms, WhereRatesAreMeasuredATaylorSeriesIsNoAnswer) {
  Dataset data = record_with_look_alikes();
  Trajectory& record = data.trajectories[0];
  record.derivatives = record.states;
  for (Index i = 0; i < record.samples(); ++i) {
    const double x = record.states(i, 0), y = record.states(i, 1);
    record.derivatives.row(i) << y, with_look_alikes(x, y, 0.0);
  }
  const IdentificationResult found = identify_with_forms(data, algorithm1(), kEffects);
  EXPECT_LT(error_of(found.model, with_look_alikes), 1e-6);
}

TEST(IdentifyWithForms, AFunctionTakesThePlaceOfATermOfItsSeries) {
  const IdentificationResult found =
      identify_with_forms(record_with_look_alikes(), algorithm1(), kEffects);
  EXPECT_EQ(terms_of(found.model, 1).size(), 5u);
  EXPECT_NE(found.model.coefficient(1, "x*cos(x)"), 0.0);
  EXPECT_LT(error_of(found.model, with_look_alikes), 1e-6);
}

TEST(IdentifyWithForms, FindsForcingBesideASpringThatHardens) {
  const Dataset data = record_of_equations(
      {{{1.0, "y"}}, {{1.0, "x"}, {-1.0, "x^3"}, {-0.2, "y"}, {0.3, "cos(1.2*t)"}}},
      Eigen::Vector2d(0.5, 0.0), 0.08, 512, 0.0);
  const IdentificationResult found = identify_with_forms(data, algorithm1(), kEffects);
  EXPECT_EQ(terms_of(found.model, 0), std::vector<std::string>{"y"});
  EXPECT_EQ(found.model.equations()[1].size(), 4u) << to_text(found.model, 4);
  EXPECT_NEAR(found.model.coefficient(1, "x^3"), -1.0, 1e-6);
  EXPECT_NEAR(found.model.coefficient(1, "y"), -0.2, 1e-6);
}

TEST(IdentifyWithForms, WhatOneStateGivesToTheNextIsOneFormInEach) {
  Dataset data;
  using Start = Eigen::Vector2d;
  for (const Start& start :
       {Start(0.2, 0.6), Start(1.5, 0.3), Start(0.8, 1.2), Start(0.1, 2.0)}) {
    Dataset record = record_of_equations(
        {{{2.5, "1"}, {-100.0, "x*y/(1+y^4/0.0731)"}},
         {{10.0, "1"}, {-100.0, "x*y/(1+y^4/0.0731)"}, {-3.0, "y"}, {-2.0, "x"}}},
        start, 0.01, 401, 0.0);
    data.states = record.states;
    data.trajectories.push_back(std::move(record.trajectories.front()));
  }
  const IdentificationResult found = identify_with_forms(data, algorithm1(), kEffects);
  EXPECT_EQ(terms_of(found.model, 0).size(), 2u);
  EXPECT_EQ(terms_of(found.model, 1).size(), 4u);
  CompiledModel rates = found.model.compile();
  const std::array<double, 2> x{0.5, 0.9};
  std::array<double, 2> found_rates{};
  rates.evaluate(0.0, x.data(), nullptr, nullptr, found_rates.data());
  const double flux = 100.0 * 0.5 * 0.9 / (1.0 + std::pow(0.9, 4) / 0.0731);
  EXPECT_NEAR(found_rates[0], 2.5 - flux, 1e-4);
  EXPECT_NEAR(found_rates[1], 10.0 - flux - 2.7 - 1.0, 1e-4);
}

/// Prey and predator of Rosenzweig and MacArthur: a second number in a denominator has nothing
/// to say, and what saturates is written as one term. By chance one record in some keeps a
/// further term that is hardly larger than its error.
TEST(IdentifyWithForms, ShapesThatSayNothingGo) {
  const Dataset clean = record_of_equations({{{1.0, "x"}, {-0.1, "x^2"}, {-1.5, "x*y/(1.5+x)"}},
                                             {{0.75, "x*y/(1.5+x)"}, {-0.3, "y"}}},
                                            Eigen::Vector2d(2.0, 1.0), 0.2, 300, 0.0);
  int exact = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const Dataset data = add_relative_noise(clean, 0.005, seed);
    const OdeModel found = identify_with_forms(data, algorithm1(), kEffects).model;
    ASSERT_EQ(found.equations()[1].size(), 2u) << to_text(found);
    if (found.equations()[0].size() == 3) ++exact;
    EXPECT_NEAR(found.coefficient(1, "y"), -0.3, 0.003) << to_text(found);
    const Expression saturated = found.equations()[1][1].term.expression();
    EXPECT_EQ(saturated.to_string().substr(0, 6), "x*y/(1") << to_text(found);
    EXPECT_EQ(saturated.to_string().find('*', 3), std::string::npos) << to_text(found);
  }
  EXPECT_GE(exact, 4);
}

TEST(IdentifyWithForms, LeavesWhatPolynomialsReachAsItIs) {
  const TestSystem& system = test_system("van-der-pol");
  const Dataset data =
      add_relative_noise(record_of(system.model, Dopri87{}, system.start, 0.05, 600), 0.01, 1);
  const IdentificationResult with = identify_with_forms(data, algorithm1(), kEffects);
  const IdentificationResult without = identify(data, algorithm1());
  EXPECT_FALSE(with.library_alone);
  EXPECT_EQ(to_text(with.model), to_text(without.model));
}

/// What a solver gives that takes steps of 0.04 and cubics between them (Hermite's).
Dataset with_cubics_between_steps(const OdeModel& model, const Vector& start) {
  constexpr Index kParts = 6;
  constexpr double kStep = 0.04;
  Dataset data = record_of(model, Dopri87{}, start, kStep, 101);
  Trajectory& record = data.trajectories.front();
  const Matrix knots = record.states, slopes = record.derivatives;
  const Index samples = kParts * (knots.rows() - 1);
  record.time = Vector::LinSpaced(samples, 0.0, kStep / kParts * double(samples - 1));
  record.states.resize(samples, knots.cols());
  record.inputs.resize(samples, 0);
  record.derivatives.resize(0, 0);
  for (Index n = 0; n < samples; ++n) {
    const Index i = n / kParts;
    const double s = double(n % kParts) / kParts, r = 1.0 - s;
    record.states.row(n) = r * r * (1.0 + 2.0 * s) * knots.row(i) +
                           s * s * (1.0 + 2.0 * r) * knots.row(i + 1) +
                           kStep * s * r * (r * slopes.row(i) - s * slopes.row(i + 1));
  }
  return data;
}

/// What is left is smooth and more than noise. Forms are taken in and none of them stays, but
/// the terms that the library gives beside them leave less: that is no model with forms.
TEST(IdentifyWithForms, ErrorsOfASolverAreNoForm) {
  const TestSystem& lorenz = test_system("lorenz");
  const Dataset data = with_cubics_between_steps(lorenz.model, Vector::Ones(3));
  const IdentificationResult alone = identify(data, algorithm1());
  EXPECT_FALSE(std::all_of(alone.fit.begin(), alone.fit.end(), [](const EquationFit& fit) {
    return fit.fits_to_noise.value_or(true);
  }));
  const IdentificationResult with = identify_with_forms(data, algorithm1(), kEffects);
  EXPECT_FALSE(with.library_alone);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(terms_of(with.model, k), terms_of(alone.model, k));
}

/// A circuit that polynomials describe to the noise, in rows of which forms say much the same
/// by fewer numbers. In one run on the trajectories they do not: their shapes are not fitted
/// there.
TEST(IdentifyWithForms, FormsThatTrajectoriesRefuteAreNotRefitted) {
  const TestSystem& circuit = test_system("tl072");
  const Dataset data =
      add_relative_noise(record_of(circuit.model, Dopri87{}, circuit.start, 0.1, 600), 1e-3, 1);
  int runs = 0;
  RunContext context;
  context.progress = [&](const Progress& at) { runs += at.activity == "filtering terms"; };
  const IdentificationResult found =
      identify_with_forms(data, algorithm1(), kEffects, {}, context);
  EXPECT_FALSE(found.library_alone);
  EXPECT_EQ(runs, 2);  // the library alone, and forms with the shapes that the rows give
}

TEST(IdentifyWithForms, TooFewSamplesAreNoReasonToFail) {
  const Dataset data = record_of_equations({{{1.0, "y"}}, {{-0.9, "sin(x)"}}},
                                           Eigen::Vector2d(-1.9, 0.0), 0.3, 24, 0.0);
  EXPECT_NO_THROW(identify_with_forms(data, algorithm1(), kEffects));
}

}  // namespace
}  // namespace lacuna
