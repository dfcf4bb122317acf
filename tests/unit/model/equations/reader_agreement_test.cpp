// SPDX-License-Identifier: MIT
// What a name and a unit may be is decided once: every reader says the same of the same text,
// and what one format holds the other holds too.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/names.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "data/times/time_names.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/roles.hpp"
#include "lacuna/data/records/table.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/run_command.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using namespace std::string_literals;

/// Pieces of adversarial texts: letters of many scripts, and what acts on its surroundings.
// clang-format off
const std::vector<std::string> kPieces{
    "a", "V", "mm", "s", "_", "x1", "9", " ", "N m", "/", "^2", "-1", "%", "*", ".", "(", ")",
    "\t", "\r", "\n", "\v", "\f", "\0"s, "\x1b[31m", "\x7f", "\xC2\x85", "\xC2\xA0", "\xC2\xAD",
    "\xC2\xB0", "\xC2\xB5", "\xC2\xB2", "\xC3\xA9", "e\xCC\x81", "\xCC\x8A", "\xCE\xA9",
    "\xE2\x84\xA6", "\xE2\x84\xAA", "\xE2\x84\xAB", "\xE2\x84\x83", "\xE2\x80\x8B",
    "\xE2\x80\x8D", "\xE2\x80\x8E", "\xE2\x80\xAE", "\xE2\x80\xA8", "\xE2\x80\xA9",
    "\xE2\x81\xA6", "\xE2\x81\xA0", "\xD8\x9C", "\xEF\xBB\xBF", "\xD9\x85", "\xE7\xA7\x92",
    "\xD1\x81", "\xF0\x9F\x98\x80", "\xEF\xBC\xB6", "\xFF", "\xC3", "[", "#", "\"", "\\", "'",
    "//", "*/", "$", "&", "<b>", "sin", "t", "pi", "time", "state", "fixed", "in", "nan"};
// clang-format on

std::string random_text(Random& random) {
  std::string text;
  const std::uint64_t pieces = random.below(12) == 0 ? 100 : random.below(5);
  const bool plain = random.below(3) == 0;  // so that enough of them can be had
  for (std::uint64_t i = 0; i < pieces; ++i)
    text += kPieces[random.below(plain ? 13 : kPieces.size())];
  return text;
}

template <class Call>
bool is_taken(const Call& call) {
  try {
    call();
    return true;
  } catch (const Error& error) {
    EXPECT_FALSE(error.remedy().empty()) << error.what();
    return false;
  }
}

/// A document with the name and the unit in every place that has one.
nlohmann::json document(const std::string& name, const std::string& unit,
                        const std::string& section) {
  const nlohmann::json quantity{{"name", name}, {"unit", unit}};
  const nlohmann::json other{{"name", "q"}, {"unit", ""}};
  nlohmann::json root{
      {"format", "lacuna.model/1"},
      {"states", nlohmann::json::array({other})},
      {"equations",
       nlohmann::json::array({{{"state", "q"}, {"terms", nlohmann::json::array()}}})}};
  if (section == "time_unit") {
    root["time_unit"] = unit;
  } else if (section == "states") {
    root["states"].push_back(quantity);
    root["equations"].push_back({{"state", name}, {"terms", nlohmann::json::array()}});
  } else {
    root[section] = nlohmann::json::array({quantity});
    if (section == "parameters") root[section][0]["value"] = 1.0;
    if (section == "outputs") root[section][0]["expression"] = "2*q";
  }
  return root;
}

bool takes_json(const std::string& name, const std::string& unit, const std::string& section) {
  using Handler = nlohmann::json::error_handler_t;
  if (!is_utf8(name) || !is_utf8(unit)) return false;
  const std::string text = document(name, unit, section).dump(-1, ' ', false, Handler::strict);
  return is_taken([&] { parse_system(text, "m.json"); });
}

Dataset record_of(const Quantity& state, const std::string& time_unit) {
  Dataset data;
  data.states = {state};
  data.time_unit = time_unit;
  Trajectory record;
  record.time = Vector::LinSpaced(3, 0.0, 1.0);
  record.states = Matrix::Zero(3, 1);
  data.trajectories = {record};
  return data;
}

Table table_of(const Quantity& column) {
  Table table;
  table.source = "r.csv";
  table.values = Matrix::Zero(3, 2);
  table.values.col(0) = Vector::LinSpaced(3, 0.0, 1.0);
  name_columns(table, {{"stamp", ""}, column}, 1);
  return table;
}

