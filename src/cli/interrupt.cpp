// SPDX-License-Identifier: MIT
#include "interrupt.hpp"

#include <pthread.h>

namespace lacuna::cli {

InterruptGuard::InterruptGuard() : interrupt_(), before_() {
  sigemptyset(&interrupt_);
  sigaddset(&interrupt_, SIGINT);
  pthread_sigmask(SIG_BLOCK, &interrupt_, &before_);
  waiter_ = std::thread([this] {
    int signal = 0;
    sigwait(&interrupt_, &signal);
    stop_.request_stop();
  });
}

InterruptGuard::~InterruptGuard() {
  pthread_kill(waiter_.native_handle(), SIGINT);  // ends the wait if nothing came
  waiter_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace lacuna::cli
