// SPDX-License-Identifier: MIT
#include "report/pages/data_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

/// A tone of 1 Hz with noise of 0.01, an input that is held for ten samples, a column that
/// nobody asked for.
Dataset tone() {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  const Index n = 4000;
  const Vector t = Vector::LinSpaced(n, 0.0, 0.01 * static_cast<double>(n - 1));
  Matrix states(n, 1), inputs(n, 2);
  for (Index i = 0; i < n; ++i) {
    states(i, 0) = std::sin(6.283185307179586 * t[i]) + 0.01 * normal(engine);
    inputs(i, 0) = std::sin(0.3 * std::floor(0.1 * static_cast<double>(i)));
    inputs(i, 1) = 5.0;
  }
  return {"s",
          {{"x", "V"}},
          {{"u", "A"}, {"room", ""}},
          {{"data/run.csv", t, states, inputs, Matrix()}},
          {},
          {},
          {"run.csv: a note"}};
}

TEST(DataSummary, SaysWhatWasMeasuredAndHow) {
  const DataSummary summary = summarise(tone(), 1);
  ASSERT_EQ(summary.channels.size(), 3u);
  const ChannelSummary& x = summary.channels[0];
  EXPECT_EQ(x.role, "state");
  EXPECT_NEAR(x.channel->noise.sigma, 0.01, 0.001);
  EXPECT_NEAR(x.largest, 1.0, 0.05);
  // The tone, its leakage in a Hann window of 2.5 s, and nothing else.
  ASSERT_TRUE(x.signal_until);
  EXPECT_NEAR(*x.signal_until, 2.0, 1.2);
  EXPECT_EQ(summary.channels[1].role, "input");
  EXPECT_EQ(summary.channels[1].hold, Hold::Zero);
  EXPECT_EQ(summary.channels[2].role, "not used");
  EXPECT_FALSE(summary.channels[2].hold);
  EXPECT_TRUE(summary.records[0].uniform);
  EXPECT_NEAR(summary.records[0].step, 0.01, 1e-9);
}

TEST(DataSummary, TextAndJsonAgree) {
  const DataSummary summary = summarise(tone(), 1);
  const std::string text = format_text(summary);
  EXPECT_THAT(text, HasSubstr("run.csv: 4000 rows, 0 .. 39.99 s, step 0.01 s"));
  EXPECT_THAT(text, HasSubstr("x [V]"));
  EXPECT_THAT(text, HasSubstr("held between samples"));
  EXPECT_THAT(text, HasSubstr("never moves"));
  EXPECT_THAT(text, HasSubstr("a note"));
  const auto json = nlohmann::json::parse(format_json(summary));
  EXPECT_EQ(json["format"], "lacuna.check/1");
  EXPECT_EQ(json["columns"][0]["noise"]["kind"], "white");
  EXPECT_EQ(json["columns"][1]["hold"], "zero");
  EXPECT_EQ(json["records"][0]["rows"], 4000);
  EXPECT_FALSE(json["columns"][2].contains("noise"));
}

TEST(DataSummary, AStateThatNobodyMeasuredIsSaidToBeOne) {
  Dataset data = tone();
  Trajectory& record = data.trajectories[0];
  data.states.push_back({"h", "m"});
  data.reconstructed = {false, true};
  record.states.conservativeResize(Eigen::NoChange, 2);
  record.states.col(1).setZero();
  record.marks = Matrix::Zero(record.samples(), 2);
  record.marks.col(1).setConstant(number_of(Mark::Missing));
  EXPECT_EQ(summarise(data, 1).channels[1].role, "not measured");
  EXPECT_THAT(data_line(data, 1), HasSubstr("states x [V]; not measured h [m]; inputs"));
}

TEST(DataSummary, OneLineSaysTheSameShortly) {
  EXPECT_EQ(data_line(tone(), 1),
            "run.csv: 4000 rows, step 0.01 s; states x [V]; inputs u [A]; not used room");
  Dataset two = tone();
  two.trajectories.push_back(two.trajectories[0]);
  two.trajectories[1].source = "other.csv";
  EXPECT_THAT(data_line(two, 2), HasSubstr("run.csv, other.csv: 8000 rows in 2 records"));
}

}  // namespace
}  // namespace lacuna
