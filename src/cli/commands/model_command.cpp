// SPDX-License-Identifier: MIT
#include <filesystem>
#include <memory>

#include "command.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::cli {
namespace {

struct ModelArguments {
  std::string model;
  std::string output = "-";
};

/// To standard output goes the format that the model does not have yet.
int model_command(const Session& session, const ModelArguments& options) {
  const SystemModel model = load_system({options.model});
  const bool was_text = std::filesystem::path(options.model).extension() == ".ode";
  const std::string other = was_text ? "out.json" : "out.ode";
  write_output(session, options.output,
               format_model_for(options.output == "-" ? other : options.output, model));
  return 0;
}

}  // namespace

Command declare_model() {
  auto options = std::make_shared<ModelArguments>();
  Command command{"model", "Convert a model: text (.ode) to JSON (.json) and back"};
  command.add("MODEL", &options->model, "Model file, or the name of a test system").require();
  command.add("-o,--output FILE|-", &options->output,
              "File to write, .ode or .json; - is standard output, in the other format");
  command.run = [options](const Session& session) { return model_command(session, *options); };
  return command;
}

}  // namespace lacuna::cli
