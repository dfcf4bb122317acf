// SPDX-License-Identifier: MIT
// Models of any names and texts in every language: texts change no token, and words are those
// of the language or of its table of names.
#include <algorithm>
#include <cstdlib>

#include "fuzz/export_lexer.hpp"
#include "fuzz/target.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/export/export_model.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "model/export/heading.hpp"
#include "model/export/languages.hpp"

namespace lacuna::fuzz {

/// Names in the first line, a formula of them in the second, behind it texts for units; or
/// .ode.
std::vector<std::string> seeds() {
  return {
      "x lambda void X gnd input _x __import__\nx^2*void - sqrt(X)/gnd\nm/s\xc2\xb2 \"*/\n",
      "a a_ A_ end\nclip(a,end,1) + step(a_) - a^11 + a^0.5\ncoding: utf-7\n\\input{x}\r.end",
      "state_ NULL M_PI time t1\nmin(NULL,1e-5)^t + 12345678901.25*tanh(time)\n\\\n\?\?/\n%{\n",
      "time s\ninput u [V]\nstate x [m]\ndx/dt = -x^2 + sin(u) - 3*abs(x)\ny = x*u [W]\n",
      "dlambda/dt = lambda*(28-X) + atan(X)\ndX/dt = delay(X,0.5)\n"};
}

namespace {

/// Pieces of a text between line feeds, at most three; the last has what is left.
std::vector<std::string> lines_of(std::string_view input) {
  std::vector<std::string> lines;
  while (lines.size() < 2 && input.find('\n') != std::string_view::npos) {
    lines.emplace_back(input.substr(0, input.find('\n')));
    input.remove_prefix(input.find('\n') + 1);
  }
  lines.emplace_back(input);
  lines.resize(3);
  return lines;
}

/// The same with these units everywhere.
OdeModel with_units(const OdeModel& model, const std::string& unit) {
  std::vector<Quantity> states = model.states(), inputs = model.inputs();
  for (Quantity& state : states) state.unit = unit;
  for (Quantity& input : inputs) input.unit = unit;
  std::vector<Output> outputs = model.outputs();
  for (Output& output : outputs) output.unit = unit;
  return OdeModel(states, inputs, model.equations(), unit).with_outputs(outputs);
}

/// A state and inputs of any names, with any text as units.
OdeModel made_of(std::string_view input) {
  const std::vector<std::string> lines = lines_of(input);
  std::set<std::string> names;
  for (const std::string& name : words_of(lines[0])) names.insert(name);
  Variables variables{{"x0"}, {names.begin(), names.end()}};
  std::vector<Quantity> inputs;
  for (const std::string& name : names) inputs.push_back({name, lines[2]});
  return OdeModel({{"x0", lines[2]}}, inputs, {{{Term::parse(lines[1], variables), 1.5}}},
                  lines[2]);
}

const NameRules& rules_of(const std::string& format) {
  if (format == "python") return python_names();
  if (format == "matlab") return matlab_names();
  if (format == "modelica") return modelica_names();
  if (format == "spice") return spice_names();
  return format == "latex" ? latex_names() : c_names();
}

bool is_known(const std::string& token, const ForeignLanguage& language,
              const std::set<std::string>& names) {
  const bool is_number = std::isdigit(static_cast<unsigned char>(token.front())) != 0;
  const bool is_mark =
      token.size() == 1 && std::isalnum(static_cast<unsigned char>(token[0])) == 0;
  // The sub-circuit's capacitor and source of a node.
  const bool is_part = language.comments_are_lines && names.contains(token.substr(1));
  return is_number || is_mark || is_part || token == "string" ||
         language.words.contains(token) || names.contains(token);
}

void check(const OdeModel& model, const std::string& format) {
  const ForeignLanguage& language = foreign_language(format);
  const std::string text = export_model(model, format);
  const auto is_printable = [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); };
  if (!std::all_of(text.begin(), text.end(), is_printable)) std::abort();
  const std::vector<std::string> tokens = tokens_of(text, language);
  if (tokens != tokens_of(export_model(with_units(model, "V"), format), language)) std::abort();
  if (language.has_commands) return;  // letters of names stand alone there
  std::set<std::string> names;
  for (const auto& [name, foreign] : foreign_names(model, rules_of(format)))
    names.insert(foreign);
  std::set<std::string> own;  // a state and the output that is just it share a name
  for (const Quantity& state : model.states()) own.insert(state.name);
  for (const Quantity& input : model.inputs()) own.insert(input.name);
  for (const Output& output : model.outputs()) own.insert(output.name);
  if (names.size() != own.size()) std::abort();
  for (const std::string& token : tokens)
    if (!is_known(token, language, names)) std::abort();
}

void check_all(const OdeModel& model) {
  for (const std::string& format : export_formats()) try {
      check(with_units(model, model.time_unit().empty() ? "s" : model.time_unit()), format);
    } catch (const ModelError&) {  // a delay, too deep
    }
}

}  // namespace

void take(std::string_view input) {
  try {
    check_all(parse_ode(input, "input"));
  } catch (const Error&) {
  }
  try {
    check_all(made_of(input));
  } catch (const Error&) {
  }
}

}  // namespace lacuna::fuzz
