// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "lacuna/core/atomic_file.hpp"
#include "lacuna/model/model_file.hpp"
#include "lacuna/systems/test_systems.hpp"

namespace lacuna::cli {
namespace {

bool shows_progress(const Session& session, const RunOptions& options) {
  if (options.progress != "auto") return options.progress == "always";
  return &session.streams.err == &std::cerr && isatty(STDERR_FILENO) != 0;
}

}  // namespace

void declare_run_options(CLI::App& app, RunOptions& options) {
  app.add_option("--seed", options.seed, "Start of everything random in the run")
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--progress", options.progress,
                 "Progress on standard error: always, never, auto (where it is a terminal)")
      ->check(CLI::IsMember({"always", "never", "auto"}))
      ->capture_default_str();
}

RunContext make_context(const Session& session, const RunOptions& options) {
  RunContext context;
  context.stop = session.stop;
  context.threads = options.threads;
  context.seed = options.seed;
  if (!shows_progress(session, options)) return context;
  std::ostream& err = session.streams.err;
  context.progress = [&err](const Progress& progress) {
    err << "\r\x1b[K" << progress.activity << ": "
        << static_cast<int>(100.0 * progress.fraction) << " %" << std::flush;
  };
  return context;
}

void finish_progress(const Session& session, const RunOptions& options) {
  if (shows_progress(session, options)) session.streams.err << "\r\x1b[K" << std::flush;
}

void write_output(const Session& session, const std::string& path, const std::string& text) {
  if (path == "-")
    session.streams.out << text;
  else
    write_file_atomically(path, text);
}

OdeModel load_model(const std::string& path) {
  if (!std::filesystem::exists(path))
    for (const TestSystem& system : test_systems())
      if (system.name == path) return system.model;
  return read_model(path);
}

}  // namespace lacuna::cli
