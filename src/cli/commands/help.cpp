// SPDX-License-Identifier: MIT
// What --help shows: options in groups, those that are used most first.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.hpp"
#include "report/pages/folded_text.hpp"

namespace lacuna::cli {
namespace {

using Options = std::vector<const Option*>;

/// A decision: so many options --help explains. Half as many leave the screen half empty; twice
/// as many do not fit on it with what stands around them.
constexpr std::size_t kMostUsed = 10;

/// A fact of layout: the column in which explanations begin.
constexpr std::size_t kNameColumns = 26;

/// The options that are used most; the first ten of a command's stand first in its help.
constexpr std::array<std::string_view, 21> kByUse = {
    "--model",    "--x0",        "--t-end",  "--states",  "--inputs", "--map",     "--dt",
    "--holdout",  "--degree",    "--terms",  "--coupling", "--format", "--output", "--model-out",
    "--report",   "--explain",   "--json",   "--noise",    "--effort", "--preset", "--effect"};

/// Options of all commands by groups; what is not here is method.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kGroups = {
    {{"Data",
      "--states --inputs --derivatives --embed --map --time --time-unit --dt --trajectory --hold "
      "--limits --holdout --input-data --input-time --each --start-time --start-samples --memory"},
     {"Model",
      "--model --degree --terms --add --equation --fix --discrete --hidden --x0 --t-start --t-end "
      "--tolerance --effect --max-effects"},
     {"Method", ""},
     {"Output",
      "--model-out --replace --json --report --open --plot --explain --digits --output --format "
      "--progress --csv --noise --inputs-out"},
     {"Limits", "--effort --time-limit --threads --max-memory --seed"}}};

bool has_word(std::string_view words, std::string_view word) {
  for (std::size_t at = words.find(word); at != std::string_view::npos;
       at = words.find(word, at + 1)) {
    const bool begins = at == 0 || words[at - 1] == ' ';
    const std::size_t end = at + word.size();
    if (begins && (end == words.size() || words[end] == ' ')) return true;
  }
  return false;
}

std::string group_of(const Option& option) {
  for (const auto& [group, names] : kGroups)
    if (has_word(names, option.name())) return std::string(group);
  return "Method";
}

/// Options of a command, by use.
Options options_by_use(const Command& command) {
  Options options;
  for (const Option& option : command.options)
    if (!option.is_argument()) options.push_back(&option);
  const auto rank = [](const Option* option) {
    return std::find(kByUse.begin(), kByUse.end(), option->name()) - kByUse.begin();
  };
  std::stable_sort(options.begin(), options.end(), [&](const auto* a, const auto* b) {
    return rank(a) < rank(b);
  });
  return options;
}

Options of_group(const Options& options, std::string_view group) {
  Options found;
  std::copy_if(options.begin(), options.end(), std::back_inserter(found),
               [&](const Option* option) { return group_of(*option) == group; });
  return found;
}

/// "  Data    --time --hold" for each group that has some of the options.
std::string names_by_group(const Options& options) {
  constexpr std::size_t kIndent = 10;  // a fact of layout
  std::string text;
  for (const auto& [group, known] : kGroups) {
    std::string line = "  " + std::string(group);
    line.resize(kIndent - 1, ' ');
    const Options own = of_group(options, group);
    for (const Option* option : own) line += " " + option->name();
    if (!own.empty()) text += folded_line(line, kScreenColumns, kIndent) + "\n";
  }
  return text;
}

/// What is explained: its name in the first column.
std::string entry(const std::string& name, const std::string& description) {
  const std::string begin = "  " + name;
  const bool fits = begin.size() + 2 <= kNameColumns;
  const std::string gap = fits ? std::string(kNameColumns - begin.size(), ' ')
                               : "\n" + std::string(kNameColumns, ' ');
  // The description is folded as if it began at the edge, and then moved.
  std::string text = folded_line(description, kScreenColumns - kNameColumns, 0);
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
    text.insert(at + 1, kNameColumns, ' ');
  return begin + gap + text + "\n";
}

/// How a value is written where the option does not say it.
std::string form_of(const Target& target) {
  if (std::holds_alternative<std::uint64_t*>(target)) return "UINT";
  if (std::holds_alternative<double*>(target) ||
      std::holds_alternative<std::optional<double>*>(target))
    return "FLOAT";
  const bool is_whole = std::holds_alternative<int*>(target) ||
                        std::holds_alternative<std::ptrdiff_t*>(target) ||
                        std::holds_alternative<std::optional<int>*>(target);
  return is_whole ? "INT" : "TEXT";
}

std::string option_entry(const Option& option) {
  std::string name = option.names;
  if (!option.is_flag())
    name += " " + (option.form.empty() ? form_of(option.target) : option.form);
  if (!option.checked.shown.empty()) name += ":" + option.checked.shown;
  if (!option.default_text.empty()) name += "=" + option.default_text;
  if (option.is_list()) name += " ...";
  if (option.is_required) name += " REQUIRED";
  if (!option.excluded.empty()) name += " Excludes: " + option.excluded;
  return entry(name, option.help);
}

std::string titled(const std::string& title, const Options& options) {
  std::string text = "\n" + title + ":\n";
  for (const Option* option : options) text += option_entry(*option);
  return text;
}

std::string usage_of(const Command& command) {
  std::string text = "Usage: lacuna " + command.name + " [OPTIONS]";
  for (const Option& option : command.options) {
    if (!option.is_argument()) continue;
    const std::string word = option.names + (option.is_list() ? "..." : "");
    text += " " + (option.is_required ? word : "[" + word + "]");
  }
  return text + "\n";
}

std::string arguments_of(const Command& command) {
  Options arguments;
  for (const Option& option : command.options)
    if (option.is_argument()) arguments.push_back(&option);
  return arguments.empty() ? "" : titled("Positionals", arguments);
}

std::string in_groups(const Options& options) {
  std::string text;
  for (const auto& [group, known] : kGroups)
    if (const Options own = of_group(options, group); !own.empty())
      text += titled(std::string(group), own);
  return text;
}

std::string most_used(const Command& command, const Options& options) {
  const Options first(options.begin(), options.begin() + kMostUsed);
  const Options others(options.begin() + kMostUsed, options.end());
  return titled("Most used", first) + "\nMore (lacuna " + command.name + " --help-all):\n" +
         names_by_group(others);
}

}  // namespace

