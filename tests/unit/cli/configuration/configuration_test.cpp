// SPDX-License-Identifier: MIT
#include "lacuna/cli/configuration/configuration.hpp"

#include "bases/expressions.hpp"
#include "bases/monomials.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "regression/formulations/strong_form.hpp"
#include "regression/pruners/minor_terms.hpp"
#include "report/json/stage_json.hpp"
#include "solvers/irls_l1.hpp"
#include "solvers/l1/l1_nlopt.hpp"
#include "solvers/stlsq.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

Pipeline build(const std::string& json) {
  Configuration configuration;
  configuration.merge_text(json, "test");
  return configuration.build(default_registry());
}

Pipeline build_set(const std::vector<std::string>& assignments) {
  Configuration configuration;
  for (const std::string& assignment : assignments) configuration.set(assignment);
  return configuration.build(default_registry());
}

template <class Concrete, class Interface>
const auto& options(const Stage<Interface>& stage) {
  return dynamic_cast<const Concrete&>(*stage).options();
}

std::optional<int> difference_order(const Pipeline& pipeline) {
  return options<FiniteDifferences>(options<StrongForm>(pipeline.formulation).differentiator)
      .order;
}

TEST(Configuration, EmptyIsAlgorithm1) {
  EXPECT_EQ(build("{}").filter->info().name, "abm");
  EXPECT_EQ(build("{}").pruner->info().name, "minor-terms");
}

TEST(Configuration, AFormattedPipelineGivesItselfBack) {
  for (const char* preset : {"algorithm1", "paper", "sindy", "robust"}) {
    const std::string whole =
        format_pipeline(build(std::string(R"({"preset": ")") + preset + "\"}"));
    EXPECT_EQ(format_pipeline(build(whole)), whole);
  }
  const std::string other =
      format_pipeline(build(R"({"formulation": {"differentiator": {"order": 6}}})"));
  EXPECT_EQ(difference_order(build(other)), 6) << "options of stages inside stages, too";
}

TEST(Configuration, OptionsWithoutATypeChangeThoseOfThePreset) {
  const Pipeline pipeline = build(R"({"tolerances": "paper", "pruner": {"eta": 0.5}})");
  EXPECT_EQ(options<MinorTerms>(pipeline.pruner).eta, 0.5);
  EXPECT_EQ(options<MinorTerms>(pipeline.pruner).tolerances,
            MinorTermsOptions::Tolerances::Paper);
}

TEST(Configuration, AnotherTypeStartsAtItsDefaults) {
  const Pipeline pipeline = build(R"({"regressor": {"type": "stlsq", "threshold": 0.25}})");
  EXPECT_EQ(options<Stlsq>(pipeline.regressor).threshold, 0.25);
  EXPECT_EQ(options<Stlsq>(pipeline.regressor).max_iterations, StlsqOptions{}.max_iterations);
}

TEST(Configuration, AStageMayBeJustItsName) {
  EXPECT_EQ(build(R"({"regressor": "irls"})").regressor->info().name, "irls");
  const Pipeline nested = build(R"({"formulation": {"differentiator": "savitzky-golay"}})");
  EXPECT_EQ(options<StrongForm>(nested.formulation).differentiator->info().name,
            "savitzky-golay");
}

TEST(Configuration, ABackEndIsThereOrRefusedWithTheReason) {
  const char* json = R"({"regressor": {"type": "irls-l1", "inner": "nlopt"}})";
  if (NloptL1::unavailable().empty())
    EXPECT_EQ(options<IrlsL1>(build(json).regressor).inner->info().name, "nlopt");
  else
    expect_error<ConfigError>([&] { build(json); }, "$.regressor.inner", "built without NLopt",
                              "choose");
}

TEST(Configuration, NestedStagesAreOverriddenLikeOthers) {
  EXPECT_EQ(difference_order(build(R"({"formulation": {"differentiator": {"order": 6}}})")), 6);
  EXPECT_EQ(difference_order(build(R"({"differentiator": {"order": 8}})")), 8);
  const Pipeline smooth = build(R"({"differentiator": "savitzky-golay"})");
  EXPECT_EQ(options<StrongForm>(smooth.formulation).differentiator->info().name,
            "savitzky-golay");
}

