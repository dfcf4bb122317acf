// SPDX-License-Identifier: MIT
#include "lacuna/model/files/model_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "lacuna/core/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

constexpr const char* kPendulum = R"json({"format": "lacuna.model/1",
 "time_unit": "s",
 "states": [{"name": "th", "unit": "rad"}, {"name": "w", "unit": "rad/s"}],
 "inputs": [{"name": "u", "unit": "N m"}],
 "equations": [
   {"state": "th", "terms": [{"term": "w", "coefficient": 1.0}]},
   {"state": "w",  "terms": [{"term": "sin(th)", "coefficient": -19.62, "ci95": [-19.7, -19.5]},
                             {"term": "w", "coefficient": -0.15, "stderr": 0.01},
                             {"term": "u", "coefficient": 1}]}]})json";

/// The pendulum's text with one piece replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = kPendulum;
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

std::string message(const std::string& json) {
  try {
    parse_model(json, "m.json");
  } catch (const ModelError& error) {
    return error.what();
  }
  return "no error";
}

std::string message_after(const std::string& from, const std::string& to) {
  return message(changed(from, to));
}

TEST(ModelFile, ReadsEveryField) {
  const OdeModel model = parse_model(kPendulum, "m.json");
  EXPECT_EQ(model.states()[1], (Quantity{"w", "rad/s"}));
  EXPECT_EQ(model.inputs()[0], (Quantity{"u", "N m"}));
  EXPECT_EQ(model.time_unit(), "s");
  const WeightedTerm& gravity = model.equations()[1][0];
  EXPECT_EQ(gravity.term.name(), "sin(th)");
  EXPECT_EQ(gravity.coefficient, -19.62);
  EXPECT_EQ((*gravity.ci95)[1], -19.5);
  EXPECT_EQ(model.equations()[1][1].standard_error, 0.01);
  EXPECT_FALSE(model.equations()[1][2].ci95);
  EXPECT_EQ(model.coefficient(1, "u"), 1.0);
}

TEST(ModelFile, OptionalPartsMayBeMissing) {
  const OdeModel model = parse_model(
      R"({"format": "lacuna.model/1", "description": "two tanks",
          "states": [{"name": "a"}, {"name": "b"}],
          "equations": [{"state": "b", "terms": []},
                        {"state": "a", "terms": [{"term": "1", "coefficient": 2}]}]})",
      "m.json");
  EXPECT_TRUE(model.inputs().empty());
  EXPECT_EQ(model.time_unit(), "s");
  EXPECT_EQ(model.states()[0].unit, "");
  EXPECT_EQ(model.coefficient(0, "1"), 2.0);
  EXPECT_TRUE(model.equations()[1].empty());
}

constexpr const char* kSections = R"json({"format": "lacuna.model/1",
 "states": [{"name": "x"}, {"name": "z"}],
 "inputs": [{"name": "u"}],
 "equations": [
   {"state": "x", "terms": [{"term": "k*u", "coefficient": 2, "fixed": true},
                            {"term": "m-z", "coefficient": 3}]},
   {"state": "z", "terms": []}],
 "parameters": [{"name": "k", "value": 0.5, "unit": "1/s", "min": 0, "max": 1,
                 "per_record": true, "stderr": 0.1},
                {"name": "m", "value": 2, "free": false}],
 "outputs": [{"name": "y", "expression": "k*abs(x)", "unit": "V"}],
 "initial": {"z": {"value": 3, "fixed": true}, "x": {"value": 1, "deviation": 0.5}}})json";

std::string section_message(const std::string& from, const std::string& to) {
  std::string text = kSections;
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return message(text.replace(place, from.size(), to));
}

