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
std::string options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  std::sort(names.begin(), names.end());
  return join(names, " ");
}

std::string names_of(const CLI::App& root) {
  std::vector<std::string> names;
  for (const CLI::App* command : root.get_subcommands({})) names.push_back(command->get_name());
  return join(names, " ");
}

/// The cases of a shell's `case` over the commands. @param offer how it offers words behind
/// `help`, with %s in their place.
std::string cases_of(const CLI::App& root, const std::string& offer) {
  const std::size_t place = offer.find("%s");
  std::string text =
      "    help) " + std::string(offer).replace(place, 2, names_of(root)) + "; return ;;\n";
  for (const CLI::App* command : root.get_subcommands({}))
    if (command->get_name() != "help")
      text += "    " + command->get_name() + ") options='" + options_of(*command) + "' ;;\n";
  return text;
}

std::string bash_script(const CLI::App& root) {
  return "# bash completion of lacuna\n"
         "_lacuna() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} options=\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W '" +
         names_of(root) +
         "' -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases_of(root, "COMPREPLY=($(compgen -W '%s' -- \"$word\"))") +
         "  esac\n"
         "  case $word in\n"
         "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
         "    *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
         "  esac\n"
         "}\n"
         "complete -o filenames -F _lacuna lacuna\n";
}

std::string zsh_script(const CLI::App& root) {
  return "#compdef lacuna\n"
         "local options=\n"
         "if (( CURRENT == 2 )); then\n"
         "  compadd " +
         names_of(root) +
         "\n"
         "  return\n"
         "fi\n"
         "case ${words[2]} in\n" +
         cases_of(root, "compadd %s") +
         "esac\n"
         "if [[ ${words[CURRENT]} == -* ]]; then\n"
         "  compadd -- ${=options}\n"
         "else\n"
         "  _files\n"
         "fi\n";
}

}  // namespace

Command declare_completion(CLI::App& root) {
  auto options = std::make_shared<CompletionArguments>();
  CLI::App* app = root.add_subcommand(
      "completion", "Print the script that completes commands and options in a shell");
  app->add_option("SHELL", options->shell, "bash or zsh")
      ->required()
      ->check(one_of({"bash", "zsh"}));
  return {app, [options, &root](const Session& session) {
            session.streams.out << (options->shell == "bash" ? bash_script(root)
                                                             : zsh_script(root));
            return 0;
          }};
}

}  // namespace lacuna::cli
