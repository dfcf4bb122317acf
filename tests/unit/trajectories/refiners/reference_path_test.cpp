// SPDX-License-Identifier: MIT
#include "trajectories/refiners/reference_path.hpp"

#include <gtest/gtest.h>

#include "lacuna/model/equations/term.hpp"

namespace lacuna {
namespace {

/// dx/dt = u, u held at 0, 0, 3, 3, -1 over steps of 0.1.
Dataset ramp(std::optional<Hold> hold) {
  Dataset data;
  data.states = {{"x", ""}};
  data.inputs = {{"u", "", hold}};
  Trajectory record;
  record.time = Vector{{0.0, 0.1, 0.2, 0.3, 0.4, 0.5}};
  record.inputs = Vector{{0.0, 0.0, 3.0, 3.0, -1.0, -1.0}};
  record.states = Vector{{0.0, 0.0, 0.0, 0.3, 0.6, 0.5}};
  data.trajectories = {record};
  return data;
}

Vector input_nodes(const Dataset& data, Index substeps) {
  TermLibrary library{{{"x"}, {"u"}}, {}};
  library.terms = {Term::parse("u", library.variables)};
  const Program program = library.compile();
  PathRecord path = make_paths(data, {Matrix::Zero(6, 1)}, program)[0];
  if (substeps > 1) set_substeps(path, substeps, program);
  return path.slots.col(1);
}

/// Simpson's rule over the nodes gives the ramp, in however many parts.
TEST(ReferencePath, TheIntegralOfAHeldInputIsTheRamp) {
  for (const Index substeps : {1, 2, 5}) {
    const Vector u = input_nodes(ramp(Hold::Zero), substeps);
    const double part = 0.1 / static_cast<double>(substeps);
    ASSERT_EQ(u.size(), 10 * substeps + 1);
    double x = 0.0;
    for (Index i = 0; i + 2 < u.size(); i += 2)
      x += part / 6.0 * (u[i] + 4.0 * u[i + 1] + u[i + 2]);
    EXPECT_NEAR(x, 0.5, 1e-12) << substeps;
  }
}

}  // namespace
}  // namespace lacuna
