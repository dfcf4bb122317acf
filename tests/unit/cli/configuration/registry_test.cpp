// SPDX-License-Identifier: MIT
#include "lacuna/cli/configuration/registry.hpp"

#include <algorithm>

#include "lacuna/solvers/ols.hpp"
#include "lacuna/solvers/stlsq.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

/// A stage that this build does not have.
struct AbsentOptions {
  static constexpr StageInfo kInfo{"absent", "Is never there.", ""};
  void describe(OptionVisitor&) {}
};

class Absent final : public Configured<Regressor, AbsentOptions> {
 public:
  using Configured::Configured;
  static std::string unavailable() { return "built without it"; }

 private:
  Regression do_fit(const LeastSquaresSystem&, const Subproblem&, Effort,
                    const RunContext&) const override {
    return {};
  }
};

Registry small_registry() {
  Registry registry;
  StlsqOptions options;
  options.threshold = 0.3;
  registry.add<Stlsq>(options);
  registry.add<Ols>();
  registry.add<Absent>();
  return registry;
}

TEST(Registry, OrdersByKindAndName) {
  EXPECT_EQ(small_registry().names("regressor"),
            (std::vector<std::string>{"absent", "ols", "stlsq"}));
  EXPECT_EQ(small_registry().kinds(), std::vector<std::string>{"regressor"});
}

TEST(Registry, MakesStagesWithTheDefaultsItWasGiven) {
  const Stage<Regressor> stage = small_registry().make<Regressor>("stlsq");
  EXPECT_EQ(dynamic_cast<const Stlsq&>(*stage).options().threshold, 0.3);
}

TEST(Registry, MakesAllOfAKindThatAreThere) {
  const auto all = small_registry().make_all<Regressor>();
  ASSERT_EQ(all.size(), 2u) << "without the one that is unavailable";
  EXPECT_EQ(all[0]->info().name, "ols");
  EXPECT_EQ(dynamic_cast<const Stlsq&>(*all[1]).options().threshold, 0.3);
}

TEST(Registry, RefusesANameTwice) {
  Registry registry = small_registry();
  expect_error<ConfigError>([&] { registry.add<Ols>(); }, "regressor", "registered already",
                            "another name");
}

TEST(Registry, SuggestsTheNearestName) {
  const Registry registry = small_registry();
  expect_error<ConfigError>([&] { registry.find("regressor", "stslq"); }, "regressor",
                            "no regressor called 'stslq'", "stlsq");
  expect_error<ConfigError>([&] { registry.find("regresor", "ols"); }, "registry",
                            "no kind of part called 'regresor'", "regressor");
}

TEST(Registry, SaysWhyAPartIsUnavailable) {
  const Registry registry = small_registry();
  EXPECT_EQ(registry.find("regressor", "absent").unavailable, "built without it");
  expect_error<ConfigError>([&] { registry.make<Regressor>("absent"); }, "regressor",
                            "built without it", "choose another");
}

}  // namespace
}  // namespace lacuna
