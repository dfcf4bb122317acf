// SPDX-License-Identifier: MIT
// Scripts that complete commands and options in a shell, from the options themselves.
#include <algorithm>
#include <memory>

#include "command.hpp"
#include "core/base/text.hpp"

namespace lacuna::cli {
namespace {

struct CompletionArguments {
  std::string shell;
};

/// "--json --seed ..." of a command, in alphabetical order.
std::string options_of(const Command& command) {
  std::vector<std::string> names{"--help", "--help-all"};
  for (const Option& option : command.options)
    for (const std::string& name : option.all_names())
      if (name.starts_with("--")) names.push_back(name);
  std::sort(names.begin(), names.end());
  return join(names, " ");
}

using Commands = std::span<const Command>;

std::string names_of(Commands commands) {
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.name);
  return join(names, " ");
}

/// The cases of a shell's `case` over the commands. @param offer how it offers words behind
/// `help`, with %s in their place.
std::string cases_of(Commands commands, const std::string& offer) {
  const std::size_t place = offer.find("%s");
  std::string text =
      "    help) " + std::string(offer).replace(place, 2, names_of(commands)) + "; return ;;\n";
  for (const Command& command : commands)
    if (command.name != "help")
      text += "    " + command.name + ") options='" + options_of(command) + "' ;;\n";
  return text;
}

std::string bash_script(Commands commands) {
  return "# bash completion of lacuna\n"
         "_lacuna() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} options=\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W '" +
         names_of(commands) +
         "' -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases_of(commands, "COMPREPLY=($(compgen -W '%s' -- \"$word\"))") +
         "  esac\n"
         "  case $word in\n"
         "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
         "    *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
         "  esac\n"
         "}\n"
         "complete -o filenames -F _lacuna lacuna\n";
}

std::string zsh_script(Commands commands) {
  return "#compdef lacuna\n"
         "local options=\n"
         "if (( CURRENT == 2 )); then\n"
         "  compadd " +
         names_of(commands) +
         "\n"
         "  return\n"
         "fi\n"
         "case ${words[2]} in\n" +
         cases_of(commands, "compadd %s") +
         "esac\n"
         "if [[ ${words[CURRENT]} == -* ]]; then\n"
         "  compadd -- ${=options}\n"
         "else\n"
         "  _files\n"
         "fi\n";
}

}  // namespace

Command declare_completion() {
  auto options = std::make_shared<CompletionArguments>();
  Command command{"completion",
                  "Print the script that completes commands and options in a shell"};
  command.add("SHELL", &options->shell, "bash or zsh").require().check(one_of({"bash", "zsh"}));
  command.run = [options](const Session& session) {
    session.streams.out << (options->shell == "bash" ? bash_script(session.commands)
                                                     : zsh_script(session.commands));
    return 0;
  };
  return command;
}

}  // namespace lacuna::cli
