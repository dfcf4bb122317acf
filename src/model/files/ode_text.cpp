// SPDX-License-Identifier: MIT
#include "lacuna/model/files/ode_text.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/base/utf8.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/names.hpp"
#include "lacuna/core/base/text.hpp"
#include "model/equations/linear_terms.hpp"
#include "model/expressions/formula_error.hpp"
#include "model/expressions/operations.hpp"
#include "model/expressions/unbound_delays.hpp"
#include "ode_line.hpp"

namespace lacuna {
namespace {

/// A right-hand side before all names are known.
struct WrittenEquation {
  std::string_view formula;
  std::string place;  ///< of the formula, "m.ode:3:11"
};

/// An output before all names are known.
struct WrittenOutput {
  std::string name, unit;
  WrittenEquation formula;
};

/// "initial x = ..." and "fixed dx/dt: ..." before all states are known.
struct WrittenInitial {
  std::string state, place;
  InitialValue value;
};
struct WrittenChoice {
  std::string state;
  WrittenEquation term;
  bool fixed;
};

/// What the statements of a text have said.
struct Statements {
  const std::string& source;
  std::string time_unit = "s";
  std::optional<Evolution> evolution = {};  ///< that of the first equation
  std::vector<Quantity> states = {}, inputs = {};
  std::vector<Parameter> parameters = {};
  std::map<std::string, Expression> values = {};  ///< of the parameters
  std::map<std::string, WrittenEquation> equations = {};
  std::vector<WrittenOutput> outputs = {};
  std::vector<WrittenInitial> initial = {};
  std::vector<WrittenChoice> choices = {};
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

/// A formula of known names; delays may have parameters.
Expression read_formula(const WrittenEquation& written, const std::vector<std::string>& known,
                        const std::vector<std::string>& states = {}) {
  const auto& [text, place] = written;
  try {
    const Expression formula = parse_expression(text);
    for (const std::string& name : formula.variables())
      if (std::find(known.begin(), known.end(), name) == known.end())
        return parse_expression(text, known);  // tells where
    check_delay_times(formula, states);
    return formula;
  } catch (const FormulaError& error) {
    throw ModelError(moved_place(place, error.column()), error.problem(), error.remedy());
  } catch (const ModelError& error) {
    throw ModelError(place, error.problem(), error.remedy());
  }
}

/// The number that a formula of parameters that are known already is.
double value_of(const WrittenEquation& written, const Statements& said) {
  std::vector<std::string> known{"t"};
  for (const auto& [name, value] : said.values) known.push_back(name);
  const std::optional<double> value =
      constant_value(substitute(read_formula(written, known), said.values));
  if (!value || !std::isfinite(*value))
    throw ModelError(written.place,
                     "'" + std::string(written.formula) + "' is no finite number",
                     "use numbers and parameters of earlier lines");
  return *value;
}

double read_value(OdeLine& line, const Statements& said) {
  const std::string_view text = line.value();
  return value_of({text, line.place_of(text)}, said);
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

/// One end of "LO..HI", which may be open.
std::optional<double> read_end(const OdeLine& line, std::string_view text,
                               const Statements& said) {
  if (trim(text).empty()) return std::nullopt;
  return value_of({trim(text), line.place_of(trim(text))}, said);
}

void read_range(OdeLine& line, const Statements& said, Parameter& parameter) {
  const std::string_view range = line.value();
  const std::size_t dots = range.find("..");
  if (dots == std::string_view::npos) line.fail("the range has no '..'", "write e.g. in 0..1");
  parameter.min = read_end(line, range.substr(0, dots), said);
  parameter.max = read_end(line, range.substr(dots + 2), said);
}

void read_parameter(OdeLine& line, Statements& said) {
  Parameter parameter{.name = line.identifier("name of a parameter")};
  take_name(line, parameter.name, said);
  line.expect('=');
  const std::string place = line.place();
  parameter.value = read_value(line, said);
  parameter.unit = line.unit();
  if (line.take("in")) read_range(line, said, parameter);
  parameter.free = !line.take("fixed");
  parameter.per_record = line.take("per_record");
  if (const std::string problem = range_problem(parameter); !problem.empty())
    throw ModelError(place, "parameter '" + parameter.name + "': " + problem,
                     "mend value or range");
  said.values.emplace(parameter.name, Expression::number(parameter.value));
  said.parameters.push_back(std::move(parameter));
}

void read_initial(OdeLine& line, Statements& said) {
  const std::string place = line.place();
  WrittenInitial initial{line.identifier("name of a state"), place, {}};
  line.expect('=');
  initial.value.value = read_value(line, said);
  line.unit();
  if (line.take("deviation")) initial.value.deviation = read_value(line, said);
  initial.value.fixed = line.take("fixed");
  said.initial.push_back(std::move(initial));
}

void read_output(OdeLine& line, const std::string& name, Statements& said) {
  if (!line.take("="))
    line.fail("'" + name + "' begins no statement",
              "write time, input, state, param, initial, d(name)/dt = ..., name[n+1] = ... or "
              "output = ...");
  const std::string_view formula = line.value();
  const std::string place = line.place_of(formula);
  for (const WrittenOutput& other : said.outputs)
    if (other.name == name)
      line.fail("the name '" + name + "' is given twice", "give every output its own");
  said.outputs.push_back({name, line.unit(), {formula, place}});
}

/// What stands on the left of an equation.
struct LeftHandSide {
  std::string state;
  Evolution evolution;
};

/// That of "dx/dt" or "x[n+1]"; nothing for another beginning of a line.
std::optional<LeftHandSide> take_left_hand_side(const std::string& name, OdeLine& line) {
  if (line.take("[n+1]")) return LeftHandSide{name, Evolution::Map};
  if (name.size() < 2 || name.front() != 'd' || !line.take("/dt")) return std::nullopt;
  return LeftHandSide{name.substr(1), Evolution::Flow};
}

/// "dx/dt: TERM" behind `fixed` or `free`.
void read_choice(OdeLine& line, bool fixed, Statements& said) {
  const std::string name = line.identifier("dNAME/dt");
  const std::optional<LeftHandSide> left = take_left_hand_side(name, line);
  if (!left)
    line.fail("'" + name + "' is no dNAME/dt and no NAME[n+1]", "write e.g. fixed dx/dt: u");
  line.expect(':');
  line.at_end();
  const std::string_view term = line.formula();
  said.choices.push_back({left->state, {term, line.place_of(term)}, fixed});
}

void read_equation(OdeLine& line, const LeftHandSide& left, Statements& said) {
  const std::string& name = left.state;
  if (said.evolution.value_or(left.evolution) != left.evolution)
    line.fail("a model is either a flow, dx/dt, or a map, x[n+1]", "write all equations alike");
  said.evolution = left.evolution;
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
    read_initial(line, said);
  } else if (line.take("fixed")) {
    read_choice(line, true, said);
  } else if (line.take("free")) {
    read_choice(line, false, said);
  } else {
    const std::string name = line.identifier("statement");
    if (const std::optional<LeftHandSide> left = take_left_hand_side(name, line))
      read_equation(line, *left, said);
    else
      read_output(line, name, said);
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
    const Expression formula = read_formula(found->second, variables.names(), variables.states);
    try {
      equations.push_back(linear_terms(formula, variables));
    } catch (const ModelError& error) {
      throw ModelError(found->second.place, error.where() + ": " + error.problem(),
                       error.remedy());
    }
  }
  return equations;
}

std::size_t place_of_state(const Statements& said, const std::string& name,
                           const std::string& place) {
  const auto found = said.number_of_state.find(name);
  if (found == said.number_of_state.end())
    throw ModelError(place, "there is no state '" + name + "'",
                     "write d" + name + "/dt = ... or mend the name");
  return found->second;
}

/// Marks what is not to be estimated.
void mark_fixed(const Statements& said, const SystemModel& system,
                std::vector<Equation>& equations) {
  const bool any_free = std::any_of(said.parameters.begin(), said.parameters.end(),
                                    [](const Parameter& parameter) { return parameter.free; });
  for (std::size_t k = 0; k < equations.size(); ++k)
    for (WeightedTerm& summand : equations[k])
      summand.fixed = any_free && std::abs(summand.coefficient) == 1.0 &&
                      !system.gives_size(summand.term.expression());
  const Variables variables = system.symbolic().variables();
  for (const auto& [state, term, fixed] : said.choices) {
    Equation& equation = equations[place_of_state(said, state, term.place)];
    const Term chosen(read_formula(term, variables.names(), variables.states), variables);
    const auto found = std::find_if(equation.begin(), equation.end(), [&](const auto& summand) {
      return summand.term == chosen;
    });
    if (found == equation.end())
      throw ModelError(
          term.place,
          left_hand_side(state, *said.evolution) + " has no term '" + chosen.name() + "'",
          "write it as `lacuna model` shows it");
    found->fixed = fixed;
  }
}

OdeModel with_outputs(const Statements& said, const OdeModel& model) {
  std::vector<Output> outputs;
  for (const WrittenOutput& output : said.outputs) {
    outputs.push_back(
        {output.name, output.unit, read_formula(output.formula, model.variables().names())});
    try {
      model.with_outputs({outputs.back()});
    } catch (const ModelError& error) {
      throw ModelError(output.formula.place, error.where() + ": " + error.problem(),
                       error.remedy());
    }
  }
  return model.with_outputs(std::move(outputs));
}

OdeModel with_initial(const Statements& said, const OdeModel& model) {
  std::vector<std::optional<InitialValue>> initial(model.states().size());
  for (const WrittenInitial& written : said.initial) {
    const std::size_t state = place_of_state(said, written.state, written.place);
    if (initial[state])
      throw ModelError(written.place, "'" + written.state + "' has two initial values",
                       "keep one");
    initial[state] = written.value;
    if (written.value.deviation && !(*written.value.deviation > 0.0))
      throw ModelError(written.place, "a deviation is not above 0", "write fixed for 0");
  }
  return model.with_initial(std::move(initial));
}

}  // namespace

SystemModel parse_ode_system(std::string_view bytes, const std::string& source) {
  const std::string text = to_utf8(bytes);
  const Statements said = read_statements(text, source);
  if (said.states.empty())
    throw ModelError(source, "there are no equations", "write e.g. dx/dt = -0.5*x");
  std::vector<Quantity> inputs = said.inputs;
  for (const Parameter& parameter : said.parameters)
    inputs.push_back({parameter.name, parameter.unit});
  const OdeModel frame(said.states, inputs, std::vector<Equation>(said.states.size()),
                       said.time_unit);
  std::vector<Equation> equations = equations_of(said, frame.variables());
  mark_fixed(said, SystemModel(frame, said.parameters), equations);
  const OdeModel model = frame.with_equations(std::move(equations))
                             .with_evolution(said.evolution.value_or(Evolution::Flow));
  return {with_initial(said, with_outputs(said, model)), said.parameters};
}

OdeModel parse_ode(std::string_view bytes, const std::string& source) {
  return parse_ode_system(bytes, source).model();
}

}  // namespace lacuna
