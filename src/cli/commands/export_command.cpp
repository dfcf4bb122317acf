// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "answers.hpp"
#include "core/base/text.hpp"
#include "core/files/temporary_file.hpp"
#include "core/files/zip_writer.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/export/export_model.hpp"
#include "model/export/fmu.hpp"
#include "report_options.hpp"

namespace lacuna::cli {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string model;
  std::string format;
  std::string output = "-";
  Digits digits;
};

/// A folder that is gone with the object.
class WorkFolder {
 public:
  WorkFolder() {
    std::string pattern = (temporary_folder() / "lacuna-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw FileError(temporary_folder().string(),
                      std::string("no folder can be made there: ") + std::strerror(errno),
                      "set TMPDIR to a folder that may be written");
    path_ = pattern;
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code none;
    fs::remove_all(path_, none);
  }

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

/// Waits for a program that leads a group of its own. @return whether it ended well.
/// @throws Cancelled, with the group ended, where a stop is asked for (the interrupt guard
/// breaks
///   into the wait).
bool ends_well(pid_t child, const std::stop_token& stop) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return false;
    if (!stop.stop_requested()) continue;
    kill(-child, SIGKILL);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    throw Cancelled();
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Runs a program with what it prints in a file. @return whether it ended well.
/// @throws Cancelled as ends_well().
bool run(std::vector<std::string> arguments, const std::string& printed,
         const std::stop_token& stop) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, printed.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  const int failure =
      posix_spawnp(&child, pointers.front(), &actions, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return failure == 0 && ends_well(child, stop);
}

std::string bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

/// The shared library of a C source, by the compiler that CC names, else `cc`.
std::string compiled(const std::string& code, const std::stop_token& stop) {
  const WorkFolder folder;
  const std::string source = folder.file("model.c"), library = folder.file("model.so");
  const char* given = std::getenv("CC");
  const std::string compiler = given != nullptr && *given != '\0' ? given : "cc";
  std::ofstream(source) << code;
  // Fused multiplications would round otherwise than the model does.
  if (run({compiler, "-std=c99", "-O2", "-ffp-contract=off", "-fPIC", "-shared",
           "-fvisibility=hidden", "-o", library, source, "-lm"},
          folder.file("printed"), stop))
    if (std::string bytes = bytes_of_file(library); !bytes.empty()) return bytes;
  const std::string said = bytes_of_file(folder.file("printed"));
  throw ConfigError("export --format fmu",
                    "the C compiler '" + compiler + "' made no library" +
                        (said.empty() ? "" : ": " + said.substr(0, said.find('\n'))),
                    "install one, or name another by the variable CC");
}

/// Folder and ending of a shared library in an FMU on this system (FMI 2.0, 2.3).
#if defined(__APPLE__)
constexpr const char* kPlatform = "darwin64";
constexpr const char* kLibraryEnding = ".dylib";
#else
constexpr const char* kPlatform = "linux64";
constexpr const char* kLibraryEnding = ".so";
#endif

std::string fmu_archive(const SystemModel& model, const std::stop_token& stop) {
  const FmuSources sources = fmu_sources(model);
  const std::string name = kFmuName;
  return zip_of({{"modelDescription.xml", sources.description},
                 {"sources/" + name + ".c", sources.code},
                 {std::string("binaries/") + kPlatform + "/" + name + kLibraryEnding,
                  compiled(sources.code, stop)}});
}

void check_format(const std::string& format) {
  std::vector<std::string> known;
  for (const auto& [name, summary] : exports()) known.push_back(name);
  if (!exports().contains(format))
    throw ConfigError("--format " + format, "there is no format '" + format + "'",
                      suggestion(format, known));
}

/// LaTeX is read by people, all else by programs.
std::string exported(const ExportArguments& options, const std::stop_token& stop) {
  check_format(options.format);
  const SystemModel model = load_system({options.model});
  if (options.format == "latex")
    return export_model(rounded(model, options.digits), options.format);
  if (options.format != "fmu") return export_model(model, options.format);
  if (options.output == "-")
    throw ConfigError("--format fmu", "an FMU is an archive, no text", "give -o model.fmu");
  return fmu_archive(model, stop);
}

int export_command(const Session& session, const ExportArguments& options) {
  write_output(session, options.output, exported(options, session.stop));
  return 0;
}

}  // namespace

const std::map<std::string, std::string>& exports() {
  static const std::map<std::string, std::string> kExports{
      {"c", "A C99 function of the rates of change"},
      {"cpp", "A C++ function of the rates of change"},
      {"fmu", "An FMU of FMI 2.0 for co-simulation; takes a C compiler"},
      {"latex", "The equations as LaTeX"},
      {"matlab", "A function for MATLAB and Octave, as ode45 takes it"},
      {"modelica", "A Modelica model"},
      {"python", "A Python function, as SciPy's solve_ivp takes it"},
      {"spice", "A netlist for SPICE"}};
  return kExports;
}

Command declare_export() {
  auto options = std::make_shared<ExportArguments>();
  Command command{"export",
                  "Write a model for another program: as its source text, or as an FMU"};
  command.add("MODEL", &options->model, "Model file, or the name of a test system").require();
  command
      .add("--format", &options->format,
           "One of `lacuna list export`: c, cpp, fmu (FMI 2.0 for co-simulation; takes a C "
           "compiler), latex, matlab, modelica, python, spice")
      .require();
  command.add("-o,--output FILE|-", &options->output, "File to write; - is standard output");
  declare_digits_option(command, options->digits,
                        "Digits of numbers in LaTeX: auto (two of the 95 % interval), full, or "
                        "so many; programs get all [default: auto]");
  command.run = [options](const Session& session) { return export_command(session, *options); };
  return command;
}

}  // namespace lacuna::cli
