// SPDX-License-Identifier: MIT
#pragma once

#include <mpi.h>

#include <span>
#include <string>

#include "lacuna/core/base/run_context.hpp"

namespace lacuna {

/// The processes of an MPI job. A member that fails says so; the others then throw when they
/// next share something instead of waiting for it.
class MpiTeam final : public Team {
 public:
  MpiTeam();
  ~MpiTeam() override;
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;

  int size() const override { return size_; }
  int rank() const override { return rank_; }
  void broadcast(std::span<double> numbers, int owner) const override;

  /// Informs the others that this member has failed, and why.
  void fail(const std::string& message) const;

  /// Waits, without keeping a core busy, until all members have come here.
  void finish() const;

 private:
  void check_failures() const;
  void wait_for(MPI_Request& request, bool watches) const;

  MPI_Comm numbers_ = MPI_COMM_NULL;   ///< what is shared
  MPI_Comm failures_ = MPI_COMM_NULL;  ///< who has failed
  int size_ = 1;
  int rank_ = 0;
};

}  // namespace lacuna
