// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// Reads a model from JSON text of the format "lacuna.model/1".
/// @param source name for messages.
/// @throws ModelError naming source and JSON path ("m.json: $.equations[1].terms[0].term,
///   column 3") or line and column: not JSON, another format, a missing or unknown key, an
///   unknown name in a term.
OdeModel parse_model(std::string_view json, const std::string& source);

/// The same with its parameters as they are named there; parse_model() has numbers for them.
SystemModel parse_system(std::string_view json, const std::string& source);

/// Reads a model file, as text (parse_ode()) where it ends in ".ode", else as JSON.
/// @throws FileError when it cannot be read; ModelError as parse_model() and parse_ode().
OdeModel read_model(const std::filesystem::path& path);

/// The same with its parameters.
SystemModel read_system(const std::filesystem::path& path);

/// The model as JSON text; parse_system() gives the same model back, to the last bit.
std::string format_model(const SystemModel& model);

/// The model as a file of that name holds it: as text (format_ode()) where the name ends in
/// ".ode", else as JSON.
std::string format_model_for(const std::filesystem::path& path, const SystemModel& model);

/// Writes the model so, whole or not at all. @throws
/// FileError when it cannot be written.
void write_model(const std::filesystem::path& path, const SystemModel& model);

}  // namespace lacuna
