// SPDX-License-Identifier: MIT
#include "call.hpp"

#include <nanobind/stl/string.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

namespace lacuna::python {
namespace {

using namespace std::chrono_literals;

constexpr auto kLook = 20ms;       ///< from one look at Python's signals to the next
constexpr auto kPatience = 500ms;  ///< after an interrupt; a call has to end within a second
constexpr auto kFarewell = 2s;     ///< before the interpreter goes away, with its process

/// What the two threads of a call share.
struct Exchange {
  std::mutex mutex;
  std::condition_variable ended;
  bool has_ended = false;
  std::exception_ptr error;
  std::string activity;
  double fraction = 0.0;
  bool is_new = false;  ///< progress since it was passed on

  template <class Duration>
  bool wait(Duration duration) {
    const nb::gil_scoped_release release;
    std::unique_lock lock(mutex);
    return ended.wait_for(lock, duration, [this] { return has_ended; });
  }
};

/// Work that nobody waits for any more.
struct Abandoned {
  std::mutex mutex;
  std::condition_variable changed;
  int count = 0;

  void add(int change) {
    const std::lock_guard lock(mutex);
    count += change;
    changed.notify_all();
  }
};

Abandoned& abandoned() {
  static auto* const instance = new Abandoned;  // threads may outlive static objects
  return *instance;
}

void pass_on_progress(Exchange& exchange, const nb::object& progress) {
  std::string activity;
  double fraction = 0.0;
  {
    const std::lock_guard lock(exchange.mutex);
    if (!exchange.is_new) return;
    activity = exchange.activity;
    fraction = exchange.fraction;
    exchange.is_new = false;
  }
  progress(activity, fraction);
}

RunContext make_context(const CallOptions& options, const std::shared_ptr<Exchange>& exchange,
                        std::stop_token stop) {
  RunContext context;
  context.stop = std::move(stop);
  context.seed = options.seed;
  context.threads = options.threads;
  if (options.time_limit)
    context.deadline = std::chrono::steady_clock::now() +
                       std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                           std::chrono::duration<double>(*options.time_limit));
  if (options.progress.is_none()) return context;
  context.progress = [exchange](const Progress& progress) {
    const std::lock_guard lock(exchange->mutex);
    exchange->activity = progress.activity;
    exchange->fraction = progress.fraction;
    exchange->is_new = true;
  };
  return context;
}

void work_and_report(const std::function<void(const RunContext&)>& work,
                     const RunContext& context, Exchange& exchange) {
  std::exception_ptr error;
  try {
    work(context);
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(exchange.mutex);
  exchange.error = error;
  exchange.has_ended = true;
  exchange.ended.notify_all();
}

/// Looks at signals and progress until the work has ended.
/// @throws nb::python_error of a signal handler or of the progress function.
void watch(Exchange& exchange, const nb::object& progress) {
  while (!exchange.wait(kLook)) {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (!progress.is_none()) pass_on_progress(exchange, progress);
  }
}

}  // namespace

Callbacks::Entry::Entry(Callbacks& all) : callbacks(all), thread(PyThread_get_thread_ident()) {
  if (all.is_interrupted_) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw nb::python_error();
  }
  all.threads_.insert(thread);
}

void Callbacks::interrupt() {
  is_interrupted_ = true;
  for (const unsigned long thread : threads_)
    PyThreadState_SetAsyncExc(thread, PyExc_KeyboardInterrupt);
}

void run_interruptible(const CallOptions& options,
                       std::function<void(const RunContext& context)> work) {
  auto exchange = std::make_shared<Exchange>();
  std::stop_source stop;
  RunContext context = make_context(options, exchange, stop.get_token());
  abandoned().add(1);  // until it is seen to end
  std::thread worker([exchange, context = std::move(context), work = std::move(work),
                      callbacks = options.callbacks]() mutable {
    work_and_report(work, context, *exchange);
    work = nullptr;  // what it keeps alive goes first
    callbacks->release();
    exchange.reset();
    abandoned().add(-1);
  });
  try {
    watch(*exchange, options.progress);
  } catch (...) {
    stop.request_stop();
    options.callbacks->interrupt();
    if (exchange->wait(kPatience)) {
      const nb::gil_scoped_release release;
      worker.join();
    } else {
      worker.detach();
    }
    throw;
  }
  {
    const nb::gil_scoped_release release;
    worker.join();
  }
  if (exchange->error) std::rethrow_exception(exchange->error);
}

void wait_for_abandoned_work() {
  const nb::gil_scoped_release release;
  std::unique_lock lock(abandoned().mutex);
  abandoned().changed.wait_for(lock, kFarewell, [] { return abandoned().count == 0; });
}

}  // namespace lacuna::python
