// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {

/// [{"record", "time": [...], "quantities": [{"name", "unit", "value": [...], "stderr", "low",
/// "high", "least", "most"}]}]; null for what is not known.
inline nlohmann::ordered_json bands_json(const std::vector<FitBands>& all) {
  using Node = nlohmann::ordered_json;
  const auto list = [](const Vector& values) {
    Node numbers = Node::array();
    for (const double value : values)
      numbers.push_back(std::isfinite(value) ? Node(value) : Node(nullptr));
    return numbers;
  };
  Node records = Node::array();
  for (const FitBands& run : all) {
    Node quantities = Node::array();
    for (std::size_t c = 0; c < run.quantities.size(); ++c) {
      const auto k = static_cast<Index>(c);
      quantities.push_back({{"name", run.quantities[c].name},
                            {"unit", run.quantities[c].unit},
                            {"value", list(run.value.col(k))},
                            {"stderr", list(run.error.col(k))},
                            {"low", list(run.low.col(k))},
                            {"high", list(run.high.col(k))},
                            {"least", list(run.least.col(k))},
                            {"most", list(run.most.col(k))}});
    }
    records.push_back({{"record", run.record},
                       {"time", list(run.time)},
                       {"quantities", std::move(quantities)}});
  }
  return records;
}

}  // namespace lacuna
