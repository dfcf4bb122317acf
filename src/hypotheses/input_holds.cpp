// SPDX-License-Identifier: MIT
#include "lacuna/hypotheses/input_holds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lacuna/core/parallel.hpp"
#include "lacuna/core/text.hpp"

namespace lacuna {
namespace {

constexpr std::array kHolds{Hold::Zero, Hold::Linear, Hold::Smooth, Hold::Switching};

using Holds = std::vector<std::optional<Hold>>;

bool moves(const Dataset& data, Index input) {
  return std::any_of(data.trajectories.begin(), data.trajectories.end(),
                     [&](const Trajectory& record) {
                       const auto values = record.inputs.col(input);
                       return values.minCoeff() < values.maxCoeff();
                     });
}

Hold shown_hold(const Dataset& data, Index input) {
  const bool held = std::all_of(
      data.trajectories.begin(), data.trajectories.end(), [&](const Trajectory& record) {
        const auto values = record.inputs.col(input);
        return shows_hold(values) || values.minCoeff() == values.maxCoeff();
      });
  return held ? Hold::Zero : Hold::Smooth;
}

/// Deviance of the nominal model under each of kHolds of one input.
std::array<double, kHolds.size()> deviances(const Problem& problem, const Holds& holds,
                                            Index input, const Assimilation& start) {
  AssimilationOptions options;
  options.free = free_coefficients(problem.nominal);
  options.priors = problem.options.tolerances;
  std::array<double, kHolds.size()> result{};
  parallel_for(kHolds.size(), problem.context.threads, [&](std::size_t h) {
    Holds tried = holds;
    tried[static_cast<std::size_t>(input)] = kHolds[h];
    result[h] = assimilate_from(problem.nominal.with_holds(tried), problem.records.data, start,
                                options, problem.context)
                    .deviance;
  });
  return result;
}

std::string meaning(Hold hold) {
  switch (hold) {
    case Hold::Zero:
      return "is held from sample to sample";
    case Hold::Linear:
      return "goes on in straight lines between samples";
    case Hold::Smooth:
      return "is smooth between samples";
    case Hold::Switching:
      return "switches between samples: where it does is not known to less than a step";
  }
  return "";
}

/// The most likely hold, or the shown one where no other is decidedly more likely.
Hold judged(const std::array<double, kHolds.size()>& deviance, Hold shown, double undecided) {
  const auto value = [&](std::size_t h) {
    return std::isfinite(deviance[h]) ? deviance[h] : INFINITY;
  };
  std::size_t best =
      static_cast<std::size_t>(std::find(kHolds.begin(), kHolds.end(), shown) - kHolds.begin());
  double least = value(best) - undecided;
  for (std::size_t h = 0; h < kHolds.size(); ++h)
    if (value(h) < least) {
      best = h;
      least = value(h);
    }
  return kHolds[best];
}

}  // namespace

ChosenHolds choose_holds(const Problem& problem) {
  const auto& [nominal, records, options, context] = problem;
  ChosenHolds chosen{nominal, {}, {}};
  Holds holds;
  std::vector<Index> open;
  for (const Quantity& input : nominal.inputs()) {
    const auto j = static_cast<Index>(holds.size());
    holds.push_back(input.hold);
    if (input.hold || !moves(records.data, j)) continue;
    holds.back() = shown_hold(records.data, j);
    open.push_back(j);
  }
  if (open.empty()) return chosen;
  context.report("how inputs go on between samples", 0.0);
  const Assimilation start =
      assimilate(nominal.with_holds(holds), records.data, records.outliers, {}, context);
  for (const Index j : open) {
    auto& hold = holds[static_cast<std::size_t>(j)];
    const std::string& name = nominal.inputs()[static_cast<std::size_t>(j)].name;
    if (std::isfinite(start.deviance)) {
      const auto deviance = deviances(problem, holds, j, start);
      hold = judged(deviance, *hold, options.decision.undecided);
      for (std::size_t h = 0; h < kHolds.size(); ++h)
        chosen.trail.push_back({"input-hold",
                                name + " " + meaning(kHolds[h]),
                                {},
                                kHolds[h] == *hold,
                                "deviance",
                                deviance[h],
                                *std::min_element(deviance.begin(), deviance.end())});
    }
    if (*hold != Hold::Smooth) chosen.notes.push_back(name + " " + meaning(*hold));
  }
  chosen.model = nominal.with_holds(holds);
  return chosen;
}

}  // namespace lacuna
