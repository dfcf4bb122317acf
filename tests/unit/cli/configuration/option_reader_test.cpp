// SPDX-License-Identifier: MIT
// Every kind of option, read from JSON through a basis made for it.
#include "lacuna/cli/configuration/configuration.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

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
