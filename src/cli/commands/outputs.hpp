// SPDX-License-Identifier: MIT
// What is read and what is written are kept apart, for all commands in one place.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/parsing/options.hpp"

namespace lacuna::cli {

/// A file, or a folder of pictures, that a command is going to write.
struct OutputFile {
  std::string option;
  std::string path;
  bool is_folder = false;
};

/// What the options that were given write: those with the form "FILE|-" (or "FILE.html|-"; "-"
/// is standard output) a file, those with the form "FOLDER" pictures.
std::vector<OutputFile> outputs_of(const std::vector<GivenOption>& given);

/// All files that are there and that any other word of the command names, patterns and sheets
/// of workbooks taken apart (files_named()): what may be read.
std::vector<std::filesystem::path> files_read_by(const std::vector<GivenOption>& given);

/// Keeps apart what is read and what is written, and tries whether it can be written, before
/// any work is done. One file is one, by whatever links and names it is called.
/// @throws ConfigError when a file would replace one that is read, or two results would go to
/// one
///   file; FileError for one that cannot be written (check_writable()).
void check_outputs(const std::vector<std::filesystem::path>& read,
                   const std::vector<OutputFile>& outputs);

}  // namespace lacuna::cli
