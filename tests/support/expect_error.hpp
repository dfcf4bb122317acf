// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace lacuna::testing {

/// Calls and expects an error of the given type whose parts say what they should.
/// @param where the whole place; problem and remedy: parts of their texts.
template <class ErrorType, class Call>
void expect_error(Call&& call, const std::string& where, const std::string& problem,
                  const std::string& remedy) {
  try {
    call();
  } catch (const ErrorType& error) {
    EXPECT_EQ(error.where(), where);
    EXPECT_THAT(error.problem(), ::testing::HasSubstr(problem));
    EXPECT_THAT(error.remedy(), ::testing::HasSubstr(remedy));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return;
  }
  ADD_FAILURE() << "nothing thrown at " << where << ": " << problem;
}

}  // namespace lacuna::testing
