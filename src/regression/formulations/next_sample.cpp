// SPDX-License-Identifier: MIT
#include "regression/formulations/next_sample.hpp"

#include <algorithm>

#include "lacuna/model/equations/ode_model.hpp"
#include "non_finite_error.hpp"
#include "regression/formulations/library_rows.hpp"

namespace lacuna {
namespace {

void check_no_rates(const Dataset& data) {
  const bool identities =
      std::any_of(data.rate_of.begin(), data.rate_of.end(),
                  [](const std::optional<Index>& rate) { return rate.has_value(); });
  const bool given = std::any_of(data.trajectories.begin(), data.trajectories.end(),
                                 [](const Trajectory& t) { return t.has_derivatives(); });
  if (!identities && !given) return;
  throw DataError("data", "a map has no derivatives, and these records bring some",
                  "leave out --derivatives and --embed, or identify a flow");
}

void check_no_delays(const TermLibrary& library) {
  for (const Term& term : library.terms)
    if (contains(term.expression(), Operation::Delay))
      throw ConfigError("term " + term.name(), "a map has no delays",
                        "give the earlier sample as a column of its own");
}

/// The samples that have a next one, which stands in the place of the derivative.
Trajectory with_next(const Trajectory& record) {
  const Index rows = record.samples() - 1;
  Trajectory result = rows_of(record, 0, rows);
  result.derivatives = record.states.bottomRows(rows);
  return result;
}

}  // namespace

LeastSquaresSystem NextSample::do_assemble(const Dataset& data, const TermLibrary& library,
                                           const RunContext& context) const {
  check_no_rates(data);
  check_no_delays(library);
  std::vector<Trajectory> records;
  records.reserve(data.trajectories.size());
  for (const Trajectory& record : data.trajectories) records.push_back(with_next(record));
  const auto rows = std::make_shared<const LibraryRows>(library, records);
  try {
    return {rows, library.names(), left_hand_sides(library.variables.states, Evolution::Map),
            context};
  } catch (const DataError&) {
    // The system knows row numbers only; where and why is worth another pass.
    if (const auto entry = rows->find_non_finite()) throw_non_finite(*entry);
    throw;
  }
}

std::optional<Vector> NextSample::do_target_noise(const Dataset&,
                                                  const Vector& state_noise) const {
  return state_noise;
}

Stage<Formulation> next_sample(const NextSampleOptions& options) { return NextSample(options); }

}  // namespace lacuna
