// SPDX-License-Identifier: MIT
#include <algorithm>

#include "readable.hpp"
#include "run_figures.hpp"

namespace lacuna {
namespace {

constexpr std::size_t kMostPictures = 6;  // further quantities are in the JSON

/// All runs as one with gaps between them.
FitBands joined(const std::vector<FitBands>& runs) {
  FitBands all = runs.front();
  if (runs.size() == 1) return all;
  const auto part = [&](const Matrix FitBands::*member) {
    std::vector<Matrix> parts;
    for (const FitBands& run : runs) parts.push_back(run.*member);
    return stacked(parts);
  };
  std::vector<Matrix> times;
  for (const FitBands& run : runs) times.emplace_back(run.time);
  all.record = std::to_string(runs.size()) + " records";
  all.time = stacked(times);
  all.value = part(&FitBands::value);
  all.low = part(&FitBands::low);
  all.high = part(&FitBands::high);
  all.least = part(&FitBands::least);
  all.most = part(&FitBands::most);
  return all;
}

/// The measured values of one channel in all records.
Series measured_series(const std::vector<FitRun>& records, std::size_t channel) {
  std::vector<Matrix> times, values;
  for (const FitRun& record : records) {
    times.emplace_back(record.time);
    values.emplace_back(record.measured.col(static_cast<Index>(channel)));
  }
  return {"measured", stacked(times), stacked(values), Curve::Measured, true};
}

/// Quantities in the order in which they are shown: measured ones first.
std::vector<std::size_t> shown(const FitBands& run) {
  std::vector<std::size_t> places;
  for (std::size_t c = 0; c < run.quantities.size(); ++c) places.push_back(c);
  std::stable_partition(places.begin(), places.end(), [&](std::size_t c) {
    return run.least.col(static_cast<Index>(c)).array().isFinite().any();
  });
  places.resize(std::min(places.size(), kMostPictures));
  return places;
}

}  // namespace

std::vector<Picture> band_pictures(const std::string& name, const std::vector<FitBands>& runs,
                                   const std::vector<FitRun>& measured,
                                   const std::vector<FitQuality>& channels,
                                   const std::string& time_unit) {
  std::vector<Picture> pictures;
  if (runs.empty()) return pictures;
  const FitBands all = joined(runs);
  for (const std::size_t c : shown(all)) {
    const auto k = static_cast<Index>(c);
    const Quantity& quantity = all.quantities[c];
    const std::string label = with_unit(quantity.name, quantity.unit);
    LineFigure figure{name + "_" + quantity.name,
                      label + " with 90 % bands, " + short_name(all.record),
                      with_unit("time", time_unit),
                      label,
                      {}};
    if (all.least.col(k).array().isFinite().any())
      figure.series.push_back(ends_of("90 % of measured values", all.time, all.least.col(k),
                                      all.most.col(k), Curve::Other));
    figure.series.push_back(ends_of("90 % band of the run", all.time, all.low.col(k),
                                    all.high.col(k), Curve::Before));
    figure.series.push_back({"run", all.time, all.value.col(k), Curve::Model});
    for (std::size_t i = 0; !measured.empty() && i < channels.size(); ++i)
      if (channels[i].channel == quantity.name)
        figure.series.push_back(measured_series(measured, i));
    pictures.push_back(draw(figure));
  }
  return pictures;
}

}  // namespace lacuna
