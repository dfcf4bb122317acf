// SPDX-License-Identifier: MIT
// Commands and their options as values: what a parser, the help and the completion read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lacuna::cli {

struct Session;

/// Takes the text of a value. @return what is wrong with it; empty where nothing is.
using Reader = std::function<std::string(const std::string&)>;

/// A condition on a value, in a sentence for one that does not meet it.
struct Check {
  Reader fault = nullptr;
  std::string shown = {};  ///< of the help, behind the form of the value: "1 to 1024"
};

/// A number in a range with its ends; NaN is in none.
Check from_to(double low, double high);

/// A number that is neither infinite nor NaN.
Check finite();

/// A number above 0 that is finite.
Check above_zero();

/// One of these words.
Check one_of(std::vector<std::string> words);

/// "'qick' is none of full, quick; did you mean 'quick'?"
std::string none_of(const std::string& word, const std::vector<std::string>& words);

/// Where values go. A `bool` is set by the option alone, a list takes any number of values.
using Target = std::variant<bool*, int*, std::ptrdiff_t*, double*, std::uint64_t*, std::string*,
                            std::optional<int>*, std::optional<double>*,
                            std::optional<std::string>*, std::vector<std::string>*, Reader>;

/// What a word stands for in a map. @param values outlive the option, as does the place.
template <class Value, class Place>
Reader word_of(const std::map<std::string, Value>& values, Place& place) {
  return [&values, &place](const std::string& word) -> std::string {
    const auto found = values.find(word);
    if (found != values.end()) {
      place = found->second;
      return "";
    }
    std::vector<std::string> words;
    for (const auto& [known, value] : values) words.push_back(known);
    return none_of(word, words);
  };
}

/// An option of a command, or an argument that is known by its place.
struct Option {
  std::string names;  ///< "-o,--output"; of an argument "DATA"
  Target target;
  std::string help;
  std::string form = {};  ///< of the value, in the help: "FILE"; empty: that of the target
  std::string default_text = {};  ///< in the help; empty: not shown
  std::string excluded = {};      ///< the option that cannot be given beside it
  Check checked = {};
  bool is_required = false;
  bool is_single = false;  ///< of a list: it takes one value

  Option& check(Check condition);
  Option& require();
  Option& expect_one();
  /// To be said of both.
  Option& exclude(std::string_view other);
  /// The help shows what the target holds now.
  Option& show_default();

  bool is_argument() const { return names.front() != '-'; }
  bool is_flag() const { return std::holds_alternative<bool*>(target); }
  bool is_list() const;

  /// All names, "-o" and "--output".
  std::vector<std::string> all_names() const;

  /// The one in messages: the first long one.
  std::string name() const;
};

/// A command: its options, and what it does when it is chosen; gives the exit status.
struct Command {
  std::string name;
  std::string description;
  std::vector<Option> options = {};
  std::function<int(const Session&)> run = nullptr;

  /// Adds an option; the reference is good until the next one.
  /// @param usage the names and, behind a blank, the form of the value: "-o,--output FILE".
  Option& add(std::string_view usage, Target target, std::string_view help);
};

/// An option that was given, with its words.
struct GivenOption {
  const Option* option;
  std::vector<std::string> words;
};

/// What a command line asks for: to run a command, or to show something.
struct Asked {
  enum class For { Run, Help, AllHelp, Version };
  For what = For::Run;
  const Command* command = nullptr;     ///< none where the help is that of the program
  std::vector<GivenOption> given = {};  ///< in the order in which they were declared
  std::string fault = {};               ///< what is wrong with the words; empty: nothing
};

/// Reads the words behind the name of the program: options write to their targets.
Asked parse(std::span<const Command> commands, std::vector<std::string> words);

}  // namespace lacuna::cli
