// SPDX-License-Identifier: MIT
#include "trajectories/fit/estimated_sizes.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "support/grey_box.hpp"
#include "trajectories/fit/fit_search.hpp"

namespace lacuna {
namespace {

/// A model at its minimum on records, each channel in deviations of its residuals.
struct Settled {
  Settled(const std::string& text, const Dataset& data)
      : model(parse_ode_system(text, "m.ode").parametrised()),
        engine(fit_engine(model, fit_records(model, data))),
        unknowns(fit_unknowns(model, {})) {
    set_substeps(engine, 4);
    const Index records = engine.records.records();
    minimum = minimise(engine, unknowns,
                       {model.values().transpose().replicate(records, 1), engine.records.starts},
                       {}, 50, {});
    engine.sigma = residual_rms(engine, unknowns, minimum.path);
    minimum.path = follow(engine, minimum.point, {});
    for (std::size_t i = 0; i < unknowns.global.size(); ++i) kept.push_back(static_cast<Index>(i));
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
            (i == j ? 0.5 * static_cast<double>(n) - hat.block(i * n, i * n, n, n).trace() : 0.0);
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
