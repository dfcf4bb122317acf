// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/refiner.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/options.hpp"

namespace lacuna {
namespace {

struct ShiftOptions {
  static constexpr StageInfo kInfo{"echo", "Hands the model back", ""};
  void describe(OptionVisitor&) {}
};

class Shift final : public Configured<Refiner, ShiftOptions> {
 private:
  RefinedModel do_refine(const RefinerTask& task, const RunContext&) const override {
    return {.model = task.start};
  }
};

Dataset line() {
  Dataset data;
  data.states = {{"x", "m"}};
  Trajectory record;
  record.time = Vector::LinSpaced(5, 0.0, 4.0);
  record.states = record.time;
  record.inputs.resize(5, 0);
  data.trajectories = {record};
  return data;
}

TEST(Refiner, RefusesModelsOfOtherStatesAndUnusableData) {
  const Dataset data = line();
  const OdeModel other({{"y", "m"}}, {}, {{}});
  EXPECT_THROW(Shift{}.refine({data, {{{"x"}, {}}, {}}, other}), ArgumentError);
  const OdeModel model(data.states, {}, {{}});
  EXPECT_THROW(Shift{}.refine({Dataset{}, {{{"x"}, {}}, {}}, model}), DataError);
}

TEST(Refiner, HonoursAStopRequest) {
  const Dataset data = line();
  const OdeModel model(data.states, {}, {{}});
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  EXPECT_THROW(Shift{}.refine({data, {{{"x"}, {}}, {}}, model}, context), Cancelled);
}

}  // namespace
}  // namespace lacuna
