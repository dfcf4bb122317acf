// SPDX-License-Identifier: MIT
#include "lacuna/model/files/model_file.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "core/base/utf8.hpp"
#include "lacuna/core/base/atomic_file.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/names.hpp"
#include "lacuna/core/base/text.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "model/expressions/formula_error.hpp"
#include "model/expressions/operations.hpp"
#include "model/expressions/unbound_delays.hpp"
#include "strict_json.hpp"

namespace lacuna {
namespace {

constexpr std::string_view kFormat = "lacuna.model/1";
constexpr std::string_view kTextExtension = ".ode";

void check_format(const JsonPlace& root) {
  const JsonPlace format = root.at("format");
  if (format.text() != kFormat)
    format.fail("the format is '" + format.text() + "'",
                "this program reads '" + std::string(kFormat) + "'");
}

void check_quantity_name(const JsonPlace& place, const std::string& name,
                         std::set<std::string>& taken) {
  if (!is_identifier(name))
    place.fail("the name '" + name + "' is not an identifier",
               "use letters, digits and underscores, a letter first");
  if (is_reserved_name(name))
    place.fail("the name '" + name + "' is a word of the formula language", "choose another");
  if (!taken.insert(name).second)
    place.fail("the name '" + name + "' is given twice",
               "give every state and input a name of its own");
}

Hold read_hold(const JsonPlace& place) {
  const std::optional<Hold> hold = hold_named(place.text());
  if (!hold)
    place.fail("the hold '" + place.text() + "' is not known",
               "write zero, linear, smooth or switching, or leave it out");
  return *hold;
}

/// A unit is shown wherever its quantity is: nothing in it may act on a terminal.
std::optional<std::string> read_unit(const JsonPlace& entry, const std::string& key) {
  const std::optional<JsonPlace> unit = entry.find(key);
  if (!unit) return std::nullopt;
  std::string text = unit->text();
  if (printable(text) != text || text.find('\n') != std::string::npos)
    unit->fail("a unit has control characters", "remove them");
  return text;
}

/// @param driven whether they are inputs, which may have a hold.
std::vector<Quantity> read_quantities(const JsonPlace& list, std::set<std::string>& taken,
                                      bool driven) {
  std::vector<Quantity> quantities;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPlace entry = list.at(i);
    if (driven)
      entry.expect_keys({"name", "unit", "hold"});
    else
      entry.expect_keys({"name", "unit"});
    const JsonPlace name = entry.at("name");
    check_quantity_name(name, name.text(), taken);
    quantities.push_back({name.text(), read_unit(entry, "unit").value_or("")});
    if (!driven) continue;
    if (const auto hold = entry.find("hold")) quantities.back().hold = read_hold(*hold);
  }
  return quantities;
}

/// Delays may have parameters in them, which formulas of known names may not.
Expression read_formula(const JsonPlace& place, const Variables& variables) {
  const std::string text = place.text();
  try {
    const Expression formula = parse_expression(text);
    const std::vector<std::string> known = variables.names();
    for (const std::string& name : formula.variables())
      if (std::find(known.begin(), known.end(), name) == known.end())
        return parse_expression(text, known);  // tells where
    check_delay_times(formula, variables.states);
    return formula;
  } catch (const FormulaError& error) {
    place.fail(error.problem(), error.remedy(), ", column " + std::to_string(error.column()));
  } catch (const ModelError& error) {
    place.fail(error.problem(), error.remedy());
  }
}

Term read_term(const JsonPlace& place, const Variables& variables) {
  return Term(read_formula(place, variables), variables);
}

bool read_flag(const JsonPlace& entry, const std::string& key, bool otherwise) {
  const auto flag = entry.find(key);
  return flag ? flag->flag() : otherwise;
}

std::optional<double> read_number(const JsonPlace& entry, const std::string& key) {
  const auto number = entry.find(key);
  return number ? std::optional(number->number()) : std::nullopt;
}

std::array<double, 2> read_interval(const JsonPlace& place) {
  if (place.size() != 2)
    place.fail("an interval has 2 numbers, not " + std::to_string(place.size()),
               "give [low, high]");
  const std::array<double, 2> interval{place.at(0).number(), place.at(1).number()};
  if (interval[0] > interval[1]) place.fail("the interval is upside down", "give [low, high]");
  return interval;
}

std::optional<double> read_error(const JsonPlace& entry) {
  const std::optional<double> error = read_number(entry, "stderr");
  if (error && *error < 0.0)
    entry.at("stderr").fail("a standard error is negative", "remove it");
  return error;
}

WeightedTerm read_summand(const JsonPlace& place, const Variables& variables) {
  place.expect_keys({"term", "coefficient", "ci95", "stderr", "fixed"});
  WeightedTerm summand{.term = read_term(place.at("term"), variables),
                       .coefficient = place.at("coefficient").number(),
                       .fixed = read_flag(place, "fixed", false)};
  summand.standard_error = read_error(place);
  if (const auto interval = place.find("ci95")) summand.ci95 = read_interval(*interval);
  return summand;
}

Equation read_terms(const JsonPlace& list, const Variables& variables) {
  Equation equation;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPlace place = list.at(i);
    WeightedTerm summand = read_summand(place, variables);
    if (!taken.insert(summand.term.name()).second)
      place.at("term").fail("the term '" + summand.term.name() + "' stands twice",
                            "add the coefficients up in one term");
    equation.push_back(std::move(summand));
  }
  return equation;
}

