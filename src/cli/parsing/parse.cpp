// SPDX-License-Identifier: MIT
// The one source that knows CLI11: commands as values go in, and what is asked for comes out.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "core/base/text.hpp"
#include "options.hpp"

namespace lacuna::cli {
namespace {

/// What the parser knows of a command.
struct Parser {
  CLI::App* app;
  std::vector<CLI::Option*> options;  ///< one for each of the command
};

CLI::Option* declared(CLI::App& app, const Option& option) {
  const auto declare = [&](const auto& target) -> CLI::Option* {
    using Place = std::decay_t<decltype(target)>;
    if constexpr (std::is_same_v<Place, Reader>)
      return app.add_option(option.names)->check(target, "");
    else if constexpr (std::is_same_v<Place, bool*>)
      return app.add_flag(option.names, *target);
    else
      return app.add_option(option.names, *target);
  };
  CLI::Option* made = std::visit(declare, option.target);
  if (option.checked.fault) made->check(option.checked.fault, "");
  if (option.is_single) made->expected(1);
  return made->required(option.is_required);
}

Parser declared(CLI::App& root, const Command& command) {
  Parser parser{root.add_subcommand(command.name), {}};
  parser.app->set_help_all_flag("--help-all");
  for (const Option& option : command.options)
    parser.options.push_back(declared(*parser.app, option));
  for (std::size_t i = 0; i < command.options.size(); ++i)
    if (const std::string& other = command.options[i].excluded; !other.empty())
      parser.options[i]->excludes(parser.app->get_option(other));
  return parser;
}

/// Names of all commands, or of all options of a command.
std::vector<std::string> known_words(const CLI::App& app, bool options) {
  std::vector<std::string> words;
  if (options) {
    for (const CLI::Option* option : app.get_options()) words.push_back(option->get_name());
  } else {
    for (const CLI::App* command : app.get_subcommands({}))
      words.push_back(command->get_name());
  }
  return words;
}

/// The first command that has such an option; null where none has.
const CLI::App* command_with(const CLI::App& app, const std::string& option) {
  for (const CLI::App* command : app.get_subcommands({}))
    if (command->get_option_no_throw(option) != nullptr) return command;
  return nullptr;
}

/// About the first word that was not expected; empty when there is none.
std::string about_unknown(const CLI::App& root, const CLI::App& command) {
  for (const std::string& word : command.remaining(true)) {
    const bool option = word.rfind("-", 0) == 0;
    if (const CLI::App* owner = option ? nullptr : command_with(root, "--" + word))
      return "'" + word + "' is an option, as in `lacuna " + owner->get_name() + " ... --" +
             word + "`";
    const auto near = nearest_name(word, known_words(option ? command : root, option));
    return "'" + word + "' is not known" + (near ? "; did you mean '" + *near + "'?" : "");
  }
  return "";
}

/// The options that a message of the parser names, in the order in which it does.
std::vector<const CLI::Option*> options_in(const std::string& message,
                                           const CLI::App& command) {
  std::vector<std::pair<std::size_t, const CLI::Option*>> found;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    for (std::size_t at = message.find(name); at != std::string::npos;
         at = message.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      const bool whole = (at == 0 || message[at - 1] == ' ') &&
                         (end == message.size() || message[end] == ' ' || message[end] == ':');
      if (!whole) continue;
      found.emplace_back(at, option);
      break;
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<const CLI::Option*> options;
  for (const auto& [at, option] : found) options.push_back(option);
  return options;
}

/// About a value that is not of the option's type: the parser converts to numbers and flags
/// only.
std::string about_type(const CLI::Option& option) {
  const std::string value = option.results().empty() ? "" : option.results().front();
  if (option.get_expected_max() == 0) return option.get_name() + " takes no value";
  if (!parse_number(value)) return option.get_name() + ": '" + value + "' is no number";
  return option.get_name() + ": '" + value + "' is no whole number, or too large";
}

template <class Kind>
bool is(const CLI::ParseError& error) {
  return dynamic_cast<const Kind*>(&error) != nullptr;
}

std::string about_count(const CLI::Option& option) {
  const std::size_t given = option.results().size();
  if (given > static_cast<std::size_t>(option.get_items_expected_max()))
    return option.get_name() + ": " + std::to_string(given) + " values are given; keep one";
  return option.get_name() + ": the value is missing";
}

/// What is wrong with the arguments, in a sentence of its own, with what to do about it.
/// @param root that was parsed.
std::string sentence_of(const CLI::ParseError& error, CLI::App& root) {
  const std::vector<CLI::App*> chosen = root.get_subcommands();
  const CLI::App& command = chosen.empty() ? root : *chosen.front();
  const std::string message = error.what();
  const std::vector<const CLI::Option*> options = options_in(message, command);
  const auto sentence = [&]() -> std::string {
    if (is<CLI::ExtrasError>(error)) return about_unknown(root, command);
    if (is<CLI::RequiredError>(error) && chosen.empty()) {
      const std::string unknown = about_unknown(root, command);
      return unknown.empty() ? "no command is given" : unknown;
    }
    if (is<CLI::ExcludesError>(error) && options.size() == 2)
      return options[0]->get_name() + " and " + options[1]->get_name() + " exclude each other";
    if (options.empty()) return message;
    if (is<CLI::RequiredError>(error)) return options[0]->get_name() + " is missing";
    if (is<CLI::ConversionError>(error)) return about_type(*options[0]);
    if (is<CLI::ArgumentMismatch>(error)) return about_count(*options[0]);
    return message;  // of a check of values, which is ours
  };
  const std::string name = chosen.empty() ? "lacuna" : "lacuna " + command.get_name();
  return sentence() + "; see `" + name + " --help`";
}

/// What is to be shown, or what is wrong.
Asked stopped_by(const CLI::ParseError& error, CLI::App& root) {
  if (is<CLI::CallForHelp>(error)) return {.what = Asked::For::Help};
  if (is<CLI::CallForAllHelp>(error)) return {.what = Asked::For::AllHelp};
  if (is<CLI::CallForVersion>(error)) return {.what = Asked::For::Version};
  return {.fault = sentence_of(error, root)};
}

std::vector<GivenOption> given_options(const Command& command, const Parser& parser) {
  std::vector<GivenOption> given;
  for (std::size_t i = 0; i < command.options.size(); ++i)
    if (parser.options[i]->count() > 0)
      given.push_back({&command.options[i], parser.options[i]->results()});
  return given;
}

}  // namespace

Asked parse(std::span<const Command> commands, std::vector<std::string> words) {
  CLI::App root("", "lacuna");
  root.set_version_flag("--version");
  root.require_subcommand(1);
  std::vector<Parser> parsers;
  for (const Command& command : commands) parsers.push_back(declared(root, command));
  Asked asked;
  try {
    std::reverse(words.begin(), words.end());
    root.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    asked = stopped_by(error, root);
  }
  const std::vector<CLI::App*> chosen = root.get_subcommands();
  for (std::size_t i = 0; i < commands.size(); ++i)
    if (!chosen.empty() && parsers[i].app == chosen.front()) {
      asked.command = &commands[i];
      asked.given = given_options(commands[i], parsers[i]);
    }
  return asked;
}

}  // namespace lacuna::cli
