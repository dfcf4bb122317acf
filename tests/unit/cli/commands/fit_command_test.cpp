// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stop_token>
#include <string>

#include "cli/commands/command.hpp"
#include "lacuna/diagnose/criterion/options.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_refused;
using ::testing::HasSubstr;
using testing::json_of;
using testing::Records;
using testing::run_command;
using testing::run_well;

/// x and u of the oscillator from another start.
std::string other_oscillation(int samples) {
  std::string record = "t [s],x [m],u [N]\n";
  for (int i = 0; i < samples; ++i) {
    const double t = 0.02 * i, x = 0.5 * std::sin(2.0 * t) + std::sin(t) / 3.0;
    record +=
        std::to_string(t) + "," + std::to_string(x) + "," + std::to_string(std::sin(t)) + "\n";
  }
  return record;
}

TEST(FitCommand, FitsWhatIsFree) {
  const Records records;
  const std::string model = records.folder().write(
      "m.ode",
      "input u [N]\nstate x [m]\nparam c = 3 [1/s^2] in 0..100\ndx/dt = v\n"
      "dv/dt = -c*x + 0.8*u\n");
  const std::string out = records.folder().file("fitted.ode");
  const auto result =
      run_well({"fit", model, records.oscillator(), "--json", "-", "--model-out", out});
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["format"], "lacuna.fit/1");
  EXPECT_NEAR(json["model"]["parameters"][0]["value"].get<double>(), 4.0, 1e-3);
  EXPECT_EQ(json["parameters"].size(), 2u);
  EXPECT_NEAR(json["parameters"][0]["value"].get<double>(), 1.0, 1e-3);
  EXPECT_NEAR(json["initial"][0]["states"]["v"]["value"].get<double>(), 1.0 / 3.0, 1e-2);
  EXPECT_THAT(records.folder().read("fitted.ode"), HasSubstr("[1/s^2] in 0..100"));
}

/// The help of a command with single blanks between its words.
std::string help_of(const std::string& command) {
  std::istringstream words(run_command({command, "--help-all"}).out);
  std::string text, word;
  while (words >> word) text += word + " ";
  return text;
}

TEST(FitCommand, HelpSaysTheDefaultsThatAreTaken) {
  EXPECT_THAT(help_of("fit"),
              HasSubstr("[default: " + std::to_string(FitOptions{}.range_starts) +
                        ", with many samples " +
                        std::to_string(FitOptions{}.range_starts_of_many) + ","));
  EXPECT_THAT(help_of("diagnose"),
              HasSubstr("at most so many effects [default: " +
                        std::to_string(DecisionOptions{}.max_effects) + "]"));
}

TEST(FitCommand, BandsAndPredictionsAreInTheAnswer) {
  const Records records;
  const std::string conditions =
      records.folder().write("new.csv", "t,u,x,v\n0,0,1,0.5\n0.5,0,,\n1,0,,\n");
  const std::string page = records.folder().file("fit.html");
  const auto result =
      run_well({"fit", records.oscillator_model(), records.oscillator(), "--bands", "--predict",
                conditions, "--json", "-", "--report", page});
  const auto json = nlohmann::json::parse(result.out);
  ASSERT_EQ(json["bands"].size(), 1u);
  EXPECT_EQ(json["bands"][0]["time"].size(), 400u);
  EXPECT_EQ(json["bands"][0]["quantities"][1]["name"], "v");
  const auto& run = json["predicted"][0];
  EXPECT_EQ(run["time"].size(), 3u);
  const auto& x = run["quantities"][0];
  EXPECT_EQ(x["name"], "x");
  EXPECT_NEAR(x["value"][2].get<double>(), std::cos(2.0) + 0.25 * std::sin(2.0), 1e-3);
  EXPECT_LE(x["low"][2], x["value"][2]);
  EXPECT_GE(x["most"][2], x["high"][2]);
  EXPECT_EQ(x["stderr"][0], 0.0) << "initial values are exact";
  EXPECT_THAT(records.folder().read("fit.html"), HasSubstr("90 % band of the run"));
  const auto plain = json_of({"fit", records.oscillator_model(), records.oscillator()});
  EXPECT_FALSE(plain.contains("bands") || plain.contains("predicted"));
}

TEST(FitCommand, PredictionsBeginSomewhere) {
  const Records records;
  const std::string conditions = records.folder().write("new.csv", "t,u,x\n0,0,1\n1,0,\n");
  expect_refused(
      {"fit", records.oscillator_model(), records.oscillator(), "--predict", conditions},
      {"new.csv", "nothing says where v begins"});
}

