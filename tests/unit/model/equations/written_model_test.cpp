// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/written_model.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/expressions/functions.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

const Expression kWrittenX = Expression::variable("x"), kWrittenY = Expression::variable("y"),
                 kWrittenZ = Expression::variable("z"), kWrittenU = Expression::variable("u"),
                 kTime = Expression::variable("t");
const std::vector<Quantity> kLorenzStates{{"x", ""}, {"y", ""}, {"z", ""}};

TEST(WrittenModel, IsThatOfTheSameText) {
  const double sigma = 10.0, rho = 28.0, beta = 8.0 / 3.0;
  const OdeModel written =
      written_model(kLorenzStates,
                    {sigma * (kWrittenY - kWrittenX), kWrittenX * (rho - kWrittenZ) - kWrittenY,
                     kWrittenX * kWrittenY - beta * kWrittenZ});
  const OdeModel read = parse_ode(
      "time s\ndx/dt = 10*(y-x)\ndy/dt = x*(28-z) - y\ndz/dt = x*y - 8/3*z\n", "lorenz");
  EXPECT_EQ(to_text(written), to_text(read));
  EXPECT_EQ(written.coefficient(0, "y"), 10.0);
  EXPECT_EQ(written.coefficient(1, "x*z"), -1.0);
}

TEST(WrittenModel, HasInputsTimeAndUnits) {
  const OdeModel model = written_model(
      {{"x", "V"}}, {-2 * kWrittenX + pow(kWrittenU, 2) + sin(3 * kTime)}, {{"u", "A"}}, "ms");
  EXPECT_EQ(to_text(model), "dx/dt = -2*x + u^2 + sin(3*t)");
  EXPECT_EQ(model.time_unit(), "ms");
  EXPECT_EQ(model.inputs()[0].unit, "A");
}

TEST(WrittenModel, SaysWhatIsWrongWhere) {
  EXPECT_THROW(written_model(kLorenzStates, {kWrittenX}), ModelError);
  try {
    written_model(kLorenzStates, {kWrittenX, kWrittenY + kWrittenU, kWrittenZ});
    FAIL() << "u is no variable";
  } catch (const ModelError& error) {
    EXPECT_NE(error.where().find("dy/dt"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("'u'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lacuna
