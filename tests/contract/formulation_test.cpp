// SPDX-License-Identifier: MIT

#include "lacuna/regression/stages/formulation.hpp"

#include <set>

#include "bases/monomials.hpp"
#include "contract/contract.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "support/one_record.hpp"

namespace lacuna::contract {
namespace {

constexpr double kStep = 0.01;

/// dx/dt = y, dy/dt = -4 x, exactly.
Dataset oscillator(Index samples) {
  Trajectory record;
  record.source = "oscillator";
  record.time = Vector::LinSpaced(samples, 0.0, kStep * static_cast<double>(samples - 1));
  record.states.resize(samples, 2);
  record.states.col(0) = (2.0 * record.time.array()).cos();
  record.states.col(1) = -2.0 * (2.0 * record.time.array()).sin();
  return support::one_record({{"x", ""}, {"y", ""}}, {}, record);
}

/// Coefficients of 1, x, y in both equations: of the flow, or of the map that it makes of a
/// step.
Matrix coefficients_of(Evolution evolution) {
  const double c = std::cos(2.0 * kStep), s = std::sin(2.0 * kStep);
  Matrix coefficients(3, 2);
  if (evolution == Evolution::Map)
    coefficients << 0.0, 0.0, c, -2.0 * s, 0.5 * s, c;
  else
    coefficients << 0.0, 0.0, 0.0, -4.0, 1.0, 0.0;
  return coefficients;
}

class EveryFormulation : public testing::TestWithParam<StageVariant> {
 protected:
  LeastSquaresSystem assemble(const Dataset& data, const TermLibrary& library,
                              int threads = 1) const {
    RunContext context;
    context.threads = threads;
    return stage_of<Formulation>(GetParam())->assemble(data, library, context);
  }
  TermLibrary library_ = Monomials{{.max_degree = 1}}.library({{"x", "y"}, {}});
};

TEST_P(EveryFormulation, GivesOneTargetPerStateThatTheTrueTermsExplain) {
  const LeastSquaresSystem system = assemble(oscillator(1000), library_);
  ASSERT_EQ(system.targets(), 2);
  EXPECT_EQ(system.term_names(), library_.names());
  const Vector first = system.subproblem(0, {0, 1, 2}).solve();
  const Vector second = system.subproblem(1, {0, 1, 2}).solve();
  const Matrix expected = coefficients_of(stage_of<Formulation>(GetParam())->evolution());
  EXPECT_LT((first - expected.col(0)).norm(), 1e-4);
  EXPECT_LT((second - expected.col(1)).norm(), 1e-4);
}

TEST_P(EveryFormulation, ThreadsDoNotChangeTheSystem) {
  EXPECT_EQ(assemble(oscillator(1000), library_, 1).factor().triangle,
            assemble(oscillator(1000), library_, 2).factor().triangle);
}

TEST_P(EveryFormulation, RefusesDataThatCannotTellAnything) {
  Dataset constant = oscillator(1000);
  constant.trajectories[0].states.col(1).setConstant(3.0);
  EXPECT_THROW(assemble(constant, library_), DataError);
  EXPECT_THROW(assemble(Dataset{}, library_), DataError);
  const TermLibrary many = Monomials{{.max_degree = 12}}.library({{"x", "y"}, {}});
  EXPECT_THROW(assemble(oscillator(60), many), DataError);
}

TEST_P(EveryFormulation, NamesTheTermThatIsNotFinite) {
  Dataset data = oscillator(1000);
  data.trajectories[0].states(0, 0) = 0.0;
  const TermLibrary library{{{"x", "y"}, {}}, {Term::parse("log(x-5)", {{"x", "y"}, {}})}};
  try {
    assemble(data, library);
    FAIL() << "the logarithm of a negative number went through";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("log(x-5)"), std::string::npos) << error.what();
  }
}

TEST_P(EveryFormulation, NoiseOfTheTargetGrowsWithThatOfTheStates) {
  const auto formulation = stage_of<Formulation>(GetParam());
  const Dataset data = oscillator(1000);
  const auto once = formulation->target_noise(data, Eigen::Vector2d(1e-3, 1e-2));
  const auto twice = formulation->target_noise(data, Eigen::Vector2d(2e-3, 2e-2));
  ASSERT_EQ(once.has_value(), twice.has_value());
  if (!once) return;  // it cannot say
  EXPECT_GT((*once)[0], 0.0);
  EXPECT_NEAR((*twice)[0], 2.0 * (*once)[0], 1e-9 * (*once)[0]);
  EXPECT_NEAR((*once)[1], 10.0 * (*once)[0], 1e-9 * (*once)[1]);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryFormulation,
                         testing::ValuesIn(available(Formulation::kKind)), test_name);

class EveryBasis : public testing::TestWithParam<StageVariant> {};

/// The library of a basis; nothing for one that has no terms before it is told them and says
/// so.
std::optional<TermLibrary> library_of(const StageVariant& variant, const Variables& variables) {
  try {
    return stage_of<Basis>(variant)->library(variables);
  } catch (const ConfigError& error) {
    EXPECT_FALSE(error.remedy().empty()) << error.what();
    return std::nullopt;
  }
}

TEST_P(EveryBasis, MakesDistinctTermsThatCanBeReadBack) {
  const Variables variables{{"x", "y"}, {"u"}};
  const auto library = library_of(GetParam(), variables);
  if (!library) return;
  std::set<std::string> names;
  for (const Term& term : library->terms) {
    EXPECT_TRUE(names.insert(term.name()).second) << term.name() << " twice";
    EXPECT_EQ(Term::parse(term.name(), variables), term);
  }
  EXPECT_EQ(library->variables, variables);
  EXPECT_EQ(library->compile().outputs(), library->size());
}

TEST_P(EveryBasis, ContainsTheStatesThemselves) {
  const auto library = library_of(GetParam(), {{"x", "y"}, {}});
  if (!library) return;
  const std::vector<std::string> names = library->names();
  for (const std::string state : {"x", "y"})
    EXPECT_EQ(std::count(names.begin(), names.end(), state), 1) << state;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryBasis, testing::ValuesIn(available(Basis::kKind)),
                         test_name);

class EveryDifferentiator : public testing::TestWithParam<StageVariant> {
 protected:
  Matrix differentiate(const Vector& time, const Matrix& values, int order = 1) const {
    return stage_of<Differentiator>(GetParam())->differentiate(time, values, order);
  }
};

Vector uniform_grid() { return Vector::LinSpaced(101, 0.0, 2.0); }

/// Steps between 0.5 and 1.5 times the mean.
Vector uneven_grid() {
  Random random(3);
  Vector time(101);
  time[0] = 0.0;
  for (Index i = 1; i < time.size(); ++i) time[i] = time[i - 1] + random.uniform(0.01, 0.03);
  return time;
}

TEST_P(EveryDifferentiator, IsExactForParabolas) {
  for (const Vector& time : {uniform_grid(), uneven_grid()}) {
    Matrix values(time.size(), 2);
    values << time.array().square().matrix(), (1.0 - 3.0 * time.array()).matrix();
    const Matrix first = differentiate(time, values);
    const Matrix second = differentiate(time, values, 2);
    EXPECT_LT((first.col(0) - 2.0 * time).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((first.col(1).array() + 3.0).abs().maxCoeff(), 1e-9);
    EXPECT_LT((second.col(0).array() - 2.0).abs().maxCoeff(), 1e-6);
    EXPECT_LT(second.col(1).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST_P(EveryDifferentiator, OrderZeroIsTheSignal) {
  const Vector time = uniform_grid();
  const Matrix values = time.array().square().matrix();
  EXPECT_LT((differentiate(time, values, 0) - values).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(EveryDifferentiator, FollowsASine) {
  const Vector time = uniform_grid();
  const Matrix rate = differentiate(time, time.array().sin().matrix());
  EXPECT_LT((rate.array() - time.array().cos()).abs().maxCoeff(), 1e-3);
}

TEST_P(EveryDifferentiator, RefusesTooFewSamplesAndShapesThatDoNotFit) {
  const Vector two = Vector::LinSpaced(2, 0.0, 1.0);
  EXPECT_THROW(differentiate(two, Matrix(two)), DataError);
  EXPECT_THROW(differentiate(uniform_grid(), Matrix::Zero(5, 1)), ArgumentError);
  EXPECT_THROW(differentiate(uniform_grid(), Matrix(uniform_grid()), -1), ArgumentError);
}

TEST_P(EveryDifferentiator, GoesOnOverAGap) {
  const Vector all = uniform_grid();
  Vector time(91);
  time << all.head(45), all.tail(46);
  const Matrix rate = differentiate(time, time.array().sin().matrix());
  EXPECT_LT((rate.array() - time.array().cos()).abs().maxCoeff(), 0.01);
}

TEST_P(EveryDifferentiator, StandardErrorsAreOfTheShapeAndOfTheSizeOfTheErrors) {
  const Vector time = Vector::LinSpaced(300, 0.0, 6.0);
  Random random(9);
  Matrix values(300, 2);
  values << time.array().sin().matrix(), time.array().cos().matrix();
  for (Index i = 0; i < 300; ++i)
    for (Index k = 0; k < 2; ++k) values(i, k) += 0.05 * random.normal();
  const auto method = stage_of<Differentiator>(GetParam());
  const auto errors = method->standard_error(time, values);
  if (!errors) return;
  ASSERT_EQ(errors->rows(), 300);
  ASSERT_EQ(errors->cols(), 2);
  EXPECT_GT(errors->minCoeff(), 0.0);
  const Vector off = method->differentiate(time, values).col(0) - time.array().cos().matrix();
  const double ratio = off.norm() / errors->col(0).norm();
  EXPECT_GT(ratio, 0.2);
  EXPECT_LT(ratio, 5.0);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryDifferentiator,
                         testing::ValuesIn(available(Differentiator::kKind)), test_name);

}  // namespace
}  // namespace lacuna::contract