TEST(Configuration, SetWritesOneValue) {
  EXPECT_EQ(difference_order(build_set({"formulation.differentiator.order=6"})), 6);
  EXPECT_EQ(build_set({"regressor.type=stlsq"}).regressor->info().name, "stlsq");
  const Pipeline pipeline = build_set({"regressor=stlsq", "regressor.threshold=0.05"});
  EXPECT_EQ(options<Stlsq>(pipeline.regressor).threshold, 0.05);
  const Pipeline other_way = build_set({"regressor.threshold=0.05", "regressor=stlsq"});
  EXPECT_EQ(options<Stlsq>(other_way.regressor).threshold, 0.05);
  EXPECT_EQ(build_set({"preset=sindy"}).filter->info().name, "none");
}

TEST(Configuration, NoValueIsGivenTwice) {
  const Pipeline pipeline = build_set({"regressor=irls", "regressor.delta=2"});
  EXPECT_EQ(pipeline.regressor->info().name, "irls");
  EXPECT_THROW(build_set({"differentiator.order=6", "differentiator.order=8"}), ConfigError);
  EXPECT_THROW(build_set({"regressor=irls", "regressor=ols"}), ConfigError);
}

TEST(Configuration, DegreeAndTermsChooseTheBasis) {
  Configuration configuration;
  configuration.set("basis.min_degree=1");
  configuration.set_degree(2);
  const auto monomials = configuration.build(default_registry()).basis;
  EXPECT_EQ(options<Monomials>(monomials).max_degree, 2);
  EXPECT_EQ(options<Monomials>(monomials).min_degree, 1);
  Configuration outright;
  outright.set_terms("max(x,y), 1");
  const auto terms = outright.build(default_registry()).basis;
  EXPECT_EQ(options<Expressions>(terms).terms, (std::vector<std::string>{"max(x,y)", "1"}));
}

TEST(Configuration, RemembersWhatWasAsked) {
  Configuration configuration;
  EXPECT_EQ(configuration.text(), "{}");
  configuration.set("regressor.threshold=0.05");
  const Configuration copy = configuration;
  EXPECT_EQ(copy.text(), R"({"regressor":{"threshold":0.05}})");
}

TEST(Configuration, UnknownKeysNameThePathAndTheNearest) {
  expect_error<ConfigError>([] { build(R"({"regresor": "ols"})"); }, "$.regresor", "regresor",
                            "regressor");
  expect_error<ConfigError>([] { build(R"({"regressor": {"type": "stlsq", "treshold": 1}})"); },
                            "$.regressor.treshold", "treshold", "threshold");
  expect_error<ConfigError>([] { build(R"({"differentiator": {"ordre": 4}})"); },
                            "$.formulation.differentiator.ordre", "ordre", "order");
  expect_error<ConfigError>([] { build(R"({"regressor": {"type": "lasso"}})"); }, "$.regressor",
                            "lasso", "known are");
  expect_error<ConfigError>([] { build(R"({"preset": "sindi"})"); }, "$.preset", "sindi",
                            "sindy");
  expect_error<ConfigError>([] { build(R"({"tolerances": "papers"})"); }, "$.tolerances",
                            "papers", "paper");
}

TEST(Configuration, WrongTypesAndRangesNameThePath) {
  expect_error<ConfigError>([] { build(R"({"basis": {"max_degree": "three"}})"); },
                            "$.basis.max_degree", "three", "whole number");
  expect_error<ConfigError>([] { build(R"({"basis": {"max_degree": 2.5}})"); },
                            "$.basis.max_degree", "2.5", "whole number");
  expect_error<ConfigError>([] { build(R"({"basis": {"max_degree": 1000}})"); },
                            "$.basis.max_degree", "out of range", "between");
  expect_error<ConfigError>([] { build(R"({"regressor": 3})"); }, "$.regressor", "3", "type");
  expect_error<ConfigError>([] { build(R"({"preset": 3})"); }, "$.preset", "3", "text");
  expect_error<ConfigError>([] { build(R"({"pruner": {"criterion": "best"}})"); },
                            "$.pruner.criterion", "best", "residual");
}

TEST(Configuration, SyntaxErrorsNameLineAndColumn) {
  Configuration configuration;
  expect_error<ConfigError>([&] { configuration.merge_text("{\n  \"a\": ]\n}", "c.json"); },
                            "c.json:2:8", "not valid JSON", "brackets");
  expect_error<ConfigError>([&] { configuration.merge_text("[1]", "c.json"); }, "c.json: $",
                            "JSON object", "preset");
}

TEST(Configuration, AssignmentsNeedAPathAndAValue) {
  Configuration configuration;
  expect_error<ConfigError>([&] { configuration.set("regressor"); }, "--set regressor",
                            "PATH=VALUE", "--set");
  EXPECT_THROW(configuration.set("=3"), ConfigError);
}

