// SPDX-License-Identifier: MIT
// Files of models.
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

/// Reads a model from text with one statement a line (`#` starts a comment):
///
///     time s
///     input u [V] hold zero
///     state x1 [V]
///     param k = 1/20 [1/s] in 0..1
///     param T = 2 fixed
///     dx1/dt = -k*sqrt(x1) + 0.5*delay(u,T)
///     y = abs(x1) [V]
///     initial x1 = 0 fixed
///
/// States are those that have an equation, in the order in which they are named first; `state`
/// gives a unit. A parameter is a number with a name. Formulas become sums of coefficients
/// times terms: products are multiplied out over sums (x*(28-z) is 28 x - x*z), numbers in
/// front of a term are its coefficient. `NAME = FORMULA` is an output. `initial` gives a start,
/// which may be `fixed` or have a `deviation`.
///
/// A text with free parameters says by them what is to be estimated: a term without a number in
/// front of it is taken as it stands there (WeightedTerm::fixed). `free dx1/dt: TERM` and
/// `fixed dx1/dt: TERM` say it of one term.
/// @param text UTF-8; what is not is read as Latin-1.
/// @param source name for messages.
/// @throws ModelError with source, line and column: a statement that is none, an unknown or
///   repeated name, a formula that cannot be read, a parameter that is not in its range.
SystemModel parse_ode_system(std::string_view text, const std::string& source);

/// The same with numbers for the parameters.
OdeModel parse_ode(std::string_view text, const std::string& source);

/// The model as such text; parse_ode_system() gives a model with the same right-hand sides.
/// Errors and intervals of coefficients are left out.
std::string format_ode(const SystemModel& model);

}  // namespace lacuna
