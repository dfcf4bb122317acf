// SPDX-License-Identifier: MIT
#include "model/expressions/unbound_delays.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(UnboundDelays, NamesAreThoseOfTheTimes) {
  EXPECT_EQ(names_in_delay_times(parse_expression("a*sin(delay(x,T+2*S))+delay(y,1)")),
            (std::set<std::string>{"S", "T"}));
}

TEST(UnboundDelays, StatesAndTimeAreNoDelays) {
  const VariableIndex variables({.states = {"x", "y"}, .inputs = {"T"}});
  EXPECT_NO_THROW(check_delay_times(parse_expression("y*delay(x,T)"), variables));
  EXPECT_THROW(check_delay_times(parse_expression("delay(x,y)"), variables), ModelError);
  EXPECT_THROW(check_delay_times(parse_expression("1+sin(delay(x,0.5*t))"), variables),
               ModelError);
}

}  // namespace
}  // namespace lacuna
