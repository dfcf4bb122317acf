// SPDX-License-Identifier: MIT
#include "trajectories/shooting/cramer_rao.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "unit/trajectories/shooting/records.hpp"

namespace lacuna {
namespace {

/// dx/dt = a, x(t) = x0 + a t: the textbook variance of a slope.
TEST(CramerRao, IsTheTextbookVarianceOfASlope) {
  const Variables variables{{"x"}, {}};
  const OdeModel drift({{"x", ""}}, {}, {{{Term::parse("1", variables), 2.0}}});
  Dataset truth;
  truth.states = {{"x", ""}};
  const Index n = 50;
  const Vector time = Vector::LinSpaced(n, 0.0, 4.9);
  truth.trajectories.push_back({"run", time, 1.0 + (2.0 * time.array()), Matrix(n, 0), {}});
  const Vector bound = cramer_rao_bound(with_free_coefficients(drift), truth,
                                        Vector::Constant(1, 0.3), equal_windows({0, n}, n));
  const double spread = (time.array() - time.mean()).matrix().squaredNorm();
  EXPECT_NEAR(bound[0], 0.3 / std::sqrt(spread), 1e-9);
}

TEST(CramerRao, FewerInitialStatesTellMore) {
  const TestSystem& system = test_system("lorenz");
  const ParametrisedModel model = with_free_coefficients(system.model);
  const Dataset truth = testing::clean_record(system.model, system, 400);
  const Vector sigma = Vector::Ones(3);
  const Vector short_windows =
      cramer_rao_bound(model, truth, sigma, equal_windows({0, 400}, 50));
  const Vector whole = cramer_rao_bound(model, truth, sigma, equal_windows({0, 400}, 400));
  EXPECT_TRUE((whole.array() < short_windows.array()).all());
  EXPECT_THROW(cramer_rao_bound(model, truth, Vector::Ones(2), equal_windows({0, 400}, 400)),
               ArgumentError);
}

}  // namespace
}  // namespace lacuna
