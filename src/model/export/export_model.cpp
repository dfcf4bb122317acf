// SPDX-License-Identifier: MIT
#include "lacuna/model/export/export_model.hpp"

#include <map>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "model/equations/formula_channel.hpp"
#include "model/export/latex.hpp"
#include "model/export/sources.hpp"
#include "model/expressions/unbound_delays.hpp"

namespace lacuna {
namespace {

using Exporter = std::string (*)(const SystemModel&);

const std::map<std::string, Exporter>& exporters() {
  static const std::map<std::string, Exporter> all = {
      {"c", export_c},           {"cpp", export_cpp},           {"latex", export_latex},
      {"matlab", export_matlab}, {"modelica", export_modelica}, {"python", export_python},
      {"spice", export_spice}};
  return all;
}

/// What every exported equation is: the rate of a state.
void check_rates(const OdeModel& model) {
  check_flow(model, "export");
  check_no_events(model, "export");
  for (const Quantity& state : model.states())
    if (is_formula_channel(state))
      throw ModelError("export", "'" + state.name + "' is a measured formula and has no rate",
                       "export the model without it");
}

/// Numbers for all parameters where a delay depends on one, which no language takes.
SystemModel with_bound_delays(const SystemModel& model) {
  for (const Equation& equation : model.symbolic().equations())
    for (const WeightedTerm& summand : equation)
      if (!names_in_delay_times(summand.term.expression()).empty()) return model.model();
  return model;
}

}  // namespace

std::vector<std::string> export_formats() {
  std::vector<std::string> names;
  for (const auto& [name, exporter] : exporters()) names.push_back(name);
  return names;
}

std::string export_model(const SystemModel& model, const std::string& format) {
  const auto found = exporters().find(format);
  if (found == exporters().end())
    throw ConfigError("export", "there is no format '" + format + "'",
                      suggestion(format, export_formats()));
  check_rates(model.symbolic());
  return found->second(with_bound_delays(model));
}

}  // namespace lacuna
