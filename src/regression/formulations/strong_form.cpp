// SPDX-License-Identifier: MIT
#include "regression/formulations/strong_form.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lacuna/model/equations/ode_model.hpp"
#include "non_finite_error.hpp"
#include "records/binding/derived_record.hpp"
#include "records/channels/shown_holds.hpp"
#include "regression/formulations/library_rows.hpp"
#include "streamed_rows.hpp"

namespace lacuna {
namespace {

/// Whether a record is a piece between gaps from which derivatives cannot be taken; the longest
/// record is never left out.
bool too_short(const Trajectory& record, const Dataset& data, const Differentiator& method) {
  if (data.has_derivatives() || record.samples() >= method.fewest_samples()) return false;
  return record.samples() < longest_record(data).samples();
}

/// rms over the record of the derivative of white noise of standard deviation 1: the root of
/// the sum of squared responses to a unit impulse, as a mean over a few places of the impulse
/// because on a grid that is not uniform, and near the ends, the place matters.
double noise_gain(const Trajectory& record, const Differentiator& differentiator) {
  const Index n = record.samples();
  const Index places = std::min<Index>(n, 8);
  Matrix impulses = Matrix::Zero(n, places);
  for (Index i = 0; i < places; ++i) impulses((2 * i + 1) * n / (2 * places), i) = 1.0;
  return differentiate_record(record, impulses, differentiator, 1).norm() /
         std::sqrt(static_cast<double>(places));
}

bool has_delay(const TermLibrary& library) {
  return std::any_of(library.terms.begin(), library.terms.end(), [](const Term& term) {
    return contains(term.expression(), Operation::Delay);
  });
}

/// The system of rows that know where they come from.
/// @param error see LeastSquaresSystem::target_error.
/// @param unchecked records in memory whose values only the rows look at, or null.
template <class Rows>
LeastSquaresSystem system_of(const std::shared_ptr<const Rows>& rows,
                             const TermLibrary& library, const std::optional<Vector>& error,
                             const Dataset* unchecked, const RunContext& context) {
  try {
    const LeastSquaresSystem system(rows, library.names(),
                                    left_hand_sides(library.variables.states, Evolution::Flow),
                                    context);
    return error ? system.with_target_error(*error) : system;
  } catch (const DataError&) {
    // The system knows row numbers only; where and why is worth another pass.
    if (unchecked) check_finite(*unchecked, context.threads);
    if (const auto entry = rows->find_non_finite()) throw_non_finite(*entry);
    throw;
  }
}

}  // namespace

LeastSquaresSystem StrongForm::do_assemble(const Dataset& data, const TermLibrary& library,
                                           const RunContext& context) const {
  const Stage<Differentiator> method = fitted_to(options().differentiator, data);
  std::vector<Trajectory> records;
  records.reserve(data.trajectories.size());
  for (const Trajectory& record : data.trajectories) {
    context.check_stop();
    if (too_short(record, data, *method)) continue;
    records.push_back(with_derivatives(record, *method, options().smooth_states));
  }
  const Index margin = data.has_derivatives() ? 0 : method->margin();
  return system_of(std::make_shared<const LibraryRows>(library, records, margin, held_inputs(data)),
                   library,
                   data.has_derivatives() ? std::nullopt : method->truncation_error(data),
                   nullptr, context);
}

LeastSquaresSystem StrongForm::do_assemble_long(const RecordStream& records,
                                                const TermLibrary& library,
                                                const RunContext& context) const {
  // What has a past needs it in memory; the rows say so where it is not.
  if (has_delay(library) && records.in_memory()) {
    check_finite(*records.in_memory(), context.threads);
    return do_assemble(*records.in_memory(), library, context);
  }
  const Dataset& data = records.excerpt();
  const bool given = data.has_derivatives();
  const Stage<Differentiator> method =
      given ? options().differentiator : fitted_to(options().differentiator, data);
  return system_of(
      std::make_shared<const StreamedRows>(library, records.records(),
                                           SampleRates{method, options().smooth_states}, given,
                                           held_inputs(data)),
      library, given ? std::nullopt : method->truncation_error(data), records.in_memory(),
      context);
}

std::optional<Vector> StrongForm::do_target_noise(const Dataset& data,
                                                  const Vector& state_noise) const {
  return state_noise *
         noise_gain(longest_record(data), *fitted_to(options().differentiator, data));
}

std::shared_ptr<const Formulation> StrongForm::do_fit(
    const Dataset& data, const std::optional<Vector>& noise) const {
  if (data.has_derivatives()) return nullptr;
  Options fitted = options();
  fitted.differentiator = fitted_to(options().differentiator, data, noise);
  return std::make_shared<const StrongForm>(std::move(fitted));
}

Stage<Formulation> strong_form(const StrongFormOptions& options) { return StrongForm(options); }

}  // namespace lacuna
