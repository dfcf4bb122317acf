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
dz/dt = x*z - 1*z + 3*(x-z)^1 - 2*u*(x+1)^1 - 0.25*(x-m) + 1*(z-w)/(1+x) + (m*x-0.5*z)^1
fixed dx/dt: u
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

/// Names and brackets of circuits and motors stay; a sum without a parameter is multiplied out.
TEST(FormatOde, FormulasOfParametersStayAsTheyAreWritten) {
  const char* written =
      "time s\ninput u [V]\nstate i [A]\nstate w\nparam R = 2 [Ohm]\nparam L = 0.01 [H]\n"
      "param K = 0.05\nparam J = 1e-04 fixed\n"
      "di/dt = (u-R*i-K*w)/L\ndw/dt = i*K*J^-1 - 0.5*w + 0.5*i\n";
  const SystemModel system = parse_ode_system(written, "m.ode");
  EXPECT_EQ(format_ode(system), written);
  EXPECT_EQ(format_ode(parse_ode_system(
                "param R = 2\nparam L = 3\ndi/dt = -(R*i)/L - 0.5*(i - 4)\n", "m.ode")),
            "time s\nstate i\nparam R = 2\nparam L = 3\ndi/dt = -i*R*L^-1 - 0.5*i + 2\n");
  // With numbers for the names the terms are those of the products.
  const OdeModel numbers = system.model();
  EXPECT_DOUBLE_EQ(numbers.coefficient(0, "i"), -200.0);
  EXPECT_DOUBLE_EQ(numbers.coefficient(0, "u"), 100.0);
  EXPECT_DOUBLE_EQ(numbers.coefficient(0, "w"), -5.0);
}

}  // namespace
}  // namespace lacuna
