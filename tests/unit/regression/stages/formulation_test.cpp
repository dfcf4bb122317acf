// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/formulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/options.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

struct RowsOptions {
  static constexpr StageInfo kInfo{"rows", "", ""};
  int count = 50;
  void describe(OptionVisitor& v) { v.field({"count", "", ""}, count); }
};

/// As many random rows as told, whatever the data.
class Rows final : public Configured<Formulation, RowsOptions> {
 public:
  using Configured::Configured;

 private:
  LeastSquaresSystem do_assemble(const Dataset& data, const TermLibrary& library,
                                 const RunContext&) const override {
    std::vector<std::string> targets(static_cast<std::size_t>(data.state_count()), "y");
    return LeastSquaresSystem(
        make_row_source(Matrix::Random(options().count, library.size()),
                        Matrix::Random(options().count, data.state_count())),
        library.names(), targets);
  }
  std::optional<Vector> do_target_noise(const Dataset&, const Vector& noise) const override {
    return 3.0 * noise;
  }
};

TermLibrary library_xy() {
  TermLibrary library{{{"x", "y"}, {}}, {}};
  for (const char* text : {"1", "x", "y"})
    library.terms.push_back(Term::parse(text, library.variables));
  return library;
}

/// x = sin t + `offset`, y = cos t.
Dataset waves(double offset = 0.0) {
  Trajectory record;
  record.time = Vector::LinSpaced(60, 0.0, 6.0);
  record.states.resize(60, 2);
  record.states << record.time.array().sin() + offset, record.time.array().cos();
  return support::one_record({{"x", ""}, {"y", ""}}, {}, record);
}

std::string refusal(const Dataset& data, const Rows& rows = Rows{}) {
  try {
    rows.assemble(data, library_xy());
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

TEST(Formulation, UsableDataReachTheMethod) { EXPECT_EQ(refusal(waves()), ""); }

TEST(Formulation, ConstantStateIsNamedWithTheRemedy) {
  Dataset data = waves();
  data.trajectories[0].states.col(1).setConstant(2.5);
  const std::string text = refusal(data);
  EXPECT_NE(text.find("state 'y'"), std::string::npos) << text;
  EXPECT_NE(text.find("constant (2.5)"), std::string::npos) << text;
  EXPECT_NE(text.find("--states"), std::string::npos) << text;
}

TEST(Formulation, RoundingIsNoVariation) {
  Dataset data = waves();
  Trajectory& record = data.trajectories[0];
  record.states.col(1).setConstant(1e6);
  for (Index i = 0; i < 60; i += 3) record.states(i, 1) = std::nextafter(1e6, 2e6);
  EXPECT_NE(refusal(data).find("is constant"), std::string::npos);
}

TEST(Formulation, AStateThatVariesLateVaries) {
  Trajectory record;
  record.time = Vector::LinSpaced(20000, 0.0, 1.0);
  record.states = Matrix::Random(20000, 2);
  record.states.col(1).setConstant(2.0);
  Dataset data = support::one_record({{"x", ""}, {"y", ""}}, {}, record);
  EXPECT_NE(refusal(data).find("is constant (2) in all 20000 samples"), std::string::npos);
  data.trajectories[0].states(19999, 1) = 2.5;
  EXPECT_EQ(refusal(data), "");
}

TEST(Formulation, SmallSignalOnAnOffsetIsVariation) {
  Dataset data = waves();
  data.trajectories[0].states *= 1e-9;
  EXPECT_EQ(refusal(data), "");
  data.trajectories[0].states.array() += 1.0;
  EXPECT_EQ(refusal(data), "");
}

TEST(Formulation, ZeroDerivativeIsRefused) {
  Dataset data = waves();
  data.trajectories[0].derivatives = data.trajectories[0].states;
  data.trajectories[0].derivatives.col(0).setZero();
  const std::string text = refusal(data);
  EXPECT_NE(text.find("state 'x': its derivative is zero throughout"), std::string::npos)
      << text;
}

TEST(Formulation, StateThatChangesOnlyBetweenRecordsHasNoDerivative) {
  Dataset data = waves();
  data.trajectories.push_back(data.trajectories[0]);
  data.trajectories[0].states.col(0).setConstant(1.0);
  data.trajectories[1].states.col(0).setConstant(2.0);
  EXPECT_NE(refusal(data).find("derivative is zero"), std::string::npos);
}

TEST(Formulation, IdentityNeedsNoDerivative) {
  Dataset data = waves();
  data.trajectories[0].derivatives = data.trajectories[0].states;
  data.trajectories[0].derivatives.col(0).setZero();
  data.rate_of = {Index{1}, std::nullopt};
  EXPECT_EQ(refusal(data), "");
}

TEST(Formulation, FewerRowsThanTermsAreRefused) {
  EXPECT_EQ(refusal(waves(), Rows{{.count = 3}}), "");
  const std::string text = refusal(waves(), Rows{{.count = 2}});
  EXPECT_NE(text.find("2 rows do not determine 3 candidate terms"), std::string::npos) << text;
}

TEST(Formulation, LibraryMustBeMadeForTheData) {
  Dataset data = waves();
  data.states[1].name = "z";
  EXPECT_THROW(Rows{}.assemble(data, library_xy()), ArgumentError);
}

TEST(Formulation, UnusableDatasetIsRefused) {
  Dataset data = waves();
  data.trajectories[0].states(7, 0) = std::nan("");
  EXPECT_THROW(Rows{}.assemble(data, library_xy()), DataError);
}

TEST(Formulation, TargetNoiseChecksItsArguments) {
  const Rows rows;
  EXPECT_EQ((*rows.target_noise(waves(), Eigen::Vector2d(1, 2)))[1], 6.0);
  EXPECT_THROW(rows.target_noise(waves(), Vector::Ones(3)), ArgumentError);
  EXPECT_THROW(rows.target_noise(waves(), Eigen::Vector2d(1, -2)), ArgumentError);
}

}  // namespace
}  // namespace lacuna
