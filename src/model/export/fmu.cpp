// SPDX-License-Identifier: MIT
#include "model/export/fmu.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/version.hpp"
#include "model/equations/formula_channel.hpp"
#include "model/export/fmu_runtime.hpp"
#include "model/export/heading.hpp"
#include "model/export/languages.hpp"
#include "model/export/sources.hpp"
#include "model/export/dialect.hpp"

namespace lacuna {
namespace {

/// A text as an attribute: what XML 1.0 has no character for is left out.
std::string attribute(const std::string& name, const std::string& text) {
  std::string value;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&') value += "&amp;";
    else if (c == '<') value += "&lt;";
    else if (c == '"') value += "&quot;";
    else if (byte >= 0x20U) value += c;
  }
  return " " + name + "=\"" + value + "\"";
}

/// One variable; @param rest further attributes. @param start nothing: it is computed.
std::string variable(const std::string& name, std::size_t reference, const std::string& unit,
                     const std::string& rest, std::optional<double> start) {
  return "    <ScalarVariable" + attribute("name", name) +
         attribute("valueReference", std::to_string(reference)) +
         (unit.empty() ? "" : attribute("description", "[" + unit + "]")) + rest + "><Real" +
         (start ? attribute("start", format_number(*start)) : "") + "/></ScalarVariable>\n";
}

std::vector<Output> further_outputs(const OdeModel& model) {
  std::vector<Output> outputs;
  for (const Output& output : model.outputs())
    if (!state_of(model, output)) outputs.push_back(output);
  return outputs;
}

std::string variables_text(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  std::string text;
  std::size_t reference = 0;
  for (std::size_t k = 0; k < model.states().size(); ++k)
    text += variable(model.states()[k].name, reference++, model.states()[k].unit,
                     R"( causality="output" variability="continuous" initial="exact")",
                     model.initial()[k] ? model.initial()[k]->value : 0.0);
  for (const Quantity& input : system.inputs())
    text += variable(input.name, reference++, input.unit,
                     R"( causality="input" variability="continuous")", 0.0);
  for (const Parameter& parameter : system.parameters())
    text += variable(parameter.name, reference++, parameter.unit,
                     R"( causality="parameter" variability="tunable" initial="exact")",
                     parameter.value);
  for (const Output& output : further_outputs(model))
    text += variable(output.name, reference++, output.unit,
                     R"( causality="output" variability="continuous" initial="calculated")", {});
  return text;
}

/// "<Unknown index="3"/>" for each of these; indices begin with 1.
std::string unknowns(const std::string& element, std::size_t first, std::size_t count) {
  std::string text;
  for (std::size_t i = first; i < first + count; ++i)
    text += "      <Unknown" + attribute("index", std::to_string(i + 1)) + "/>\n";
  return text.empty() ? "" : "    <" + element + ">\n" + text + "    </" + element + ">\n";
}

std::string structure_text(const SystemModel& system) {
  const OdeModel& model = system.symbolic();
  const std::size_t states = model.states().size(), own = model.inputs().size();
  const std::size_t outputs = further_outputs(model).size();
  std::string all = unknowns("Outputs", 0, states);
  const std::string others = unknowns("Outputs", states + own, outputs);
  if (!others.empty()) {
    constexpr std::string_view kBegin = "    <Outputs>\n", kEnd = "    </Outputs>\n";
    all.resize(all.size() - kEnd.size());
    all += others.substr(kBegin.size());
  }
  return all + unknowns("InitialUnknowns", states + own, outputs);
}

/// 128 bits of a text by FNV-1a from two starts, as a GUID.
std::string guid_of(const std::string& text) {
  constexpr std::uint64_t kPrime = 0x100000001b3ULL, kStart = 0xcbf29ce484222325ULL;
  std::uint64_t a = kStart, b = ~kStart;
  for (const char c : text) {
    a = (a ^ static_cast<unsigned char>(c)) * kPrime;
    b = (b ^ static_cast<unsigned char>(c)) * kPrime;
  }
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "{%08x-%04x-%04x-%04x-%012llx}",
                static_cast<unsigned>(a >> 32U), static_cast<unsigned>(a >> 16U & 0xffffU),
                static_cast<unsigned>(a & 0xffffU), static_cast<unsigned>(b >> 48U),
                static_cast<unsigned long long>(b & 0xffffffffffffULL));
  return buffer.data();
}

std::string description_of(const SystemModel& system, const std::string& guid) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription" +
         attribute("fmiVersion", "2.0") + attribute("modelName", kFmuName) +
         attribute("guid", guid) +
         attribute("generationTool", "lacuna " + std::string(kVersion)) + ">\n  <CoSimulation" +
         attribute("modelIdentifier", kFmuName) +
         attribute("canHandleVariableCommunicationStepSize", "true") +
         ">\n    <SourceFiles><File" + attribute("name", std::string(kFmuName) + ".c") +
         "/></SourceFiles>\n  </CoSimulation>\n  <ModelVariables>\n" + variables_text(system) +
         "  </ModelVariables>\n  <ModelStructure>\n" + structure_text(system) +
         "  </ModelStructure>\n</fmiModelDescription>\n";
}

std::string size(const std::string& name, std::size_t count) {
  return "#define " + name + " " + std::to_string(count) + "\n";
}

std::string values_array(const std::string& name, const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number_with_point(value);
  return "static const double " + name + "[] = {" + (text.empty() ? "0.0" : text) + "};\n";
}

std::string starts_text(const SystemModel& system) {
  std::vector<double> states, parameters;
  for (const auto& initial : system.symbolic().initial())
    states.push_back(initial ? initial->value : 0.0);
  for (const Parameter& parameter : system.parameters()) parameters.push_back(parameter.value);
  return values_array("lacuna_start_states", states) +
         values_array("lacuna_start_parameters", parameters);
}

/// The model with those outputs only that are no states.
SystemModel without_plain_outputs(const SystemModel& system) {
  return {system.symbolic().with_outputs(further_outputs(system.symbolic())),
          system.parameters()};
}

}  // namespace

FmuSources fmu_sources(const SystemModel& given) {
  check_flow(given.symbolic(), "export");
  check_no_events(given.symbolic(), "export");
  const SystemModel system = without_plain_outputs(given);
  const OdeModel& model = system.symbolic();
  const ForeignNames names = foreign_names(model, c_names());
  const std::string body =
      heading("// ", system, names) +
      "#include <math.h>\n#include <stdlib.h>\n#include <string.h>\n\n" +
      c_functions(system, ParameterPlace::Argument) + "\n" +
      size("LACUNA_STATES", model.states().size()) + size("LACUNA_INPUTS", system.inputs().size()) +
      size("LACUNA_PARAMETERS", system.parameters().size()) +
      size("LACUNA_OUTPUTS", model.outputs().size()) + starts_text(system);
  const std::string guid = guid_of(body + kFmuRuntime);
  return {description_of(system, guid),
          body + "#define LACUNA_GUID \"" + guid + "\"\n" + kFmuRuntime};
}

}  // namespace lacuna
