// SPDX-License-Identifier: MIT
#include "column_use.hpp"

#include <algorithm>

#include "core/base/names.hpp"
#include "data/times/time_names.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "records/channels/column_hints.hpp"

namespace lacuna::cli {
namespace {

constexpr std::string_view kNoUnit = "none";

/// Whether a column stays as it was in most samples of every record.
bool stays(const Dataset& data, Index state) {
  return std::all_of(data.trajectories.begin(), data.trajectories.end(),
                     [&](const Trajectory& record) {
                       return shows_hold(record.states.col(state));
                     });
}

bool has_state(const RecordUse& record) {
  return !columns_with(record, ColumnUse::State).empty();
}

ColumnUse use_named(const std::string& name) {
  for (const ColumnUse use : {ColumnUse::State, ColumnUse::Input})
    if (to_string(use) == name) return use;
  return ColumnUse::LeftOut;
}

/// @return the unit; empty for none.
std::string asked_unit(const std::string& of, const std::string& unit, Questions& questions) {
  const std::string proposed = unit.empty() ? std::string(kNoUnit) : unit;
  for (;;) {
    const std::string answer = questions.ask("  unit of " + of, proposed);
    if (answer == proposed) return unit;
    if (answer == kNoUnit) return "";
    const auto fault = unit_fault(answer);
    if (!fault) return answer;
    questions.remark(fault->problem + "; " + fault->remedy);
  }
}

std::string asked_time_unit(const std::string& unit, Questions& questions) {
  for (;;) {
    const std::string answer = questions.ask("Unit of the time", unit);
    if (answer == unit) return unit;
    if (const auto symbol = time_unit_symbol(answer)) return *symbol;
    questions.remark("'" + answer + "' is none of " + known_time_units());
  }
}

}  // namespace

std::string to_string(ColumnUse use) {
  if (use == ColumnUse::State) return "state";
  return use == ColumnUse::Input ? "input" : "leave out";
}

RecordUse proposed_use(const Dataset& data) {
  RecordUse record{data.time_unit, {}};
  for (Index k = 0; k < data.state_count(); ++k) {
    UsedColumn column{data.states[static_cast<std::size_t>(k)]};
    if (stays(data, k)) {
      column.use = ColumnUse::Input;
      column.reason = column.quantity.name + " stays as it was in most samples";
    }
    record.columns.push_back(std::move(column));
  }
  for (const ColumnRemark& remark : column_remarks(data)) {
    UsedColumn& column = record.columns[static_cast<std::size_t>(remark.column)];
    column.use = remark.kind == ColumnKind::Held ? ColumnUse::Input : ColumnUse::LeftOut;
    column.reason = remark.sentence;
  }
  if (!has_state(record) && !record.columns.empty())
    record.columns.front() = {data.states.front()};
  for (const Quantity& input : data.inputs)
    record.columns.push_back({input, ColumnUse::Input, ""});
  return record;
}

RecordUse asked_use(RecordUse record, Questions& questions) {
  record.time_unit = asked_time_unit(record.time_unit, questions);
  const std::vector<std::string> uses = {to_string(ColumnUse::State),
                                         to_string(ColumnUse::Input),
                                         to_string(ColumnUse::LeftOut)};
  for (UsedColumn& column : record.columns) {
    if (!column.reason.empty()) questions.remark(column.reason);
    column.use =
        use_named(questions.choose(column.quantity.name, uses, to_string(column.use)));
    if (column.use != ColumnUse::LeftOut)
      column.quantity.unit = asked_unit(column.quantity.name, column.quantity.unit, questions);
  }
  if (!has_state(record))
    throw ConfigError("columns", "no column is a state", "let at least one be a state");
  return record;
}

std::vector<std::string> columns_with(const RecordUse& record, ColumnUse use) {
  std::vector<std::string> names;
  for (const UsedColumn& column : record.columns)
    if (column.use == use) names.push_back(column.quantity.name);
  return names;
}

}  // namespace lacuna::cli
