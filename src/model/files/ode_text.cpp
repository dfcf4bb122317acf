// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "model/equations/known_formula.hpp"
#include "model/equations/linear_terms.hpp"
#include "model/equations/output_fault.hpp"
#include "model/expressions/operations.hpp"
#include "ode_event.hpp"
#include "ode_line.hpp"
#include "written_formula.hpp"

namespace lacuna {
namespace {

/// An output before all names are known.
struct WrittenOutput {
  std::string name, unit;
  WrittenFormula formula;
  std::optional<NoiseLaw> noise = {};
};

/// "initial x = ..." and "fixed dx/dt: ..." before all states are known.
struct WrittenInitial {
  std::string state, place;
  std::size_t line;
  InitialValue value;
};
struct WrittenChoice {
  std::string state;
  WrittenFormula term;
  std::size_t line;
  bool fixed;
};

/// Where things were given first: nothing is given twice.
class FirstLines {
 public:
  /// @throws ModelError that names both lines when it has been given before.
  void add(const std::string& what, std::size_t line, const std::string& place,
           const std::string& remedy) {
    const auto [first, is_new] = lines_.try_emplace(what, line);
    if (!is_new)
      throw ModelError(place,
                       what + " is given twice, first in line " + std::to_string(first->second),
                       remedy);
  }

