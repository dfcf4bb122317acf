// SPDX-License-Identifier: MIT
#include "lacuna/core/base/function_ref.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace lacuna {
namespace {

double apply(FunctionRef<double(double)> function, double x) { return function(x); }

double half(double x) { return x / 2.0; }

TEST(FunctionRef, CallsLambdasThatKeepState) {
  int calls = 0;
  const auto count = [&calls](double x) {
    ++calls;
    return x + calls;
  };
  EXPECT_EQ(apply(count, 1.0), 2.0);
  EXPECT_EQ(apply(count, 1.0), 3.0);
}

TEST(FunctionRef, CallsFunctionsAndFunctionPointers) {
  auto* pointer = &half;
  EXPECT_EQ(apply(pointer, 3.0), 1.5);
  EXPECT_EQ(apply([](double x) { return half(x); }, 3.0), 1.5);
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

TEST(FunctionRef, ForwardsMoveOnlyArguments) {
  const auto take = [](std::unique_ptr<int> value) { return *value; };
  const FunctionRef<int(std::unique_ptr<int>)> reference(take);
  EXPECT_EQ(reference(std::make_unique<int>(4)), 4);
}

}  // namespace
}  // namespace lacuna
