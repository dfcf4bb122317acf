// SPDX-License-Identifier: MIT
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "cli/configuration/identification_configuration.hpp"
#include "core/base/text.hpp"
#include "diagnose/journey/fitted_outputs.hpp"
#include "lacuna/cli/configuration/configuration.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/lacuna.h"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/report/reports.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "lacuna/version.hpp"

struct lacuna_records {
  lacuna::Dataset data;
};

struct lacuna_model {
  lacuna::SystemModel system;
  lacuna::CompiledModel rates;
};

namespace lacuna {
namespace {

thread_local std::string last_error;

/// Runs what may throw; no exception leaves a C function.
template <class Result, class Run>
Result guarded(Result failed, const Run& run) {
  try {
    return run();
  } catch (const std::bad_alloc&) {
    last_error = "not enough memory";
  } catch (const std::exception& error) {
    last_error = error.what();
  }
  return failed;
}

/// What a caller gave, which must be there.
template <class Value>
const Value& given(const char* function, const char* name, const Value* value) {
  if (value == nullptr)
    throw ArgumentError(function, std::string(name) + " is NULL", "give one");
  return *value;
}

std::string_view text_or_nothing(const char* text) { return text == nullptr ? "" : text; }

std::vector<Quantity> quantities(const char* names) {
  std::vector<Quantity> all;
  for (const std::string& name : split_list(text_or_nothing(names)))
    if (!name.empty()) all.push_back(split_header(name));
  return all;
}

Matrix from_rows(const double* values, Index rows, Index columns) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values, rows, columns);
}

char* copy_of(const std::string& text) {
  char* copy = new char[text.size() + 1];
  std::memcpy(copy, text.c_str(), text.size() + 1);
  return copy;
}

Configuration configuration_of(const char* json) {
  Configuration configuration;
  if (const std::string_view text = text_or_nothing(json); !text.empty())
    configuration.merge_text(text, "configuration");
  return configuration;
}

SystemModel parse_model_text(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string::npos && text[begin] == '{' ? parse_system(text, "model")
                                                          : parse_ode_system(text, "model");
}

/// The records in the variables of a model; none where none are given.
Dataset view_of(const OdeModel& model, const lacuna_records* records) {
  return records == nullptr ? Dataset()
                            : model_view(model, records->data, finite_differences());
}

}  // namespace
}  // namespace lacuna

using namespace lacuna;  // NOLINT(google-build-using-namespace): C has no namespaces

const char* lacuna_version(void) { return kVersion.data(); }

const char* lacuna_error(void) { return last_error.c_str(); }

void lacuna_text_free(char* text) { delete[] text; }

lacuna_records* lacuna_records_new(const char* states, const char* inputs,
                                   const char* time_unit) {
  return guarded<lacuna_records*>(nullptr, [&] {
    Dataset data;
    data.time_unit = text_or_nothing(time_unit);
    data.states = quantities(states);
    data.inputs = quantities(inputs);
    if (data.states.empty())
      throw ArgumentError("lacuna_records_new", "there is no state",
                          "name at least one, \"x [m]\"");
    return new lacuna_records{std::move(data)};
  });
}

lacuna_records* lacuna_records_read(const char* path) {
  return guarded<lacuna_records*>(nullptr, [&] {
    return new lacuna_records{read_dataset({&given("lacuna_records_read", "path", path)})};
  });
}

int lacuna_records_add(lacuna_records* records, size_t samples, const double* time,
                       const double* states, const double* inputs) {
  return guarded(1, [&] {
    constexpr const char* kHere = "lacuna_records_add";
    given(kHere, "records", records);
    given(kHere, "time", time);
    given(kHere, "states", states);
    Dataset& data = records->data;
    if (data.input_count() > 0) given(kHere, "inputs", inputs);
    const auto n = static_cast<Index>(samples);
    Dataset one = data;
    one.trajectories = {{"record " + std::to_string(data.trajectories.size() + 1),
                         Eigen::Map<const Vector>(time, n),
                         from_rows(states, n, data.state_count()),
                         from_rows(inputs, n, data.input_count()),
                         {}}};
    check_dataset(one);
    data.trajectories.push_back(std::move(one.trajectories.front()));
    return 0;
  });
}

void lacuna_records_free(lacuna_records* records) { delete records; }

lacuna_model* lacuna_model_parse(const char* text) {
  return guarded<lacuna_model*>(nullptr, [&] {
    SystemModel system = parse_model_text(&given("lacuna_model_parse", "text", text));
    CompiledModel rates = system.model().compile();
    return new lacuna_model{std::move(system), std::move(rates)};
  });
}

size_t lacuna_model_states(const lacuna_model* model) {
  return model == nullptr ? 0 : static_cast<size_t>(model->rates.dimension());
}

size_t lacuna_model_inputs(const lacuna_model* model) {
  return model == nullptr ? 0 : static_cast<size_t>(model->rates.inputs());
}

int lacuna_model_rates(const lacuna_model* model, double t, const double* states,
                       const double* inputs, double* rates) {
  return guarded(1, [&] {
    constexpr const char* kHere = "lacuna_model_rates";
    given(kHere, "states", states);
    given(kHere, "rates", rates);
    CompiledModel compiled = given(kHere, "model", model).rates;  // one for each thread
    if (compiled.inputs() > 0) given(kHere, "inputs", inputs);
    if (!compiled.delays().empty())
      throw ModelError(kHere, "the model has delays, and its rates depend on earlier states",
                       "simulate it by the command or from C++");
    compiled.evaluate(t, states, inputs, nullptr, rates);
    return 0;
  });
}

void lacuna_model_free(lacuna_model* model) { delete model; }

char* lacuna_identify(const lacuna_records* records, const char* configuration) {
  return guarded<char*>(nullptr, [&] {
    const Registry registry = default_registry();
    const Configuration asked = configuration_of(configuration);
    const IdentificationTask task{
        .pipeline = asked.build(registry),
        .library = asked.says_pipeline() ? LibraryScope::AsGiven : LibraryScope::Extended,
        .options = identification_options(asked, registry)};
    Identification found =
        identify_records(given("lacuna_identify", "records", records).data, task);
    return copy_of(format_json(report_of(std::move(found), task.pipeline, asked.text())));
  });
}

char* lacuna_diagnose(const lacuna_model* model, const lacuna_records* records,
                      const lacuna_records* held_out, const char* configuration) {
  return guarded<char*>(nullptr, [&] {
    const SystemModel& nominal = given("lacuna_diagnose", "model", model).system;
    given("lacuna_diagnose", "records", records);
    const Dataset data = view_of(nominal.model(), records);
    const FittedOutputs fitted = with_fitted_outputs(nominal, data, {});
    const DiagnosisOptions options =
        diagnosis_options(configuration_of(configuration), default_registry());
    Diagnosis found =
        diagnose(fitted.model.model(), data, view_of(nominal.model(), held_out), options);
    found.notes.insert(found.notes.begin(), fitted.notes.begin(), fitted.notes.end());
    return copy_of(format_json(found, with_parameters_of(fitted.model, found.augmented)));
  });
}

char* lacuna_fit(const lacuna_model* model, const lacuna_records* records,
                 const lacuna_records* held_out) {
  return guarded<char*>(nullptr, [&] {
    const SystemModel& system = given("lacuna_fit", "model", model).system;
    given("lacuna_fit", "records", records);
    return copy_of(format_json(
        fit(system, view_of(system.model(), records), view_of(system.model(), held_out))));
  });
}
