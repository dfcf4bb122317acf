// SPDX-License-Identifier: MIT
#include "trajectories/smoother/spectral_lines.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <utility>

#include "lacuna/trajectories/smoother/disturbance_test.hpp"

namespace lacuna {
namespace {

struct Peak {
  SpectralLine line;
  double power = 0.0;
};

/// Next power of two not below four times the samples: the padding resolves a line to a quarter
/// of the record's own resolution.
std::size_t padded(Index samples) {
  std::size_t size = 1;
  while (size < 4 * static_cast<std::size_t>(samples)) size *= 2;
  return size;
}

void sort_by_power(std::vector<Peak>& peaks) {
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.power > b.power; });
}

/// Local maxima of one equation's spectrum, strongest first.
std::vector<Peak> peaks_of(const LinearisedRecord& record, const Vector& disturbance,
                           Index equation) {
  const std::size_t size = padded(disturbance.size());
  std::vector<double> signal(size, 0.0);
  const double mean = disturbance.mean();
  for (Index i = 0; i < disturbance.size(); ++i)
    signal[static_cast<std::size_t>(i)] = disturbance[i] - mean;
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double> transform;
  transform.fwd(spectrum, signal);
  const double step =
      (record.time[record.steps()] - record.time[0]) / static_cast<double>(record.steps());
  const double middle = record.time[0] + 0.5 * step;
  std::vector<Peak> peaks;
  for (std::size_t i = 2; i + 1 < size / 2; ++i) {
    const double power = std::norm(spectrum[i]);
    if (power < std::norm(spectrum[i - 1]) || power <= std::norm(spectrum[i + 1])) continue;
    const double frequency = static_cast<double>(i) / (static_cast<double>(size) * step);
    const double phase = std::arg(spectrum[i]) + 0.5 * std::numbers::pi -
                         2.0 * std::numbers::pi * frequency * middle;
    peaks.push_back(
        {{equation, frequency, std::remainder(phase, 2.0 * std::numbers::pi)}, power});
  }
  sort_by_power(peaks);
  return peaks;
}

std::size_t longest_of(const Assimilation& fit) {
  std::size_t longest = 0;
  for (std::size_t r = 0; r < fit.records.size(); ++r)
    if (fit.records[r].samples() > fit.records[longest].samples()) longest = r;
  return longest;
}

/// A term in the middle of the steps of a record.
Vector in_middles(const LinearisedRecord& record, const Vector& everywhere) {
  Vector values(record.steps());
  for (Index i = 0; i < values.size(); ++i) values[i] = everywhere[record.grid.middle(i)];
  return values;
}

}  // namespace

std::vector<SpectralLine> spectral_lines(const Assimilation& fit, Index count) {
  const std::size_t longest = longest_of(fit);
  const Matrix disturbance = disturbance_along(fit, longest);
  std::vector<Peak> all;
  for (Index k = 0; k < disturbance.cols(); ++k) {
    if (fit.noise.disturbance[k] == 0.0) continue;
    std::vector<Peak> peaks = peaks_of(fit.records[longest], disturbance.col(k), k);
    peaks.resize(std::min(peaks.size(), static_cast<std::size_t>(count)));
    all.insert(all.end(), peaks.begin(), peaks.end());
  }
  sort_by_power(all);
  std::vector<SpectralLine> lines;
  for (const Peak& peak : all) lines.push_back(peak.line);
  return lines;
}

std::vector<ModulationLine> modulation_lines(const Assimilation& fit, Index count) {
  const std::size_t longest = longest_of(fit);
  const LinearisedRecord& record = fit.records[longest];
  const Matrix disturbance = disturbance_along(fit, longest);
  std::vector<ModulationLine> lines;
  for (Index k = 0; k < disturbance.cols(); ++k) {
    if (fit.noise.disturbance[k] == 0.0) continue;
    std::vector<std::pair<double, ModulationLine>> own;
    for (const WeightedTerm& summand : fit.model.equations()[static_cast<std::size_t>(k)]) {
      const Expression& term = summand.term.expression();
      if (term.variables().empty()) continue;
      const Vector m = in_middles(record, evaluate_on(record, fit.model.variables(), term));
      const auto peaks = peaks_of(record, m.cwiseProduct(disturbance.col(k)), k);
      if (!peaks.empty())
        own.push_back({peaks.front().power / m.squaredNorm(), {peaks.front().line, term}});
    }
    std::stable_sort(own.begin(), own.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    own.resize(std::min(own.size(), static_cast<std::size_t>(count)));
    for (auto& [power, line] : own) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace lacuna
