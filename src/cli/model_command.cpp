// SPDX-License-Identifier: MIT
#include <filesystem>
#include <memory>

#include "command.hpp"
#include "lacuna/model/model_file.hpp"
#include "lacuna/model/ode_text.hpp"

namespace lacuna::cli {
namespace {

struct Options {
  std::string model;
  std::string output = "-";
};

bool is_ode(const std::string& path) {
  return std::filesystem::path(path).extension() == ".ode";
}

/// To standard output goes the format that the model does not have yet.
int model_command(const Session& session, const Options& options) {
  check_outputs({options.model}, {{"--output", options.output}});
  const OdeModel model = load_model(options.model);
  const bool as_text = options.output == "-" ? !is_ode(options.model) : is_ode(options.output);
  write_output(session, options.output, as_text ? format_ode(model) : format_model(model));
  return 0;
}

}  // namespace

Command declare_model(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app =
      root.add_subcommand("model", "Convert a model: text (.ode) to JSON (.json) and back");
  app->add_option("MODEL", options->model, "Model file, or the name of a test system")
      ->required();
  app->add_option("-o,--output", options->output,
                  "File to write, .ode or .json; - is standard output, in the other format");
  return {app, [options](const Session& session) { return model_command(session, *options); }};
}

}  // namespace lacuna::cli
