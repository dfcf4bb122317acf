// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "readable.hpp"
#include "run_figures.hpp"

namespace lacuna {
namespace {

constexpr std::size_t kMostPictures = 6;  // further quantities are in the JSON

/// Both ends of a band as one curve with a gap between them.
Series ends_of(const std::string& label, const Vector& time, const Vector& low,
               const Vector& high, Curve curve) {
  const Index n = time.size();
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  Series series{label, Vector(2 * n + 1), Vector(2 * n + 1), curve};
  series.x << time, time[n - 1], time;
  series.y << low, kGap, high;
  return series;
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
  const auto longest = std::max_element(
      runs.begin(), runs.end(),
      [](const auto& a, const auto& b) { return a.time.size() < b.time.size(); });
  std::vector<Picture> pictures;
  if (longest == runs.end()) return pictures;
  const auto record = static_cast<std::size_t>(longest - runs.begin());
  for (const std::size_t c : shown(*longest)) {
    const auto k = static_cast<Index>(c);
    const Quantity& quantity = longest->quantities[c];
    const std::string label = with_unit(quantity.name, quantity.unit);
    LineFigure figure{name + "_" + quantity.name,
                      label + " with 90 % bands, " + short_name(longest->record),
                      with_unit("time", time_unit),
                      label,
                      {}};
    if (longest->least.col(k).array().isFinite().any())
      figure.series.push_back(ends_of("90 % of measured values", longest->time,
                                      longest->least.col(k), longest->most.col(k),
                                      Curve::Other));
    figure.series.push_back(ends_of("90 % band of the run", longest->time, longest->low.col(k),
                                    longest->high.col(k), Curve::Before));
    figure.series.push_back({"run", longest->time, longest->value.col(k), Curve::Model});
    for (std::size_t i = 0; record < measured.size() && i < channels.size(); ++i)
      if (channels[i].channel == quantity.name)
        figure.series.push_back({"measured", measured[record].time,
                                 measured[record].measured.col(static_cast<Index>(i)),
                                 Curve::Measured, true});
    pictures.push_back(draw(figure));
  }
  return pictures;
}

}  // namespace lacuna
