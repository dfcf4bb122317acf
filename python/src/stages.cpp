// SPDX-License-Identifier: MIT
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "cli/commands/answers.hpp"
#include "cli/configuration/description.hpp"
#include "cli/configuration/option_reader.hpp"
#include "core/base/utf8.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "own_stages.hpp"
#include "report/json/stage_json.hpp"
#include "report/pages/folded_text.hpp"

namespace lacuna::python {
namespace {

using Rows = nb::ndarray<const double, nb::ndim<2>, nb::device::cpu>;
using Times = nb::ndarray<const double, nb::ndim<1>, nb::device::cpu>;

nb::dict described(const OptionDescription& option) {
  nb::dict result;
  result["name"] = option.name;
  result["type"] = option.type;
  result["unit"] = option.unit;
  result["range"] = option.range;
  result["default"] = option.value;
  result["text"] = option.text;
  return result;
}

/// Every registered part with its options.
nb::list parts() {
  nb::list result;
  for (const RegistryEntry& entry : registry().entries()) {
    nb::dict part;
    part["kind"] = std::string(entry.kind);
    part["name"] = std::string(entry.info.name);
    part["summary"] = std::string(entry.info.summary);
    part["reference"] = std::string(entry.info.reference);
    part["unavailable"] = entry.unavailable;
    nb::list options;
    if (entry.unavailable.empty())
      for (const OptionDescription& option : describe_options(entry))
        options.append(described(option));
    part["options"] = options;
    result.append(part);
  }
  return result;
}

/// Sees no option and changes none.
std::shared_ptr<const StageInterface> made(const RegistryEntry& entry) {
  const Json none = Json::object();
  OptionReader defaults(registry(), none, none, "$");
  return entry.make(defaults);
}

/// All options of a part with those that are given, as JSON; what is wrong with them is said.
std::string checked_stage(const std::string& kind, const std::string& name,
                          const std::string& options) {
  Json given = Json::parse(options);
  given["type"] = name;
  const RegistryEntry& entry = registry().find(kind, name);
  if (!entry.unavailable.empty())
    throw ConfigError(name, "it is not in this build: " + entry.unavailable,
                      "choose another one (list_parts())");
  return format_stage(*read_stage(registry(), kind, given, name, *made(entry)));
}

/// A registered part of a type with its options as JSON.
template <class Part>
std::shared_ptr<const Part> part_of(const std::string& name, const std::string& options) {
  Json given = Json::parse(options);
  given["type"] = name;
  const RegistryEntry& entry = registry().find(Part::kKind, name);
  return std::dynamic_pointer_cast<const Part>(
      read_stage(registry(), Part::kKind, given, name, *made(entry)));
}

Matrix matrix_of(const Rows& rows) {
  Matrix result(static_cast<Index>(rows.shape(0)), static_cast<Index>(rows.shape(1)));
  const auto view = rows.view();
  for (Index i = 0; i < result.rows(); ++i)
    for (Index k = 0; k < result.cols(); ++k)
      result(i, k) = view(static_cast<std::size_t>(i), static_cast<std::size_t>(k));
  return result;
}

/// A regressor on rows: coefficients of all columns, 0 where a term has gone.
std::vector<double> fitted(const WrittenRegressor& regressor, const Rows& theta,
                           const Rows& target) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < theta.shape(1); ++i) names.push_back("c" + std::to_string(i + 1));
  const LeastSquaresSystem system(make_row_source(matrix_of(theta), matrix_of(target)), names,
                                  {"y"});
  const Regression found = regressor.fit(system, system.subproblem(0, system.all_terms()));
  std::vector<double> result(names.size(), 0.0);
  for (std::size_t i = 0; i < found.active.size(); ++i)
    result[static_cast<std::size_t>(found.active[i])] =
        found.coefficients[static_cast<Index>(i)];
  return result;
}

/// dx/dt of columns at their samples by a registered method.
nb::object derivatives(const std::string& method, const std::string& options,
                       const Times& times, const Rows& values) {
  const auto stage = part_of<Differentiator>(method, options);
  const auto view = times.view();
  Vector time(static_cast<Index>(times.shape(0)));
  for (Index i = 0; i < time.size(); ++i) time[i] = view(static_cast<std::size_t>(i));
  return array_of(stage->differentiate(time, matrix_of(values)));
}

/// What Python's garbage collector asks of a part, whose function may refer to the part.
template <class Part>
struct Collected {
  static int traverse(PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    if (nb::inst_ready(self)) Py_VISIT(nb::inst_ptr<Part>(self)->written().collectable());
    return 0;
  }

  static int clear(PyObject* self) {
    if (nb::inst_ready(self)) nb::inst_ptr<Part>(self)->written().clear();
    return 0;
  }

  static inline PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(&traverse)},
                                       {Py_tp_clear, reinterpret_cast<void*>(&clear)},
                                       {0, nullptr}};
};

template <class Part>
nb::class_<Part> bind_written(nb::module_& module, const char* name) {
  return nb::class_<Part>(module, name, nb::type_slots(Collected<Part>::slots));
}

}  // namespace

void bind_stages(nb::module_& module) {
  module.def("parts", &parts, nb::sig("def parts() -> list[dict[str, typing.Any]]"));
  module.def("checked_stage", &checked_stage, nb::arg("kind"), nb::arg("name"),
             nb::arg("options"));
  module.def(
      "preset",
      [](const std::string& name, bool paper) {
        return format_pipeline(preset(name, paper ? Tolerances::Paper : Tolerances::Repaired));
      },
      nb::arg("name"), nb::arg("paper"));
  module.def(
      "list_parts",
      [](const std::string& kind) {
        return folded(printable(cli::list_of_parts(registry(), kind)));
      },
      nb::arg("kind"));
  module.def(
      "describe",
      [](const std::string& name) {
        return folded(printable(cli::description_of(registry(), name)));
      },
      nb::arg("name"));
  module.def("derivatives", &derivatives, nb::arg("method"), nb::arg("options"),
             nb::arg("time"), nb::arg("values"));
  module.def(
      "library",
      [](const std::string& name, const std::string& options, std::vector<std::string> states,
         std::vector<std::string> inputs) {
        return part_of<Basis>(name, options)
            ->library({std::move(states), std::move(inputs)})
            .names();
      },
      nb::arg("name"), nb::arg("options"), nb::arg("states"), nb::arg("inputs"),
      "Names of the terms of a registered basis.");
  bind_written<WrittenBasis>(module, "WrittenBasis")
      .def(nb::new_([](std::string name, nb::object function) {
             return WrittenBasis(Written(std::move(name), std::move(function)));
           }),
           nb::arg("name"), nb::arg("function"))
      .def(
          "library",
          [](const WrittenBasis& self, std::vector<std::string> states,
             std::vector<std::string> inputs) {
            return self.library({std::move(states), std::move(inputs)}).names();
          },
          nb::arg("states"), nb::arg("inputs"));
  bind_written<WrittenRegressor>(module, "WrittenRegressor")
      .def(nb::new_([](std::string name, nb::object function) {
             return WrittenRegressor(Written(std::move(name), std::move(function)));
           }),
           nb::arg("name"), nb::arg("function"))
      .def("fit", &fitted, nb::arg("theta"), nb::arg("target"));
  bind_written<WrittenEffect>(module, "WrittenEffect")
      .def(nb::new_([](std::string name, nb::object function, std::string cause) {
             return WrittenEffect(Written(std::move(name), std::move(function)),
                                  std::move(cause));
           }),
           nb::arg("name"), nb::arg("function"), nb::arg("cause"));
}

}  // namespace lacuna::python
