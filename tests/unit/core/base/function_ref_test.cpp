// SPDX-License-Identifier: MIT
#include "lacuna/core/base/function_ref.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

double apply(FunctionRef<double(double)> function, double x) { return function(x); }

TEST(FunctionRef, CallsLambdasThatKeepState) {
  int calls = 0;
  const auto count = [&calls](double x) {
    ++calls;
    return x + calls;
  };
  EXPECT_EQ(apply(count, 1.0), 2.0);
  EXPECT_EQ(apply(count, 1.0), 3.0);
}

TEST(FunctionRef, ChangesTheCallableItself) {
  struct Counter {
    int count = 0;
    void operator()() { ++count; }
  } counter;
  const FunctionRef<void()> reference(counter);
  reference();
  const FunctionRef<void()> copy = reference;
  copy();
  EXPECT_EQ(counter.count, 2);
}

}  // namespace
}  // namespace lacuna