/// Whatever record a unit stands in that nothing converts, a note says so.
TEST(FitCommand, UnitsThatNothingConvertsAreSaidOfAllRecords) {
  const Records records;
  const std::string conditions =
      records.folder().write("new.csv", "t,u [kg],x,v\n0,0,1,0.5\n0.5,0,,\n1,0,,\n");
  std::string other = other_oscillation(100);
  other.replace(other.find("[m]"), 3, "[K]");
  const std::string held = records.folder().write("held.csv", other);
  const auto result = run_well({"fit", records.oscillator_model(), records.oscillator(),
                                "--holdout", held, "--predict", conditions, "--json", "-"});
  const std::string notes = nlohmann::json::parse(result.out)["notes"].dump();
  EXPECT_THAT(notes, HasSubstr("u is in kg, wanted is N"));
  EXPECT_THAT(notes, HasSubstr("x is in K, wanted is m"));
}

TEST(FitCommand, RecordsThatAreUsedAreNoneToHoldOut) {
  const Records records;
  expect_refused({"fit", records.oscillator_model(), records.oscillator(), "--holdout",
                  records.oscillator()},
                 {"osc.csv", "it has the samples of", "leave --holdout out"});
}

TEST(FitCommand, NothingComparedIsNoPerfectFit) {
  const Records records;
  const std::string other = records.folder().write("other.csv", other_oscillation(300));
  const std::vector<std::string> command{"fit", records.oscillator_model(),
                                         records.oscillator(), "--holdout", other};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), command.begin(), command.end());
    return run_command(more);
  };
  const auto none = with({"--start-samples", "300"});
  EXPECT_EQ(none.status, 0) << none.err;
  EXPECT_THAT(none.out, HasSubstr("there is no gap (see --start-samples)"));
  EXPECT_THAT(none.out, ::testing::Not(HasSubstr("gap 0")));
  const auto json = nlohmann::json::parse(with({"--start-samples", "300", "--json", "-"}).out);
  EXPECT_TRUE(json["gap"].is_null());

  const auto ahead = with({"--ahead", "1000"});
  EXPECT_THAT(ahead.out, HasSubstr("1000 samples ahead nothing to compare"));
  const auto far = nlohmann::json::parse(with({"--ahead", "1000", "--json", "-"}).out);
  EXPECT_TRUE(far["fit"][0]["k_step"]["rmse"].is_null());
  EXPECT_EQ(far["fit"][0]["k_step"]["samples"], 0);
  EXPECT_EQ(far["fit"][0]["samples"], 400);
}

constexpr const char* kOralDose =
    "time h\nparam ka = 0.8 in 0.01..20\nparam ke = 0.3 in 0.001..20\nparam V = 15 in 1..200\n"
    "dg/dt = -ka*g\ndc/dt = ka*g - ke*c\ny = c/V\ninitial g = 100 fixed\n"
    "initial c = 0 fixed\n";

/// An oral dose of 100 at t = 0: ka = 1.2, ke = 0.15, V = 20, in closed form.
std::string oral_dose(const std::string& first_row) {
  std::string rows = "t,y\n" + first_row;
  for (const double t : {0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 24.0})
    rows += std::to_string(t) + "," +
            std::to_string(100.0 / 20.0 * 1.2 / (1.2 - 0.15) *
                           (std::exp(-0.15 * t) - std::exp(-1.2 * t))) +
            "\n";
  return rows;
}

TEST(FitCommand, ADoseAtATimeWithoutASample) {
  const Records records;
  const std::string model = records.folder().write("oral.ode", kOralDose);
  const std::string blank = records.folder().write("blank.csv", oral_dose("0,\n"));
  const std::string later = records.folder().write("later.csv", oral_dose(""));
  const auto fitted = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"fit", model});
    arguments.insert(arguments.end(), {"--json", "-"});
    const auto result = run_well(arguments);
    return nlohmann::json::parse(result.out);
  };
  for (const auto& json : {fitted({blank}), fitted({later, "--start-time", "0"})}) {
    EXPECT_NEAR(json["parameters"][0]["value"].get<double>(), 1.2, 2e-3);
    EXPECT_NEAR(json["parameters"][1]["value"].get<double>(), 0.15, 2e-3);
    EXPECT_NEAR(json["parameters"][2]["value"].get<double>(), 20.0, 2e-2);
  }
  EXPECT_THAT(fitted({later})["notes"].dump(), HasSubstr("t = 0.25"));
  expect_refused({"fit", model, later, "--start-time", "1"},
                 {"later.csv", "it begins at t = 0.25, before the start time 1"});
}

TEST(FitCommand, UnevenTimesMoveNoInitialValue) {
  // A first sample, then many close together much later: the way between them is no gap.
  const Records records;
  const std::string model = records.folder().write(
      "decay.ode",
      "param tau = 0.2 in 0.001..10\ndx/dt = -x/tau\ny = x\ninitial x = 1 fixed\n");
  std::string rows = "t,y\n0,1\n";
  for (int i = 0; i < 30; ++i) {
    const double t = 0.1 + 0.002 * i;
    rows += std::to_string(t) + "," + std::to_string(std::exp(-t / 0.1)) + "\n";
  }
  const std::string data = records.folder().write("uneven.csv", rows);
  const auto json = json_of({"fit", model, data});
  EXPECT_NEAR(json["parameters"][0]["value"].get<double>(), 0.1, 1e-4);
  EXPECT_EQ(json["fit"][0]["samples"], 31);
}

