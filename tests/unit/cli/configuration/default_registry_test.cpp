// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "lacuna/cli/configuration/registry.hpp"

namespace lacuna {
namespace {

void expect_names(const std::string& kind, const std::vector<std::string>& expected) {
  const std::vector<std::string> names = default_registry().names(kind);
  for (const std::string& name : expected)
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << kind << " " << name;
}

TEST(DefaultRegistry, HasThePartsOfTheFirstShelf) {
  expect_names("basis", {"monomials", "expressions", "chebyshev", "legendre", "hermite", "radial",
                         "piecewise-linear", "real-powers", "sum", "product"});
  expect_names("formulation", {"strong"});
  expect_names("differentiator",
               {"finite-differences", "savitzky-golay", "smoothing-spline", "whittaker", "kalman",
                "trend-filter", "local-polynomial", "spectral", "auto"});
  expect_names("filter", {"abm", "svd", "vca", "none"});
  expect_names("regressor", {"ols", "irls", "irls-l1", "stlsq"});
  expect_names("l1-solver", {"coordinate-descent", "ceres", "nlopt"});
  expect_names("pruner", {"minor-terms", "sequential-thresholding", "information-criterion",
                          "cross-validation", "keep-all"});
  expect_names("integrator", {"rk4", "dopri5", "dopri8"});
}

}  // namespace
}  // namespace lacuna
