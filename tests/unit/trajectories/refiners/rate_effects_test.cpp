// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/QR>

#include "lacuna/bases/monomials.hpp"
#include "support/noisy_records.hpp"
#include "trajectories/subset_selection/negligible_columns.hpp"

namespace lacuna {
namespace {

/// Values of a term at all nodes of the path.
Vector values_of(const std::string& term, const WindowSearch& search) {
  std::vector<double> values;
  for (const SampleWindow& window : search.path.windows) {
    const PathRecord& record = search.path.records[window.record];
    const Index nodes = (window.samples - 1) * record.stride() + 1;
    for (Index i = 0; i < nodes; ++i) {
      const double x = record.slots(window.first * record.stride() + i, 0);
      const double y = record.slots(window.first * record.stride() + i, 1);
      values.push_back(term == "x" ? x : term == "y" ? y : x * x * y);
    }
  }
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

TEST(RateEffects, AreWhatTheOtherTermsCannotSay) {
  const Dataset data = noisy_record("van-der-pol", 300, 0.01, 1);
  const TermLibrary library = Monomials{}.library({{"x", "y"}, {}});
  const SearchTask task = search_task(data, {library}, analyse_noise(data), {});
  WindowSearch search = prepared_search(task);
  search.path.windows = windows_of(search.path.records, 50);
  search.fit.coefficients = Matrix::Zero(2, library.size());
  const auto place = [&](const std::string& name) {
    const std::vector<std::string> names = library.names();
    return std::find(names.begin(), names.end(), name) - names.begin();
  };
  const std::vector<Coefficient> columns = {
      {1, place("x")}, {0, place("y")}, {1, place("x^2*y")}, {1, place("y")}};
  const RateEffects effects(search, columns);

  const Vector h = Eigen::Vector3d(-1.0, -2.0, 2.0);
  const Vector fractions = effects.fractions({0, 2, 3}, h);
  const std::string names[] = {"x", "x^2*y", "y"};
  Matrix theta(values_of("x", search).size(), 3);
  for (Index i = 0; i < 3; ++i) theta.col(i) = values_of(names[i], search);
  const double rate = (theta * h).norm();
  for (Index i = 0; i < 3; ++i) {
    Matrix others(theta.rows(), 2);
    others << theta.col((i + 1) % 3), theta.col((i + 2) % 3);
    const Vector left =
        theta.col(i) - others * others.colPivHouseholderQr().solve(Vector(theta.col(i)));
    EXPECT_NEAR(fractions[i], std::abs(h[i]) * left.norm() / rate, 1e-9);
  }
  // Alone in its equation a term is the whole rate.
  EXPECT_NEAR(effects.fractions({1}, Vector::Constant(1, 0.7))[0], 1.0, 1e-12);
}

}  // namespace
}  // namespace lacuna
