// SPDX-License-Identifier: MIT
#include "mpi_team.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

constexpr int kFailure = 1;  // tag

}  // namespace

MpiTeam::MpiTeam() {
  MPI_Comm_dup(MPI_COMM_WORLD, &numbers_);
  MPI_Comm_dup(MPI_COMM_WORLD, &failures_);
  MPI_Comm_size(numbers_, &size_);
  MPI_Comm_rank(numbers_, &rank_);
}

MpiTeam::~MpiTeam() {
  MPI_Comm_free(&numbers_);
  MPI_Comm_free(&failures_);
}

void MpiTeam::check_failures() const {
  int waiting = 0;
  MPI_Status status{};
  MPI_Iprobe(MPI_ANY_SOURCE, kFailure, failures_, &waiting, &status);
  if (waiting == 0) return;
  int length = 0;
  MPI_Get_count(&status, MPI_CHAR, &length);
  std::string message(static_cast<std::size_t>(length), '\0');
  MPI_Recv(message.data(), length, MPI_CHAR, status.MPI_SOURCE, kFailure, failures_,
           MPI_STATUS_IGNORE);
  throw DataError("process " + std::to_string(status.MPI_SOURCE), message, "");
}

void MpiTeam::wait_for(MPI_Request& request, bool watches) const {
  constexpr int kImpatient = 200;
  for (int asked = 0;; ++asked) {
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    if (watches) check_failures();
    // Whoever works may need this core.
    if (asked > kImpatient)
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    else
      std::this_thread::yield();
  }
}

void MpiTeam::broadcast(std::span<double> numbers, int owner) const {
  // MPI counts with int.
  constexpr std::size_t kMost = std::numeric_limits<int>::max() / 2;
  while (!numbers.empty()) {
    const std::span<double> part = numbers.first(std::min(numbers.size(), kMost));
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(part.data(), static_cast<int>(part.size()), MPI_DOUBLE, owner, numbers_,
               &request);
    wait_for(request, true);
    numbers = numbers.subspan(part.size());
  }
}

void MpiTeam::fail(const std::string& message) const {
  for (int other = 0; other < size_; ++other)
    if (other != rank_)
      MPI_Send(message.data(), static_cast<int>(message.size()), MPI_CHAR, other, kFailure,
               failures_);
}

void MpiTeam::finish() const {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(failures_, &request);
  wait_for(request, false);
}

}  // namespace lacuna
