// SPDX-License-Identifier: MIT
#include <memory>

#include "answers.hpp"
#include "command.hpp"
#include "data_options.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "lacuna/records/channels/map_hint.hpp"
#include "records/channels/column_hints.hpp"
#include "report/pages/data_summary.hpp"

namespace lacuna::cli {
namespace {

struct CheckArguments {
  DataOptions data;
  std::optional<std::string> model, json;
  std::string differentiator = "finite-differences";
  RunOptions run;
};

/// Whether every state has a column, or is made from one, and no channel is a formula.
bool is_all_measured(const OdeModel& model, const Dataset& data) {
  if (data.states.size() != model.states().size()) return false;
  for (Index k = 0; k < data.state_count(); ++k)
    if (is_hidden(data, k)) return false;
  return true;
}

/// Samples of the longest record, short gaps bridged.
Index longest_piece(const Dataset& data, GapOptions gaps) {
  gaps.shortest_record = 2;
  return longest_record(usable_records(data, gaps).data).samples();
}

/// The records in the variables of a model, with what is odd about the two together.
DataSummary summary_for(const Differentiator& differentiator, const CheckRequest& options) {
  const OdeModel model = with_holds(load_flow(*options.model, "check --model"), options.data);
  check_map(options.data, column_names(model));
  ColumnRoles roles = common_roles(options.data);
  roles.blanks = Blanks::Mark;
  const Dataset data = records_for(model, options.data, roles, differentiator, Columns::All);
  DataSummary summary = summarise(data, static_cast<Index>(model.inputs().size()));
  if (!is_all_measured(model, data)) return summary;  // slips are looked for where all is seen
  const GapOptions gaps;
  if (longest_piece(data, gaps) < gaps.shortest_record) {
    summary.notes.push_back("no record has " + std::to_string(gaps.shortest_record) +
                            " samples or more in a row: slips of units, signs and columns are "
                            "not looked for, and `lacuna diagnose` wants more; `lacuna fit` "
                            "takes so few");
    return summary;
  }
  const UsableRecords usable = usable_records(data, gaps);
  summary.hints = look_at(model, observed(used_part(model, usable.data)),
                          unused_part(model, usable.data), HintOptions{});
  return summary;
}

int check_command(const Session& session, const CheckArguments& options) {
  make_context(session, options.run).report("reading data", 0.0);
  CheckRequest request{options.data, {}, options.differentiator};
  if (options.model) request.model = {*options.model};
  const DataSummary summary = answer(session.registry, request);
  finish_progress(session, options.run);
  if (options.json) write_output(session, *options.json, format_json(summary));
  if (options.json != "-") show(session, format_text(summary));
  return 0;
}

}  // namespace

DataSummary answer(const Registry& registry, const CheckRequest& request) {
  const auto differentiator = registry.make<Differentiator>(request.differentiator);
  if (request.model) return summary_for(*differentiator, request);
  const Dataset data = read_data(request.data);
  DataSummary summary = summarise(data, data.input_count());
  summary.hints = column_hints(data);
  if (const std::optional<Hint> hint = map_hint(data)) summary.hints.push_back(*hint);
  return summary;
}

Command declare_check() {
  auto options = std::make_shared<CheckArguments>();
  Command command{"check", "Show what would be read: columns, roles, step, noise, what is odd"};
  command.add("DATA", &options->data.paths, "Files (text, .gz, .npy) or quoted patterns")
      .require();
  command.add("--model FILE", &options->model,
              "Model file: says the roles; slips of units, signs and columns are looked for");
  declare_column_options(command, options->data, true);
  command
      .add("--differentiator NAME", &options->differentiator,
           "How states without a column are made from those that have one")
      .show_default();
  command.add("--json FILE|-", &options->json, "Write it as JSON; - for standard output");
  declare_run_options(command, options->run);
  command.run = [options](const Session& session) { return check_command(session, *options); };
  return command;
}

}  // namespace lacuna::cli
