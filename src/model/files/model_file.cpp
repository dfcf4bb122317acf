// SPDX-License-Identifier: MIT
#include "lacuna/model/files/model_file.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/file_bytes.hpp"
#include "event_text.hpp"
#include "lacuna/core/base/error.hpp"
#include "model/equations/known_formula.hpp"
#include "model/equations/output_fault.hpp"
#include "model/expressions/formula_error.hpp"
#include "model/expressions/operations.hpp"
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

/// Where names stood first.
using FirstPaths = std::unordered_map<std::string, std::string>;

/// @throws ModelError that names both places where `name` has stood before.
void add_first(const JsonPlace& place, const std::string& what, const std::string& name,
               const std::string& remedy, FirstPaths& first) {
  const auto [before, is_new] = first.try_emplace(name, place.path());
  if (!is_new)
    place.fail(what + " '" + name + "' is given twice, first at " + before->second, remedy);
}

void check_quantity_name(const JsonPlace& place, const std::string& name, FirstPaths& taken) {
  if (const auto fault = name_fault(name)) place.fail(fault->problem, fault->remedy);
  add_first(place, "the name", name, "give every state and input a name of its own", taken);
}

Hold read_hold(const JsonPlace& place) {
  const std::optional<Hold> hold = hold_named(place.text());
  if (!hold)
    place.fail("the hold '" + place.text() + "' is not known",
               "write zero, linear, smooth or switching, or leave it out");
  return *hold;
}

std::optional<std::string> read_unit(const JsonPlace& entry, const std::string& key) {
  const std::optional<JsonPlace> unit = entry.find(key);
  if (!unit) return std::nullopt;
  std::string text = unit->text();
  if (const auto fault = unit_fault(text)) unit->fail(fault->problem, fault->remedy);
  return text;
}

/// @param driven whether they are inputs, which may have a hold.
std::vector<Quantity> read_quantities(const JsonPlace& list, FirstPaths& taken, bool driven) {
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

Expression read_formula(const JsonPlace& place, const VariableIndex& variables) {
  try {
    return parse_known(place.text(), variables);
  } catch (const FormulaError& error) {
    place.fail(error.problem(), error.remedy(), ", column " + std::to_string(error.column()));
  } catch (const ModelError& error) {
    place.fail(error.problem(), error.remedy());
  }
}

Term read_term(const JsonPlace& place, const VariableIndex& variables) {
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

WeightedTerm read_summand(const JsonPlace& place, const VariableIndex& variables) {
  place.expect_keys({"term", "coefficient", "ci95", "stderr", "fixed"});
  WeightedTerm summand{.term = read_term(place.at("term"), variables),
                       .coefficient = place.at("coefficient").number(),
                       .fixed = read_flag(place, "fixed", false)};
  summand.standard_error = read_error(place);
  if (const auto interval = place.find("ci95")) summand.ci95 = read_interval(*interval);
  return summand;
}

Equation read_terms(const JsonPlace& list, const VariableIndex& variables) {
  Equation equation;
  FirstPaths taken;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPlace place = list.at(i);
    WeightedTerm summand = read_summand(place, variables);
    add_first(place.at("term"), "the term", summand.term.name(),
              "add the coefficients up in one term", taken);
    equation.push_back(std::move(summand));
  }
  return equation;
}

/// The state of a name. @throws ModelError at `place` when there is none.
std::size_t state_named(const JsonPlace& place, const std::string& name,
                        const VariableIndex& variables) {
  const std::optional<Index> slot = variables.find(name);
  if (slot && *slot < variables.states()) return static_cast<std::size_t>(*slot);
  const std::vector<std::string> states(variables.names().begin(),
                                        variables.names().begin() + variables.states());
  place.fail("there is no state '" + name + "'", suggestion(name, states));
}

std::vector<Equation> read_equations(const JsonPlace& list, const VariableIndex& variables) {
  std::vector<std::optional<Equation>> found(static_cast<std::size_t>(variables.states()));
  FirstPaths first;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPlace entry = list.at(i);
    entry.expect_keys({"state", "terms"});
    const JsonPlace state = entry.at("state");
    std::optional<Equation>& equation = found[state_named(state, state.text(), variables)];
    add_first(state, "the equation of", state.text(), "join their terms", first);
    equation = read_terms(entry.at("terms"), variables);
  }
  std::vector<Equation> equations;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i])
      list.fail("the state '" + variables.names()[i] + "' has no equation",
                "add one; an empty list of terms means that it is constant");
    equations.push_back(*std::move(found[i]));
  }
  return equations;
}

