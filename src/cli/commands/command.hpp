// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "cli/parsing/options.hpp"
#include "lacuna/cli/commands/cli.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "outputs.hpp"

namespace lacuna::cli {

/// What a command works with besides its own options.
struct Session {
  const Registry& registry;
  CliStreams streams;
  std::stop_token stop;
  std::string command_line = {};  ///< as a shell would take it, for reports
  const Team* team = nullptr;     ///< processes among which the work is divided
  /// When the command began, from which a time limit counts.
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::span<const Command> commands = {};  ///< all that there are
};

Command declare_identify();
Command declare_bench();
Command declare_simulate();
Command declare_fit();
Command declare_plan();
Command declare_sync();
Command declare_diagnose();
Command declare_model();
Command declare_export();
Command declare_check();
Command declare_compare();
Command declare_completion();
Command declare_list();
Command declare_describe();
Command declare_start();

/// What `lacuna --help` shows.
std::string program_help(std::span<const Command> commands);

/// What `--help` of a command shows: the options that are used most; `--help-all` all, in
/// groups.
std::string command_help(const Command& command, bool all);

/// Options that every computing command has.
struct RunOptions {
  std::uint64_t seed = 1;
  int threads = 1;
  std::uint64_t max_memory = 0;  ///< bytes
  std::optional<double> time_limit;  ///< seconds
  Thoroughness effort = Thoroughness::Normal;
  std::string progress = "auto";
};

void declare_run_options(Command& command, RunOptions& options);

/// Efforts by the names that users give them.
const std::map<std::string, Thoroughness>& efforts();

/// The option --time-limit: at the limit the command ends, with what it has by then or, where
/// that is nothing (OutOfTime), with an error.
void declare_time_limit(Command& command, RunOptions& options);

/// Options of a command that can give an answer with some of its stages left out.
void declare_effort_options(Command& command, RunOptions& options);

/// Reads a size in memory: 300MB, 4G or a number of bytes.
Reader bytes_in(std::uint64_t& bytes);

/// The run context of a command, with progress on standard error where that is wanted.
RunContext make_context(const Session& session, const RunOptions& options);

/// Whether progress is on one line of a terminal: what is written there is seen at once.
bool is_watched(const Session& session, const RunOptions& options);

/// Ends the line that progress was shown on.
void finish_progress(const Session& session, const RunOptions& options);

/// The exit status of a command with a verdict: where none may be given, a line on standard
/// error says why.
int status_of(const Session& session, const Admission& admission);

/// Writes text to a file, whole or not at all, or to standard output for "-".
void write_output(const Session& session, const std::string& path, const std::string& text);

/// Shows text for people in lines of a screen (folded()); nothing in it (a column's name) can act
/// on the terminal.
void show(const Session& session, const std::string& text);

/// A model by its file, or as a program has it in memory.
struct ModelSource {
  std::string path = {};  ///< or the name of a test system, when there is no such file
  std::optional<SystemModel> given = {};  ///< in place of a file
};

/// The model with its parameters.
SystemModel load_system(const ModelSource& source);

/// The same with numbers for them.
OdeModel load_model(const ModelSource& source);

/// The same for a command that needs a flow. @throws ModelError for a map.
OdeModel load_flow(const ModelSource& source, const std::string& command);

}  // namespace lacuna::cli