std::string program_help(std::span<const Command> commands) {
  std::string text =
      "Finds the equations of a dynamical system in measured data.\n\n"
      "  lacuna check record.csv\n"
      "  lacuna identify record.csv --model-out model.json\n"
      "  lacuna sync model.json other_record.csv\n"
      "  lacuna diagnose --model nominal.json record.csv\n"
      "  lacuna simulate model.json --x0 1,0,0 --t-end 100 --dt 0.1 -o orbit.csv\n"
      "Usage: lacuna [OPTIONS] SUBCOMMAND\n\nOptions:\n" +
      entry("-h,--help", "Print this help message and exit") +
      entry("--version", "Display program version information and exit") + "\nSubcommands:\n";
  for (const Command& command : commands) text += entry(command.name, command.description);
  return text + "\n" +
         folded_line(
             "Each command has its own --help. Exit status: 0 done; 1 the numbers do not allow "
             "an answer; 2 bad arguments, configuration or data; 130 interrupted.",
             kScreenColumns, 0) +
         "\n";
}

std::string command_help(const Command& command, bool all) {
  const Options options = options_by_use(command);
  return folded(command.description + "\n") + "\n" + usage_of(command) + arguments_of(command) +
         (all || options.size() <= kMostUsed + 2 ? in_groups(options)
                                                 : most_used(command, options));
}

}  // namespace lacuna::cli
