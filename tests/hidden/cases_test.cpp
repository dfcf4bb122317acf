// SPDX-License-Identifier: MIT
#include "hidden/support/cases.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>

#include "hidden/support/records.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna::hidden {
namespace {

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

TEST(HiddenCases, HaveDistinctNamesThatFindThem) {
  std::set<std::string> names;
  for (const HiddenCase& hidden : all_cases()) names.insert(hidden.name);
  EXPECT_EQ(names.size(), all_cases().size());
  EXPECT_EQ(case_named("lorenz-null").about, "Convection, complete");
  EXPECT_THROW(case_named("nothing of the kind"), ArgumentError);
}

class HiddenCaseTest : public testing::TestWithParam<HiddenCase> {};

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

std::string test_name(const testing::TestParamInfo<HiddenCase>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, HiddenCaseTest, testing::ValuesIn(all_cases()), test_name);

}  // namespace

void PrintTo(const HiddenCase& hidden, std::ostream* out) { *out << hidden.name; }

}  // namespace lacuna::hidden
