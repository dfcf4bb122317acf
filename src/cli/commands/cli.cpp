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

void describe_program(CLI::App& app) {
  app.name("lacuna");
  app.description(
      "Finds the equations of a dynamical system in measured data.\n\n"
      "  lacuna check record.csv\n"
      "  lacuna identify record.csv --model-out model.json\n"
      "  lacuna sync model.json other_record.csv\n"
      "  lacuna diagnose --model nominal.json record.csv\n"
      "  lacuna simulate model.json --x0 1,0,0 --t-end 100 --dt 0.1 -o orbit.csv");
  app.footer(
      "Each command has its own --help. Exit status: 0 done; 1 the numbers do not allow "
      "an answer; 2 bad arguments, configuration or data; 130 interrupted.");
  app.set_version_flag("--version", "lacuna " + std::string(kVersion));
  app.require_subcommand(1);
}

/// An empty text is no value; CLI11 takes it for one. @return the option that has it.
std::optional<std::string> empty_option(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& text : option->results())
      if (text.empty()) return option->get_name();
  return std::nullopt;
}

/// Reads the arguments. @return exit status when there is nothing more to do.
std::optional<int> parse(CLI::App& app, int argc, const char* const* argv,
                         const CliStreams& streams) {
  try {
    app.parse(argc, argv);
    const auto empty = empty_option(*app.get_subcommands().front());
    if (!empty) return std::nullopt;
    return fail(streams, "command line: " + *empty +
                             ": the value is empty; give one or leave " + "the option out");
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error, streams.out, streams.err);
    return fail(streams, "command line: " + cli::sentence_of(error, app));
  }
}

/// What the run may take, in bytes.
std::uint64_t memory_of(const CLI::App& command) {
  const CLI::Option* option = command.get_option_no_throw("--max-memory");
  return option != nullptr && option->count() > 0 ? option->as<std::uint64_t>()
                                                  : cli::default_memory();
}

/// The command with what it works on: "identify record.csv".
std::string place_of(const CLI::App& command) {
  std::string place = command.get_name();
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional())
      for (const std::string& text : option->results()) place += " " + text;
  return place;
}

int fail_of_memory(const CliStreams& streams, const CLI::App& command) {
  return fail(streams, place_of(command) + ": not enough memory (" +
                           std::to_string(memory_of(command) >> 20U) +
                           " MB); use fewer samples or terms, or raise --max-memory");
}

/// Runs a command; what goes wrong becomes one line and a status.
int run_chosen(const cli::Command& command, const cli::Session& session) {
  const CliStreams& streams = session.streams;
  const auto interrupted = [&] {
    streams.err << "lacuna: interrupted; nothing was written\n";
    return cli::kInterrupted;
  };
  try {
    const cli::MemoryLimit limit(memory_of(*command.app));
    cli::keep_freed_memory();
    cli::check_outputs(cli::files_read_by(*command.app), cli::outputs_of(*command.app));
    return command.run(session);
  } catch (const OutOfTime&) {
    streams.err << "lacuna: error: " << one_line(place_of(*command.app))
                << ": incomplete: the time limit came before anything was known; nothing was "
                   "written; give it more time (--time-limit)\n";
    return kNoAnswer;
  } catch (const Cancelled&) {
    return interrupted();
  } catch (const ArgumentError& error) {  // its place is a function, which users do not know
    const char* look =
        error.remedy().empty() ? "; look at what is read with `lacuna check`" : "";
    return fail(streams, place_of(*command.app) + ": " + user_text(error) + look);
  } catch (const Error& error) {
    // A read that was broken into by an interrupt has failed too.
    return session.stop.stop_requested() ? interrupted() : fail(streams, error.what());
  } catch (const std::bad_alloc&) {
    return fail_of_memory(streams, *command.app);
  } catch (const std::length_error&) {  // more than any container can hold
    return fail_of_memory(streams, *command.app);
  } catch (const std::exception& error) {
    return fail(streams, place_of(*command.app) + ": " + error.what() +
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

/// The option of `lacuna demo`: which of the trials.
CLI::App& declare_demo(CLI::App& root, std::vector<std::string>& names) {
  CLI::App* app = root.add_subcommand(
      "demo", "Run the commands to try, with the records that come with the program");
  app->add_option("NAME", names, "Which of them [default: all]")
      ->check(cli::one_of({"check", "diagnose", "identify"}));
  return *app;
}

/// The option of `lacuna help`: the command.
CLI::App& declare_help(CLI::App& root, std::string& name) {
  CLI::App* app =
      root.add_subcommand("help", "Show the help of lacuna, or of one of its commands");
  app->add_option("COMMAND", name, "Which command [default: what there is]");
  return *app;
}

int show_help(const CLI::App& root, const std::string& name, const CliStreams& streams) {
  std::vector<std::string> names;
  for (const CLI::App* command : root.get_subcommands({})) {
    names.push_back(command->get_name());
    if (names.back() != name) continue;
    streams.out << command->help("lacuna");
    return 0;
  }
  if (!name.empty())
    return fail(streams, "help " + name + ": there is no command '" + name + "'; " +
                             suggestion(name, names));
  streams.out << root.get_formatter()->make_help(&root, "lacuna", CLI::AppFormatMode::Normal);
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
  CLI::App app;
  describe_program(app);
  const std::vector<cli::Command> commands = {
      cli::declare_identify(app),   cli::declare_simulate(app), cli::declare_sync(app),
      cli::declare_diagnose(app),   cli::declare_fit(app),      cli::declare_model(app),
      cli::declare_export(app),     cli::declare_check(app),    cli::declare_compare(app),
      cli::declare_completion(app), cli::declare_list(app),     cli::declare_describe(app),
      cli::declare_plan(app),       cli::declare_bench(app),    cli::declare_start(app)};
  std::vector<std::string> names;
  const CLI::App& demo = declare_demo(app, names);
  std::string topic;
  const CLI::App& help = declare_help(app, topic);
  cli::arrange_help(app);
  if (const auto status = parse(app, argc, argv, streams))
    return with_output_checked(*status, streams);
  if (help.parsed()) return with_output_checked(show_help(app, topic, streams), streams);
  if (demo.parsed()) return run_demo(names, session, patience);

  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of its write
  const auto chosen = std::find_if(commands.begin(), commands.end(),
                                   [](const auto& command) { return command.app->parsed(); });
  const cli::InterruptGuard interrupt(patience);
  session.stop = interrupt.token();
  session.command_line = command_line(argc, argv);
  const bool leads = session.team == nullptr || session.team->rank() == 0;
  const std::string name = chosen->app->get_name();
  const bool divides = name == "identify" || name == "diagnose";
  if (!leads && !divides) return 0;
  return with_output_checked(run_chosen(*chosen, session), streams);
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