const std::array<std::string, 4> kQuantitySections{"states", "inputs", "parameters", "outputs"};

TEST(Readers, SayTheSameOfAUnit) {
  Random random(20261125);
  int taken = 0;
  for (int i = 0; i < 1500; ++i) {
    const std::string unit = random_text(random);
    const bool good = !unit_fault(unit);
    taken += good;
    SCOPED_TRACE(printable(unit));
    for (const std::string& section : kQuantitySections)
      EXPECT_EQ(takes_json("x", unit, section), good) << section;
    EXPECT_EQ(takes_json("x", unit, "time_unit"), good);
    EXPECT_EQ(is_taken([&] { OdeModel({{"x", unit}}, {}, {{}}); }), good);
    EXPECT_EQ(is_taken([&] { OdeModel({{"x", ""}}, {{"u", unit}}, {{}}); }), good);
    EXPECT_EQ(is_taken([&] { OdeModel({{"x", ""}}, {}, {{}}, unit); }), good);
    EXPECT_EQ(is_taken([&] { check_dataset(record_of({"x", unit}, "s")); }), good);
    EXPECT_EQ(is_taken([&] { check_dataset(record_of({"x", ""}, unit)); }), good);
    EXPECT_EQ(is_taken([&] { assign_roles(table_of({"x", ""}), {.time_unit = unit}); }), good);
    // What a text has on the left and right of a unit is layout, and what is no UTF-8 Latin-1.
    const std::string read = to_utf8(unit);
    const bool inside = read.find('\n') == std::string::npos && !unit_fault(trim(read));
    for (const char* begin : {"input u [", "state x [", "param k = 1 [", "y = 2*x [", "time ["})
      EXPECT_EQ(is_taken([&] { parse_ode_system(begin + unit + "]\ndx/dt = 1\n", "m.ode"); }),
                inside)
          << begin;
  }
  EXPECT_GT(taken, 300);
}

TEST(Readers, SayTheSameOfAName) {
  Random random(44);
  int taken = 0;
  for (int i = 0; i < 1500; ++i) {
    std::string name = random_text(random);
    if (random.below(2) == 0) name = to_identifier(name);
    if (name == "x" || name == "q") continue;
    const bool good = !name_fault(name);
    taken += good;
    SCOPED_TRACE(printable(name));
    for (const std::string& section : kQuantitySections)
      EXPECT_EQ(takes_json(name, "", section), good) << section;
    EXPECT_EQ(is_taken([&] { OdeModel({{name, ""}}, {}, {{}}); }), good);
    EXPECT_EQ(is_taken([&] { OdeModel({{"x", ""}}, {{name, ""}}, {{}}); }), good);
    EXPECT_EQ(is_taken([&] { check_dataset(record_of({name, ""}, "s")); }), good);
    EXPECT_EQ(is_taken([&] {
                Table table = table_of({"x", ""});
                rename_column(table, name, "x");
              }),
              good || name == "t");
    if (name.find_first_of("#\n") != std::string::npos || trim(name).empty()) continue;
    const bool inside = !name_fault(trim(name));
    for (const char* end : {" = 1", " = 1 [V] fixed"})
      EXPECT_EQ(
          is_taken([&] { parse_ode_system("param " + name + end + "\ndq/dt = 1\n", "m.ode"); }),
          inside)
          << end;
    EXPECT_EQ(is_taken([&] { parse_ode_system("input " + name + "\ndq/dt = 1\n", "m.ode"); }),
              inside);
  }
  EXPECT_GT(taken, 300);
}

TEST(Readers, CleanWhatHeadersHoldAndSaySo) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const std::string header = random_text(random), unit = random_text(random);
    const Table table = table_of({header, unit});
    const Quantity& column = table.columns[1];
    SCOPED_TRACE(printable(header) + " / " + printable(unit));
    EXPECT_FALSE(unit_fault(column.unit));
    EXPECT_EQ(column.unit == trim(to_utf8(unit)), !unit_fault(trim(to_utf8(unit))));
    EXPECT_TRUE(!name_fault(column.name) || column.name == "t");
    std::size_t notes = 0;
    for (const std::string& note : table.notes) {
      EXPECT_FALSE(comment_fault(note)) << note;
      notes += note.rfind("r.csv:1:2: ", 0) == 0;
    }
    const bool renamed = !header.empty() && column.name != to_utf8(header);
    EXPECT_EQ(notes, std::size_t{renamed} + (column.unit != trim(to_utf8(unit))));
  }
}

