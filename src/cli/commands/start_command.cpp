// SPDX-License-Identifier: MIT
// From a file that nobody has looked at to a model to write on and the command for next time.
#include <filesystem>
#include <memory>
#include <utility>

#include "cli/start/column_use.hpp"
#include "cli/start/skeleton.hpp"
#include "cli/terminal/questions.hpp"
#include "cli/terminal/shell_text.hpp"
#include "command.hpp"
#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "data/formats/file_kinds.hpp"
#include "data_options.hpp"
#include "lacuna/core/base/error.hpp"
#include "report/pages/data_summary.hpp"

namespace lacuna::cli {
namespace {

namespace fs = std::filesystem;

struct StartArguments {
  DataOptions data;
  std::optional<std::string> skeleton;
  bool yes = false, replace = false;
};

/// Beside the user, not beside the record: "record.csv.gz" becomes "record.ode".
std::string skeleton_path(const StartArguments& options) {
  if (options.skeleton) return *options.skeleton;
  fs::path name = fs::path(options.data.paths.front()).filename();
  while (name.has_extension()) name = name.stem();
  return name.string() + ".ode";
}

/// @throws FileError where the file would be replaced.
void check_skeleton(const std::string& path, const StartArguments& options) {
  std::error_code none;
  if (path != "-" && !options.replace && fs::exists(path, none))
    throw FileError("start: " + path, "the file is there already",
                    "name another one with --model-out, or replace it with --replace");
  std::vector<fs::path> read;
  for (const std::string& word : options.data.paths)
    for (fs::path& file : files_named(word)) read.push_back(std::move(file));
  check_outputs(read, {{"--model-out", path}});
}

/// The unit that times are read in; nothing where that of the file is right.
std::optional<std::string> time_unit_for(const DataOptions& options, const RecordUse& use,
                                         const Dataset& read) {
  if (use.time_unit != read.time_unit) return use.time_unit;
  return options.time_unit;
}

/// A command with the same data. @param flags behind the options of the data.
std::string line_for(std::vector<std::string> words, const DataOptions& data,
                     const std::vector<std::string>& flags) {
  words.insert(words.end(), data.paths.begin(), data.paths.end());
  using Given = std::pair<const char*, const std::optional<std::string>&>;
  for (const auto& [flag, value] :
       {Given{"--time", data.time}, Given{"--time-unit", data.time_unit},
        Given{"--trajectory", data.trajectory}})
    if (value) words.insert(words.end(), {flag, *value});
  if (data.step) words.insert(words.end(), {"--dt", format_number(*data.step)});
  for (const std::string& map : data.names) words.insert(words.end(), {"--map", map});
  words.insert(words.end(), flags.begin(), flags.end());
  return shell_line(words);
}

std::string next_steps(const DataOptions& data, const RecordUse& use,
                       const std::string& model) {
  const auto line = [&](std::vector<std::string> words, std::vector<std::string> flags) {
    return "  " + line_for(std::move(words), data, flags) + "\n";
  };
  return "\nThe equations from the data:\n" +
         line({"lacuna", "identify"}, column_flags(use, data.states.empty())) + "\nWrote " +
         model + ". Once its equations are what is known: what they lack, and the values of\n"
         "their parameters:\n" +
         line({"lacuna", "diagnose", "--model", model}, {}) + line({"lacuna", "fit", model}, {});
}

/// What the columns are, by the person or by the samples.
RecordUse use_of(const Session& session, const StartArguments& options, const Dataset& data) {
  show(session, format_text(summarise(data, data.input_count())) + "\n");
  Questions questions(session.streams.out, options.yes ? nullptr : session.streams.in);
  return asked_use(proposed_use(data), questions);
}

int start_command(const Session& session, const StartArguments& options) {
  const std::string path = skeleton_path(options);
  check_skeleton(path, options);
  const Dataset data = read_data(options.data);
  const bool only_skeleton = path == "-";
  const RecordUse use = only_skeleton ? proposed_use(data) : use_of(session, options, data);
  write_output(session, path, skeleton_of(use, options.data.name()));
  if (only_skeleton) return 0;
  DataOptions read = options.data;
  read.time_unit = time_unit_for(options.data, use, data);
  session.streams.out << printable(next_steps(read, use, path));  // lines to copy: not folded
  return 0;
}

}  // namespace

Command declare_start() {
  auto options = std::make_shared<StartArguments>();
  Command command{"start",
                  "Look at a file, ask what its columns are, write a model's skeleton and the "
                  "commands for next time"};
  command.add("DATA", &options->data.paths, "Files (text, .gz, .npy) or quoted patterns")
      .require();
  declare_column_options(command, options->data, true);
  command.add("--model-out FILE.ode|-", &options->skeleton,
              "The skeleton [default: as the record is called, .ode, in this folder]");
  command.add("--yes", &options->yes, "Ask nothing: take what the samples propose");
  command.add("--replace", &options->replace, "Write over a skeleton that is there");
  command.run = [options](const Session& session) { return start_command(session, *options); };
  return command;
}

}  // namespace lacuna::cli
