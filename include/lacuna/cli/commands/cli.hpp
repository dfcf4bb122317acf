// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>

#include "lacuna/cli/configuration/registry.hpp"

namespace lacuna {

class Team;

/// Where the command line reads and writes.
struct CliStreams {
  std::ostream& out;  ///< results for people, or JSON with `--json -`
  std::ostream& err;  ///< errors and progress
  std::istream* in = nullptr;  ///< answers to questions; nothing: each is answered as proposed
};

/// The `lacuna` command as a function, so that a user's own program can have it, with parts of
/// its own: `auto registry = default_registry(); registry.add<MyBasis>(); return run_cli(...)`.
/// After an interrupt the forms without streams end the process themselves where a step cannot
/// be stopped; the form with streams returns when that step is done.
/// @return exit status: 0 done; 1 the numbers do not allow an answer; 2 bad arguments,
///   configuration or data; 130 interrupted.
int run_cli(int argc, const char* const* argv);
int run_cli(int argc, const char* const* argv, const Registry& registry);
int run_cli(int argc, const char* const* argv, const Registry& registry, CliStreams streams);

/// The same in each member of a team: the leader reads, shows and writes what is not divided.
/// @param streams of a member that does not lead: errors only.
int run_cli(int argc, const char* const* argv, const Registry& registry, CliStreams streams,
            const Team& team);

}  // namespace lacuna
