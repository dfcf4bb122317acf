// SPDX-License-Identifier: MIT
#include "diagnose/journey/locate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numerics/least_squares.hpp"
#include "trajectories/smoother/innovation_system.hpp"
#include "trajectories/smoother/spectral_lines.hpp"

namespace lacuna {
namespace {

constexpr Index kBins = 10;

/// Edges between the deciles of one variable over all records.
Vector decile_edges(const Assimilation& fit, Index slot) {
  std::vector<double> all;
  for (const LinearisedRecord& record : fit.records)
    for (Index i = 0; i < record.slots.rows(); i += record.grid.stride)
      all.push_back(record.slots(i, slot));
  std::sort(all.begin(), all.end());
  Vector edges(kBins + 1);
  for (Index i = 0; i <= kBins; ++i)
    edges[i] = all[static_cast<std::size_t>(i) * (all.size() - 1) / kBins];
  return edges;
}

/// Columns of a constant rate in each bin.
Matrix bin_columns(const Assimilation& fit, const InnovationSystem& system, Index equation,
                   Index slot, const Vector& edges) {
  std::vector<Matrix> values;
  for (const LinearisedRecord& record : fit.records) {
    const auto x = record.slots.col(slot).array();
    values.emplace_back(x.size(), kBins);
    for (Index bin = 0; bin < kBins; ++bin) {
      const double end =
          bin + 1 == kBins ? std::nextafter(edges[kBins], INFINITY) : edges[bin + 1];
      values.back().col(bin) = (x >= edges[bin] && x < end).cast<double>();
    }
  }
  return system.rate_columns(equation, values);
}

/// The range of deciles, not all of them, in which a constant rate explains most.
Location best_range(const Matrix& columns, const Vector& innovations, const Vector& edges) {
  const Matrix gram = columns.transpose() * columns;
  const Vector inner = columns.transpose() * innovations;
  Location best;
  for (Index first = 0; first < kBins; ++first)
    for (Index count = 1; count < kBins && first + count <= kBins; ++count) {
      const double length = gram.block(first, first, count, count).sum();
      const double sum = inner.segment(first, count).sum();
      const double sigma = length > 0.0 ? std::abs(sum) / std::sqrt(length) : 0.0;
      if (sigma > best.sigma) best = {"", edges[first], edges[first + count], {}, sigma};
    }
  return best;
}

/// A line of the spectrum as a place; sine and cosine both fit.
Location line_location(const Assimilation& fit, const InnovationSystem& system,
                       const SpectralLine& line) {
  std::vector<Matrix> values;
  for (const LinearisedRecord& record : fit.records) {
    const auto angle = (2.0 * std::numbers::pi * line.frequency) *
                       record.slots.col(record.slots.cols() - 1).array();
    values.emplace_back(angle.size(), 2);
    values.back().col(0) = angle.sin();
    values.back().col(1) = angle.cos();
  }
  const Matrix columns = system.rate_columns(line.equation, values);
  const Vector inner = columns.transpose() * system.innovations();
  const Vector solved = solve_symmetric(columns.transpose() * columns, inner);
  const double gain = solved.dot(inner);
  return {"", 0.0, 0.0, line.frequency, gain > 0.0 ? std::sqrt(gain) : 0.0};
}

std::vector<Location> locations(const Assimilation& fit, const InnovationSystem& system,
                                Index equation, const std::vector<SpectralLine>& lines) {
  std::vector<Location> result;
  const std::vector<std::string> names = fit.model.variables().names();
  for (std::size_t slot = 0; slot < names.size(); ++slot) {
    const Vector edges = decile_edges(fit, static_cast<Index>(slot));
    const Matrix columns = bin_columns(fit, system, equation, static_cast<Index>(slot), edges);
    result.push_back(best_range(columns, system.innovations(), edges));
    result.back().variable = names[slot];
  }
  for (const SpectralLine& line : lines)
    if (line.equation == equation) result.push_back(line_location(fit, system, line));
  std::stable_sort(result.begin(), result.end(),
                   [](const Location& a, const Location& b) { return a.sigma > b.sigma; });
  return result;
}

}  // namespace

std::vector<Disagreement> locate(const Assimilation& fit, const RunContext& context) {
  const InnovationSystem system(fit);
  const std::vector<SpectralLine> lines = spectral_lines(fit, 1);
  std::vector<Disagreement> result;
  double total = 0.0;
  for (const EquationStructure& structure : test_disturbances(fit, context)) {
    context.report("locating the disagreement", 0.5);
    total += structure.drop;
    result.push_back({structure.equation, structure.rms,
                      structure.rms / std::max(structure.sigma, 1.0), structure.sigma,
                      structure.drop, structure.relative,
                      locations(fit, system, structure.equation, lines)});
  }
  for (Disagreement& equation : result)
    equation.fraction = total > 0.0 ? equation.fraction / total : 0.0;
  return result;
}

}  // namespace lacuna
