// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::cli {

/// A command to try.
struct TrialCommand {
  std::string name;     ///< "check"
  std::string purpose;  ///< what it shows, a sentence
  std::vector<std::string> words;  ///< of the command line, behind the program's name
};

/// The folder of the records that come with the program: "data" or "share/lacuna/data" below one
/// of the three folders above the program's file; nothing where there is none.
/// @param program path of its file.
std::optional<std::filesystem::path> shipped_data(const std::filesystem::path& program);

/// The same of the program that runs.
std::optional<std::filesystem::path> shipped_data();

/// Three commands for the records in that folder.
std::vector<TrialCommand> trials(const std::filesystem::path& data);

/// What the program shows that was called without a command.
/// @param data nothing: the records are not there, and no command is shown.
std::string welcome(const std::optional<std::filesystem::path>& data);

}  // namespace lacuna::cli
