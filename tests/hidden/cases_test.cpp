// SPDX-License-Identifier: MIT
#include "hidden/support/cases.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>

#include "hidden/support/records.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::hidden {
namespace {

const std::set<std::string> kVocabulary = {"constant-offset",
                                           "linear-term",
                                           "quadratic-term",
                                           "cubic-term",
                                           "higher-order-term",
                                           "cross-term",
                                           "cubic-stiffness",
                                           "quadratic-drag",
                                           "coulomb-friction",
                                           "stribeck-friction",
                                           "dead-zone",
                                           "backlash",
                                           "saturation",
                                           "one-sided-stop",
                                           "piecewise-linear",
                                           "overflow",
                                           "saturating-rate",
                                           "exponential-conduction",
                                           "leakage",
                                           "feedthrough",
                                           "periodic-forcing",
                                           "parameter-drift",
                                           "time-trend",
                                           "delay",
                                           "lag",
                                           "channel-skew",
                                           "hysteresis",
                                           "missing-coupling",
                                           "unmeasured-input"};

const std::vector<HiddenCase>& cases() {
  static const std::vector<HiddenCase> all = all_cases();
  return all;
}

auto count(Kind kind) {
  return std::count_if(cases().begin(), cases().end(),
                       [&](const HiddenCase& hidden) { return hidden.kind == kind; });
}

/// What the terms of the nominal model leave over of the derivative in one equation when their
/// coefficients are fitted anew, relative to the derivative.
double fraction_after_refit(const HiddenCase& hidden, const Dataset& record, Index equation) {
  const Trajectory& run = record.trajectories[0];
  const Matrix rates = central_rates(record);
  const Equation& terms = hidden.nominal.equations()[static_cast<std::size_t>(equation)];
  Matrix theta(rates.rows(), static_cast<Index>(terms.size()));
  for (Index j = 0; j < theta.cols(); ++j) {
    const Expression expression = terms[static_cast<std::size_t>(j)].term.expression();
    const Program program(std::vector<Expression>{expression}, hidden.nominal.variables());
    Program::Workspace workspace;
    Vector slots(run.states.cols() + run.inputs.cols() + 1);
    for (Index i = 0; i < theta.rows(); ++i) {
      slots << run.states.row(i + 3).transpose(), run.inputs.row(i + 3).transpose(),
          run.time[i + 3];
      program.evaluate(slots.data(), &theta(i, j), workspace);
    }
  }
  const Vector y = rates.col(equation);
  return (y - theta * theta.householderQr().solve(y)).norm() / y.norm();
}

TEST(HiddenCases, CoverTheVocabulary) {
  std::set<std::string> covered;
  for (const HiddenCase& hidden : cases())
    for (const HiddenEffect& effect : hidden.effects)
      if (!effect.names.empty()) covered.insert(effect.names[0]);
  EXPECT_EQ(covered, kVocabulary);
}

TEST(HiddenCases, AreEnoughOfEachKind) {
  EXPECT_GE(count(Kind::Effects), 24);
  EXPECT_GE(count(Kind::Nothing), 8);
  EXPECT_GE(count(Kind::Coefficients), 4);
  EXPECT_GE(count(Kind::Inexpressible), 4);
  EXPECT_GE(std::count_if(cases().begin(), cases().end(),
                          [](const HiddenCase& hidden) {
                            return hidden.kind == Kind::Nothing &&
                                   hidden.noise != NoiseKind::White;
                          }),
            4);
  EXPECT_GE(std::count_if(cases().begin(), cases().end(),
                          [](const HiddenCase& hidden) { return hidden.effects.size() > 1; }),
            6);
}

TEST(HiddenCases, HaveDistinctNamesThatFindThem) {
  std::set<std::string> names;
  for (const HiddenCase& hidden : cases()) names.insert(hidden.name);
  EXPECT_EQ(names.size(), cases().size());
  EXPECT_EQ(case_named("lorenz-null").about, "Convection, complete");
  EXPECT_THROW(case_named("nothing of the kind"), ArgumentError);
}

TEST(HiddenCases, StrengthScalesTheEffects) {
  const HiddenCase half = case_named("oscillator-hardening", 0.5);
  EXPECT_EQ(half.effects[0].coefficient, -7.0);
  EXPECT_EQ(half.system.model.coefficient(1, "x^3"), -7.0);
  EXPECT_EQ(half.augmented->coefficient(1, "x^3"), -7.0);
}

class HiddenCaseTest : public testing::TestWithParam<HiddenCase> {};

TEST_P(HiddenCaseTest, ModelsCanBeSaved) {
  const HiddenCase& hidden = GetParam();
  EXPECT_EQ(to_text(parse_model(format_model(hidden.nominal), "nominal")),
            to_text(hidden.nominal));
  if (!hidden.augmented) return;
  EXPECT_EQ(to_text(parse_model(format_model(*hidden.augmented), "augmented")),
            to_text(*hidden.augmented));
}

TEST_P(HiddenCaseTest, RecordsLookMeasured) {
  const HiddenCase& hidden = GetParam();
  const auto [find, check] = make_records(hidden, 0.01, 1);
  for (const Dataset& record : {find, check}) {
    ASSERT_NO_THROW(check_dataset(record));
    EXPECT_EQ(record.states, hidden.nominal.states());
    EXPECT_EQ(record.inputs, hidden.nominal.inputs());
    EXPECT_GE(record.samples(), 4000);
    EXPECT_LE(record.samples(), 10000);
    EXPECT_LT(record.trajectories[0].states.cwiseAbs().maxCoeff(), 200.0);
    EXPECT_FALSE(record.has_derivatives());
  }
  EXPECT_GT((find.trajectories[0].states - check.trajectories[0].states).norm(),
            0.1 * find.trajectories[0].states.norm());
}

TEST_P(HiddenCaseTest, EffectsAreOfSensibleSize) {
  const HiddenCase& hidden = GetParam();
  const Dataset record = clean_record(hidden, 2);
  const Matrix rest = leftover(hidden.without_effects(), record);
  const Vector size =
      rest.colwise().norm().array() / central_rates(record).colwise().norm().array();
  std::set<Index> concerned;
  for (const HiddenEffect& effect : hidden.effects)
    concerned.insert(hidden.nominal.state_index(effect.equation));
  for (Index k = 0; k < size.size(); ++k) {
    if (concerned.contains(k)) {
      const double fraction = fraction_after_refit(hidden, record, k);
      EXPECT_GT(fraction, 0.01) << "equation " << k;
      EXPECT_LT(fraction, 0.7) << "equation " << k;
    } else if ((hidden.skew.array() == 0.0).all()) {
      EXPECT_LT(size[k], 1e-3) << "equation " << k;
    }
  }
}

TEST_P(HiddenCaseTest, WrongCoefficientsAreListed) {
  const HiddenCase& hidden = GetParam();
  for (const WrongCoefficient& wrong : hidden.wrong) {
    const Index equation = hidden.nominal.state_index(wrong.equation);
    EXPECT_NEAR(hidden.nominal.coefficient(equation, wrong.term), wrong.nominal, 1e-12);
    EXPECT_NEAR(hidden.system.model.coefficient(equation, wrong.term), wrong.truth, 1e-12);
  }
}

std::string test_name(const testing::TestParamInfo<HiddenCase>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, HiddenCaseTest, testing::ValuesIn(all_cases()), test_name);

}  // namespace

void PrintTo(const HiddenCase& hidden, std::ostream* out) { *out << hidden.name; }

}  // namespace lacuna::hidden
