// SPDX-License-Identifier: MIT
#include "equation_problem.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "hurried_terms.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/identify/pipeline/presets.hpp"

namespace lacuna {
namespace {

/// A library with some of its terms.
TermLibrary with_terms(const TermSet& kept, const TermLibrary& library) {
  TermLibrary some{library.variables, {}};
  for (const Index term : kept)
    some.terms.push_back(library.terms[static_cast<std::size_t>(term)]);
  return some;
}

/// What a stage makes as long as there is time; nothing past the deadline.
template <class Work>
auto in_time(Work work) -> std::optional<decltype(work())> {
  try {
    return work();
  } catch (const OutOfTime&) {
    return std::nullopt;
  }
}

/// The run to read rows in, whose time is up where it does not do.
RunContext for_reading(Index rows, Index columns, RunContext context) {
  using Clock = std::chrono::steady_clock;
  if (!context.deadline) return context;
  const std::chrono::duration<double> left = *context.deadline - Clock::now();
  if (!can_be_read(rows, columns, left.count(), context.threads)) context.deadline = Clock::now();
  return context;
}

}  // namespace

EquationProblem equation_problem(const RecordStream& records, const Pipeline& pipeline,
                                 EquationLibraries libraries, const RunContext& context) {
  const RunContext unhurried = context.unhurried();
  const RunContext& timed = context.team == nullptr ? context : unhurried;
  const auto rows = [&](const RunContext& within) {
    return pipeline.formulation->assemble(records, libraries.library, within);
  };
  const TermSet cheap =
      cheap_terms(libraries.library, records.samples(), records.excerpt().state_count());
  const bool may_be_fewer = libraries.allowed.empty() && context.team == nullptr &&
                            static_cast<Index>(cheap.size()) < libraries.library.size();
  auto system = in_time([&] {
    const Index columns = libraries.library.size() + records.excerpt().state_count();
    return rows(may_be_fewer ? for_reading(records.samples(), columns, timed) : unhurried);
  });
  const Index all = libraries.library.size();
  if (!system) {
    libraries.library = with_terms(cheap, libraries.library);
    system = rows(unhurried);
  }
  unhurried.report("filtering terms", 0.0);
  auto filtered = in_time([&] { return pipeline.filter->filter(*system, timed); });
  const bool is_filtered = filtered.has_value();
  if (!is_filtered)  // the preset without one
    filtered = sindy().filter->filter(*system, unhurried);
  const Index left_out = all - libraries.library.size();
  return {std::move(libraries), *std::move(system), *std::move(filtered), left_out,
          is_filtered};
}

}  // namespace lacuna
