// SPDX-License-Identifier: MIT
// Records that were written with a slip: the cause has to be told and no effect named; and all
// other records, which have none.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "hidden/support/cases.hpp"
#include "hidden/support/disturbance.hpp"
#include "hidden/support/records.hpp"
#include "hidden/whole_vocabulary.hpp"
#include "lacuna/records/binding/read_records.hpp"

namespace lacuna::hidden {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// What was done to a record.
using Deed = std::function<void(const OdeModel& model, Trajectory& record)>;

/// A record of a case with a slip.
struct SlipRecord {
  std::string name;  ///< of the case
  Deed deed;
  std::vector<HintKind> kinds;  ///< each is a right answer
  std::string word;             ///< that stands in the message
};

auto column(const OdeModel& model, Trajectory& record, const std::string& name) {
  const auto& inputs = model.inputs();
  for (std::size_t j = 0; j < inputs.size(); ++j)
    if (inputs[j].name == name) return record.inputs.col(static_cast<Index>(j));
  return record.states.col(model.state_index(name));
}

Deed time_times(double factor) {
  return [=](const OdeModel&, Trajectory& record) { record.time *= factor; };
}

Deed times(const std::string& name, double factor) {
  return
      [=](const OdeModel& model, Trajectory& record) { column(model, record, name) *= factor; };
}

Deed swap(const std::string& a, const std::string& b) {
  return [=](const OdeModel& model, Trajectory& record) {
    column(model, record, a).swap(column(model, record, b));
  };
}

Deed both(const Deed& first, const Deed& second) {
  return [=](const OdeModel& model, Trajectory& record) {
    first(model, record);
    second(model, record);
  };
}

/// Names that are not in the list of units of angle or decimal prefixes: km/h for m/s.
constexpr double kKilometresPerHour = 3.6;

std::vector<SlipRecord> slip_records() {
  const std::vector<HintKind> time{HintKind::TimeUnit}, unit{HintKind::ChannelUnit},
      sign{HintKind::Sign}, swapped{HintKind::SwappedColumns}, identity{HintKind::Identity};
  return {
      {"pendulum-null", time_times(1e3), time, "ms"},
      {"pendulum-dry-friction", time_times(1e6), time, "us"},
      {"lorenz-null", time_times(1e3), time, "1000 times too large"},
      {"lorenz-hum", time_times(1.0 / 60.0), time, "min"},
      {"motor-null", time_times(1e3), time, "ms"},
      {"filter-null-quantised", time_times(1e-3), time, "time looks 1000 times too small"},
      {"tanks-null-coloured", time_times(60.0), time, "60 times too large"},
      {"tanks-overflow", time_times(60.0), time, "s and not min"},
      {"rossler-null", time_times(100.0), time, "100 times too large"},
      {"nerve-null-coloured", time_times(1e-3), time, "too small"},
      {"prey-harvest", time_times(24.0 * 60.0 * 60.0), time, "86400"},
      {"pendulum-null", times("th", kDegrees), unit, "degrees"},
      {"pendulum-drag", times("th", kDegrees), unit, "th"},
      {"pendulum-null", both(times("th", kDegrees), times("w", kDegrees)), unit, "th and w"},
      {"turntable-cogging", times("w", 1.0 / kTurn), unit, "turns"},
      {"motor-null", times("w", 30.0 / std::numbers::pi), unit, "turns per minute"},
      {"oscillator-hardening", times("x", 1e3), unit, "x"},
      {"oscillator-null-outliers", times("v", 0.01), unit, "100 times too small"},
      {"lorenz-null", times("z", 1e-3), unit, "z"},
      {"tanks-overflow", times("h1", 100.0), unit, "h1"},
      {"motor-friction-limit", times("i", 1e3), unit, "i"},
      {"prey-null", times("y", 1e3), unit, "y"},
      {"masses-hard-coupling", times("x2", 100.0), unit, "x2"},
      {"pendulum-null", times("u", 1e3), unit, "u"},
      {"pendulum-dry-friction", times("u", -1.0), sign, "u"},
      {"buoy-drag", times("v", -1.0), sign, "v"},
      {"rossler-null", times("z", -1.0), sign, "z"},
      {"oscillator-hardening", swap("x", "v"), swapped, "x and v"},
      {"tanks-leak", swap("h1", "h2"), swapped, "h1 and h2"},
      {"stage-dry-friction", times("v", kKilometresPerHour), identity, "dx/dt"},
  };
}

Diagnosis diagnosed(const SlipRecord& slip, std::uint64_t seed) {
  const HiddenCase hidden = case_named(slip.name);
  auto [find, check] = make_records(hidden, 0.01, seed);
  for (Dataset* data : {&find, &check})
    for (Trajectory& record : data->trajectories) slip.deed(hidden.nominal, record);
  return diagnosis_of(hidden.nominal, find, check);
}

bool is_told(const SlipRecord& slip, const std::vector<Hint>& hints) {
  return std::any_of(hints.begin(), hints.end(), [&](const Hint& hint) {
    return std::find(slip.kinds.begin(), slip.kinds.end(), hint.kind) != slip.kinds.end() &&
           hint.message.find(slip.word) != std::string::npos;
  });
}

TEST(Slips, AreToldAndNoEffectIsNamed) {
  int told = 0, number = 0;
  for (const SlipRecord& slip : slip_records()) {
    const Diagnosis diagnosis = diagnosed(slip, static_cast<std::uint64_t>(++number));
    std::string said;
    for (const Hint& hint : diagnosis.hints)
      said += to_string(hint.kind) + ": " + hint.message + "\n";
    EXPECT_TRUE(diagnosis.effects.empty()) << slip.name << ": " << said;
    if (is_told(slip, diagnosis.hints))
      ++told;
    else
      std::cout << number << " " << slip.name << " (" << slip.word << "):\n" << said;
  }
  EXPECT_GE(told, 28);
}

TEST(Slips, AreNotSeenWhereThereAreNone) {
  ASSERT_FALSE(all_cases().empty());
  for (const HiddenCase& hidden : all_cases()) {
    const Dataset clean = clean_record(hidden, 3);
    for (const double level : {0.0, 0.03}) {
      const BoundRecords records = observed(disturbed(clean, hidden.noise, level, 17));
      const std::vector<Hint> hints =
          look_at(hidden.nominal, records, unused_part(hidden.nominal, records.data), {});
      EXPECT_EQ(withheld_by(hints), Withheld::Nothing)
          << hidden.name << " " << level << ": " << hints.front().message;
    }
  }
}

}  // namespace
}  // namespace lacuna::hidden
