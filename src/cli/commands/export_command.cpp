// SPDX-License-Identifier: MIT
#include <memory>

#include "command.hpp"
#include "core/base/text.hpp"
#include "lacuna/model/export/export_model.hpp"

namespace lacuna::cli {
namespace {

struct ExportArguments {
  std::string model;
  std::string format;
  std::string output = "-";
};

int export_command(const Session& session, const ExportArguments& options) {
  check_outputs({options.model}, {{"--output", options.output}});
  write_output(session, options.output,
               export_model(load_model({options.model}), options.format));
  return 0;
}

}  // namespace

Command declare_export(CLI::App& root) {
  auto options = std::make_shared<ExportArguments>();
  CLI::App* app =
      root.add_subcommand("export", "Write a model as source text of another program");
  app->add_option("MODEL", options->model, "Model file, or the name of a test system")
      ->required();
  app->add_option("--format", options->format, join(export_formats(), ", "))->required();
  app->add_option("-o,--output", options->output, "File to write; - is standard output");
  return {app, [options](const Session& session) { return export_command(session, *options); }};
}

}  // namespace lacuna::cli