TEST(ModelFile, ReadsParametersOutputsAndStarts) {
  const SystemModel system = parse_system(kSections, "m.json");
  ASSERT_EQ(system.parameters().size(), 2u);
  const Parameter& k = system.parameters()[0];
  EXPECT_EQ(k.value, 0.5);
  EXPECT_EQ(k.unit, "1/s");
  EXPECT_TRUE(k.free && k.per_record);
  EXPECT_EQ(k.max, 1.0);
  EXPECT_EQ(k.standard_error, 0.1);
  EXPECT_FALSE(system.parameters()[1].free || system.parameters()[1].min.has_value());
  EXPECT_TRUE(system.symbolic().equations()[0][0].fixed);
  EXPECT_EQ(system.symbolic().initial()[1]->value, 3.0);
  EXPECT_TRUE(system.symbolic().initial()[1]->fixed);
  EXPECT_EQ(system.symbolic().initial()[0]->deviation, 0.5);
  const OdeModel plain = parse_model(kSections, "m.json");
  EXPECT_EQ(plain.coefficient(0, "u"), 1.0);
  EXPECT_EQ(system.symbolic().equations()[0][1].term.name(), "m-z") << "as it is written";
  EXPECT_EQ(plain.coefficient(0, "1"), 6.0) << "with numbers it is a sum of terms";
  EXPECT_EQ(plain.coefficient(0, "z"), -3.0);
  EXPECT_EQ(plain.outputs()[0].formula.to_string(), "0.5*abs(x)");
}

TEST(ModelFile, BadSectionsAreNamedWithTheirPath) {
  EXPECT_THAT(section_message("k*abs(x)", "k*abs(q)"),
              HasSubstr("$.outputs[0].expression, column 7: unknown name 'q'"));
  EXPECT_THAT(section_message("k*abs(x)", "delay(x,1)"),
              HasSubstr("$.outputs[0]: output y: an output cannot be delayed"));
  EXPECT_THAT(section_message("\"y\"", "\"k\""),
              HasSubstr("$.outputs[0].name: the name 'k' is given twice"));
  EXPECT_THAT(section_message("\"y\"", "\"x\""),
              HasSubstr("$.outputs[0]: output x: a state has the same name"));
  EXPECT_THAT(section_message("\"k\", \"value\"", "\"x\", \"value\""),
              HasSubstr("$.parameters[0].name: the name 'x' is given twice"));
  EXPECT_THAT(section_message("0.5, \"unit\"", "1.5, \"unit\""),
              HasSubstr("$.parameters[0]: parameter 'k': its value 1.5 is not in its range"));
  EXPECT_THAT(section_message("\"min\": 0", "\"min\": 2"), HasSubstr("2..1 is upside down"));
  EXPECT_THAT(section_message("\"free\": false", "\"free\": 0"),
              HasSubstr("$.parameters[1].free: true or false is expected"));
  EXPECT_THAT(section_message("{\"z\": {", "{\"q\": {"),
              HasSubstr("$.initial.q: there is no state 'q'"));
  EXPECT_THAT(section_message("\"deviation\": 0.5", "\"deviation\": 0"),
              HasSubstr("$.initial.x.deviation: a deviation is not above 0"));
  EXPECT_THAT(section_message("{\"z\": {\"value\": 3, \"fixed\": true}, \"x\": {\"value\": 1, "
                              "\"deviation\": 0.5}}",
                              "[]"),
              HasSubstr("$.initial: an object is expected here"));
}

TEST(ModelFile, BadTermsAreNamedWithPathAndColumn) {
  EXPECT_EQ(message_after("sin(th)", "w*sin(tu)"),
            "m.json: $.equations[1].terms[0].term, column 7: unknown name 'tu'; did you mean "
            "'th'?");
  EXPECT_THAT(message_after("sin(th)", "sin(th"),
              HasSubstr("$.equations[1].terms[0].term, column 4: '(' without ')'"));
  EXPECT_THAT(message_after("\"term\": \"u\"", "\"term\": 3"),
              HasSubstr("$.equations[1].terms[2].term: a string is expected here"));
  EXPECT_THAT(message_after("\"term\": \"u\"", "\"term\": \"w\""),
              HasSubstr("$.equations[1].terms[2].term: the term 'w' is given twice, first at "
                        "$.equations[1].terms["));
}