/// How a parameter varies over records.
std::optional<ParameterSpread> read_spread(const JsonPlace& parameter) {
  const auto place = parameter.find("varies");
  if (!place) return std::nullopt;
  place->expect_keys({"deviation", "factor"});
  const auto deviation = read_number(*place, "deviation"), factor = read_number(*place, "factor");
  if (deviation.has_value() == factor.has_value())
    place->fail("it is neither a deviation nor a factor",
                "write one of both, e.g. {\"factor\": 1.5}");
  return ParameterSpread{deviation ? *deviation : *factor, factor.has_value()};
}

std::vector<Parameter> read_parameters(const JsonPlace& list, FirstPaths& taken) {
  std::vector<Parameter> parameters;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPlace entry = list.at(i);
    entry.expect_keys(
        {"name", "value", "unit", "free", "min", "max", "per_record", "deviation", "factor",
         "varies", "stderr", "ci95"});
    const JsonPlace name = entry.at("name");
    check_quantity_name(name, name.text(), taken);
    Parameter parameter{.name = name.text(),
                        .value = entry.at("value").number(),
                        .unit = read_unit(entry, "unit").value_or(""),
                        .free = read_flag(entry, "free", true),
                        .min = read_number(entry, "min"),
                        .max = read_number(entry, "max"),
                        .per_record = read_flag(entry, "per_record", false),
                        .deviation = read_number(entry, "deviation"),
                        .factor = read_number(entry, "factor"),
                        .varies = read_spread(entry),
                        .standard_error = read_error(entry)};
    if (const auto interval = entry.find("ci95")) parameter.ci95 = read_interval(*interval);
    if (const std::string problem = range_problem(parameter); !problem.empty())
      entry.fail("parameter '" + parameter.name + "': " + problem,
                 "mend value, range or deviation");
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

NoiseLaw read_noise(const JsonPlace& place) {
  place.expect_keys({"law", "freedom", "constant", "fraction", "below", "above",
                     "truncated"});
  const std::string name = place.at("law").text();
  const std::optional<NoiseForm> form = noise_form_named(name);
  if (!form)
    place.at("law").fail("the noise '" + name + "' is not known",
                         "write constant, proportional, both, lognormal, poisson or student");
  NoiseLaw law{.form = *form,
               .constant = read_number(place, "constant"),
               .fraction = read_number(place, "fraction"),
               .below = read_number(place, "below"),
               .above = read_number(place, "above")};
  if (const auto truncated = place.find("truncated")) law.truncated = truncated->flag();
  law.freedom = read_number(place, "freedom").value_or(law.freedom);
  if (const std::string problem = law_problem(law); !problem.empty())
    place.fail(problem, "mend its numbers");
  return law;
}

/// @param taken names of inputs and parameters, not those of states.
std::vector<Output> read_outputs(const JsonPlace& list, const OdeModel& model,
                                 FirstPaths taken) {
  const VariableIndex variables(model.variables());
  std::vector<Output> outputs;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPlace entry = list.at(i);
    entry.expect_keys({"name", "expression", "unit", "noise"});
    const JsonPlace name = entry.at("name");
    check_quantity_name(name, name.text(), taken);
    outputs.push_back({name.text(), read_unit(entry, "unit").value_or(""),
                       read_formula(entry.at("expression"), variables)});
    if (const auto noise = entry.find("noise")) outputs.back().noise = read_noise(*noise);
    if (const auto fault = output_fault(outputs.back(), variables))
      entry.fail("output " + name.text() + ": " + fault->problem, fault->remedy);
  }
  return outputs;
}

