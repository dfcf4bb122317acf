// SPDX-License-Identifier: MIT
// The same on several machines, which divide the rows among them: a team of MPI processes.
#include <mpi.h>

#include <iostream>
#include <lacuna/lacuna.hpp>

using namespace lacuna;

class MpiTeam final : public Team {
 public:
  int size() const override { return asked(MPI_Comm_size); }
  int rank() const override { return asked(MPI_Comm_rank); }
  void broadcast(std::span<double> numbers, int owner) const override {
    MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, owner,
              MPI_COMM_WORLD);
  }

 private:
  static int asked(int (*question)(MPI_Comm, int*)) {
    int answer = 0;
    question(MPI_COMM_WORLD, &answer);
    return answer;
  }
};

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const MpiTeam team;
  const RunContext context{.team = &team};
  const RecordStream records = read_stream({"part-*.csv"}, {}, context);
  const Pipeline pipeline{monomials({.max_degree = 2}),
                          strong_form({finite_differences()}),
                          abm(),
                          ols(),
                          minor_terms(),
                          no_refiner()};
  const OdeModel found = identify(records, pipeline, context).model;
  // Each process has the model; one of them is enough to print it.
  if (context.leads())
    std::cout << team.size() << " processes, " << records.samples() << " samples\n"
              << to_text(found, 4) << '\n';
  MPI_Finalize();
}
