// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lacuna/model/files/model_file.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

constexpr const char* kAll = R"(time min
input u [V] hold zero
state x [V]
state z
param k = 0.05 [1/s] in 0..1
param m = 2 in 1.. per_record
param w = 3 in ..4 fixed
param j = -1e-09 fixed
dx/dt = -2*sqrt(x)*k + 4*u + sin(w*x) - z
dz/dt = x*z - z + 3*(x-z)^1 - 2*u*(x+1)^1
fixed dx/dt: u
free dz/dt: z
y = abs(x)+m [V]
s = x
initial x = 0 fixed
initial z = 1.5 deviation 0.25
)";

TEST(FormatOde, GivesBackWhatWasWritten) {
  EXPECT_EQ(format_ode(parse_ode_system(kAll, "m.ode")), kAll);
}

TEST(FormatOde, JsonAndBackIsTheSameModel) {
  const SystemModel system = parse_ode_system(kAll, "m.ode");
  const std::string json = format_model(system);
  const SystemModel again = parse_system(json, "m.json");
  EXPECT_EQ(format_model(again), json);
  EXPECT_EQ(format_ode(again), kAll);
  EXPECT_EQ(format_model(parse_ode_system(format_ode(again), "m.ode")), json);
}

}  // namespace
}  // namespace lacuna
