// SPDX-License-Identifier: MIT
#include "lacuna/model/model_file.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "core/utf8.hpp"
#include "formula_error.hpp"
#include "lacuna/core/atomic_file.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/core/names.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/model/ode_text.hpp"
#include "operations.hpp"
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

Term read_term(const JsonPlace& place, const Variables& variables) {
  const std::string text = place.text();
  try {
    return Term::parse(text, variables);
  } catch (const FormulaError& error) {
    place.fail(error.problem(), error.remedy(), ", column " + std::to_string(error.column()));
  } catch (const ModelError& error) {
    place.fail(error.problem(), error.remedy());
  }
}

std::array<double, 2> read_interval(const JsonPlace& place) {
  if (place.size() != 2)
    place.fail("an interval has 2 numbers, not " + std::to_string(place.size()),
               "give [low, high]");
  const std::array<double, 2> interval{place.at(0).number(), place.at(1).number()};
  if (interval[0] > interval[1]) place.fail("the interval is upside down", "give [low, high]");
  return interval;
}

WeightedTerm read_summand(const JsonPlace& place, const Variables& variables) {
  place.expect_keys({"term", "coefficient", "ci95", "stderr"});
  WeightedTerm summand{read_term(place.at("term"), variables),
                       place.at("coefficient").number()};
  if (const auto error = place.find("stderr")) {
    summand.standard_error = error->number();
    if (*summand.standard_error < 0.0) error->fail("a standard error is negative", "remove it");
  }
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

std::vector<std::string> names_of(const std::vector<Quantity>& quantities) {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities) names.push_back(quantity.name);
  return names;
}

OdeModel read_document(const JsonPlace& root) {
  root.expect_keys({"format", "description", "time_unit", "states", "inputs", "equations"});
  check_format(root);
  if (const auto description = root.find("description")) description->text();
  std::set<std::string> taken;
  const JsonPlace state_list = root.at("states");
  std::vector<Quantity> states = read_quantities(state_list, taken, false);
  if (states.empty()) state_list.fail("there are no states", "name at least one");
  std::vector<Quantity> inputs;
  if (const auto list = root.find("inputs")) inputs = read_quantities(*list, taken, true);
  const auto unit = read_unit(root, "time_unit");
  std::vector<Equation> equations =
      read_equations(root.at("equations"), {names_of(states), names_of(inputs)});
  return OdeModel(std::move(states), std::move(inputs), std::move(equations),
                  unit.value_or("s"));
}

}  // namespace

OdeModel parse_model(std::string_view json, const std::string& source) {
  const nlohmann::json document = parse_strict_json(json, source);
  return read_document(JsonPlace(document, source));
}

OdeModel read_model(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code unreadable;
  if (!file || std::filesystem::is_directory(path, unreadable))
    throw FileError(path.string(), "the model file cannot be read",
                    "check that it exists and that it may be read");
  const std::string text{std::istreambuf_iterator<char>(file),
                         std::istreambuf_iterator<char>()};
  if (file.bad()) throw FileError(path.string(), "reading failed", "check the disk");
  if (path.extension() == kTextExtension) return parse_ode(text, path.string());
  return parse_model(text, path.string());
}

std::string format_model_for(const std::filesystem::path& path, const OdeModel& model) {
  return path.extension() == kTextExtension ? format_ode(model) : format_model(model);
}

void write_model(const std::filesystem::path& path, const OdeModel& model) {
  write_file_atomically(path, format_model_for(path, model));
}

}  // namespace lacuna
