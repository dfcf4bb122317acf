// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/regressor.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/options.hpp"
#include "systems.hpp"

namespace lacuna {
namespace {

struct DirectOptions {
  static constexpr StageInfo kInfo{"direct", "", ""};
  bool forget_a_term = false;
  void describe(OptionVisitor& v) { v.field({"forget_a_term", "", ""}, forget_a_term); }
};

class Direct final : public Configured<Regressor, DirectOptions> {
 public:
  using Configured::Configured;

 private:
  Regression do_fit(const LeastSquaresSystem&, const Subproblem& problem, Effort,
                    const RunContext&) const override {
    Regression result{problem.active(), problem.solve(), problem.residual_norm()};
    if (options().forget_a_term) result.active.pop_back();
    return result;
  }
};

TEST(Regressor, EmptySetLeavesTheTarget) {
  const LeastSquaresSystem system = small_system();
  const Regression result = Direct{}.fit(system, system.subproblem(1, {}));
  EXPECT_TRUE(result.active.empty());
  EXPECT_EQ(result.coefficients.size(), 0);
  EXPECT_TRUE(result.converged);
  EXPECT_DOUBLE_EQ(result.residual_norm, system.factor().target_norms[1]);
}

TEST(Regressor, SubproblemMustComeFromTheSystem) {
  const LeastSquaresSystem system = small_system();
  const LeastSquaresSystem other(make_row_source(Matrix::Random(9, 3), Matrix::Random(9, 2)),
                                 {"a", "b", "c"}, {"p", "q"});
  EXPECT_THROW(Direct{}.fit(other, system.subproblem(0, {0, 2})), ArgumentError);
}

TEST(Regressor, ResultMustBeComplete) {
  const LeastSquaresSystem system = small_system();
  const Direct broken{{.forget_a_term = true}};
  EXPECT_THROW(broken.fit(system, system.subproblem(0, {0, 2})), ArgumentError);
}

}  // namespace
}  // namespace lacuna
