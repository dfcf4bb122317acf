// SPDX-License-Identifier: MIT
#include "trials.hpp"

#include "cli/terminal/shell_text.hpp"

namespace lacuna::cli {
namespace {

namespace fs = std::filesystem;

/// A decision: so far above its file a program's data are looked for. An installed one has them
/// one folder up, one in its build folder two; farther up other people's folders begin.
constexpr int kFoldersAbove = 3;

constexpr const char* kModel = "pendulum.ode";

}  // namespace

std::optional<fs::path> shipped_data(const fs::path& program) {
  fs::path folder = program;
  for (int i = 0; i < kFoldersAbove; ++i) {
    folder = folder.parent_path();
    for (const char* place : {"share/lacuna/data", "data"}) {
      std::error_code none;
      if (fs::is_regular_file(folder / place / kModel, none)) return folder / place;
    }
  }
  return std::nullopt;
}

std::optional<fs::path> shipped_data() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? std::nullopt : shipped_data(program);
}

std::vector<TrialCommand> trials(const fs::path& data) {
  const std::string first = (data / "pendulum_scope_1.csv.gz").string();
  const std::string columns = "th=CH1,w=CH2,u=CH3";
  return {{"check", "What is in a file: columns, step, noise", {"check", first}},
          {"diagnose",
           "What a pendulum's model lacks, found in one record and tried on another",
           {"diagnose", "--model", (data / kModel).string(), first, "--holdout",
            (data / "pendulum_scope_2.csv.gz").string(), "--map", columns}},
          {"identify",
           "The equations of a chaotic circuit from its record",
           {"identify", (data / "tl072_record.csv.gz").string()}}};
}

std::string welcome(const std::optional<fs::path>& data) {
  std::string text =
      "lacuna finds the equations of a dynamical system in measured data, and what a model\n"
      "lacks.\n\nYour own record:\n  lacuna start FILE\n";
  if (data) {
    text += "\nThree things to try; `lacuna demo` runs them:\n";
    for (const TrialCommand& trial : trials(*data))
      text += "  # " + trial.purpose + "\n  lacuna " + shell_line(trial.words) + "\n";
  }
  return text + "\nAll commands: lacuna --help\n";
}

}  // namespace lacuna::cli
