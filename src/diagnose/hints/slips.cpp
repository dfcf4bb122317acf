// SPDX-License-Identifier: MIT
#include "slips.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna {
namespace {

/// 10, 0.1, 100, 0.01, ... 10^n, 10^-n.
std::vector<double> powers_of_ten(int n) {
  std::vector<double> factors;
  for (int k = 1; k <= n; ++k) {
    factors.push_back(std::pow(10.0, k));
    factors.push_back(std::pow(10.0, -k));
  }
  return factors;
}

void append_with_inverse(std::vector<double>& factors, std::initializer_list<double> more) {
  for (const double factor : more) {
    factors.push_back(factor);
    factors.push_back(1.0 / factor);
  }
}

/// Units of time: decimal ones, minutes, hours, days.
std::vector<double> time_factors() {
  std::vector<double> factors = powers_of_ten(9);
  append_with_inverse(factors, {60.0, 3600.0, 86400.0});
  return factors;
}

/// Decimal prefixes, degrees, turns, turns per minute.
std::vector<double> channel_factors() {
  std::vector<double> factors = powers_of_ten(6);
  append_with_inverse(
      factors, {180.0 / std::numbers::pi, 2.0 * std::numbers::pi, 30.0 / std::numbers::pi});
  return factors;
}

/// A measured state and the measured ones that the model's identities derive from it.
std::vector<Index> chain_from(const OdeModel& model, const Dataset& data, Index state) {
  std::vector<Index> chain{state};
  for (auto next = identity_of(model, state); next; next = identity_of(model, *next)) {
    if (std::find(chain.begin(), chain.end(), *next) != chain.end()) break;
    if (!data.is_measured(*next)) break;
    chain.push_back(*next);
  }
  return chain;
}

bool is_derived_from(const OdeModel& model, const Dataset& data, Index state) {
  const auto rate = identity_of(model, state);
  return rate && !data.is_measured(*rate);
}

using Groups = std::vector<std::vector<Index>>;

Groups scaled_groups(const OdeModel& model, const Dataset& data) {
  Groups groups;
  std::vector<Index> states;
  for (Index k = 0; k < model.dimension(); ++k)
    if (data.is_measured(k)) states.push_back(k);
  for (const Index k : states) groups.push_back({k});
  for (Index k = 0; k < data.input_count(); ++k) groups.push_back({model.dimension() + k});
  for (const Index k : states) {
    std::vector<Index> chain = chain_from(model, data, k);
    std::sort(chain.begin(), chain.end());
    if (chain.size() > 1 && std::find(groups.begin(), groups.end(), chain) == groups.end())
      groups.push_back(std::move(chain));
  }
  if (std::find(groups.begin(), groups.end(), states) == groups.end())
    groups.push_back(std::move(states));
  return groups;
}

auto column_of(Trajectory& record, Index channel) {
  const Index states = record.states.cols();
  return channel < states ? record.states.col(channel) : record.inputs.col(channel - states);
}

/// What each channel is multiplied by, with states that follow from others.
Vector channel_corrections(const OdeModel& model, const Dataset& data, const Slip& slip) {
  Vector factors = Vector::Ones(data.state_count() + data.input_count());
  for (const Index channel : slip.channels) factors[channel] = slip.correction;
  const double time = slip.kind == HintKind::TimeUnit ? slip.correction : 1.0;
  // As often as there are states: a chain may run against their order.
  for (Index pass = 0; pass < model.dimension(); ++pass)
    for (Index k = 0; k < model.dimension(); ++k) {
      const auto rate = identity_of(model, k);
      if (rate && !data.is_measured(*rate)) factors[*rate] = factors[k] / time;
    }
  return factors;
}

}  // namespace

std::vector<Slip> possible_slips(const OdeModel& model, const Dataset& data) {
  std::vector<Slip> slips;
  for (const double factor : time_factors()) slips.push_back({HintKind::TimeUnit, {}, factor});
  for (const std::vector<Index>& group : scaled_groups(model, data)) {
    for (const double factor : channel_factors())
      slips.push_back({HintKind::ChannelUnit, group, factor});
    slips.push_back({HintKind::Sign, group, -1.0});
  }
  std::vector<Index> columns;
  for (Index k = 0; k < model.dimension(); ++k)
    if (data.is_measured(k) && !is_derived_from(model, data, k)) columns.push_back(k);
  for (Index k = 0; k < data.input_count(); ++k) columns.push_back(model.dimension() + k);
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = i + 1; j < columns.size(); ++j)
      slips.push_back({HintKind::SwappedColumns, {columns[i], columns[j]}});
  return slips;
}

Dataset corrected(const OdeModel& model, Dataset data, const Slip& slip) {
  if (slip.kind == HintKind::SwappedColumns) {
    for (Trajectory& record : data.trajectories)
      column_of(record, slip.channels[0]).swap(column_of(record, slip.channels[1]));
    return data;
  }
  const Vector factors = channel_corrections(model, data, slip);
  for (Trajectory& record : data.trajectories) {
    if (slip.kind == HintKind::TimeUnit) record.time *= slip.correction;
    for (Index channel = 0; channel < factors.size(); ++channel)
      column_of(record, channel) *= factors[channel];
  }
  return data;
}

std::optional<CoefficientFactor> as_coefficient(const OdeModel& model, const Slip& slip) {
  if (slip.kind == HintKind::SwappedColumns) return std::nullopt;
  Vector factors = Vector::Ones(model.dimension() + static_cast<Index>(model.inputs().size()));
  for (const Index channel : slip.channels) factors[channel] = slip.correction;
  const double time = slip.kind == HintKind::TimeUnit ? slip.correction : 1.0;
  std::optional<CoefficientFactor> found;
  for (Index k = 0; k < model.dimension(); ++k) {
    const Equation& terms = model.equations()[static_cast<std::size_t>(k)];
    for (std::size_t j = 0; j < terms.size(); ++j) {
      const auto& exponents = terms[j].term.exponents();
      if (!exponents) return std::nullopt;
      double factor = time / factors[k];
      for (Index i = 0; i < factors.size(); ++i)
        factor *= std::pow(factors[i], (*exponents)[static_cast<std::size_t>(i)]);
      if (std::abs(factor - 1.0) < 1e-9) continue;
      if (found || identity_of(model, k)) return std::nullopt;
      found = CoefficientFactor{k, static_cast<Index>(j), factor};
    }
  }
  return found;
}

const std::string& channel_name(const OdeModel& model, Index channel) {
  const auto place = static_cast<std::size_t>(channel);
  const std::size_t states = model.states().size();
  return place < states ? model.states()[place].name : model.inputs()[place - states].name;
}

}  // namespace lacuna
