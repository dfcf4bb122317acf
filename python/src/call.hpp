// SPDX-License-Identifier: MIT
// Long calls: the interpreter goes on, Ctrl-C ends them, progress is passed on.
#pragma once

#include <nanobind/nanobind.h>

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "lacuna/core/base/run_context.hpp"

namespace lacuna::python {

namespace nb = nanobind;

/// Functions of Python that a call may run, and the threads in which they run now. Used with
/// the interpreter's lock, but for release().
class Callbacks {
 public:
  /// The value of a function, which ends by KeyboardInterrupt where the call is interrupted.
  template <class Function>
  auto run(Function function) {
    const Entry entry(*this);
    return function();
  }

  void interrupt();

  void keep(std::shared_ptr<const void> function) { kept_.push_back(std::move(function)); }
  void release() { kept_.clear(); }  ///< when the call has ended

 private:
  struct Entry {
    explicit Entry(Callbacks& all);
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    ~Entry() { callbacks.threads_.erase(callbacks.threads_.find(thread)); }

    Callbacks& callbacks;
    unsigned long thread;
  };

  std::multiset<unsigned long> threads_;
  bool is_interrupted_ = false;
  std::vector<std::shared_ptr<const void>> kept_;
};

/// How a call runs: seed, threads, who is informed how far it is (None, or a function of an
/// activity and a fraction), and when it ends with the answer that it has by then.
struct CallOptions {
  std::uint64_t seed = 1;
  int threads = 1;
  nb::object progress = nb::none();
  std::optional<double> time_limit = {};  ///< seconds
  std::shared_ptr<Callbacks> callbacks = std::make_shared<Callbacks>();
};

/// Runs work in a thread of its own without the interpreter's lock while this one looks at
/// Python's signals. After an interrupt work is asked to stop, and functions of Python in it
/// are ended; where it has not ended half a second later it is left to end by itself, and
/// nothing of its result is seen.
/// @param work keeps all that it uses alive itself.
/// @throws nb::python_error of a signal handler; what work throws.
void run_interruptible(const CallOptions& options,
                       std::function<void(const RunContext& context)> work);

/// Gives work that was left to end by itself two seconds, before the interpreter goes away.
/// What does not look at its stop token by then (in a factorisation) ends with the process.
void wait_for_abandoned_work();

/// The value of work that runs so.
template <class Work>
auto call(const CallOptions& options, Work work) {
  using Result = decltype(work(std::declval<const RunContext&>()));
  auto result = std::make_shared<std::optional<Result>>();
  run_interruptible(options, [result, work = std::move(work)](const RunContext& context) {
    result->emplace(work(context));
  });
  return std::move(**result);
}

}  // namespace lacuna::python
