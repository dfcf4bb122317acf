// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"
#include "folded_text.hpp"
#include "readable.hpp"
#include "records/channels/channel_noise.hpp"
#include "report/pages/pages.hpp"
#include "report/plot/mathml.hpp"
#include "run_figures.hpp"

namespace lacuna {
namespace {

/// All records as one with gaps between them; none where there is none.
std::vector<GapRecord> runs_of(const Fit& fit) {
  if (fit.runs.empty()) return {};
  std::vector<Matrix> times, measured, model;
  for (const FitRun& run : fit.runs) {
    times.emplace_back(run.time);
    measured.push_back(run.measured);
    model.push_back(run.model);
  }
  const std::string name = fit.runs.size() == 1 ? fit.runs.front().record
                                                : std::to_string(fit.runs.size()) + " records";
  const Vector time = stacked(times);
  return {{name, time, stacked(measured), Matrix(), stacked(model), 0, time.size()}};
}

/// The deviation of each value by the law of its channel; empty where no law has one that depends
/// on the value.
Matrix deviations_of(const Fit& fit, const Matrix& model) {
  const auto varies = [](const FitQuality& quality) {
    return quality.law && quality.law->form != NoiseForm::Constant &&
           quality.law->form != NoiseForm::Student;
  };
  if (std::none_of(fit.quality.begin(), fit.quality.end(), varies)) return {};
  Matrix all = Matrix::Constant(model.rows(), model.cols(),
                                std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < fit.quality.size(); ++c) {
    if (!varies(fit.quality[c])) continue;
    const auto k = static_cast<Index>(c);
    for (Index i = 0; i < model.rows(); ++i)
      if (const double y = model(i, k); std::isfinite(y))
        all(i, k) = ChannelNoise(*fit.quality[c].law, 1.0, Vector::Constant(1, y)).deviation(y);
  }
  return all;
}

/// The spread of a number over the records, of its logarithm where it varies by a factor.
std::vector<std::string> spread_row(const FittedParameter& number) {
  const FittedSpread& spread = *number.spread;
  const std::string name =
      (spread.by_factor ? "spread of log " : "spread of ") + number.name;
  const std::string limits =
      spread.ci95      ? "[" + format_number((*spread.ci95)[0], 5) + ", " +
                             format_number((*spread.ci95)[1], 5) + "]"
      : spread.at_most ? "at most " + format_number(*spread.at_most, 3)
                       : "not determined by itself";
  return {name, format_number(spread.start, 5), format_number(spread.value, 6), limits,
          spread.by_factor ? "" : number.unit};
}

PageSection numbers_section(const Fit& fit) {
  std::vector<std::vector<std::string>> rows;
  for (const FittedParameter& number : fit.numbers)
    rows.push_back({number.name, format_number(number.start, 5), format_number(number.value, 6),
                    number.ci95 ? "[" + format_number((*number.ci95)[0], 5) + ", " +
                                      format_number((*number.ci95)[1], 5) + "]"
                    : number.bound ? "at the " + *number.bound + " of its range"
                                   : "not determined by itself",
                    number.unit});
  for (const FittedParameter& number : fit.numbers)
    if (number.spread)
      rows.push_back(spread_row(number));
  std::vector<std::string> sentences;
  for (const FitCombination& combination : fit.combinations)
    sentences.push_back(combination.message);
  return {"Numbers", table({"number", "start", "estimate", "95 % interval", "unit"}, rows) +
                         bullets(sentences)};
}

}  // namespace

Page fit_page(const Fit& fit) {
  Page page;
  page.title =
      "Fit of " + (fit.records.empty()       ? std::string("a model")
                   : fit.records.size() == 1 ? short_name(fit.records.front())
                                             : std::to_string(fit.records.size()) + " records");
  for (const FitQuality& quality : fit.quality) {
    page.facts.push_back({"Fit of " + quality.channel,
                          std::isfinite(quality.fit_percent)
                              ? format_number(quality.fit_percent, 4) + " %"
                              : "not determined",
                          "free run, rmse " + format_number(quality.rmse, 4) +
                              (quality.unit.empty() ? "" : " " + quality.unit)});
  }
  const FitStanding standing = standing_of(fit);
  page.headline = sentence_of(standing);
  page.tone = !standing.converged   ? Tone::Bad
              : standing.is_sound() ? Tone::Good
                                    : Tone::Doubtful;
  page.findings = said_once(fit.notes);
  page.equations = equations_mathml(fit.model.model());
  page.sections.push_back(numbers_section(fit));
  const std::vector<GapRecord> runs = runs_of(fit);
  const std::string& time_unit = fit.model.symbolic().time_unit();
  if (!fit.bands.empty())
    page.sections.push_back(
        {"Bands", {}, band_pictures("bands", fit.bands, fit.runs, fit.quality, time_unit)});
  if (!fit.predicted.empty())
    page.sections.push_back(
        {"Prediction", {}, band_pictures("predicted", fit.predicted, {}, {}, time_unit)});
  if (runs.empty()) return page;
  std::vector<Quantity> channels;
  Vector noise(static_cast<Index>(fit.quality.size()));
  for (std::size_t c = 0; c < fit.quality.size(); ++c) {
    channels.push_back({fit.quality[c].channel, fit.quality[c].unit});
    noise[static_cast<Index>(c)] = fit.quality[c].noise;
  }
  const RunView view{runs, channels, fit.model.symbolic().time_unit(), noise, "", "free run",
                     deviations_of(fit, runs.front().after)};
  page.sections.push_back({"Record and free run", {}, comparison_pictures(view)});
  page.sections.push_back({"What the free run is off", {}, deviation_pictures(view)});
  return page;
}

}  // namespace lacuna
