// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <thread>

#include "cli/terminal/colour.hpp"
#include "cli/terminal/memory_limit.hpp"
#include "cli/terminal/progress_line.hpp"
#include "cli/terminal/progress_log.hpp"
#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/near_file.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "report/pages/folded_text.hpp"

namespace lacuna::cli {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

/// Seconds: what a clock shows of a run, and what it can count.
constexpr double kShortestLimit = 1e-3, kLongestLimit = 1e9;

/// Digits and nothing else, as strtoull takes "-1" for 2^64 - 1. @return what is wrong.
std::string check_seed(const std::string& text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stop == end) return "";
  return "'" + text + "' is not a whole number from 0 to 2^64 - 1";
}

/// A check of a number of seconds.
std::string check_time_limit(const std::string& text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stop == end && value >= kShortestLimit && value <= kLongestLimit)
    return "";
  return "'" + text + "' is no time from 0.001 to 1e9 seconds";
}

/// Bytes of "4G", "500MB", "200k" or plain digits. @return what is wrong.
std::string read_bytes(const std::string& text, std::uint64_t& bytes) {
  constexpr std::string_view kUnits = "kMGT";
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const std::size_t unit = stop == end ? std::string::npos : kUnits.find(*stop);
  const unsigned shift = stop == end ? 0U : 10U * (static_cast<unsigned>(unit) + 1U);
  const std::string_view rest(stop == end ? end : stop + 1, end);
  const bool known =
      stop == end || (unit != std::string::npos && (rest.empty() || rest == "B"));
  if (error != std::errc() || !known || value > (std::uint64_t{1} << 62U) >> shift ||
      value << shift < kLeastMemory)
    return "'" + text + "' is not a size from 16M on, such as 500M or 4G";
  bytes = value << shift;
  return "";
}

/// How progress is shown: on one line of a terminal, in lines of a log, or not at all. A program
/// that has the library write into a stream of its own gets no log.
enum class Shown { Line, Log, Nothing };

Shown progress_of(const Session& session, const RunOptions& options) {
  if (options.progress == "always") return Shown::Line;
  if (options.progress == "never" || &session.streams.err != &std::cerr) return Shown::Nothing;
  return isatty(STDERR_FILENO) != 0 ? Shown::Line : Shown::Log;
}

std::function<void(const Progress&)> progress_function(std::ostream& err, Shown shown) {
  if (shown == Shown::Nothing) return nullptr;
  if (shown == Shown::Log)
    return [log = std::make_shared<ProgressLog>(err)](const Progress& progress) {
      log->note(progress);
    };
  return [&err, line = ProgressLine()](const Progress& progress) mutable {
    err << "\r\x1b[K" << line.text(progress, Clock::now()) << std::flush;
  };
}

}  // namespace

Reader bytes_in(std::uint64_t& bytes) {
  return [&bytes](const std::string& text) { return read_bytes(text, bytes); };
}

void declare_run_options(Command& command, RunOptions& options) {
  command.add("--seed", &options.seed, "Start of everything random in the run")
      .check({check_seed, "whole number"})
      .show_default();
  options.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 64U));
  command
      .add("--threads", &options.threads,
           "Threads; the result does not depend on it [default: the machine's cores]")
      .check(from_to(1, 1024));
  options.max_memory = default_memory();
  command.add("--max-memory SIZE", bytes_in(options.max_memory),
              "Memory that the run may take, e.g. 4G, in bytes [default: three quarters "
              "of the machine's]");
  command
      .add("--progress", &options.progress,
           "Progress on standard error: always, never, auto (on a terminal at once, else "
           "a line every ten seconds)")
      .check(one_of({"always", "never", "auto"}))
      .show_default();
}

const std::map<std::string, Thoroughness>& efforts() {
  static const std::map<std::string, Thoroughness> kEfforts{{"quick", Thoroughness::Quick},
                                                            {"normal", Thoroughness::Normal},
                                                            {"full", Thoroughness::Full}};
  return kEfforts;
}

void declare_time_limit(Command& command, RunOptions& options) {
  command
      .add("--time-limit S", &options.time_limit,
           "Seconds after which the run ends with the answer that it has by then and names "
           "the stages left out")
      .check({check_time_limit, "0.001 to 1e9"});
}

void declare_effort_options(Command& command, RunOptions& options) {
  command.add("--effort quick|normal|full", word_of(efforts(), options.effort),
              "quick: only what an answer needs; normal: all stages, as far as something "
              "can be gained; full: all to their end [default: normal]");
  declare_time_limit(command, options);
}

RunContext make_context(const Session& session, const RunOptions& options) {
  RunContext context;
  if (options.time_limit)
    context.deadline = session.begin + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(*options.time_limit));
  context.stop = session.stop;
  context.threads = options.threads;
  context.seed = options.seed;
  context.team = session.team;
  if (context.leads())
    context.progress =
        progress_function(session.streams.err, progress_of(session, options));
  return context;
}

bool is_watched(const Session& session, const RunOptions& options) {
  return progress_of(session, options) == Shown::Line;
}

void finish_progress(const Session& session, const RunOptions& options) {
  if (is_watched(session, options))
    session.streams.err << "\r\x1b[K" << std::flush;
}

int status_of(const Session& session, const Admission& admission) {
  if (admission.stands()) return 0;
  session.streams.err << "lacuna: error: no verdict: " << admission.why << "; "
                      << admission.remedy << "\n";
  return 1;
}

void write_output(const Session& session, const std::string& path, const std::string& text) {
  if (path == "-")
    session.streams.out << text;
  else
    write_file_atomically(path, text);
}

void show(const Session& session, const std::string& text) {
  const std::string shown = printable(text);
  session.streams.out << folded(shows_colour(session.streams.out) ? coloured(shown) : shown);
}

OdeModel load_model(const ModelSource& source) { return load_system(source).model(); }

OdeModel load_flow(const ModelSource& source, const std::string& command) {
  OdeModel model = load_model(source);
  check_flow(model, command);
  return model;
}

SystemModel load_system(const ModelSource& source) {
  if (source.given) return *source.given;
  std::error_code unreadable;
  if (fs::exists(source.path, unreadable)) return read_system(source.path);
  std::vector<std::string> known;
  for (const TestSystem& system : test_systems()) {
    if (system.name == source.path) return system.model;
    known.push_back(system.name);
  }
  const auto near = nearest_name(source.path, known);
  if (near && remedy_of_missing(source.path, "").empty())
    throw FileError(source.path, "there is no such model file or test system",
                    "did you mean the test system '" + *near + "'?");
  return read_system(source.path);
}

}  // namespace lacuna::cli
