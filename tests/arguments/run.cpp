// SPDX-License-Identifier: MIT
// Calls every public function that takes arrays with what it is made for, with what is empty,
// of another size, negative, huge or not finite, and with mixtures: each has to answer with
// finite numbers or with an Error. Every function has a process, so that a crash is one
// failure.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <set>

#include "arguments/calls.hpp"
#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/sanitizers.hpp"

namespace lacuna::arguments {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kMixtures = 300;
constexpr time_t kLongest = 5;             // of one call, seconds of the processor
constexpr std::chrono::seconds kMost{20};  // of all mixtures of one function
constexpr rlim_t kMemory = rlim_t{3} << 30;

/// What a process says while it makes the calls of one function; its parent reads it.
struct Progress {
  std::size_t next = 0;      ///< number of the call that is being made
  std::size_t answered = 0;  ///< calls that gave something
  char message[400] = {};    ///< what is wrong with it; empty: nothing
  char arguments[400] = {};
};

/// Ends the process by SIGPROF when the processor has worked for so long from now on, by
/// SIGALRM when it does not work at all.
void limit_time(time_t seconds) {
  const itimerval work{{0, 0}, {seconds, 0}};
  setitimer(ITIMER_PROF, &work, nullptr);
  alarm(static_cast<unsigned>(20 * seconds));
}

void write(char (&place)[400], const std::string& text) {
  std::strncpy(place, text.c_str(), sizeof(place) - 1);
}

/// Which choices are taken: the first, each other one beside the first, and mixtures.
std::vector<std::vector<std::size_t>> mixtures(const std::vector<std::size_t>& sizes) {
  std::vector<std::vector<std::size_t>> picks = {std::vector<std::size_t>(sizes.size(), 0)};
  for (std::size_t i = 0; i < sizes.size(); ++i)
    for (std::size_t pick = 1; pick < sizes[i]; ++pick) {
      picks.push_back(picks.front());
      picks.back()[i] = pick;
    }
  Random random(1);
  for (int k = 0; k < kMixtures && sizes.size() > 1; ++k) {
    picks.push_back(picks.front());
    for (std::size_t i = 0; i < sizes.size(); ++i)
      if (random.below(3) > 0)
        picks.back()[i] = static_cast<std::size_t>(random.below(sizes[i]));
  }
  return picks;
}

/// What is wrong with one call; empty: nothing.
std::string trouble_of(const Call& call, Hand& hand, Progress& progress) {
  try {
    const bool is_finite = call.run(hand);
    ++progress.answered;
    const bool may_be = call.may_be_infinite || (call.passes_on && !hand.are_finite());
    return is_finite || may_be ? "" : "what it gives is not finite";
  } catch (const Error&) {
  } catch (const Cancelled&) {
  } catch (const std::exception& error) {
    return std::string("throws ") + error.what();
  }
  return "";
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " | ") + name;
  return text;
}

/// In the process of a function: makes its calls from progress.next on, up to a failure.
void make_calls(const Call& call, Progress& progress) {
  if (!testing::kIsSanitized) {
    const rlimit limit{kMemory, kMemory};
    setrlimit(RLIMIT_AS, &limit);
  }
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  std::vector<std::size_t> sizes;
  limit_time(kLongest);
  {
    Hand first({});
    write(progress.arguments, "the first of all");
    trouble_of(call, first, progress);
    sizes = first.sizes();
  }
  const auto all = mixtures(sizes);
  const auto begin = Clock::now();
  for (; progress.next < all.size() && Clock::now() - begin < kMost; ++progress.next) {
    Hand hand(all[progress.next]);
    std::string text;
    for (std::size_t i = 0; i < sizes.size(); ++i)
      text += (i == 0 ? "" : ",") + std::to_string(all[progress.next][i]);
    write(progress.arguments, text);
    limit_time(kLongest);
    const std::string trouble = trouble_of(call, hand, progress);
    limit_time(0);
    if (trouble.empty()) continue;
    write(progress.arguments, list(hand.names()));
    write(progress.message, trouble);
    return;
  }
  progress.next = all.size() + 1;
}

/// Failures of one function, of which the first few are told.
struct Failures {
  std::size_t count = 0, answered = 0;
  std::set<std::string> texts;
};

Failures failures_of(const Call& call, Progress& progress) {
  constexpr std::size_t kTold = 4, kEnough = 12;
  Failures failures;
  progress = {};
  while (failures.count < kEnough) {
    progress.message[0] = progress.arguments[0] = 0;
    const std::size_t before = progress.next;
    const pid_t child = fork();
    if (child == 0) {
      if (!freopen("/dev/null", "w", stderr)) _exit(2);
      make_calls(call, progress);
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && progress.message[0] == 0) break;
    std::string what = progress.message;
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGPROF || signal == SIGALRM)
      what = "takes more than 5 s";
    else if (signal != 0)
      what = strsignal(signal);
    if (what.empty()) what = "ends the process";
    ++failures.count;
    if (failures.texts.size() < kTold) failures.texts.insert(what + ": " + progress.arguments);
    progress.next = std::max(before, progress.next) + 1;
  }
  failures.answered = progress.answered;
  return failures;
}

/// Whether a function keeps what this program is for.
bool holds(const Call& call, Progress& progress) {
  Failures failures;
  if (!call.run)
    failures.texts.insert("a parameter has a type without values (values.hpp, left_out.txt)");
  else
    failures = failures_of(call, progress);
  if (call.run && failures.count == 0 && failures.answered == 0)
    failures.texts.insert("never answers: no values fit (values.cpp)");
  if (failures.texts.empty()) return true;
  std::cout << call.header << ": " << call.name << "\n";
  for (const std::string& text : failures.texts) std::cout << "    " << text << "\n";
  if (failures.count > failures.texts.size())
    std::cout << "    (" << failures.count << " calls)\n";
  return false;
}

int run(const std::string& part_of_name) {
  void* const memory = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
  Progress& progress = *new (memory) Progress;
  int count = 0, failed = 0;
  for (const Call& call : all_calls()) {
    if ((call.header + ": " + call.name).find(part_of_name) == std::string::npos) continue;
    ++count;
    if (!holds(call, progress)) ++failed;
  }
  std::cout << count << " functions, " << failed << " failed" << std::endl;
  return failed == 0 && count > 0 ? 0 : 1;
}

}  // namespace
}  // namespace lacuna::arguments

int main(int count, char** words) { return lacuna::arguments::run(count > 1 ? words[1] : ""); }
