// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/attractor/comparison.hpp"

#include <cmath>

#include "data/records/number_range.hpp"
#include "dynamics/attractor/density_distance.hpp"
#include "dynamics/attractor/extents.hpp"
#include "dynamics/attractor/power_spectrum.hpp"
#include "dynamics/attractor/rosenstein.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/core/statistics/interval.hpp"

namespace lacuna {
namespace {

/// A fact of the interval: few blocks, so that each is longer than the attractor's memory;
/// Student's t pays for their number.
constexpr Index kParts = 5;

/// A mean with half of its 95 % interval.
struct Estimate {
  double mean = 0.0, half = 0.0;
};

Estimate estimate_of(const std::vector<double>& values) {
  const Eigen::Map<const Vector> all(values.data(), static_cast<Index>(values.size()));
  const double n = static_cast<double>(values.size()), mean = all.mean();
  const double deviation = std::sqrt((all.array() - mean).square().sum() / (n - 1.0));
  return {mean, student_quantile_975(n - 1.0) * deviation / std::sqrt(n)};
}

/// The longest record in blocks.
std::vector<Trajectory> blocks_of(const Dataset& data) {
  const Trajectory& record = longest_record(data);
  std::vector<Trajectory> blocks;
  for (Index i = 0; i < kParts; ++i) {
    const Index begin = i * record.samples() / kParts;
    blocks.push_back(rows_of(record, begin, (i + 1) * record.samples() / kParts - begin));
  }
  return blocks;
}

using Blocks = std::vector<Trajectory>;
using Distance = FunctionRef<double(const Trajectory&, const Trajectory&)>;

/// Holds a difference against both intervals, where all of them are numbers.
AttractorMeasure judged(AttractorMeasure measure, double difference) {
  const double allowed = std::hypot(measure.first_half, measure.second_half);
  if (std::isfinite(difference) && std::isfinite(allowed))
    measure.agree = difference <= allowed;
  else
    measure.note = "the values are beyond the range of numbers";
  return measure;
}

/// Distances of neighbouring blocks of one record, and of blocks of different records.
AttractorMeasure distance_measure(std::string name, const Blocks& a, const Blocks& b,
                                  Distance distance, const RunContext& context) {
  std::vector<double> within, between;
  for (std::size_t i = 0; i < a.size(); ++i) {
    context.check_stop();
    between.push_back(distance(a[i], b[i]));
    if (i == 0) continue;
    within.push_back(distance(a[i - 1], a[i]));
    within.push_back(distance(b[i - 1], b[i]));
  }
  const Estimate own = estimate_of(within), other = estimate_of(between);
  return judged({std::move(name), "", own.mean, other.mean, own.half, other.half},
                other.mean - own.mean);
}

/// A measure that the deadline may leave out.
template <class Make>
AttractorMeasure in_time(const std::string& name, Make make) {
  try {
    return make();
  } catch (const OutOfTime&) {
    return {.name = name, .note = kTimeIsUp, .left_out = true};
  }
}

/// One that may be out of reach of a record, too; its message then stands in the note.
template <class Make>
AttractorMeasure if_possible(const std::string& name, Make make) {
  try {
    return in_time(name, make);
  } catch (const ArgumentError& error) {
    return {.name = name, .note = error.what()};
  }
}

AttractorMeasure compared(std::string name, std::string unit, const Estimate& a,
                          const Estimate& b) {
  return judged({std::move(name), std::move(unit), a.mean, b.mean, a.half, b.half},
                std::abs(a.mean - b.mean));
}

Estimate exponent_of(const Blocks& blocks, const RunContext& context) {
  std::vector<double> exponents;
  for (const Trajectory& block : blocks)
    exponents.push_back(rosenstein_divergence(block, kDivergenceReferences, context).exponent);
  return estimate_of(exponents);
}

void check_alike(const Dataset& a, const Dataset& b) {
  bool alike = a.states.size() == b.states.size();
  for (std::size_t k = 0; alike && k < a.states.size(); ++k)
    alike = a.states[k].name == b.states[k].name;
  if (!alike)
    throw ArgumentError("records to compare", "their states are not the same",
                        "give both the same columns (--states, --map)");
}

}  // namespace

std::vector<AttractorMeasure> compare_attractors(const Dataset& a, const Dataset& b,
                                                 const RunContext& context) {
  check_alike(a, b);
  check_number_range(a);
  check_number_range(b);
  context.report("comparing", 0.0);
  std::vector<AttractorMeasure> measures;
  const AttractorExtents first = attractor_extents(a, kParts);
  const AttractorExtents second = attractor_extents(b, kParts);
  for (std::size_t k = 0; k < a.states.size(); ++k) {
    const auto i = static_cast<Index>(k);
    measures.push_back(compared("extent of " + a.states[k].name, a.states[k].unit,
                                {first.size[i], first.half_width[i]},
                                {second.size[i], second.half_width[i]}));
  }
  const Blocks in_a = blocks_of(a), in_b = blocks_of(b);
  measures.push_back(if_possible("spectrum", [&] {
    return distance_measure(
        "spectrum", in_a, in_b,
        [](const auto& x, const auto& y) { return power_spectrum_distance(x, y, 4); }, context);
  }));
  measures.push_back(in_time("density", [&] {
    return distance_measure(
        "density", in_a, in_b,
        [](const auto& x, const auto& y) { return density_distance(x.states, y.states); },
        context);
  }));
  measures.push_back(if_possible("Lyapunov exponent", [&] {
    return compared("Lyapunov exponent", "1/" + a.time_unit, exponent_of(in_a, context),
                    exponent_of(in_b, context));
  }));
  return measures;
}

}  // namespace lacuna
