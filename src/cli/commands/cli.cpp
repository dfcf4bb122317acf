// SPDX-License-Identifier: MIT
#include "lacuna/cli/commands/cli.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <stdexcept>

#include "cli/start/trials.hpp"
#include "cli/terminal/interrupt.hpp"
#include "cli/terminal/memory_limit.hpp"
#include "cli/terminal/shell_text.hpp"
#include "command.hpp"
#include "core/base/text.hpp"
#include "core/base/user_text.hpp"
#include "core/base/utf8.hpp"
#include "lacuna/version.hpp"

namespace lacuna {
namespace {

constexpr int kNoAnswer = 1, kBadInput = 2;

/// After an interrupt a run has so long to end by itself. With 20 ms between two looks at it,
/// and the time to give gigabytes back, the program is gone within 0.2 s.
constexpr std::chrono::milliseconds kPatience{100};

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return printable(text);
}

int fail(const CliStreams& streams, const std::string& text) {
  streams.err << "lacuna: error: " << one_line(text) << "\n";
  return kBadInput;
}

/// An empty text is no value; the parser takes it for one. @return the option that has it.
std::optional<std::string> empty_option(const std::vector<cli::GivenOption>& given) {
  for (const auto& [option, words] : given)
    if (std::find(words.begin(), words.end(), "") != words.end()) return option->name();
  return std::nullopt;
}

/// What the arguments alone ask for. @return exit status when there is nothing more to do.
std::optional<int> answered(const cli::Asked& asked, std::span<const cli::Command> commands,
                            const CliStreams& streams) {
  using For = cli::Asked::For;
  if (!asked.fault.empty()) return fail(streams, "command line: " + asked.fault);
  if (asked.what == For::Run) {
    const auto empty = empty_option(asked.given);
    if (!empty) return std::nullopt;
    return fail(streams, "command line: " + *empty +
                             ": the value is empty; give one or leave the option out");
  }
  if (asked.what == For::Version)
    streams.out << "lacuna " << kVersion << "\n";
  else if (asked.command == nullptr)
    streams.out << cli::program_help(commands);
  else
    streams.out << cli::command_help(*asked.command, asked.what == For::AllHelp);
  return 0;
}

/// What the run may take, in bytes.
std::uint64_t memory_of(const cli::Asked& asked) {
  std::uint64_t bytes = cli::default_memory();
  for (const auto& [option, words] : asked.given)
    if (option->names == "--max-memory") cli::bytes_in(bytes)(words.front());
  return bytes;
}

/// The command with what it works on: "identify record.csv".
std::string place_of(const cli::Asked& asked) {
  std::string place = asked.command->name;
  for (const auto& [option, words] : asked.given)
    if (option->is_argument())
      for (const std::string& word : words) place += " " + word;
  return place;
}

int fail_of_memory(const CliStreams& streams, const cli::Asked& asked) {
  return fail(streams, place_of(asked) + ": not enough memory (" +
                           std::to_string(memory_of(asked) >> 20U) +
                           " MB); use fewer samples or terms, or raise --max-memory");
}

/// Runs a command; what goes wrong becomes one line and a status.
int run_chosen(const cli::Asked& asked, const cli::Session& session) {
  const CliStreams& streams = session.streams;
  const auto interrupted = [&] {
    streams.err << "lacuna: interrupted; nothing was written\n";
    return cli::kInterrupted;
  };
  try {
    const cli::MemoryLimit limit(memory_of(asked));
    cli::keep_freed_memory();
    cli::check_outputs(cli::files_read_by(asked.given), cli::outputs_of(asked.given));
    return asked.command->run(session);
  } catch (const OutOfTime&) {
    streams.err << "lacuna: error: " << one_line(place_of(asked))
                << ": incomplete: the time limit came before anything was known; nothing was "
                   "written; give it more time (--time-limit)\n";
    return kNoAnswer;
  } catch (const Cancelled&) {
    return interrupted();
  } catch (const ArgumentError& error) {  // its place is a function, which users do not know
    const char* look =
        error.remedy().empty() ? "; look at what is read with `lacuna check`" : "";
    return fail(streams, place_of(asked) + ": " + user_text(error) + look);
  } catch (const Error& error) {
    // A read that was broken into by an interrupt has failed too.
    return session.stop.stop_requested() ? interrupted() : fail(streams, error.what());
  } catch (const std::bad_alloc&) {
    return fail_of_memory(streams, asked);
  } catch (const std::length_error&) {  // more than any container can hold
    return fail_of_memory(streams, asked);
  } catch (const std::exception& error) {
    return fail(streams, place_of(asked) + ": " + error.what() +
                             "; this is an error of lacuna, please report it");
  }
}

std::string command_line(int argc, const char* const* argv) {
  std::vector<std::string> words{"lacuna"};
  words.insert(words.end(), argv + 1, argv + argc);
  return cli::shell_line(words);
}

/// The status, unless what was to be shown is lost.
int with_output_checked(int status, const CliStreams& streams) {
  streams.out.flush();
  if (streams.out) return status;
  return fail(streams,
              "standard output: the result could not be written in full; check that "
              "there is space, or give a file (-o, --json)");
}

/// Its option is which of the trials.
cli::Command declare_demo(std::vector<std::string>& names) {
  cli::Command command{"demo",
                       "Run the commands to try, with the records that come with the program"};
  command.add("NAME", &names, "Which of them [default: all]")
      .check(cli::one_of({"check", "diagnose", "identify"}));
  return command;
}

/// Its option is the command.
cli::Command declare_help(std::string& name) {
  cli::Command command{"help", "Show the help of lacuna, or of one of its commands"};
  command.add("COMMAND", &name, "Which command [default: what there is]");
  return command;
}

int show_help(std::span<const cli::Command> commands, const std::string& name,
              const CliStreams& streams) {
  std::vector<std::string> names;
  for (const cli::Command& command : commands) {
    names.push_back(command.name);
    if (names.back() != name) continue;
    streams.out << cli::command_help(command, false);
    return 0;
  }
  if (!name.empty())
    return fail(streams, "help " + name + ": there is no command '" + name + "'; " +
                             suggestion(name, names));
  streams.out << cli::program_help(commands);
  return 0;
}

int run_words(int argc, const char* const* argv, cli::Session session,
              cli::InterruptGuard::Patience patience);

/// Runs the trials of these names (all without one), each below its line; ends with the first that
/// fails.
int run_demo(const std::vector<std::string>& names, const cli::Session& session,
             cli::InterruptGuard::Patience patience) {
  const auto data = cli::shipped_data();
  if (!data)
    return fail(session.streams,
                "demo: the records that come with the program are not beside it; run it from "
                "where it was installed or built");
  for (const cli::TrialCommand& trial : cli::trials(*data)) {
    const bool is_asked =
        names.empty() || std::find(names.begin(), names.end(), trial.name) != names.end();
    if (!is_asked) continue;
    session.streams.out << "# " << trial.purpose << "\n$ lacuna "
                        << printable(cli::shell_line(trial.words)) << "\n\n" << std::flush;
    std::vector<const char*> words{"lacuna"};
    for (const std::string& word : trial.words) words.push_back(word.c_str());
    const int status =
        run_words(static_cast<int>(words.size()), words.data(), session, patience);
    if (status != 0) return status;
    session.streams.out << "\n";
  }
  return 0;
}

/// Parses and runs. @param session without what the arguments and the guard give.
/// @param patience of the guard against interrupts.
int run_words(int argc, const char* const* argv, cli::Session session,
              cli::InterruptGuard::Patience patience) {
  const CliStreams& streams = session.streams;
  std::vector<std::string> trials;
  std::string topic;
  const std::vector<cli::Command> commands = {
      cli::declare_identify(),   cli::declare_simulate(), cli::declare_sync(),
      cli::declare_diagnose(),   cli::declare_fit(),      cli::declare_model(),
      cli::declare_export(),     cli::declare_check(),    cli::declare_compare(),
      cli::declare_completion(), cli::declare_list(),     cli::declare_describe(),
      cli::declare_plan(),       cli::declare_bench(),    cli::declare_start(),
      declare_demo(trials),      declare_help(topic)};
  const cli::Asked asked = cli::parse(commands, {argv + std::min(argc, 1), argv + argc});
  if (const auto status = answered(asked, commands, streams))
    return with_output_checked(*status, streams);
  const std::string& name = asked.command->name;
  if (name == "help") return with_output_checked(show_help(commands, topic, streams), streams);
  if (name == "demo") return run_demo(trials, session, patience);

  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of its write
  const cli::InterruptGuard interrupt(patience);
  session.stop = interrupt.token();
  session.command_line = command_line(argc, argv);
  session.commands = commands;
  const bool leads = session.team == nullptr || session.team->rank() == 0;
  const bool divides = name == "identify" || name == "diagnose";
  if (!leads && !divides) return 0;
  return with_output_checked(run_chosen(asked, session), streams);
}

}  // namespace

int run_cli(int argc, const char* const* argv) {
  try {
    return run_cli(argc, argv, default_registry());
  } catch (const std::bad_alloc&) {  // before there is a command
    return fail({std::cout, std::cerr}, "lacuna: not enough memory to start; raise the limit");
  }
}

int run_cli(int argc, const char* const* argv, const Registry& registry) {
  if (argc <= 1 && isatty(STDOUT_FILENO) != 0) {
    std::cout << cli::welcome(cli::shipped_data());
    return 0;
  }
  return run_words(argc, argv, {registry, {std::cout, std::cerr, &std::cin}, {}}, kPatience);
}

int run_cli(int argc, const char* const* argv, const Registry& registry, CliStreams streams) {
  return run_words(argc, argv, {registry, streams, {}}, {});
}

int run_cli(int argc, const char* const* argv, const Registry& registry, CliStreams streams,
            const Team& team) {
  return run_words(argc, argv, {registry, streams, {}, {}, &team}, {});
}

}  // namespace lacuna
