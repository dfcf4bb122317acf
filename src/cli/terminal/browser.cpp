// SPDX-License-Identifier: MIT
#include "browser.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <cstdlib>
#include <string>

extern char** environ;

namespace lacuna::cli {
namespace {

/// Runs "program file" with nothing on its standard streams and waits for its end: openers hand the
/// file to a browser and return.
bool run(std::string program, std::string file) {
  posix_spawn_file_actions_t streams;
  if (posix_spawn_file_actions_init(&streams) != 0) return false;
  for (const int stream : {0, 1, 2})
    posix_spawn_file_actions_addopen(&streams, stream, "/dev/null", O_RDWR, 0);
  std::array<char*, 3> words{program.data(), file.data(), nullptr};
  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, program.c_str(), &streams, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  if (failed != 0) return false;
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

bool open_in_browser(const std::filesystem::path& file) {
  const std::string path = std::filesystem::absolute(file).string();
  if (const char* chosen = std::getenv("BROWSER"); chosen != nullptr && *chosen != '\0')
    return run(chosen, path);
  return run("xdg-open", path) || run("open", path);
}

}  // namespace lacuna::cli
