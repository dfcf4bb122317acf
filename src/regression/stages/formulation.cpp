// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/formulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/base/parallel.hpp"
#include "core/base/text.hpp"

namespace lacuna {
namespace {

std::string state_place(const Dataset& data, Index state) {
  return "state '" + data.states[static_cast<std::size_t>(state)].name + "'";
}

void check_variables(const Dataset& data, const Variables& variables) {
  const auto same = [](const std::vector<Quantity>& quantities,
                       const std::vector<std::string>& names) {
    return std::equal(
        quantities.begin(), quantities.end(), names.begin(), names.end(),
        [](const Quantity& q, const std::string& name) { return q.name == name; });
  };
  if (same(data.states, variables.states) && same(data.inputs, variables.inputs)) return;
  throw ArgumentError("formulation",
                      "the term library is made for other variables than the data",
                      "make it for the states and inputs of the dataset");
}

/// Whether values differ by no more than rounding of their own size.
bool is_constant(double low, double high) {
  // A fact of rounding.
  constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
  return high - low <= kRounding * std::max(std::abs(low), std::abs(high));
}

void check_state_varies(const Dataset& data, Index state) {
  constexpr Index kTogether = 4096;  // a fact of cost: most states are seen to vary in so many
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Trajectory& trajectory : data.trajectories) {
    const auto values = trajectory.states.col(state);
    for (Index first = 0; first < values.size(); first += kTogether) {
      const auto some = values.segment(first, std::min(kTogether, values.size() - first));
      low = std::min(low, some.minCoeff());
      high = std::max(high, some.maxCoeff());
      if (!is_constant(low, high)) return;
    }
  }
  throw DataError(state_place(data, state),
                  "is constant (" + format_number(low, 6) + ") in all " +
                      std::to_string(data.samples()) + " samples",
                  "leave it out with --states or check the sensor");
}

/// Whether dx/dt is zero at every sample: as given, or because no record shows a change.
bool rate_is_zero(const Dataset& data, Index state) {
  return std::all_of(
      data.trajectories.begin(), data.trajectories.end(), [&](const Trajectory& t) {
        if (t.has_derivatives()) return (t.derivatives.col(state).array() == 0.0).all();
        return is_constant(t.states.col(state).minCoeff(), t.states.col(state).maxCoeff());
      });
}

void check_state_moves(const Dataset& data, Index state) {
  if (data.rate_state(state) || !rate_is_zero(data, state)) return;
  const std::string& name = data.states[static_cast<std::size_t>(state)].name;
  throw DataError(state_place(data, state), "its derivative is zero throughout",
                  "give '" + name + "' as an input, leave it out, or check the derivatives");
}

/// Rows are combinations of the samples, so neither may be fewer than the terms.
void check_count(const Dataset& data, Index count, const std::string& what, Index terms) {
  if (count >= terms) return;
  throw DataError(data.trajectories.size() == 1 ? data.trajectories[0].source : "data",
                  std::to_string(count) + " " + what + " do not determine " +
                      std::to_string(terms) + " candidate terms",
                  "give a longer record or fewer terms, e.g. a lower degree");
}

/// @throws ConfigError where records are read in pieces.
void check_in_memory(const RecordStream& records, const std::string& who) {
  if (records.in_memory()) return;
  throw ConfigError(who, "it needs the records in memory, and these are read in pieces",
                    "leave out --memory, or choose --set formulation=strong");
}

}  // namespace

LeastSquaresSystem Formulation::assemble(const RecordStream& records,
                                         const TermLibrary& library,
                                         const RunContext& context) const {
  const bool is_map = evolution() == Evolution::Map;
  if (is_map) check_in_memory(records, "a map");
  const Dataset& data = records.in_memory() ? *records.in_memory() : records.excerpt();
  const bool in_pieces = records.is_long() && !is_map;
  check_form(data);
  if (!in_pieces) check_finite(data, context.threads);
  check_variables(data, library.variables);
  parallel_for(data.states.size(), context.threads, [&](std::size_t k) {
    check_state_varies(data, static_cast<Index>(k));
    check_state_moves(data, static_cast<Index>(k));
  });
  check_count(data, data.samples(), "samples",
              library.size());  // before L x L numbers are made
  context.check_stop();
  LeastSquaresSystem system =
      in_pieces ? do_assemble_long(records, library, context)
                : do_assemble(is_map ? data : records.excerpt(), library, context);
  check_count(data, system.rows(), "rows", system.terms());
  return system;
}

LeastSquaresSystem Formulation::do_assemble_long(const RecordStream& records,
                                                 const TermLibrary& library,
                                                 const RunContext& context) const {
  check_in_memory(records, "formulation " + std::string(info().name));
  check_finite(*records.in_memory(), context.threads);
  return do_assemble(*records.in_memory(), library, context);
}

std::optional<Vector> Formulation::target_noise(const Dataset& data,
                                                const Vector& state_noise) const {
  check_dataset(data);
  const bool usable = state_noise.size() == data.state_count() && state_noise.allFinite() &&
                      (state_noise.array() >= 0.0).all();
  if (!usable)
    throw ArgumentError("target noise", "the noise of the states is not one number per state",
                        "give one finite standard deviation, 0 or more, for each state");
  const bool given = std::any_of(data.trajectories.begin(), data.trajectories.end(),
                                 [](const Trajectory& t) { return t.has_derivatives(); });
  if (given) return std::nullopt;
  return do_target_noise(data, state_noise);
}

Stage<Formulation> fitted_to(const Stage<Formulation>& form, const Dataset& data,
                             const std::optional<Vector>& noise) {
  check_form(data);
  // The samples of a map show no noise: none is known of any state.
  if (noise && noise->size() > 0 && noise->size() != data.state_count())
    throw ArgumentError("formulation", "the noise is not one number per state",
                        "give one standard deviation for each state");
  auto fitted = form->do_fit(data, noise);
  return fitted ? Stage<Formulation>(std::move(fitted)) : form;
}

}  // namespace lacuna
