// SPDX-License-Identifier: MIT
#include "cli/configuration/identification_configuration.hpp"

#include "core/base/json.hpp"
#include "option_reader.hpp"

namespace lacuna {
namespace {

/// Overrides options by what a configuration says of them.
template <class Options>
void read(const Registry& registry, const Json& root, Options& options) {
  const std::string key(Options::kInfo.name);
  if (!root.contains(key)) return;
  const auto rules = std::dynamic_pointer_cast<const Rules<Options>>(read_stage(
      registry, RulesOf<Options>::kKind, root.at(key), "$." + key, Rules<Options>(options)));
  options = rules->options();
}

}  // namespace

IdentificationOptions identification_options(const Configuration& configuration,
                                             const Registry& registry) {
  const Json root = sorted_json(configuration.text());
  IdentificationOptions options;
  read(registry, root, options.library);
  read(registry, root, options.forms);
  read(registry, root, options.dead_time);
  read(registry, root, options.plain_structure);
  read(registry, root, options.validation);
  read(registry, root, options.relations);
  read(registry, root, options.advice);
  read(registry, root, options.map);
  read(registry, root, options.sync);
  options.advice.search = options.forms;
  return options;
}

}  // namespace lacuna
