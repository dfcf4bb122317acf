// SPDX-License-Identifier: MIT
// What calls are given, and what they answer.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "call.hpp"
#include "cli/commands/answers.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "report/pages/pages.hpp"

namespace lacuna::python {

/// An answer in all the ways in which it is shown. What an answer cannot be shown as is empty.
struct Answer {
  std::function<std::string()> json;
  std::function<std::string(const TextOptions& options)> text;
  std::function<Page()> page = {};
  std::function<std::string()> trail = {};
  std::function<std::string()> csv = {};
  std::function<std::string(const std::string& format)> inputs = {};  ///< of a plan
  std::optional<SystemModel> model = {};
  std::vector<std::string> warnings = {};
  std::string failure = {};  ///< why the numbers do not allow an answer; empty: they do
};

using Arguments = nb::typed<nb::dict, nb::str, nb::any>;

/// Keyword arguments by their names; each is there or has its default.
class Given {
 public:
  explicit Given(Arguments values) : values_(std::move(values)) { take_call(); }

  template <class Value>
  void take(const char* name, Value& value) const {
    if (!values_.contains(name)) return;
    const nb::object given = values_[name];
    if (!nb::try_cast(given, value))
      throw ArgumentError(name,
                          "a value of the type '" +
                              nb::cast<std::string>(given.type().attr("__name__")) +
                              "' cannot be used",
                          "give what the description of the function names");
  }

  /// One by one, as a caster of a vector must not run out of memory.
  void take(const char* name, std::vector<Table>& tables) const {
    if (!values_.contains(name)) return;
    for (const nb::handle table : nb::cast<nb::list>(values_[name]))
      tables.push_back(nb::cast<const Table&>(table));
  }

  bool has(const char* name) const { return values_.contains(name); }

  /// A part written in Python, or each of a list.
  template <class Part, class Use>
  void take_own(const char* name, Use use) const {
    if (!values_.contains(name)) return;
    for (const nb::handle given : nb::cast<nb::list>(values_[name])) {
      Part part = nb::cast<const Part&>(given);
      part.written().join(call_.callbacks);
      use(std::move(part));
    }
  }

  const CallOptions& call() const { return call_; }

 private:
  void take_call() {
    take("seed", call_.seed);
    take("threads", call_.threads);
    if (has("progress")) call_.progress = values_["progress"];
    take("time_limit", call_.time_limit);
    if (call_.time_limit && !(*call_.time_limit >= 1e-3 && *call_.time_limit <= 1e9))
      throw ArgumentError("time_limit", "it is no time from 0.001 to 1e9 seconds",
                          "give seconds, or leave it out");
  }

  Arguments values_;
  CallOptions call_ = {};
};

/// The value of work that the arguments ask for, kept for the ways in which it is shown.
template <class Work>
auto ended(const Given& given, Work work) {
  return std::make_shared<const decltype(work(std::declval<const RunContext&>()))>(
      call(given.call(), std::move(work)));
}

/// The same of what a command answers to a request.
template <class Request>
auto answered(const Given& given, Request request) {
  return ended(given, [request = std::move(request)](const RunContext& context) {
    if constexpr (requires { answer(registry(), request, context); })
      return answer(registry(), request, context);
    else if constexpr (requires { answer(request, context); })
      return answer(request, context);
    else
      return answer(registry(), request);
  });
}

inline void take_data(const Given& given, cli::DataOptions& data) {
  given.take("paths", data.paths);
  given.take("tables", data.tables);
  given.take("time", data.time);
  given.take("time_unit", data.time_unit);
  given.take("trajectory", data.trajectory);
  given.take("step", data.step);
  given.take("states", data.states);
  given.take("inputs", data.inputs);
  given.take("derivatives", data.derivatives);
  given.take("embed", data.embed);
  given.take("holds", data.holds);
  given.take("names", data.names);
}

inline void take_held_out(const Given& given, cli::RecordSources& sources) {
  given.take("held_out_paths", sources.paths);
  given.take("held_out_tables", sources.tables);
}

inline void take_model(const Given& given, cli::ModelSource& model) {
  given.take("model", model.given);
  given.take("model_path", model.path);
}

/// Models, each by its value or its path, with names: `models` is a list of pairs.
inline std::vector<cli::ModelSource> models_of(const Given& given) {
  std::vector<std::pair<std::string, std::optional<SystemModel>>> models;
  given.take("models", models);
  std::vector<cli::ModelSource> sources;
  for (auto& [path, model] : models) sources.push_back({path, std::move(model)});
  return sources;
}

/// A value by the name that it has on the command line.
/// @throws ConfigError that lists the names.
template <class Value>
void take_named(const Given& given, const char* name,
                const std::map<std::string, Value>& values, Value& value) {
  std::string chosen;
  given.take(name, chosen);
  if (chosen.empty()) return;
  const auto found = values.find(chosen);
  std::vector<std::string> names;
  for (const auto& [known, one] : values) names.push_back(known);
  if (found == values.end())
    throw ConfigError(name, "'" + chosen + "' is not known",
                      "give one of " + join(names, ", "));
  value = found->second;
}

}  // namespace lacuna::python
