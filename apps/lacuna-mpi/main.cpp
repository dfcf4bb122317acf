// SPDX-License-Identifier: MIT
// The command on several processes: mpirun -n 8 lacuna-mpi identify 'part-*.npy'.
#include <mpi.h>

#include <iostream>
#include <sstream>

#include "lacuna/cli/commands/cli.hpp"
#include "mpi_team.hpp"

namespace {

/// Runs the command in this process. What a member that does not lead has to say goes to the
/// others, one of whom is the leader.
int run_member(int argc, char** argv, const lacuna::MpiTeam& team) {
  const lacuna::Registry registry = lacuna::default_registry();
  if (team.rank() == 0) {
    const int status = lacuna::run_cli(argc, argv, registry, {std::cout, std::cerr}, team);
    if (status == 2 || status == 130) team.fail("the first process has ended");
    return status;
  }
  std::ostringstream nothing, errors;
  const int status = lacuna::run_cli(argc, argv, registry, {nothing, errors}, team);
  if (status != 0) team.fail(errors.str());
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  int status = 0;
  {
    const lacuna::MpiTeam team;
    status = run_member(argc, argv, team);
    team.finish();
  }
  MPI_Finalize();
  return status;
}
