// SPDX-License-Identifier: MIT
// Passes over rows that a team divides give to the bit what one process gets.
#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/error.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/linear/subproblem.hpp"
#include "regression/linear/column_range.hpp"
#include "support/thread_team.hpp"

namespace lacuna {
namespace {

constexpr Index kRows = 5 * 32768 + 100;

struct TeamRows {
  Matrix theta = Matrix::Random(kRows, 4);
  Matrix targets = Matrix::Random(kRows, 2);

  std::shared_ptr<const RowSource> source() const { return make_row_source(theta, targets); }
  LeastSquaresSystem system(const RunContext& context, Folding folding) const {
    return {source(), {"a", "b", "c", "d"}, {"p", "q"}, context, folding};
  }
};

TEST(TeamOfProcesses, FactorsRefinementsAndResidualsAreThoseOfOne) {
  const TeamRows rows;
  for (const Folding folding :
       {Folding::Gram, Folding::Orthogonal, Folding::Deflated, Folding::Automatic}) {
    const LeastSquaresSystem alone = rows.system({}, folding);
    const Subproblem problem = alone.subproblem(1, {0, 2, 3});
    const Vector h = problem.solve();
    testing::ThreadTeam(3).run(2, [&](const RunContext& context) {
      const LeastSquaresSystem system = rows.system(context, folding);
      EXPECT_EQ(system.factor().triangle, alone.factor().triangle);
      EXPECT_EQ(system.factor().target_norms, alone.factor().target_norms);
      EXPECT_EQ(system.refined(problem, h, context), alone.refined(problem, h));
      EXPECT_EQ(system.residuals(1, {0, 2, 3}, h, context), alone.residuals(1, {0, 2, 3}, h));
      const auto cauchy = [](const Eigen::Ref<const Vector>& r, Eigen::Ref<Vector> w) {
        w = (1.0 + r.array().square()).inverse();
      };
      EXPECT_EQ(system.reweighted(problem, h, cauchy, context).solve(),
                alone.reweighted(problem, h, cauchy).solve());
    });
  }
}

TEST(TeamOfProcesses, RangesOfColumnsAndWhatIsNotFiniteAreFoundByAll) {
  TeamRows rows;
  rows.theta.col(2) *= 1e150;
  const auto name = [](Index column) { return "column " + std::to_string(column); };
  const std::vector<int> expected = scan_columns(*rows.source(), name);
  testing::ThreadTeam(3).run(1, [&](const RunContext& context) {
    EXPECT_EQ(scan_columns(*rows.source(), name, context), expected);
  });
  rows.theta(100000, 3) = std::numeric_limits<double>::quiet_NaN();
  testing::ThreadTeam(3).run(1, [&](const RunContext& context) {
    try {
      scan_columns(*rows.source(), name, context);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const DataError& error) {
      EXPECT_EQ(error.where(), "column 3, row 100001");
    }
  });
}

}  // namespace
}  // namespace lacuna
