// SPDX-License-Identifier: MIT
// What records tell of parameters, and what is known before.
#include "trajectories/fit/identifiability.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/grey_box.hpp"
#include "trajectories/fit/estimated_sizes.hpp"
#include "trajectories/fit/fit_search.hpp"

namespace lacuna {
namespace {

/// R of random rows that see only the given combinations of changes (rows of `seen`).
Matrix triangle_of(const Matrix& seen) {
  Random random(3);
  Matrix rows(50, seen.cols());
  for (Index i = 0; i < rows.rows(); ++i) {
    rows.row(i).setZero();
    for (Index j = 0; j < seen.rows(); ++j)
      rows.row(i) += 100.0 * random.normal() * seen.row(j);
  }
  const Eigen::HouseholderQR<Matrix> qr(rows);
  return Matrix(qr.matrixQR().topRows(seen.cols()).triangularView<Eigen::Upper>());
}

/// What is said of numbers of which the records see these combinations.
std::vector<std::string> said(const Matrix& seen, const Vector& values,
                              const std::vector<std::string>& names, bool is_sum = false) {
  const Matrix triangle = triangle_of(seen);
  const DeterminedBy problem{triangle, values, names};
  const Matrix open = undetermined_directions(problem);
  std::vector<std::string> messages;
  for (Index j = 0; j < open.cols(); ++j) {
    messages.push_back(combination_of(problem, open.col(j), is_sum).message);
    if (is_sum) {
      EXPECT_TRUE(may_be_sum(problem, open.col(j)));
    }
  }
  return messages;
}

TEST(Identifiability, ProductsQuotientsAndPowersAreNamed) {
  // Rows are differentials: d(k1 k4) = k4 dk1 + k1 dk4.
  EXPECT_THAT(said(Matrix{{4.0, 0.5, 0.0}, {0.0, 0.0, 1.0}}, Vector{{0.5, 4.0, -2.0}},
                   {"k1", "k4", "c"}),
              ElementsAre("k1 and k4 only as k1*k4"));
  EXPECT_THAT(said(Matrix{{0.25, -0.75}}, Vector{{3.0, 2.0}}, {"a", "b"}),
              ElementsAre("a and b only as a/b^2"));
  EXPECT_THAT(
      said(Matrix{{5.0, 2.0, 0.0}, {0.0, 0.1, 5.0}}, Vector{{2.0, 5.0, 0.1}}, {"a", "b", "c"}),
      ElementsAre("a, b and c only as a*b and c/a"))
      << "the scale of a hidden state";
}

TEST(Identifiability, ALossIsNamedAsItWouldBeWithoutItsSign) {
  // -a b is seen of a loss a and a gain b: a db + b da.
  EXPECT_THAT(said(Matrix{{4.0, -0.5}}, Vector{{-0.5, 4.0}}, {"a", "b"}),
              ElementsAre("a and b only as a*b"));
  // u / b^2 and b c, of a store that nobody measured and its root.
  EXPECT_THAT(said(Matrix{{4.0, 4.0, 0.0}, {0.0, 3.0, -0.5}}, Vector{{0.25, -0.5, 3.0}},
                   {"u", "b", "c"}),
              ElementsAre("u, b and c only as u/b^2 and b*c"));
}

TEST(Identifiability, ASumIsNamed) {
  EXPECT_THAT(said(Matrix{{1.0, 1.0}}, Vector{{3.0, 2.0}}, {"a", "b"}, true),
              ElementsAre("a and b only as a + b"));
}

TEST(Identifiability, WhatHasNoInfluenceIsNamedAloneAndWhatIsSeenIsNot) {
  EXPECT_THAT(said(Matrix{{1.0, 0.0}}, Vector{{3.0, 2.0}}, {"a", "b"}),
              ElementsAre("b: the records do not determine it"));
  EXPECT_TRUE(said(Matrix::Identity(2, 2), Vector{{3.0, 1e-9}}, {"a", "b"}).empty())
      << "a number may be 0";
  EXPECT_THAT(said(Matrix{{1.0, -1.5}, {1e-4, 0.0}}, Vector{{3.0, 2.0}}, {"a", "b"}),
              ElementsAre("a and b only as b/a"))
      << "known only together in practice";
}

TEST(Identifiability, ADirectionThatIsNotFiniteIsNoCrash) {
  const Matrix triangle = Matrix::Identity(2, 2);
  const Vector values = Vector::Ones(2);
  const std::vector<std::string> names{"a", "b"};
  const FitCombination found =
      combination_of({triangle, values, names}, Vector::Constant(2, std::nan("")));
  EXPECT_TRUE(found.members.empty());
  EXPECT_FALSE(found.message.empty());
}

// What is known of parameters and starts before a record is seen.
/// x = rate * t, measured with noise.
Dataset line_record(double rate, double first, std::uint64_t seed) {
  constexpr Index kSamples = 200;
  Random random(seed);
  Dataset data{"s", {{"x", ""}}, {}, {}, {}};
  Trajectory record{"line", sample_times(first, 0.01, kSamples), Matrix(kSamples, 1),
                    Matrix(kSamples, 0), Matrix()};
  for (Index i = 0; i < kSamples; ++i)
    record.states(i, 0) = rate * record.time[i] + 0.1 * random.normal();
  data.trajectories = {record};
  return data;
}

// The posterior of a linear model with normal noise is known: precisions add up, means are
// weighted by them.
TEST(KnownBefore, WhatIsKnownOfAParameterBeforeWeighsAsItsPrecision) {
  const Dataset data = line_record(2.0, 0.0, 3);
  const Trajectory& line = data.trajectories[0];
  for (const double deviation : {0.003, 0.01, 100.0}) {
    const std::string text = "param a = 1.998 +- " + std::to_string(deviation) +
                             "\ndx/dt = a\ninitial x = 0 at 0 fixed\n";
    const Fit found = fit(parse_ode_system(text, "m.ode"), data, {});
    const double sigma = found.quality[0].rmse;
    const double information = line.time.squaredNorm() / (sigma * sigma);
    const double prior = 1.0 / (deviation * deviation);
    const double mean = (line.time.dot(line.states.col(0)) / (sigma * sigma) + 1.998 * prior) /
                        (information + prior);
    const FittedParameter& a = found.numbers.at(0);
    EXPECT_NEAR(a.value, mean, 1e-4) << deviation;
    ASSERT_TRUE(a.standard_error) << deviation;
    EXPECT_NEAR(*a.standard_error, 1.0 / std::sqrt(information + prior),
                0.05 * *a.standard_error)
        << deviation;
    ASSERT_EQ(found.model.parameters().size(), 1u);
    EXPECT_FALSE(found.model.parameters()[0].deviation) << "part of the estimate now";
  }
}

// Correlated residuals say how far a parameter may be off by the record; where the prior says
// far more than that, its deviation is the error.
TEST(KnownBefore, APriorIsPartOfTheErrorWhereResidualsAreCorrelated) {
  Dataset data = line_record(2.0, 0.0, 3);
  Trajectory& line = data.trajectories[0];
  line.states.col(0).array() += 0.3 * (8.0 * line.time.array()).sin();
  const Fit found = fit(parse_ode_system("param a = 2 +- 0.0003\ndx/dt = a\n"
                                         "initial x = 0 at 0 fixed\n",
                                         "m.ode"),
                        data, {});
  EXPECT_FALSE(found.quality[0].white);
  ASSERT_TRUE(found.numbers.at(0).standard_error);
  EXPECT_NEAR(*found.numbers.at(0).standard_error, 0.0003, 0.00005);
}

// The product of a lognormal and a normal density has its maximum where the sum of both scores
// is 0.
TEST(KnownBefore, AFactorIsANormalPriorOfTheLogarithm) {
  const Dataset data = line_record(2.0, 0.0, 3);
  const Trajectory& line = data.trajectories[0];
  const double log_factor = std::log(1.002);
  const Fit found = fit(parse_ode_system("param a = 1.99 */ 1.002\ndx/dt = a\n"
                                         "initial x = 0 at 0 fixed\n",
                                         "m.ode"),
                        data, {});
  const double sigma = found.quality[0].rmse;
  const auto score = [&](double a) {
    return line.time.dot(line.states.col(0) - a * line.time) / (sigma * sigma) -
           std::log(a / 1.99) / (log_factor * log_factor * a);
  };
  double low = 1.9, high = 2.1;
  while (high - low > 1e-9) (score(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  EXPECT_NEAR(found.numbers.at(0).value, low, 1e-4);
  const double information =
      line.time.squaredNorm() / (sigma * sigma) + 1.0 / std::pow(log_factor * low, 2);
  ASSERT_TRUE(found.numbers[0].standard_error);
  EXPECT_NEAR(*found.numbers[0].standard_error, 1.0 / std::sqrt(information),
              0.05 / std::sqrt(information));
  EXPECT_FALSE(found.model.parameters().at(0).factor) << "part of the estimate now";
}

TEST(KnownBefore, APriorHoldsTheParameterOfEachRecord) {
  Dataset data = line_record(2.0, 0.0, 3);
  data.trajectories.push_back(line_record(3.0, 0.0, 4).trajectories[0]);
  const Fit found =
      fit(parse_ode_system(
              "param a = 2.5 +- 0.001 per_record\ndx/dt = a\ninitial x = 0 fixed\n", "m.ode"),
          data, {});
  ASSERT_EQ(found.numbers.at(0).per_record.size(), 2u);
  EXPECT_NEAR(found.numbers.at(0).per_record[0], 2.5, 0.05);
  EXPECT_NEAR(found.numbers.at(0).per_record[1], 2.5, 0.05);
}

TEST(KnownBefore, TheStartOfTheModelMayLieBeforeTheFirstSample) {
  const Dataset data = line_record(2.0, 0.5, 3);
  const SystemModel system =
      parse_ode_system("param a = 1\ndx/dt = a\ninitial x = 0 at 0 fixed\n", "m.ode");
  const Fit found = fit(system, data, {});
  EXPECT_NEAR(found.numbers.at(0).value, 2.0, 4.0 * *found.numbers.at(0).standard_error);
  EXPECT_TRUE(found.quality[0].white);
  const Fit given_later = fit(system, data, {}, {.start_time = 0.5});
  EXPECT_GT(given_later.numbers.at(0).value, 2.1) << "0 at the first sample, where x is 1";
  EXPECT_THROW(fit(system, data, {}, {.start_time = 0.6}), DataError) << "behind a sample";
}

/// A model at its minimum on records, each channel in deviations of its residuals.
struct Settled {
  Settled(const std::string& text, const Dataset& data)
      : model(parse_ode_system(text, "m.ode").parametrised()),
        engine(fit_engine(model, fit_records(model, data))),
        unknowns(fit_unknowns(model, {})) {
    set_substeps(engine, 4);
    const Index records = engine.records.records();
    minimum = minimise(
        engine, unknowns,
        {model.values().transpose().replicate(records, 1), engine.records.starts}, {}, 50, {});
    engine.sigma = residual_rms(engine, unknowns, minimum.path);
    minimum.path = follow(engine, minimum.point, {});
    for (std::size_t i = 0; i < unknowns.global.size(); ++i)
      kept.push_back(static_cast<Index>(i));
    linear = linearise(engine, unknowns, minimum.point, minimum.path, {});
  }
  EstimatedSizes sizes() { return estimated_sizes(engine, unknowns, minimum, linear, kept); }

  ParametrisedModel model;
  FitEngine engine;
  FitUnknowns unknowns;
  FitMinimum minimum;
  std::vector<Index> kept;
  FitLinear linear;
};

/// Two channels of a decay that feeds a second state, in as many records.
Dataset records_of(Index count, const std::string& outputs, Index samples = 12) {
  const OdeModel truth =
      parse_ode("dx/dt = -0.5*x\ndz/dt = 0.5*x - 0.2*z\n" + outputs, "d.ode");
  Dataset all;
  for (Index r = 0; r < count; ++r) {
    const Dataset one = support::grey_box(
        truth, {.start = (Vector(2) << 2.0 + static_cast<double>(r), 0.5).finished(),
                .step = 0.4,
                .samples = samples,
                .noise = 0.05,
                .seed = static_cast<std::uint64_t>(r + 1)});
    if (r == 0)
      all = one;
    else
      all.trajectories.push_back(one.trajectories[0]);
  }
  return all;
}

constexpr const char* kModel =
    "param k = 0.6\nparam l = 0.25\ndx/dt = -k*x\ndz/dt = k*x - l*z\n";

/// The formulas of Kenward and Roger with the whole matrices: n values, all unknowns.
struct Whole {
  explicit Whole(Settled& at) {
    const Index m = at.engine.states(), records = at.engine.records.records(), g = 2;
    const Index n = at.engine.records.samples(), c = at.engine.count();
    Matrix x = Matrix::Zero(n * c, records * m + g);
    for (Index r = 0; r < records; ++r)
      sensitivities(at.engine, at.minimum.point, at.minimum.path, {}, r,
                    [&](Index sample, const Matrix& rows, const Vector&) {
                      for (Index k = 0; k < c; ++k) {
                        x.row(k * n + sample).segment(r * m, m) = rows.row(k).head(m);
                        x.row(k * n + sample).tail(g) = rows.row(k).tail(g);
                      }
                    });
    const Matrix phi = (x.transpose() * x).inverse();
    const Matrix hat = x * phi * x.transpose();
    Matrix information(c, c);
    for (Index i = 0; i < c; ++i)
      for (Index j = 0; j < c; ++j)
        information(i, j) =
            0.5 * hat.block(i * n, j * n, n, n).squaredNorm() +
            (i == j ? 0.5 * static_cast<double>(n) - hat.block(i * n, i * n, n, n).trace()
                    : 0.0);
    const Matrix w = information.inverse();
    const double part = (static_cast<double>(n * c - x.cols())) / static_cast<double>(n * c);
    Matrix sum = Matrix::Zero(x.cols(), x.cols());
    for (Index i = 0; i < c; ++i) {
      const Matrix rows = x.middleRows(i * n, n), q = rows.transpose() * rows;
      const double taken = hat.block(i * n, i * n, n, n).trace();
      const double ratio = part * static_cast<double>(n) / (static_cast<double>(n) - taken);
      sum += (ratio - 1.0 + 2.0 * w(i, i)) * q;
      for (Index j = 0; j < c; ++j) {
        const Matrix other = x.middleRows(j * n, n);
        sum -= 2.0 * w(i, j) * q * phi * (other.transpose() * other);
      }
    }
    added = (phi * sum * phi).bottomRightCorner(g, g);
  }
  Matrix added;
};

TEST(EstimatedSizes, AreTheFormulasWithWholeMatrices) {
  Settled at(kModel + std::string("y = x\nz = z\n"), records_of(2, "y = x\nz = z\n"));
  const Matrix expected = Whole(at).added, found = at.sizes().added;
  EXPECT_GT(expected(0, 0), 0.0);
  EXPECT_LT((found - expected).norm(), 1e-6 * expected.norm());
}

TEST(EstimatedSizes, OneChannelHasTheDegreesOfFreedomOfStudentsQuantile) {
  Settled at(kModel + std::string("y = x + z\n"), records_of(1, "y = x + z\n"));
  const EstimatedSizes found = at.sizes();
  for (const double freedom : found.freedom) EXPECT_NEAR(freedom, 12.0 - 4.0, 1e-6);
  EXPECT_LT(found.added.cwiseAbs().maxCoeff(),
            1e-9 * (at.linear.reduced.topLeftCorner(2, 2).inverse()).squaredNorm());
}

TEST(EstimatedSizes, KnownDeviationsCostNothing) {
  Settled at(kModel + std::string("y = x noise constant 0.05\nz = z noise constant 0.05\n"),
             records_of(1, "y = x\nz = z\n"));
  EXPECT_EQ(at.sizes().added.norm(), 0.0);
}

}  // namespace
}  // namespace lacuna
