// SPDX-License-Identifier: MIT
#include "settings.hpp"

namespace lacuna::benchmarks {

StudyArguments study_arguments(int argc, char** argv) {
  StudyArguments arguments;
  Configuration configuration;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.find('=') == std::string::npos) {
      arguments.places.push_back(argument);
      continue;
    }
    arguments.settings.push_back(argument);
    configuration.set(argument);
  }
  arguments.options = identification_options(configuration, default_registry());
  return arguments;
}

std::string settings_text(const StudyArguments& arguments) {
  std::string text;
  for (const std::string& setting : arguments.settings) text += " " + setting;
  return text;
}

}  // namespace lacuna::benchmarks