TEST(Configuration, ReadsFiles) {
  const testing::TemporaryFolder folder;
  Configuration configuration;
  configuration.merge_file(folder.write("c.json", R"({"regressor": "irls"})"));
  EXPECT_EQ(configuration.build(default_registry()).regressor->info().name, "irls");
  EXPECT_THROW(configuration.merge_file(folder.file("absent.json")), FileError);
}

TEST(Configuration, WhatIsGivenTwiceIsNamedTwice) {
  Configuration configuration;
  configuration.set("regressor=stlsq");
  configuration.set("regressor.threshold=0.1");
  expect_error<ConfigError>([&] { configuration.set("regressor.threshold=0.2"); },
                            "--set regressor.threshold=0.2",
                            "twice, first as 'regressor.threshold=0.1'", "keep one");
  configuration.set_equation("x: y");
  expect_error<ConfigError>([&] { configuration.set_equation(" x : 1"); }, "--equation  x : 1",
                            "the equation of 'x' is given twice, first as 'x: y'", "keep one");
  configuration.add_constraint("x: y = 1");
  configuration.add_constraint("x: x = 1");
  expect_error<ConfigError>([&] { configuration.add_constraint("x:y=2"); }, "--fix x:y=2",
                            "first as 'x: y = 1'", "keep one");
}

TEST(Configuration, ConstraintsAreEqualitiesOrBounds) {
  Configuration configuration;
  for (const char* text : {"x: y = 1", "y: x < 0", "y: x >= -3", "-2 y: z, x: z <= 4"})
    configuration.add_constraint(text);
  const auto found = configuration.build(default_registry()).constraints;
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].relation, ConstraintRelation::Equal);
  EXPECT_EQ(found[1].relation, ConstraintRelation::AtMost);
  EXPECT_EQ(found[1].summands[0].term, "x");
  EXPECT_EQ(found[2].relation, ConstraintRelation::AtLeast);
  EXPECT_EQ(found[2].value, -3.0);
  EXPECT_EQ(found[3].relation, ConstraintRelation::AtMost);
  ASSERT_EQ(found[3].summands.size(), 2u);
  EXPECT_EQ(found[3].summands[0].factor, -2.0);
  EXPECT_EQ(found[3].value, 4.0);
  Configuration wrong;
  wrong.add_constraint("y: x < z");
  expect_error<ConfigError>([&] { wrong.build(default_registry()); }, "$.constraints[0]",
                            "what stands behind < is no number", "w: u = 1");
}

TEST(Configuration, AKeyThatStandsTwiceHasAPath) {
  Configuration configuration;
  expect_error<ConfigError>(
      [&] { configuration.merge_text(R"({"basis": {"type": "a", "type": "b"}})", "c.json"); },
      "c.json: $.basis.type", "twice", "remove one");
  configuration.merge_text("\xEF\xBB\xBF{}", "c.json");
}

TEST(Configuration, OptionsThatContradictOneAnotherAreRefused) {
  const auto refused = [](const std::function<void(Configuration&)>& second,
                          const std::string& place, const std::string& path) {
    Configuration configuration;
    configuration.set_degree(3);
    expect_error<ConfigError>([&] { second(configuration); }, place, "'" + path + "'",
                              "keep one");
  };
  refused([](Configuration& c) { c.set("basis.max_degree=2"); }, "--set basis.max_degree=2",
          "basis.max_degree");
  refused([](Configuration& c) { c.set("basis=fourier"); }, "--set basis=fourier",
          "basis.type");
  refused([](Configuration& c) { c.set(R"(basis={"max_degree": 1})"); },
          R"(--set basis={"max_degree": 1})", "basis.max_degree");
  refused([](Configuration& c) { c.set_terms("x,y"); }, "--terms", "basis.type");
  Configuration agreeing;
  agreeing.merge_text(R"({"basis": {"max_degree": 5}})", "c.json");  // options go before files
  agreeing.set_degree(3);
  agreeing.set("basis.type=monomials");
  agreeing.set("basis.min_degree=1");
  EXPECT_EQ(options<Monomials>(agreeing.build(default_registry()).basis).max_degree, 3);
}

TEST(Configuration, LevelsAreCountedBeforeAnythingIsRead) {
  Configuration configuration;
  const std::string deep = std::string(100000, '[');
  expect_error<ConfigError>([&] { configuration.merge_text("{\"basis\":" + deep, "c.json"); },
                            "c.json:1:41", "deeper than 32 levels", "brackets");
  EXPECT_THROW(configuration.set("basis.x=" + deep + std::string(100000, ']')), ConfigError);
}

}  // namespace
}  // namespace lacuna
