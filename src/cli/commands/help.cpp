// SPDX-License-Identifier: MIT
// What --help shows: options in groups, those that are used most first.
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.hpp"
#include "report/pages/folded_text.hpp"

namespace lacuna::cli {
namespace {

using Options = std::vector<const CLI::Option*>;

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

/// "--output" of "-o,--output".
std::string long_name(const CLI::Option& option) {
  const auto& names = option.get_lnames();
  return names.empty() ? option.get_name() : "--" + names.front();
}

std::string group_of(const CLI::Option& option) {
  for (const auto& [group, names] : kGroups)
    if (has_word(names, long_name(option))) return std::string(group);
  return "Method";
}

bool is_about_help(const CLI::App& app, const CLI::Option* option) {
  return option == app.get_help_ptr() || option == app.get_help_all_ptr();
}

/// Options of a command but for those that show help, by use.
Options options_by_use(const CLI::App& app) {
  Options options = app.get_options([&](const CLI::Option* option) {
    return option->nonpositional() && !is_about_help(app, option);
  });
  const auto rank = [](const CLI::Option* option) {
    return std::find(kByUse.begin(), kByUse.end(), long_name(*option)) - kByUse.begin();
  };
  std::stable_sort(options.begin(), options.end(), [&](const auto* a, const auto* b) {
    return rank(a) < rank(b);
  });
  return options;
}

Options of_group(const Options& options, std::string_view group) {
  Options found;
  std::copy_if(options.begin(), options.end(), std::back_inserter(found),
               [&](const CLI::Option* option) { return group_of(*option) == group; });
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
    for (const CLI::Option* option : own) line += " " + long_name(*option);
    if (!own.empty()) text += folded_line(line, kScreenColumns, kIndent) + "\n";
  }
  return text;
}

class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(kNameColumns); }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    if (app->get_parent() == nullptr) return CLI::Formatter::make_help(app, name, mode);
    const Options options = options_by_use(*app);
    return folded(make_description(app)) + "\n" + make_usage(app, std::move(name)) +
           make_positionals(app) +
           (mode == CLI::AppFormatMode::All || options.size() <= kMostUsed + 2
                ? in_groups(options)
                : most_used(*app, options));
  }

  std::string make_option(const CLI::Option* option, bool positional) const override {
    return entry(make_option_name(option, positional) + make_option_opts(option),
                 make_option_desc(option));
  }

  std::string make_footer(const CLI::App* app) const override {
    return folded_line(app->get_footer(), kScreenColumns, 0) + "\n";
  }

  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_display_name(true), command->get_description());
  }

 private:
  static std::string entry(const std::string& name, const std::string& description) {
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

  std::string in_groups(const Options& options) const {
    std::string text;
    for (const auto& [group, known] : kGroups)
      if (const Options own = of_group(options, group); !own.empty())
        text += make_group(std::string(group), false, own);
    return text;
  }

  std::string most_used(const CLI::App& app, const Options& options) const {
    const Options first(options.begin(), options.begin() + kMostUsed);
    const Options others(options.begin() + kMostUsed, options.end());
    return make_group("Most used", false, first) + "\nMore (lacuna " + app.get_name() +
           " --help-all):\n" + names_by_group(others);
  }
};

}  // namespace

void arrange_help(CLI::App& root) {
  const auto formatter = std::make_shared<HelpFormatter>();
  root.formatter(formatter);
  for (CLI::App* command : root.get_subcommands({})) {
    command->formatter(formatter);
    command->set_help_all_flag("--help-all", "Show all options, in groups");
  }
}

}  // namespace lacuna::cli