 private:
  std::unordered_map<std::string, std::size_t> lines_;
};

/// What the statements of a text have said.
struct Statements {
  const std::string& source;
  std::string time_unit = "s";
  std::optional<Evolution> evolution = {};  ///< that of the first equation
  std::vector<Quantity> states = {}, inputs = {};
  std::vector<Parameter> parameters = {};
  std::map<std::string, Expression> values = {};  ///< of the parameters
  std::unordered_map<std::string, WrittenFormula> equations = {};
  std::vector<WrittenOutput> outputs = {};
  std::vector<WrittenInitial> initial = {};
  std::vector<WrittenChoice> choices = {};
  std::vector<WrittenEvent> events = {};
  std::unordered_map<std::string, std::size_t> number_of_state = {};
  FirstLines first = {};
};

void take_name(const OdeLine& line, const std::string& name, Statements& said) {
  said.first.add("the name '" + name + "'", line.line_number(), line.place(),
                 "give every state, input and parameter a name of its own");
}

/// A formula of parameters of earlier lines.
Expression parse_of_parameters(std::string_view text, const Statements& said) {
  const Expression formula = parse_expression(text);
  for (const std::string& name : formula.variables()) {
    if (name == "t" || said.values.contains(name)) continue;
    std::vector<std::string> known{"t"};
    for (const auto& [parameter, value] : said.values) known.push_back(parameter);
    return parse_expression(text, known);  // reports where
  }
  return formula;
}

/// The number that a formula of parameters that are known already is.
double value_of(const WrittenFormula& written, const Statements& said) {
  const Expression formula = read_formula(
      written, [&](std::string_view text) { return parse_of_parameters(text, said); });
  const std::optional<double> value = constant_value(substitute(formula, said.values));
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

/// "varies */ FACTOR" or "varies +- DEVIATION", if it is next.
void read_spread(OdeLine& line, const Statements& said, Parameter& parameter) {
  if (!line.take("varies")) return;
  const bool by_factor = line.take("*/");
  if (!by_factor && !line.take("+-"))
    line.fail("there is no spread behind 'varies'", "write varies */ 1.5 or varies +- 0.2");
  parameter.varies = ParameterSpread{read_value(line, said), by_factor};
}

void read_parameter(OdeLine& line, Statements& said) {
  Parameter parameter{.name = line.identifier("name of a parameter")};
  take_name(line, parameter.name, said);
  line.expect('=');
  const std::string place = line.place();
  parameter.value = read_value(line, said);
  if (line.take("+-")) parameter.deviation = read_value(line, said);
  if (line.take("*/")) parameter.factor = read_value(line, said);
  read_spread(line, said, parameter);
  parameter.unit = line.unit();
  if (!parameter.varies) read_spread(line, said, parameter);
  if (line.take("in")) read_range(line, said, parameter);
  parameter.free = !line.take("fixed");
  parameter.per_record = line.take("per_record");
  if (const std::string problem = range_problem(parameter); !problem.empty())
    throw ModelError(place, "parameter '" + parameter.name + "': " + problem,
                     "mend value, range or deviation");
  said.values.emplace(parameter.name, Expression::number(parameter.value));
  said.parameters.push_back(std::move(parameter));
}

void read_initial(OdeLine& line, Statements& said) {
  const std::string place = line.place();
  WrittenInitial initial{line.identifier("name of a state"), place, line.line_number(), {}};
  line.expect('=');
  initial.value.value = read_value(line, said);
  line.unit();
  if (line.take("at")) initial.value.time = read_value(line, said);
  if (line.take("deviation") || line.take("+-"))
    initial.value.deviation = read_value(line, said);
  initial.value.fixed = line.take("fixed");
  said.initial.push_back(std::move(initial));
}

void read_output(OdeLine& line, const std::string& name, Statements& said) {
  if (!line.take("="))
    line.fail("'" + name + "' begins no statement",
              "write time, input, state, param, initial, at, every, when, d(name)/dt = ..., "
              "name[n+1] = ... or output = ...");
  const std::string_view formula = line.formula_before_unit();
  const std::string place = line.place_of(formula);
  said.first.add("the output '" + name + "'", line.line_number(), place,
                 "give every output a name of its own");
  said.outputs.push_back({name, line.unit(), {formula, place}});
  if (line.take("noise")) said.outputs.back().noise = read_noise(line);
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
  said.choices.push_back({left->state, {term, line.place_of(term)}, line.line_number(), fixed});
}

void read_equation(OdeLine& line, const LeftHandSide& left, Statements& said) {
  const std::string& name = left.state;
  if (said.evolution.value_or(left.evolution) != left.evolution)
    line.fail("a model is either a flow, dx/dt, or a map, x[n+1]", "write all equations alike");
  said.evolution = left.evolution;
  if (const auto fault = name_fault(name)) line.fail(fault->problem, fault->remedy);
  state_named(line, name, said);
  line.expect('=');
  const std::string_view formula = line.formula();
  const std::string place = line.place_of(formula);
  said.first.add("the equation of '" + name + "'", line.line_number(), place, "join their terms");
  said.equations.emplace(name, WrittenFormula{formula, place});
}

void read_time(OdeLine& line, Statements& said) {
  said.first.add("the time unit", line.line_number(), line.place(), "keep one");
  said.time_unit = line.time_unit();
}

void read_state(OdeLine& line, Statements& said) {
  const std::string name = line.identifier("name of a state");
  said.first.add("the statement 'state " + name + "'", line.line_number(), line.place(),
                 "keep one");
  state_named(line, name, said).unit = line.unit();
}

/// The number of a time; what is estimated cannot be one.
double read_event_time(const WrittenFormula& written, const Statements& said) {
  const Expression formula = read_formula(
      written, [&](std::string_view text) { return parse_of_parameters(text, said); });
  for (const Parameter& parameter : said.parameters)
    if (parameter.free && formula.variables().contains(parameter.name))
      throw ModelError(written.place, "the time of an event cannot be estimated",
                       "make " + parameter.name + " fixed, or write a condition: when t > " +
                           parameter.name + ": ...");
  return value_of(written, said);
}

/// An event, if the line is one.
bool take_event(OdeLine& line, Statements& said) {
  for (const char* word : {"at", "every", "when"}) {
    if (!line.take_keyword(word)) continue;
    said.events.push_back(read_event(line, word, [&](const WrittenFormula& written) {
      return read_event_time(written, said);
    }));
    return true;
  }
  return false;
}

void read_statement(OdeLine& line, Statements& said) {
  if (line.take_keyword("time")) {
    read_time(line, said);
  } else if (line.take_keyword("input")) {
    read_input(line, said);
  } else if (line.take_keyword("state")) {
    read_state(line, said);
  } else if (line.take_keyword("param")) {
    read_parameter(line, said);
  } else if (line.take_keyword("initial")) {
    read_initial(line, said);
  } else if (line.take_keyword("fixed")) {
    read_choice(line, true, said);
  } else if (line.take_keyword("free")) {
    read_choice(line, false, said);
  } else if (!take_event(line, said)) {
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
    OdeLine line(content, number, source);
    if (!line.at_end()) read_statement(line, said);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return said;
}

std::vector<Equation> equations_of(const Statements& said, const VariableIndex& variables) {
  std::set<std::string> parameters;
  for (const Parameter& parameter : said.parameters) parameters.insert(parameter.name);
  std::vector<Equation> equations;
  for (const Quantity& state : said.states) {
    const auto found = said.equations.find(state.name);
    if (found == said.equations.end())
      throw ModelError(said.source, "the state '" + state.name + "' has no equation",
                       "add d" + state.name + "/dt = ...; 0 means that it is constant");
    const std::vector<Expression> summands = read_formula(
        found->second,
        [&](std::string_view text) { return parse_known_summands(text, variables); });
    try {
      equations.push_back(linear_terms(summands, variables, parameters));
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
      summand.fixed =
          any_free && summand.fixed && !system.gives_size(summand.term.expression());
  const VariableIndex variables(system.symbolic().variables());
  FirstLines first;
  for (const auto& [state, term, line, fixed] : said.choices) {
    Equation& equation = equations[place_of_state(said, state, term.place)];
    const Term chosen(
        read_formula(term, [&](std::string_view text) { return parse_known(text, variables); }),
        variables);
    first.add(
        "what is said of " + chosen.name() + " in " + left_hand_side(state, *said.evolution),
        line, term.place, "keep one");
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
  const VariableIndex variables(model.variables());
  std::vector<Output> outputs;
  for (const WrittenOutput& output : said.outputs) {
    outputs.push_back(
        {output.name, output.unit, read_formula(output.formula, [&](std::string_view text) {
           return parse_known(text, variables);
         }),
         output.noise});
    if (const auto fault = output_fault(outputs.back(), variables))
      throw ModelError(output.formula.place, "output " + output.name + ": " + fault->problem,
                       fault->remedy);
  }
  return model.with_outputs(std::move(outputs));
}

OdeModel with_initial(const Statements& said, const OdeModel& model) {
  std::vector<std::optional<InitialValue>> initial(model.states().size());
  FirstLines first;
  for (const WrittenInitial& written : said.initial) {
    const std::size_t state = place_of_state(said, written.state, written.place);
    first.add("the initial value of '" + written.state + "'", written.line, written.place,
              "keep one");
    initial[state] = written.value;
    if (written.value.deviation && !(*written.value.deviation > 0.0))
      throw ModelError(written.place, "a deviation is not above 0", "write fixed for 0");
  }
  return model.with_initial(std::move(initial));
}

}  // namespace

SystemModel parse_ode_system(std::string_view bytes, const std::string& source) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  const std::string text = to_utf8(bytes);
  const Statements said = read_statements(text, source);
  if (said.states.empty())
    throw ModelError(source, "there are no equations", "write e.g. dx/dt = -0.5*x");
  std::vector<Quantity> inputs = said.inputs;
  for (const Parameter& parameter : said.parameters)
    inputs.push_back({parameter.name, parameter.unit});
  const OdeModel frame(said.states, inputs, std::vector<Equation>(said.states.size()),
                       said.time_unit);
  std::vector<Equation> equations = equations_of(said, VariableIndex(frame.variables()));
  mark_fixed(said, SystemModel(frame, said.parameters), equations);
  const OdeModel model = frame.with_equations(std::move(equations))
                             .with_evolution(said.evolution.value_or(Evolution::Flow));
  return {with_events(said.events, with_initial(said, with_outputs(said, model))),
          said.parameters};
}

OdeModel parse_ode(std::string_view bytes, const std::string& source) {
  return parse_ode_system(bytes, source).model();
}

}  // namespace lacuna