std::vector<Equation> read_equations(const JsonPlace& list, const Variables& variables) {
  const std::vector<std::string>& states = variables.states;
  std::vector<std::optional<Equation>> found(states.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPlace entry = list.at(i);
    entry.expect_keys({"state", "terms"});
    const JsonPlace state = entry.at("state");
    const auto place = std::find(states.begin(), states.end(), state.text());
    if (place == states.end())
      state.fail("there is no state '" + state.text() + "'", suggestion(state.text(), states));
    std::optional<Equation>& equation = found[static_cast<std::size_t>(place - states.begin())];
    if (equation)
      state.fail("the state '" + state.text() + "' has two equations", "join their terms");
    equation = read_terms(entry.at("terms"), variables);
  }
  std::vector<Equation> equations;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!found[i])
      list.fail("the state '" + states[i] + "' has no equation",
                "add one; an empty list of terms means that it is constant");
    equations.push_back(*std::move(found[i]));
  }
  return equations;
}

std::vector<Parameter> read_parameters(const JsonPlace& list, std::set<std::string>& taken) {
  std::vector<Parameter> parameters;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPlace entry = list.at(i);
    entry.expect_keys(
        {"name", "value", "unit", "free", "min", "max", "per_record", "stderr", "ci95"});
    const JsonPlace name = entry.at("name");
    check_quantity_name(name, name.text(), taken);
    Parameter parameter{.name = name.text(),
                        .value = entry.at("value").number(),
                        .unit = read_unit(entry, "unit").value_or(""),
                        .free = read_flag(entry, "free", true),
                        .min = read_number(entry, "min"),
                        .max = read_number(entry, "max"),
                        .per_record = read_flag(entry, "per_record", false),
                        .standard_error = read_error(entry)};
    if (const auto interval = entry.find("ci95")) parameter.ci95 = read_interval(*interval);
    if (const std::string problem = range_problem(parameter); !problem.empty())
      entry.fail("parameter '" + parameter.name + "': " + problem, "mend value or range");
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

/// @param taken names of inputs and parameters, not those of states.
std::vector<Output> read_outputs(const JsonPlace& list, const OdeModel& model,
                                 std::set<std::string> taken) {
  std::vector<Output> outputs;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPlace entry = list.at(i);
    entry.expect_keys({"name", "expression", "unit"});
    const JsonPlace name = entry.at("name");
    check_quantity_name(name, name.text(), taken);
    const Output output{name.text(), read_unit(entry, "unit").value_or(""),
                        read_formula(entry.at("expression"), model.variables())};
    try {
      outputs.push_back(model.with_outputs({output}).outputs().front());
    } catch (const ModelError& error) {
      entry.fail(error.where() + ": " + error.problem(), error.remedy());
    }
  }
  return outputs;
}