TEST(FitCommand, WhatIsLeftOutOfARecordIsNoted) {
  const Records records;
  const std::string model = records.folder().write(
      "driven.ode", "input u\nparam a = 1 in 0.01..10\ndx/dt = -a*x + u\ny = x\n");
  std::string rows = "t,y,u\n";
  for (int i = 0; i < 40; ++i)
    rows += std::to_string(0.1 * i) + "," + std::to_string(std::exp(-0.1 * i)) +
            (i == 3 ? ",\n" : ",0\n");
  const std::string data = records.folder().write("driven.csv", rows);
  const auto result = run_well({"fit", model, data, "--json", "-"});
  EXPECT_THAT(nlohmann::json::parse(result.out)["notes"].dump(),
              HasSubstr("value of 'u' missing, 1 row left out"));
}

TEST(FitCommand, ErrorsAreOneLine) {
  const Records records;
  const std::string model = records.folder().write("m.ode", "dx/dt = -0.5*x\ny = 2*x\n");
  expect_refused({"fit", model, records.oscillator()},
                 {"osc.csv", "no column for the output 'y'", "--map"});
  expect_refused({"fit", model}, {"DATA"});
  for (const char* option : {"--start-samples", "--ahead"})
    expect_refused({"fit", model, records.oscillator(), option, "99999999999999999999999"},
                   {option});
}

/// A decay from 100 of which every value has a deviation, and doses of 50 at 4 and 8.
std::string dosed_record() {
  std::string record = "t,x,sd\n";
  for (int i = 0; i < 60; ++i) {
    const double t = 0.2 * i;
    double x = 100.0 * std::exp(-0.3 * t);
    for (const double dose : {4.1, 8.1})
      if (t > dose) x += 50.0 * std::exp(-0.3 * (t - dose));
    const double sd = i % 2 == 0 ? 0.1 : 3.0;
    record += std::to_string(t) + "," + std::to_string(x + sd * std::sin(37.0 * i)) + "," +
              std::to_string(sd) + "\n";
  }
  return record;
}

TEST(FitCommand, EventsAndDeviationsAreUsed) {
  const Records records;
  const std::string data = records.folder().write("doses.csv", dosed_record());
  const std::string model = records.folder().write(
      "m.ode",
      "param k = 0.5 in 0..\nparam D = 30\ndx/dt = -k*x\nevery 4 from 4.1 until 9: x += D\n");
  const auto json = json_of({"fit", model, data, "--deviation", "x=sd"});
  EXPECT_NEAR(json["parameters"][0]["value"].get<double>(), 0.3, 0.002);
  EXPECT_NEAR(json["parameters"][1]["value"].get<double>(), 50.0, 0.3);
  EXPECT_TRUE(json["log_likelihood"].is_number());
  EXPECT_EQ(json["model"]["events"][0]["every"], 4.0);
  expect_refused({"fit", model, data, "--deviation", "x=error"}, {"deviation of x", "'error'"});
}

TEST(FitCommand, TheLawOfNoiseIsPartOfTheAnswer) {
  const Records records;
  const std::string data = records.folder().write("doses.csv", dosed_record());
  const std::string model = records.folder().write(
      "m.ode",
      "param k = 0.5 in 0..\ndx/dt = -k*x\nevery 4 from 4.1 until 9: x += 50\n"
      "x = x noise proportional below 20\n");
  const auto result = run_well({"fit", model, data});
  EXPECT_THAT(result.out, HasSubstr("proportional noise"));
  EXPECT_THAT(result.out, HasSubstr("log-likelihood"));
}

/// Asks a run to stop as soon as the first answer is on the screen.
class StoppingScreen : public std::stringbuf {
 public:
  explicit StoppingScreen(std::stop_source& stop) : stop_(stop) {}

 private:
  int sync() override {
    if (str().find("First answer") != std::string::npos) stop_.request_stop();
    return 0;
  }

  std::stop_source& stop_;
};

TEST(FitCommand, TheFirstAnswerStaysWhereTheRestIsInterrupted) {
  const Records records;
  const std::string model = records.folder().write(
      "m.ode", "input u [N]\nparam c = 3 in 0..100\ndx/dt = v\ndv/dt = -c*x + 0.8*u\n");
  std::stop_source stop;
  StoppingScreen screen(stop);
  std::ostringstream out;
  std::ostream err(&screen);
  const Registry registry = default_registry();
  const cli::Session session{.registry = registry,
                             .streams = {out, err},
                             .stop = stop.get_token(),
                             .begin = {}};  // long ago: the run takes longer than a moment
  const cli::Command command = cli::declare_fit();
  cli::parse({&command, 1}, {"fit", model, records.oscillator(), "--progress", "always"});
  EXPECT_THROW(command.run(session), Cancelled);
  EXPECT_THAT(screen.str(), HasSubstr("First answer, from the given start"));
  EXPECT_THAT(screen.str(), HasSubstr("c "));
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace lacuna
