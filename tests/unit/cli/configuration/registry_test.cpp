// SPDX-License-Identifier: MIT
#include "lacuna/cli/configuration/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cli/configuration/variants.hpp"
#include "lacuna/cli/configuration/configuration.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "solvers/irls_l1.hpp"
#include "solvers/ols.hpp"
#include "solvers/stlsq.hpp"
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

void expect_names(const std::string& kind, const std::vector<std::string>& expected) {
  const std::vector<std::string> names = default_registry().names(kind);
  for (const std::string& name : expected)
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << kind << " " << name;
}

TEST(DefaultRegistry, HasThePartsOfTheFirstShelf) {
  expect_names("basis", {"monomials", "expressions", "chebyshev", "legendre", "hermite",
                         "radial", "piecewise-linear", "real-powers", "sum", "product"});
  expect_names("formulation", {"strong"});
  expect_names("differentiator",
               {"finite-differences", "savitzky-golay", "smoothing-spline", "whittaker",
                "kalman", "trend-filter", "local-polynomial", "spectral", "auto"});
  expect_names("filter", {"abm", "svd", "vca", "none"});
  expect_names("regressor", {"ols", "irls", "irls-l1", "stlsq"});
  expect_names("l1-solver", {"coordinate-descent", "ceres", "nlopt"});
  expect_names("pruner", {"minor-terms", "sequential-thresholding", "information-criterion",
                          "cross-validation", "keep-all"});
  expect_names("integrator", {"rk4", "dopri5", "dopri8"});
}

const StageVariant* find(const std::vector<StageVariant>& all, const std::string& label) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const auto& variant) { return variant.label == label; });
  return found == all.end() ? nullptr : &*found;
}

TEST(Variants, NestedStagesAppearOncePerRegisteredInnerStage) {
  const Registry registry = default_registry();
  const auto all = variants(registry, "regressor");
  for (const std::string& inner : registry.names("l1-solver")) {
    const StageVariant* variant = find(all, "irls-l1[" + inner + "]");
    ASSERT_NE(variant, nullptr) << inner;
    if (!variant->unavailable.empty()) continue;
    const auto& stage = dynamic_cast<const IrlsL1&>(*variant->stage);
    EXPECT_EQ(stage.options().inner->info().name, inner);
  }
  EXPECT_EQ(find(all, "irls-l1"), nullptr);
}

TEST(Variants, StagesOfTheirOwnKindStayAsTheyAre) {
  const auto all = variants(default_registry(), "basis");
  ASSERT_NE(find(all, "sum"), nullptr);
  EXPECT_TRUE(find(all, "sum")->unavailable.empty());
  EXPECT_EQ(all.size(), default_registry().names("basis").size());
}

// Every kind of option, read from JSON through a basis made for it.
enum class Colour { Red, Green };

struct ProbeOptions {
  static constexpr StageInfo kInfo{"probe", "Has an option of every kind.", ""};
  static constexpr std::array<std::string_view, 2> kColours{"red", "green"};
  double number = 1.0;
  int whole = 2;
  bool flag = false;
  std::string text = "a";
  std::optional<double> maybe_number = {};
  std::optional<int> maybe_whole = 7;
  std::vector<std::string> list = {};
  Colour colour = Colour::Red;

  void describe(OptionVisitor& v) {
    v.field({"number", "s", "A number.", 0.0, 10.0}, number);
    v.field({"whole", "", "A whole number.", 0.0}, whole);
    v.field({"flag", "", "A flag."}, flag);
    v.field({"text", "", "A text."}, text);
    v.field({"maybe_number", "", "A number or none.", 0.0}, maybe_number);
    v.field({"maybe_whole", "", "A whole number or none."}, maybe_whole);
    v.field({"list", "", "Some texts."}, list);
    v.field({"colour", "", "A choice."}, kColours, colour);
  }
};

class Probe final : public Configured<Basis, ProbeOptions> {
 public:
  using Configured::Configured;

 private:
  std::vector<Term> do_terms(const Variables&) const override { return {}; }
};

ProbeOptions read(const std::string& fields) {
  Registry registry = default_registry();
  registry.add<Probe>();
  Configuration configuration;
  configuration.merge_text(R"({"basis": {"type": "probe")" + fields + "}}", "test");
  const Pipeline pipeline = configuration.build(registry);
  return dynamic_cast<const Probe&>(*pipeline.basis).options();
}

TEST(OptionReader, LeavesDefaultsWhereNothingIsGiven) {
  const ProbeOptions options = read("");
  EXPECT_EQ(options.number, 1.0);
  EXPECT_EQ(options.maybe_whole, 7);
  EXPECT_FALSE(options.maybe_number);
}

TEST(OptionReader, ReadsEveryKind) {
  const ProbeOptions options = read(
      R"(, "number": 2.5, "whole": 4.0, "flag": true, "text": "b", "maybe_number": 0.5,
          "maybe_whole": null, "list": ["x", "y"], "colour": "green")");
  EXPECT_EQ(options.number, 2.5);
  EXPECT_EQ(options.whole, 4);
  EXPECT_TRUE(options.flag);
  EXPECT_EQ(options.text, "b");
  EXPECT_EQ(options.maybe_number, 0.5);
  EXPECT_FALSE(options.maybe_whole);
  EXPECT_EQ(options.list, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(options.colour, Colour::Green);
}

TEST(OptionReader, AListMayBeWrittenAsOneText) {
  EXPECT_EQ(read(R"(, "list": "max(x,y), 1")").list,
            (std::vector<std::string>{"max(x,y)", "1"}));
  EXPECT_EQ(read(R"(, "list": 1)").list, std::vector<std::string>{"1"});
}

TEST(OptionReader, RefusesOtherTypes) {
  const std::vector<std::array<std::string, 2>> wrong = {
      {"number", "true"},     {"number", "null"},      {"whole", "1.5"}, {"whole", "1e300"},
      {"flag", "1"},          {"text", "3"},           {"list", "[1]"},  {"colour", "1"},
      {"maybe_number", "[]"}, {"maybe_whole", "\"x\""}};
  for (const auto& entry : wrong)
    expect_error<ConfigError>([&] { read(", \"" + entry[0] + "\": " + entry[1]); },
                              "$.basis." + entry[0], "is not", "give");
}

TEST(OptionReader, ChecksRanges) {
  expect_error<ConfigError>([] { read(R"(, "number": 11)"); }, "$.basis.number", "11",
                            "between 0 and 10");
  EXPECT_THROW(read(R"(, "whole": -1)"), ConfigError);
  EXPECT_THROW(read(R"(, "maybe_number": -1)"), ConfigError);
}

TEST(OptionReader, RefusesNamesThatAreNotText) {
  Configuration configuration;
  configuration.merge_text(R"({"basis": {"type": 3}})", "test");
  expect_error<ConfigError>([&] { configuration.build(default_registry()); }, "$.basis.type",
                            "3", "text");
}

}  // namespace
}  // namespace lacuna