TEST(ModelFile, SyntaxErrorsAreNamedWithLineAndColumn) {
  EXPECT_THAT(message_after("\"time_unit\": \"s\",", "\"time_unit\": \"s\""),
              HasSubstr("m.json:3:9: not valid JSON"));
  EXPECT_THAT(message(""), HasSubstr("m.json:1:1: the file is empty"));
  EXPECT_THAT(message("{\"format\": "), HasSubstr("m.json:1:12: the JSON text ends too early"));
  EXPECT_THAT(message_after("-19.62", "NaN"), HasSubstr("m.json:7:65: not valid JSON"));
  EXPECT_THAT(message_after("-19.62", "1e999"), HasSubstr("out of the range of a double"));
  EXPECT_THAT(message_after("rad/s", "\xff"), HasSubstr("m.json:3:"));
  EXPECT_EQ(message(std::string(100000, '[')).find('\n'), std::string::npos);
}

TEST(ModelFile, UnknownMissingAndRepeatedKeys) {
  EXPECT_EQ(message_after("\"time_unit\"", "\"time_units\""),
            "m.json: $: unknown key 'time_units'; did you mean 'time_unit'?");
  EXPECT_THAT(message_after("\"coefficient\": -0.15", "\"coeficient\": -0.15"),
              HasSubstr("$.equations[1].terms[1]: unknown key 'coeficient'; did you mean "
                        "'coefficient'?"));
  EXPECT_THAT(message_after("\"coefficient\": -0.15, ", ""),
              HasSubstr("$.equations[1].terms[1]: the key 'coefficient' is missing"));
  EXPECT_THAT(message_after("\"unit\": \"rad/s\"", "\"unit\": \"rad/s\", \"unit\": \"\""),
              HasSubstr("m.json: $.states[1].unit: the key stands twice"));
  EXPECT_THAT(message("[]"), HasSubstr("$: an object is expected here, not a JSON array"));
  EXPECT_THAT(message("{}"), HasSubstr("$: the key 'format' is missing"));
}

TEST(ModelFile, ValuesOfTheWrongKind) {
  EXPECT_THAT(message_after("lacuna.model/1", "lacuna.model/9"),
              HasSubstr("$.format: the format is 'lacuna.model/9'"));
  EXPECT_THAT(message_after("-0.15", "\"-0.15\""),
              HasSubstr("$.equations[1].terms[1].coefficient: a number is expected here"));
  EXPECT_THAT(message_after("-0.15", "null"), HasSubstr("a number is expected here, not null"));
  EXPECT_THAT(message_after("[-19.7, -19.5]", "[-19.5]"),
              HasSubstr("$.equations[1].terms[0].ci95: an interval has 2 numbers, not 1"));
  EXPECT_THAT(message_after("[-19.7, -19.5]", "[-19.5, -19.7]"), HasSubstr("upside down"));
  EXPECT_THAT(message_after("0.01", "-0.01"), HasSubstr("terms[1].stderr: a standard error"));
  EXPECT_THAT(message_after("[{\"name\": \"u\", \"unit\": \"N m\"}]", "7"),
              HasSubstr("$.inputs: an array is expected here, not a JSON number"));
}

TEST(ModelFile, AUnitCannotActOnATerminal) {
  for (const std::string unit : {"\\u001b[31m", "\\u0000", "a\\nb", "\\u009b"})
    EXPECT_THAT(message_after("\"rad/s\"", "\"" + unit + "\""),
                HasSubstr("$.states[1].unit: the unit "));
  EXPECT_EQ(message_after("\"rad/s\"", "\"\xc2\xb0/s\""), "no error");
}