TEST(Readers, TheCommandLineSaysTheSame) {
  const testing::TemporaryFolder folder;
  std::string rows = "z,x\n";
  for (int i = 0; i < 40; ++i)
    rows += std::to_string(0.1 * i) + "," + std::to_string(i % 3) + "\n";
  const std::string path = folder.write("r.csv", rows);
  Random random(3);
  for (int i = 0; i < 150; ++i) {
    const std::string text = random_text(random);
    if (text.empty() || text.find('\0') != std::string::npos) continue;
    SCOPED_TRACE(printable(text));
    const auto unit = testing::run_command({"check", path, "--time-unit=" + text});
    EXPECT_EQ(unit.status == 2, !time_unit_symbol(text)) << unit.err;
    if (text.find_first_of("=,()") != std::string::npos || text == "z") continue;
    const bool good = !name_fault(trim(text)) || trim(text) == "t";
    const auto name = testing::run_command({"check", path, "--map=" + text + "=x"});
    EXPECT_EQ(name.status == 0, good) << name.err;
  }
}

/// A name that can be had and is new.
std::string fresh_name(Random& random, std::vector<std::string>& names) {
  for (;;) {
    std::string name = to_identifier(random_text(random)).substr(0, 40);
    if (name_fault(name) || std::find(names.begin(), names.end(), name) != names.end())
      name = "n" + std::to_string(names.size());
    names.push_back(name);
    return name;
  }
}

std::string in_brackets(Random& random) {
  const std::string unit = cleaned_unit(to_utf8(random_text(random)));
  return unit.empty() ? "" : " [" + unit + "]";
}

std::string random_term(Random& random, const std::vector<std::string>& names) {
  const auto name = [&] { return names[random.below(names.size())]; };
  const std::string a = name(), b = name();
  const std::array<std::string, 9> forms{a,
                                         a + "*" + b,
                                         a + "^2",
                                         "sin(" + a + "-" + b + ")",
                                         a + "/(1.5+" + b + "^2)",
                                         "max(" + a + "," + b + ")*" + a,
                                         "(" + a + "-2*" + b + ")*" + b,
                                         "exp(-" + a + ")",
                                         "(" + a + "-" + b + ")^1"};
  return format_number(std::round(random.uniform(-9.0, 9.0)) / 4.0 + 0.1) + "*" +
         forms[random.below(forms.size())];
}

/// A text model in which everything has an adversarial name and unit.
std::string random_model(Random& random) {
  std::vector<std::string> states, names;
  for (std::uint64_t i = 0; i <= random.below(3); ++i)
    states.push_back(fresh_name(random, names));
  std::string text = "# a model\ntime" + in_brackets(random) + "\n";
  for (const std::string& state : states) text += "state " + state + in_brackets(random) + "\n";
  for (std::uint64_t i = 0; i < random.below(3); ++i)
    text += "input " + fresh_name(random, names) + in_brackets(random) +
            (random.below(2) == 0 ? " hold zero\n" : "\n");
  for (std::uint64_t i = 0; i < random.below(3); ++i)
    text += "param " + fresh_name(random, names) + " = 1.5" + in_brackets(random) +
            (random.below(2) == 0 ? " in ..2\n" : " fixed\n");
  for (const std::string& state : states) {
    text += "d" + state + "/dt = 0";
    for (std::uint64_t i = 0; i < random.below(4); ++i)
      text += " + " + random_term(random, names);
    text += "\ninitial " + state + " = 2\n";
  }
  std::vector<std::string> all = names;
  for (std::uint64_t i = 0; i < random.below(3); ++i)
    text += fresh_name(random, all) + " = " + random_term(random, names) + in_brackets(random) +
            "\n";
  return text;
}

TEST(Readers, ATextGoesThroughJsonAndComesBack) {
  Random random(12);
  for (int i = 0; i < 600; ++i) {
    const std::string text = random_model(random);
    SCOPED_TRACE(text);
    const SystemModel model = parse_ode_system(text, "m.ode");
    const SystemModel by_json = parse_system(format_model(model), "m.json");
    EXPECT_EQ(format_model(by_json), format_model(model));
    const SystemModel again = parse_ode_system(format_ode(by_json), "again.ode");
    EXPECT_EQ(format_model(again), format_model(model));
    EXPECT_EQ(format_ode(again), format_ode(model));
  }
}

}  // namespace
}  // namespace lacuna
