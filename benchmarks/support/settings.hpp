// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/config/identification_configuration.hpp"

namespace lacuna::benchmarks {

/// Arguments of a study: those that have a place, and options of `identify` among them, written
/// PATH=VALUE: forms.same=0.2.
struct StudyArguments {
  std::vector<std::string> places;
  std::vector<std::string> settings;  ///< as they were written
  IdentificationOptions options;
};

/// @throws ConfigError as identification_options().
StudyArguments study_arguments(int argc, char** argv);

/// " forms.same=0.2": what a table says of its settings; empty where there are none.
std::string settings_text(const StudyArguments& arguments);

}  // namespace lacuna::benchmarks