std::vector<std::optional<InitialValue>> read_initial(const JsonPlace& object,
                                                      const OdeModel& model) {
  std::vector<std::optional<InitialValue>> initial(model.states().size());
  const VariableIndex variables(model.variables());
  for (const std::string& name : object.keys()) {
    const JsonPlace entry = object.at(name);
    const std::size_t state = state_named(entry, name, variables);
    entry.expect_keys({"value", "fixed", "deviation", "at"});
    const InitialValue value{entry.at("value").number(), read_flag(entry, "fixed", false),
                             read_number(entry, "deviation"), read_number(entry, "at")};
    if (value.deviation && !(*value.deviation > 0.0))
      entry.at("deviation").fail("a deviation is not above 0", "use \"fixed\": true for 0");
    initial[state] = value;
  }
  return initial;
}

/// The guard of a condition "x > c".
Expression read_guard(const JsonPlace& place, const VariableIndex& variables) {
  const std::string text = place.text();
  const auto sides = condition_sides(text);
  if (!sides || sides->larger.empty() || sides->smaller.empty())
    place.fail("'" + text + "' is no condition", "compare two formulas by one > or <");
  try {
    return parse_known(sides->larger, variables) - parse_known(sides->smaller, variables);
  } catch (const ModelError& error) {
    place.fail(error.problem(), error.remedy());
  }
}

Event read_event(const JsonPlace& place, const VariableIndex& variables) {
  place.expect_keys({"at", "every", "from", "until", "when", "set"});
  Event event{.time = read_number(place, "at"),
              .period = read_number(place, "every"),
              .last = read_number(place, "until")};
  if (event.period && event.time)
    place.fail("'at' and 'every' exclude each other", "say by 'from' when the first one is");
  if (const auto from = place.find("from")) {
    if (!event.period)
      from->fail("nothing happens 'every' so long", "write 'at', or add 'every'");
    event.time = from->number();
  } else if (event.period) {
    event.time = 0.0;
  }
  if (const auto condition = place.find("when")) event.guard = read_guard(*condition, variables);
  const JsonPlace set = place.at("set");
  for (const std::string& name : set.keys()) {
    state_named(set.at(name), name, variables);
    event.resets.push_back({name, read_formula(set.at(name), variables)});
  }
  return event;
}

OdeModel with_events(const JsonPlace& list, const OdeModel& model) {
  const VariableIndex variables(model.variables());
  std::vector<Event> events;
  for (std::size_t i = 0; i < list.size(); ++i) {
    events.push_back(read_event(list.at(i), variables));
    try {
      model.with_events({events.back()});
    } catch (const ModelError& error) {
      list.at(i).fail(error.problem(), error.remedy());
    }
  }
  return model.with_events(std::move(events));
}

/// A description is a comment.
void check_description(const JsonPlace& place) {
  if (const auto fault = comment_fault(place.text())) place.fail(fault->problem, fault->remedy);
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
                    "equations", "parameters", "outputs", "initial", "events"});
  check_format(root);
  if (const auto description = root.find("description")) check_description(*description);
  FirstPaths taken;
  const JsonPlace state_list = root.at("states");
  std::vector<Quantity> states = read_quantities(state_list, taken, false);
  if (states.empty()) state_list.fail("there are no states", "name at least one");
  std::vector<Quantity> inputs;
  if (const auto list = root.find("inputs")) inputs = read_quantities(*list, taken, true);
  std::vector<Parameter> parameters;
  if (const auto list = root.find("parameters")) parameters = read_parameters(*list, taken);
  for (const Parameter& parameter : parameters)
    inputs.push_back({parameter.name, parameter.unit});
  for (const Quantity& state : states) taken.erase(state.name);  // an output may be a state
  const auto unit = read_unit(root, "time_unit");
  std::vector<Equation> equations =
      read_equations(root.at("equations"), VariableIndex({names_of(states), names_of(inputs)}));
  OdeModel model(std::move(states), std::move(inputs), std::move(equations),
                 unit.value_or("s"));
  if (const auto list = root.find("outputs"))
    model = model.with_outputs(read_outputs(*list, model, std::move(taken)));
  if (const auto object = root.find("initial"))
    model = model.with_initial(read_initial(*object, model));
  model = with_time(root, model);
  if (const auto list = root.find("events")) model = with_events(*list, model);
  return {std::move(model), std::move(parameters)};
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
  const std::string text = read_text_file(path, "model file");
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
