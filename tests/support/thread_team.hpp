// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <barrier>
#include <functional>
#include <span>
#include <thread>
#include <vector>

#include "lacuna/core/base/run_context.hpp"

namespace lacuna::testing {

/// A team whose members are threads of the test.
class ThreadTeam {
 public:
  explicit ThreadTeam(int size) : meeting_(size) {
    for (int rank = 0; rank < size; ++rank) members_.emplace_back(*this, size, rank);
  }

  /// Calls work(context) in every member at a time, each on `threads` threads.
  void run(int threads, const std::function<void(const RunContext&)>& work) {
    std::vector<std::jthread> all;
    for (const Member& member : members_)
      all.emplace_back([&work, &member, threads] {
        RunContext context;
        context.threads = threads;
        context.team = &member;
        work(context);
      });
  }

 private:
  class Member final : public Team {
   public:
    Member(ThreadTeam& team, int size, int rank) : team_(team), size_(size), rank_(rank) {}
    int size() const override { return size_; }
    int rank() const override { return rank_; }
    void broadcast(std::span<double> numbers, int owner) const override {
      if (rank_ == owner) team_.shared_.assign(numbers.begin(), numbers.end());
      team_.meeting_.arrive_and_wait();
      std::copy(team_.shared_.begin(), team_.shared_.end(), numbers.begin());
      team_.meeting_.arrive_and_wait();
    }

   private:
    ThreadTeam& team_;
    int size_, rank_;
  };

  std::barrier<> meeting_;
  std::vector<double> shared_;
  std::vector<Member> members_;
};

}  // namespace lacuna::testing