TEST(ModelFile, NamesAndEquationsThatDoNotFit) {
  EXPECT_THAT(message_after("\"name\": \"u\"", "\"name\": \"w\""),
              HasSubstr("$.inputs[0].name: the name 'w' is given twice"));
  EXPECT_THAT(message_after("\"name\": \"u\"", "\"name\": \"t\""),
              HasSubstr("$.inputs[0].name: the name 't' is a word"));
  EXPECT_THAT(message_after("\"name\": \"u\"", "\"name\": \"2u\""),
              HasSubstr("$.inputs[0].name: the name '2u' is not an identifier"));
  EXPECT_THAT(message_after("{\"state\": \"w\"", "{\"state\": \"v\""),
              HasSubstr("$.equations[1].state: there is no state 'v'"));
  EXPECT_THAT(message_after("{\"state\": \"w\"", "{\"state\": \"th\""),
              HasSubstr("$.equations[1].state: the equation of 'th' is given twice, first at "
                        "$.equations[0].state"));
  EXPECT_THAT(
      message_after(
          "{\"state\": \"th\", \"terms\": [{\"term\": \"w\", \"coefficient\": 1.0}]},", ""),
      HasSubstr("$.equations: the state 'th' has no equation"));
  EXPECT_THAT(message(R"({"format": "lacuna.model/1", "states": [], "equations": []})"),
              HasSubstr("$.states: there are no states"));
}

TEST(ModelFile, NothingCutShortIsAcceptedOrCrashes) {
  const std::string text = kPendulum;
  ASSERT_FALSE(text.empty());
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_THROW(parse_model(text.substr(0, length), "m.json"), ModelError) << length;
}

TEST(ModelFileOnDisk, WhatIsWrittenReadsBackAndOthersAreNamed) {
  const testing::TemporaryFolder folder;
  write_model(folder.file("m.json"), parse_model(kPendulum, "m.json"));
  EXPECT_EQ(format_model(read_model(folder.file("m.json"))),
            format_model(parse_model(kPendulum, "m.json")));
  EXPECT_THROW(read_model(folder.file("absent.json")), FileError);
  EXPECT_THROW(read_model(folder.file("")), FileError);
  EXPECT_THROW(write_model(folder.file("no/m.json"), parse_model(kPendulum, "m")), FileError);
}

TEST(ModelFile, TimeIsContinuousOrDiscrete) {
  const auto text = [](const std::string& time, const std::string& term) {
    return R"({"format": "lacuna.model/1", )" + time +
           R"("states": [{"name": "x"}], "equations": [{"state": "x", "terms": [{"term": ")" +
           term + R"(", "coefficient": 2}]}]})";
  };
  const auto parse = [&](const std::string& time, const std::string& term) {
    return parse_model(text(time, term), "m.json");
  };
  EXPECT_FALSE(parse("", "x").is_map());
  EXPECT_FALSE(parse(R"("time": "continuous", )", "x").is_map());
  const OdeModel map = parse(R"("time": "discrete", )", "x");
  EXPECT_TRUE(map.is_map());
  EXPECT_THAT(format_model(map), HasSubstr("\"time\": \"discrete\""));
  EXPECT_EQ(format_model(parse_model(format_model(map), "again")), format_model(map));
  EXPECT_THROW(parse(R"("time": "hourly", )", "x"), ModelError);
  EXPECT_THROW(parse(R"("time": "discrete", )", "delay(x,1)"), ModelError);
}

TEST(ModelFile, AnEventHasOneOccasion) {
  const auto read = [](const std::string& occasion) {
    return parse_model(R"({"format": "lacuna.model/1", "states": [{"name": "x"}],
      "equations": [{"state": "x", "terms": []}], "events": [{)" +
                           occasion + R"(, "set": {"x": "0"}}]})",
                       "m.json");
  };
  EXPECT_EQ(read(R"("every": 2, "from": 1)").events().front().time, 1.0);
  EXPECT_EQ(read(R"("at": 3)").events().front().time, 3.0);
  for (const char* two : {R"("at": 1, "every": 2)", R"("at": 1, "from": 2)", R"("from": 2)"})
    EXPECT_THROW(read(two), ModelError) << two;
}

}  // namespace
}  // namespace lacuna
