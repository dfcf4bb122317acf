// SPDX-License-Identifier: MIT
#include "lacuna/core/base/stage.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string_view>
#include <type_traits>

#include "lacuna/core/base/options.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

class Scaler : public StageInterface {
 public:
  static constexpr std::string_view kKind = "scaler";
  virtual double scale(double x) const = 0;
};

struct FactorOptions {
  static constexpr StageInfo kInfo{"factor", "Multiplies.", "none"};
  double factor = 2.0;
  void describe(OptionVisitor& v) { v.field({"factor", "", "The factor.", 0.0}, factor); }
};

class Factor final : public Configured<Scaler, FactorOptions> {
 public:
  using Configured::Configured;
  double scale(double x) const override { return options().factor * x; }
};

TEST(Stage, HoldsAnyConcreteStage) {
  const Stage<Scaler> stage = Factor{{.factor = 3.0}};
  EXPECT_EQ(stage->scale(2.0), 6.0);
  EXPECT_EQ((*stage).info().name, "factor");
}

TEST(Stage, CopiesShareOneObject) {
  const Stage<Scaler> stage = Factor{};
  const Stage<Scaler> copy =
      stage;  // NOLINT(performance-unnecessary-copy-initialization): tested
  EXPECT_EQ(copy.shared().get(), stage.shared().get());
}

TEST(Stage, IsNeverNullAndNeverForgotten) {
  testing::expect_error<ArgumentError>([] { Stage<Scaler>(std::shared_ptr<const Scaler>()); },
                                       "scaler", "no stage given", "");
  EXPECT_FALSE((std::is_default_constructible_v<Stage<Scaler>>));
}

TEST(Stage, RefusesOptionsOutOfRange) {
  testing::expect_error<ConfigError>([] { Factor{{.factor = -1.0}}; }, "factor.factor",
                                     "-1 is out of range", "at least 0");
}

}  // namespace
}  // namespace lacuna
