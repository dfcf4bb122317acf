// SPDX-License-Identifier: MIT
#include "lacuna/model/ode_text.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/utf8.hpp"
#include "formula_error.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/core/names.hpp"
#include "lacuna/core/text.hpp"
#include "linear_terms.hpp"
#include "ode_line.hpp"
#include "operations.hpp"

namespace lacuna {
namespace {

/// A right-hand side before all names are known.
struct WrittenEquation {
  std::string_view formula;
  std::string place;  ///< of the formula, "m.ode:3:11"
};

/// What the statements of a text have said.
struct Statements {
  const std::string& source;
  std::string time_unit = "s";
  std::vector<Quantity> states = {}, inputs = {};
  std::map<std::string, Expression> parameters = {};
  std::map<std::string, WrittenEquation> equations = {};
  std::map<std::string, std::size_t> number_of_state = {};
  std::set<std::string> taken = {};  ///< names of states, inputs and parameters
};

/// "m.ode:3" and the column of a formula's place, moved by a column inside the formula.
std::string moved_place(const std::string& place, std::size_t column) {
  const std::size_t colon = place.rfind(':');
  return place.substr(0, colon + 1) +
         std::to_string(std::stoul(place.substr(colon + 1)) + column - 1);
}

void take_name(const OdeLine& line, const std::string& name, Statements& said) {
  if (!said.taken.insert(name).second)
    line.fail("the name '" + name + "' is given twice",
              "give every state, input and parameter a name of its own");
}

/// All that a formula may name.
std::vector<std::string> all_names(std::vector<std::string> names, const Statements& said) {
  for (const auto& [name, value] : said.parameters) names.push_back(name);
  return names;
}

/// A formula with numbers for parameters; delays may have parameters.
Expression read_formula(std::string_view text, const std::string& place,
                        const std::vector<std::string>& variables, const Statements& said) {
  try {
    const Expression formula = substitute(parse_expression(text), said.parameters);
    for (const std::string& name : formula.variables())
      if (std::find(variables.begin(), variables.end(), name) == variables.end())
        return parse_expression(text, all_names(variables, said));  // tells where
    return formula;
  } catch (const FormulaError& error) {
    throw ModelError(moved_place(place, error.column()), error.problem(), error.remedy());
  } catch (const ModelError& error) {
    throw ModelError(place, error.problem(), error.remedy());
  }
}

/// A number, or a formula of parameters that are known already.
double read_value(OdeLine& line, const Statements& said) {
  const std::string_view text = line.value();
  const std::optional<double> value =
      constant_value(read_formula(text, line.place_of(text), {"t"}, said));
  if (!value || !std::isfinite(*value))
    throw ModelError(line.place_of(text), "'" + std::string(text) + "' is no finite number",
                     "use numbers and parameters of earlier lines");
  return *value;
}

void expect_end(OdeLine& line) {
  if (!line.at_end())
    line.fail("nothing more belongs here", "see the examples in docs/file-formats.md");
}

void read_input(OdeLine& line, Statements& said) {
  Quantity input{line.identifier("name of an input"), ""};
  take_name(line, input.name, said);
  input.unit = line.unit();
  if (line.take("hold")) {
    const std::string name = line.identifier("hold");
    input.hold = hold_named(name);
    if (!input.hold)
      line.fail("the hold '" + name + "' is not known",
                "write zero, linear, smooth or switching, or leave it out");
  }
  said.inputs.push_back(std::move(input));
}

/// The state of a name, which becomes one if it is none yet.
Quantity& state_named(const OdeLine& line, const std::string& name, Statements& said) {
  const auto [place, is_new] = said.number_of_state.try_emplace(name, said.states.size());
  if (!is_new) return said.states[place->second];
  take_name(line, name, said);
  return said.states.emplace_back(Quantity{name, ""});
}

void read_parameter(OdeLine& line, Statements& said) {
  const std::string name = line.identifier("name of a parameter");
  take_name(line, name, said);
  line.expect('=');
  const double value = read_value(line, said);
  line.unit();
  if (line.take("in")) {
    const std::string_view range = line.formula();
    const std::size_t dots = range.find("..");
    if (dots == std::string_view::npos)
      line.fail("the range has no '..'", "write e.g. in 0..1");
  } else {
    line.take("fixed");
  }
  said.parameters.emplace(name, Expression::number(value));
}

/// "x" of "dx/dt"; nothing for another beginning of a line.
std::optional<std::string> state_of_rate(const std::string& name, OdeLine& line) {
  if (name.size() < 2 || name.front() != 'd' || !line.take("/dt")) return std::nullopt;
  return name.substr(1);
}

void read_equation(OdeLine& line, const std::string& name, Statements& said) {
  if (!is_identifier(name) || is_reserved_name(name))
    line.fail("'" + name + "' cannot be a state", "use another name");
  state_named(line, name, said);
  line.expect('=');
  const std::string_view formula = line.formula();
  if (!said.equations.try_emplace(name, WrittenEquation{formula, line.place_of(formula)})
           .second)
    line.fail("the state '" + name + "' has two equations", "join their terms");
}

void read_statement(OdeLine& line, Statements& said) {
  if (line.take("time")) {
    said.time_unit = line.at_end() ? "" : std::string(line.formula());
  } else if (line.take("input")) {
    read_input(line, said);
  } else if (line.take("state")) {
    Quantity& state = state_named(line, line.identifier("name of a state"), said);
    state.unit = line.unit();
  } else if (line.take("param")) {
    read_parameter(line, said);
  } else if (line.take("initial")) {
    line.fail("initial values are not part of a model here",
              "leave the line out; records give them, or --x0");
  } else {
    const std::string name = line.identifier("statement");
    const std::optional<std::string> state = state_of_rate(name, line);
    if (!state && !line.take("="))
      line.fail("'" + name + "' begins no statement",
                "write time, input, state, param or d(name)/dt = ...");
    if (!state)
      line.fail("'" + name + " = ...' would be an output, which models do not have here",
                "measure the states themselves, or write d" + name + "/dt = ...");
    read_equation(line, *state, said);
  }
  expect_end(line);
}

Statements read_statements(std::string_view text, const std::string& source) {
  Statements said{source};
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view content = text.substr(0, end);
    if (!content.empty() && content.back() == '\r') content.remove_suffix(1);
    OdeLine line(content.substr(0, content.find('#')), number, source);
    if (!line.at_end()) read_statement(line, said);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return said;
}

std::vector<Equation> equations_of(const Statements& said, const Variables& variables) {
  std::vector<Equation> equations;
  for (const Quantity& state : said.states) {
    const auto found = said.equations.find(state.name);
    if (found == said.equations.end())
      throw ModelError(said.source, "the state '" + state.name + "' has no equation",
                       "add d" + state.name + "/dt = ...; 0 means that it is constant");
    const auto& [text, place] = found->second;
    const Expression formula = read_formula(text, place, variables.names(), said);
    try {
      equations.push_back(linear_terms(formula, variables));
    } catch (const ModelError& error) {
      throw ModelError(place, error.where() + ": " + error.problem(), error.remedy());
    }
  }
  return equations;
}

}  // namespace

OdeModel parse_ode(std::string_view bytes, const std::string& source) {
  const std::string text = to_utf8(bytes);
  Statements said = read_statements(text, source);
  if (said.states.empty())
    throw ModelError(source, "there are no equations", "write e.g. dx/dt = -0.5*x");
  Variables variables;
  for (const Quantity& state : said.states) variables.states.push_back(state.name);
  for (const Quantity& input : said.inputs) variables.inputs.push_back(input.name);
  std::vector<Equation> equations = equations_of(said, variables);
  return OdeModel(std::move(said.states), std::move(said.inputs), std::move(equations),
                  said.time_unit);
}

std::string format_ode(const OdeModel& model) {
  const auto with_unit = [](const Quantity& quantity) {
    return quantity.name + (quantity.unit.empty() ? "" : " [" + quantity.unit + "]");
  };
  std::string text = "time";
  text += (model.time_unit().empty() ? "" : " " + model.time_unit()) + "\n";
  for (const Quantity& input : model.inputs())
    text += "input " + with_unit(input) +
            (input.hold ? " hold " + to_string(*input.hold) : "") + "\n";
  for (const Quantity& state : model.states()) text += "state " + with_unit(state) + "\n";
  return text + to_text(model) + "\n";
}

}  // namespace lacuna
