// SPDX-License-Identifier: MIT
// What holds for the exports of any model: nothing of a text is read as code by readers of the
// language that are not ours, and what is computed there is what is computed here.
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/text.hpp"
#include "lacuna/model/export/export_model.hpp"
#include "support/hostile_models.hpp"
#include "support/other_programs.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::testing {
namespace {

/// Models that are taken apart by lexers, and how many of them are compiled and run;
/// LACUNA_EXPORTS_RUN=2000 runs all.
constexpr int kModels = 2000;
constexpr const char* kRun = "250";

std::string models_to_run() {
  const char* given = std::getenv("LACUNA_EXPORTS_RUN");
  return given == nullptr ? kRun : given;
}

nlohmann::json as_texts(const Vector& values) {
  nlohmann::json texts = nlohmann::json::array();
  for (const double value : values) texts.push_back(format_number(value));
  return texts;
}

Vector rates_of(const OdeModel& model, double t, const Vector& x, const Vector& u) {
  Vector rate(static_cast<Index>(model.equations().size()));
  model.compile().evaluate(t, x.data(), u.data(), nullptr, rate.data());
  return rate;
}

/// Whether something on the way is a number over 0, which has other values elsewhere.
bool divides_by_zero(const OdeModel& model, double t, const Vector& x, const Vector& u) {
  std::feclearexcept(FE_DIVBYZERO);
  rates_of(model, t, x, u);
  return std::fetestexcept(FE_DIVBYZERO) != 0;
}

/// How much the rates move with the last digits of the time, a state or an input, over these
/// digits.
Vector moved_by_digits(const OdeModel& model, double t, const Vector& x, const Vector& u,
                       const Vector& rate) {
  constexpr double kMove = 1e-12;
  Vector size = Vector::Zero(rate.size());
  const auto add_change = [&](double moved_t, const Vector& moved_x, const Vector& moved_u) {
    size += (rates_of(model, moved_t, moved_x, moved_u) - rate).cwiseAbs() / kMove;
  };
  add_change(t * (1.0 + kMove), x, u);
  for (Index k = 0; k < x.size(); ++k) {
    Vector moved = x;
    moved[k] *= 1.0 + kMove;
    add_change(t, moved, u);
  }
  for (Index k = 0; k < u.size(); ++k) {
    Vector moved = u;
    moved[k] *= 1.0 + kMove;
    add_change(t, x, moved);
  }
  return size;
}

/// How much the rates move when what is computed on the way is rounded the other way, ten times
/// that over the tolerance of the comparison: numbers in a formula may be written as sums.
Vector moved_by_rounding(const OdeModel& model, double t, const Vector& x, const Vector& u,
                         const Vector& rate) {
  constexpr double kTolerance = 1e-12, kTimes = 10.0;
  Vector size = Vector::Zero(rate.size());
  for (const int direction : {FE_UPWARD, FE_DOWNWARD}) {
    std::fesetround(direction);
    const Vector moved = rates_of(model, t, x, u);
    std::fesetround(FE_TONEAREST);
    size += (moved - rate).cwiseAbs() * (kTimes / kTolerance);
  }
  return size;
}

/// What rounding errors are measured from: the sizes of the terms of an equation, and how much
/// it moves with the last digits of what goes in and what is computed on the way.
Vector uncertainty(const OdeModel& model, double t, const Vector& x, const Vector& u,
                   const Vector& rate) {
  Vector size = rate.cwiseAbs() + moved_by_digits(model, t, x, u, rate) +
                moved_by_rounding(model, t, x, u, rate);
  for (std::size_t k = 0; k < model.equations().size(); ++k)
    for (const WeightedTerm& summand : model.equations()[k]) {
      std::vector<Equation> one(model.equations().size());
      one[k] = {summand};
      const auto row = static_cast<Index>(k);
      size[row] += std::abs(rates_of(model.with_equations(one), t, x, u)[row]);
    }
  return size;
}

/// Two places, the first at time 0, with the rates there.
nlohmann::json points(const OdeModel& model, Random& random) {
  nlohmann::json list = nlohmann::json::array();
  for (const double t : {0.0, 0.7}) {
    Vector x(model.dimension()), u(static_cast<Index>(model.inputs().size()));
    for (double& value : x) value = random.uniform(-2.0, 2.0);
    for (double& value : u) value = random.uniform(-2.0, 2.0);
    const Vector rate = rates_of(model, t, x, u);
    list.push_back({{"t", format_number(t)},
                    {"x", as_texts(x)},
                    {"u", as_texts(u)},
                    {"rate", as_texts(rate)},
                    {"divides_by_zero", divides_by_zero(model, t, x, u)},
                    {"size", as_texts(uncertainty(model, t, x, u, rate))}});
  }
  return list;
}

/// Writes 0.FORMAT, 1.FORMAT, ... and models.json, what the models say.
void write_exports(const TemporaryFolder& place, const std::string& format) {
  Random random(44);
  nlohmann::json models = nlohmann::json::array();
  for (int k = 0; k < kModels; ++k) {
    const OdeModel model = hostile_model(random);
    place.write(std::to_string(k) + "." + format, export_model(model, format));
    models.push_back({{"states", model.states().size()},
                      {"inputs", model.inputs().size()},
                      {"points", points(model, random)}});
  }
  place.write("models.json", models.dump());
}

class ExportProperties : public ::testing::TestWithParam<std::string> {};

/// What a language is read by, beside a python with Pygments.
std::string missing_program(const std::string& format) {
  const std::vector<std::pair<std::string, std::string>> programs = {
      {"c", "cc --version"},
      {"cpp", "c++ --version"},
      {"latex", "pdflatex --version"},
      {"matlab", "octave-cli --version"},
      {"python", "true"},
      {"modelica", "true"},
      {"spice", "ngspice --version"}};
  for (const auto& [name, call] : programs)
    if (name == format && !can_run(call)) return call;
  return "";
}

TEST_P(ExportProperties, OfRandomModelsHold) {
  const std::string python = python_with("numpy, pygments");
  if (python.empty()) GTEST_SKIP() << "there is no python with NumPy and Pygments";
  const std::string missing = missing_program(GetParam());
  if (!missing.empty()) GTEST_SKIP() << "this does not run: " << missing;
  const TemporaryFolder place;
  write_exports(place, GetParam());
  const std::string call = python + " " LACUNA_SOURCE_DIR "/tests/exports/check.py " +
                           GetParam() + " " + place.file("") + " " + models_to_run();
  EXPECT_EQ(std::system(call.c_str()), 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, ExportProperties, ::testing::ValuesIn(export_formats()),
                         [](const auto& format) { return format.param; });

}  // namespace
}  // namespace lacuna::testing
