// SPDX-License-Identifier: MIT
#include "skeleton.hpp"

#include <filesystem>

#include "core/base/text.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/equations/system_model.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "model/export/quoted_text.hpp"

namespace lacuna::cli {
namespace {

std::vector<Quantity> quantities_with(const RecordUse& record, ColumnUse use) {
  std::vector<Quantity> quantities;
  for (const UsedColumn& column : record.columns)
    if (column.use == use) quantities.push_back(column.quantity);
  return quantities;
}

/// Lines that show, by the model's own names, what may be written.
std::string help_lines(const RecordUse& record) {
  const std::string state = columns_with(record, ColumnUse::State).front();
  const auto inputs = columns_with(record, ColumnUse::Input);
  const std::string more = inputs.empty() ? "" : " + " + inputs.front();
  return "# Write what is known behind each d.../dt, for example\n"
         "#   param k = 0.5 in 0..10\n"
         "#   d" + state + "/dt = -k*" + state + more + "\n"
         "#   initial " + state + " = 0 fixed\n"
         "# 0 stays where nothing is known; what follows a # is a comment.\n";
}

}  // namespace

std::string skeleton_of(const RecordUse& record, const std::string& source) {
  const std::vector<Quantity> states = quantities_with(record, ColumnUse::State);
  const OdeModel model(states, quantities_with(record, ColumnUse::Input),
                       std::vector<Equation>(states.size()), record.time_unit);
  const std::string name = std::filesystem::path(source).filename().string();
  return "# Skeleton of a model for " + quoted_text(name) + "\n" + help_lines(record) +
         format_ode(SystemModel(model));
}

std::vector<std::string> column_flags(const RecordUse& record, bool all_states) {
  std::vector<std::string> flags;
  const auto inputs = columns_with(record, ColumnUse::Input);
  if (!all_states || !columns_with(record, ColumnUse::LeftOut).empty())
    flags = {"--states", join(columns_with(record, ColumnUse::State), ",")};
  if (!inputs.empty()) flags.insert(flags.end(), {"--inputs", join(inputs, ",")});
  return flags;
}

}  // namespace lacuna::cli
