// SPDX-License-Identifier: MIT
#include "lacuna/cli/cli.hpp"

#include <algorithm>
#include <iostream>

#include "command.hpp"
#include "interrupt.hpp"
#include "lacuna/core/text.hpp"

namespace lacuna {
namespace {

constexpr int kBadInput = 2;
constexpr int kInterrupted = 130;

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

int fail(const CliStreams& streams, const std::string& text) {
  streams.err << "lacuna: error: " << one_line(text) << "\n";
  return kBadInput;
}

void describe_program(CLI::App& app) {
  app.name("lacuna");
  app.description(
      "Finds the equations of a dynamical system in measured data.\n\n"
      "  lacuna identify record.csv --model-out model.json\n"
      "  lacuna sync model.json other_record.csv\n"
      "  lacuna diagnose --model nominal.json record.csv\n"
      "  lacuna simulate model.json --x0 1,0,0 --t-end 100 --dt 0.1 -o orbit.csv");
  app.footer(
      "Each command has its own --help. Exit status: 0 done; 1 the numbers do not allow "
      "an answer; 2 bad arguments, configuration or data; 130 interrupted.");
  app.set_version_flag("--version", "lacuna " LACUNA_VERSION);
  app.require_subcommand(1);
}

/// Names of all commands, or of all options of a command.
std::vector<std::string> known_words(CLI::App& app, bool options) {
  std::vector<std::string> words;
  if (options) {
    for (const CLI::Option* option : app.get_options()) words.push_back(option->get_name());
  } else {
    for (const CLI::App* command : app.get_subcommands({}))
      words.push_back(command->get_name());
  }
  return words;
}

/// "did you mean ...?" for the first word that was not expected; empty when there is none.
std::string hint(CLI::App& app, CLI::App& command) {
  for (const std::string& word : command.remaining(true)) {
    const bool option = word.rfind("-", 0) == 0;
    const auto near = nearest_name(word, known_words(option ? command : app, option));
    if (near) return "'" + word + "': did you mean '" + *near + "'? ";
    return "'" + word + "' is not known; ";
  }
  return "";
}

/// Reads the arguments. @return exit status when there is nothing more to do.
std::optional<int> parse(CLI::App& app, int argc, const char* const* argv,
                         const CliStreams& streams) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error, streams.out, streams.err);
    const auto chosen = app.get_subcommands();
    CLI::App& command = chosen.empty() ? app : *chosen.front();
    const std::string name = chosen.empty() ? "lacuna" : "lacuna " + command.get_name();
    return fail(streams, std::string("command line: ") + error.what() + "; " +
                             hint(app, command) + "see `" + name + " --help`");
  }
}

int run_chosen(const std::vector<cli::Command>& commands, const cli::Session& session) {
  const auto chosen = std::find_if(commands.begin(), commands.end(),
                                   [](const auto& command) { return command.app->parsed(); });
  return chosen->run(session);
}

}  // namespace

int run_cli(int argc, const char* const* argv) {
  return run_cli(argc, argv, default_registry());
}

int run_cli(int argc, const char* const* argv, const Registry& registry) {
  return run_cli(argc, argv, registry, {std::cout, std::cerr});
}

int run_cli(int argc, const char* const* argv, const Registry& registry, CliStreams streams) {
  CLI::App app;
  describe_program(app);
  const std::vector<cli::Command> commands = {
      cli::declare_identify(app), cli::declare_simulate(app), cli::declare_sync(app),
      cli::declare_diagnose(app), cli::declare_model(app),    cli::declare_list(app),
      cli::declare_describe(app)};
  if (const auto status = parse(app, argc, argv, streams)) return *status;

  const cli::InterruptGuard interrupt;
  try {
    return run_chosen(commands, {registry, streams, interrupt.token()});
  } catch (const Cancelled&) {
    streams.err << "lacuna: interrupted; nothing was written\n";
    return kInterrupted;
  } catch (const Error& error) {
    return fail(streams, error.what());
  } catch (const std::bad_alloc&) {
    return fail(streams, "not enough memory; use fewer samples or fewer terms");
  } catch (const std::exception& error) {
    return fail(streams, error.what());
  }
}

}  // namespace lacuna