std::vector<std::optional<InitialValue>> read_initial(const JsonPlace& object,
                                                      const OdeModel& model) {
  std::vector<std::optional<InitialValue>> initial(model.states().size());
  const std::vector<std::string> states = model.variables().states;
  for (const std::string& name : object.keys()) {
    const JsonPlace entry = object.at(name);
    const auto state = std::find(states.begin(), states.end(), name);
    if (state == states.end())
      entry.fail("there is no state '" + name + "'", suggestion(name, states));
    entry.expect_keys({"value", "fixed", "deviation"});
    const InitialValue value{entry.at("value").number(), read_flag(entry, "fixed", false),
                             read_number(entry, "deviation")};
    if (value.deviation && !(*value.deviation > 0.0))
      entry.at("deviation").fail("a deviation is not above 0", "use \"fixed\": true for 0");
    initial[static_cast<std::size_t>(state - states.begin())] = value;
  }
  return initial;
}

/// The model as the flow or the map that the document says it is.
OdeModel with_time(const JsonPlace& root, const OdeModel& model) {
  const std::optional<JsonPlace> time = root.find("time");
  if (!time || time->text() == "continuous") return model;
  if (time->text() != "discrete")
    time->fail("there is no time '" + time->text() + "'", "write continuous or discrete");
  try {
    return model.with_evolution(Evolution::Map);
  } catch (const ModelError& error) {
    time->fail(error.problem(), error.remedy());
  }
}

SystemModel read_document(const JsonPlace& root) {
  root.expect_keys({"format", "description", "time_unit", "time", "states", "inputs",
                    "equations", "parameters", "outputs", "initial"});
  check_format(root);
  if (const auto description = root.find("description")) description->text();
  std::set<std::string> taken;
  const JsonPlace state_list = root.at("states");
  std::vector<Quantity> states = read_quantities(state_list, taken, false);
  if (states.empty()) state_list.fail("there are no states", "name at least one");
  std::vector<Quantity> inputs;
  if (const auto list = root.find("inputs")) inputs = read_quantities(*list, taken, true);
  const std::vector<std::string> input_names = names_of(inputs);
  std::set<std::string> others(input_names.begin(), input_names.end());
  std::vector<Parameter> parameters;
  if (const auto list = root.find("parameters")) parameters = read_parameters(*list, taken);
  for (const Parameter& parameter : parameters) {
    inputs.push_back({parameter.name, parameter.unit});
    others.insert(parameter.name);
  }
  const auto unit = read_unit(root, "time_unit");
  std::vector<Equation> equations =
      read_equations(root.at("equations"), Variables{names_of(states), names_of(inputs)});
  OdeModel model(std::move(states), std::move(inputs), std::move(equations),
                 unit.value_or("s"));
  if (const auto list = root.find("outputs"))
    model = model.with_outputs(read_outputs(*list, model, std::move(others)));
  if (const auto object = root.find("initial"))
    model = model.with_initial(read_initial(*object, model));
  return {with_time(root, model), std::move(parameters)};
}

}  // namespace

SystemModel parse_system(std::string_view json, const std::string& source) {
  const nlohmann::json document = parse_strict_json(json, source);
  return read_document(JsonPlace(document, source));
}

OdeModel parse_model(std::string_view json, const std::string& source) {
  return parse_system(json, source).model();
}

OdeModel read_model(const std::filesystem::path& path) { return read_system(path).model(); }

SystemModel read_system(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code unreadable;
  if (!file || std::filesystem::is_directory(path, unreadable))
    throw FileError(path.string(), "the model file cannot be read",
                    "check that it exists and that it may be read");
  const std::string text{std::istreambuf_iterator<char>(file),
                         std::istreambuf_iterator<char>()};
  if (file.bad()) throw FileError(path.string(), "reading failed", "check the disk");
  if (path.extension() == kTextExtension) return parse_ode_system(text, path.string());
  return parse_system(text, path.string());
}

std::string format_model_for(const std::filesystem::path& path, const SystemModel& model) {
  return path.extension() == kTextExtension ? format_ode(model) : format_model(model);
}

void write_model(const std::filesystem::path& path, const SystemModel& model) {
  write_file_atomically(path, format_model_for(path, model));
}

}  // namespace lacuna
