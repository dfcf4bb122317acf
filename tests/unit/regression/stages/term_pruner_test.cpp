// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/term_pruner.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/options.hpp"
#include "systems.hpp"

namespace lacuna {
namespace {

inline constexpr StageInfo kIdle{"idle", "", ""};

class Idle final : public Configured<Regressor, NoOptions<kIdle>> {
  Regression do_fit(const LeastSquaresSystem&, const Subproblem& problem, Effort,
                    const RunContext&) const override {
    return {problem.active(), problem.solve(), problem.residual_norm()};
  }
};

struct KeepOptions {
  static constexpr StageInfo kInfo{"keep", "", ""};
  int lost = 0;  ///< terms that vanish without a reason
  void describe(OptionVisitor& v) { v.field({"lost", "", ""}, lost); }
};

class Keep final : public Configured<TermPruner, KeepOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem&, Index, const TermSet& active,
                       const Regressor&, const RunContext&) const override {
    return {TermSet(active.begin() + options().lost, active.end()), {}};
  }
};

TEST(TermPruner, NothingToChooseFromIsNotAskedFor) {
  EXPECT_TRUE(Keep{{.lost = 1}}.prune(small_system(), 0, {}, Idle{}).kept.empty());
}

TEST(TermPruner, ArgumentsMustFitTheSystem) {
  EXPECT_THROW(Keep{}.prune(small_system(), 2, {0}, Idle{}), ArgumentError);
  EXPECT_THROW(Keep{}.prune(small_system(), 0, {0, 3}, Idle{}), ArgumentError);
  EXPECT_THROW(Keep{}.prune(small_system(), 0, {2, 0}, Idle{}), ArgumentError);
}

TEST(TermPruner, EveryTermMustBeAccountedFor) {
  EXPECT_THROW(Keep{{.lost = 1}}.prune(small_system(), 0, {0, 2}, Idle{}), ArgumentError);
}

}  // namespace
}  // namespace lacuna
