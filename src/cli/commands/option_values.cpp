// SPDX-License-Identifier: MIT
#include "option_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"

namespace lacuna::cli {
namespace {

/// An end of a range: whole numbers without an exponent.
std::string end_text(double end) {
  constexpr double kLongest = 1e15;  // a fact: whole numbers below are exact in a double
  const bool whole = std::abs(end) < kLongest && end == std::floor(end);
  return whole ? std::to_string(static_cast<long long>(end)) : format_number(end);
}

std::string none_of(const std::string& word, const std::vector<std::string>& words) {
  const auto near = nearest_name(word, words);
  return "'" + word + "' is none of " + join(words, ", ") +
         (near ? "; did you mean '" + *near + "'?" : "");
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

}  // namespace

CLI::Validator from_to(double low, double high) {
  const std::string range = end_text(low) + " to " + end_text(high);
  return {[low, high, range](std::string& text) {
            const auto value = parse_number(text);
            if (value && *value >= low && *value <= high) return std::string();
            return "'" + text + "' is no number from " + range;
          },
          range};
}

CLI::Validator finite() {
  return {[](std::string& text) {
            const auto value = parse_number(text);
            // What is no number at all is refused where it is read.
            if (!value || std::isfinite(*value)) return std::string();
            return "'" + text + "' is no finite number";
          },
          ""};
}

CLI::Validator above_zero() {
  return {[](std::string& text) {
            const auto value = parse_number(text);
            if (value && *value > 0.0 && std::isfinite(*value)) return std::string();
            return "'" + text + "' is no number above 0";
          },
          "above 0"};
}

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string shown = join(words, "|");
  return {[words = std::move(words)](std::string& text) {
            const bool known = std::find(words.begin(), words.end(), text) != words.end();
            return known ? std::string() : none_of(text, words);
          },
          shown};
}

CLI::Validator number_of(std::map<std::string, int> numbers) {
  return {[numbers = std::move(numbers)](std::string& text) {
            const auto found = numbers.find(text);
            if (found == numbers.end()) {
              std::vector<std::string> words;
              for (const auto& [word, number] : numbers) words.push_back(word);
              return none_of(text, words);
            }
            text = std::to_string(found->second);
            return std::string();
          },
          ""};
}

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

}  // namespace lacuna::cli
