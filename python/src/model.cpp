// SPDX-License-Identifier: MIT
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <memory>

#include "bindings.hpp"
#include "cli/commands/command.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/export/export_model.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::python {
namespace {

using Rows = nb::ndarray<const double, nb::ndim<2>, nb::device::cpu>;
using Times = nb::ndarray<const double, nb::ndim<1>, nb::device::cpu>;

/// Rows between two looks at Python's signals.
constexpr std::size_t kBlock = 65536;

/// An array of NumPy that owns its numbers. @param shape of the array; row-major.
nb::object new_array(std::vector<std::size_t> shape, double*& values) {
  std::size_t count = 1;
  for (const std::size_t size : shape) count *= size;
  auto numbers =
      std::make_unique_for_overwrite<double[]>(count);  // NOLINT(modernize-avoid-c-arrays)
  values = numbers.get();
  const nb::capsule owner(numbers.get(),
                          [](void* p) noexcept { delete[] static_cast<double*>(p); });
  double* const data = numbers.release();
  return nb::cast(nb::ndarray<nb::numpy, double>(data, shape.size(), shape.data(), owner));
}

[[noreturn]] void fail_shape(const std::string& name, std::size_t columns) {
  throw ArgumentError("model", name + " has not " + std::to_string(columns) + " columns",
                      "give one row for each time, one column for each " +
                          std::string(name == "x" ? "state" : "input"));
}

/// A model at many points: times (n or 1), states n x m, inputs n x p.
struct Points {
  const Times& t;
  const Rows& x;
  const Rows& u;

  std::size_t count() const { return x.shape(0); }

  void check(const CompiledModel& model) const {
    if (static_cast<Index>(x.shape(1)) != model.dimension())
      fail_shape("x", static_cast<std::size_t>(model.dimension()));
    if (static_cast<Index>(u.shape(1)) != model.inputs() || u.shape(0) != count())
      fail_shape("u", static_cast<std::size_t>(model.inputs()));
    if (t.shape(0) != count() && t.shape(0) != 1)
      throw ArgumentError("model", "t has not one value for each row of x", "give one or n");
    if (!model.delays().empty())
      throw ModelError("model", "its rate depends on earlier values", "use simulate()");
  }
};

/// Calls f(t, x, u, row) for each point without the interpreter's lock; an interrupt ends it.
template <class Function>
void for_each_point(const Points& points, Function f) {
  const auto t = points.t.view();
  const auto x = points.x.view();
  const auto u = points.u.view();
  std::vector<double> states(points.x.shape(1)), inputs(points.u.shape(1));
  for (std::size_t first = 0; first < points.count(); first += kBlock) {
    if (first > 0 && PyErr_CheckSignals() != 0) throw nb::python_error();
    const nb::gil_scoped_release release;
    for (std::size_t i = first; i < std::min(first + kBlock, points.count()); ++i) {
      for (std::size_t k = 0; k < states.size(); ++k) states[k] = x(i, k);
      for (std::size_t k = 0; k < inputs.size(); ++k) inputs[k] = u(i, k);
      f(t(points.t.shape(0) == 1 ? 0 : i), states.data(), inputs.data(), i);
    }
  }
}

/// dx/dt (of a map the next states), n x m.
/// @param model a copy: several threads may evaluate one model.
nb::object rates(CompiledModel model, const Times& t, const Rows& x, const Rows& u) {
  const Points points{t, x, u};
  points.check(model);
  const auto m = static_cast<std::size_t>(model.dimension());
  double* values = nullptr;
  nb::object result = new_array({points.count(), m}, values);
  for_each_point(points,
                 [&](double time, const double* state, const double* input, std::size_t i) {
                   model.evaluate(time, state, input, nullptr, values + i * m);
                 });
  return result;
}

/// df_k/dx_j, n x m x m.
nb::object jacobians(CompiledModel model, const Times& t, const Rows& x, const Rows& u) {
  const Points points{t, x, u};
  points.check(model);
  const auto m = static_cast<std::size_t>(model.dimension());
  double* values = nullptr;
  nb::object result = new_array({points.count(), m, m}, values);
  Matrix derivative(model.dimension(), model.dimension());
  for_each_point(
      points, [&](double time, const double* state, const double* input, std::size_t i) {
        model.jacobian(time, state, input, nullptr, derivative);
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            values + i * m * m, derivative.rows(), derivative.cols()) = derivative;
      });
  return result;
}

/// Coefficient and term of every summand, equation by equation, with numbers for parameters.
std::vector<std::vector<std::pair<double, std::string>>> terms(const SystemModel& system) {
  std::vector<std::vector<std::pair<double, std::string>>> result;
  const OdeModel model = system.model();
  for (const Equation& equation : model.equations()) {
    auto& list = result.emplace_back();
    for (const WeightedTerm& summand : equation)
      list.emplace_back(summand.coefficient, summand.term.name());
  }
  return result;
}

SystemModel from_terms(const std::vector<std::string>& states,
                       const std::vector<std::string>& inputs,
                       const std::vector<std::vector<std::pair<double, std::string>>>& terms,
                       const std::string& time_unit, bool is_map) {
  const Variables variables{states, inputs};
  const auto quantities = [](const std::vector<std::string>& headers) {
    std::vector<Quantity> result;
    for (const std::string& header : headers) result.push_back({header, ""});
    return result;
  };
  std::vector<Equation> equations;
  for (const auto& list : terms) {
    Equation& equation = equations.emplace_back();
    for (const auto& [coefficient, term] : list)
      equation.push_back({Term::parse(term, variables), coefficient});
  }
  const OdeModel model(quantities(states), quantities(inputs), std::move(equations), time_unit);
  return model.with_evolution(is_map ? Evolution::Map : Evolution::Flow);
}

std::vector<std::pair<std::string, std::string>> named(
    const std::vector<Quantity>& quantities) {
  std::vector<std::pair<std::string, std::string>> result;
  for (const Quantity& quantity : quantities) result.emplace_back(quantity.name, quantity.unit);
  return result;
}

}  // namespace

void bind_model(nb::module_& module) {
  nb::class_<CompiledModel>(module, "Evaluator", "Right-hand sides at many points.")
      .def(
          "rates", &rates, nb::arg("t"), nb::arg("x"), nb::arg("u"),
          nb::sig("def rates(self, t: typing.Any, x: typing.Any, u: typing.Any) -> typing.Any"))
      .def("jacobians", &jacobians, nb::arg("t"), nb::arg("x"), nb::arg("u"),
           nb::sig("def jacobians(self, t: typing.Any, x: typing.Any, u: typing.Any) -> "
                   "typing.Any"));
  nb::class_<SystemModel>(module, "SystemModel", "Equations in states, inputs and parameters.")
      .def_static("from_text", &parse_ode_system, nb::arg("text"), nb::arg("source"))
      .def_static("from_json", &parse_system, nb::arg("json"), nb::arg("source"))
      .def_static("from_terms", &from_terms, nb::arg("states"), nb::arg("inputs"),
                  nb::arg("terms"), nb::arg("time_unit"), nb::arg("is_map"))
      .def_static(
          "load", [](const std::string& path) { return cli::load_system({path}); },
          nb::arg("path"))
      .def("to_text", &format_ode)
      .def("to_json", &format_model)
      .def(
          "equations",
          [](const SystemModel& self, std::optional<int> digits) {
            return to_text(self.model(), digits);
          },
          nb::arg("digits") = nb::none())
      .def(
          "export",
          [](const SystemModel& self, const std::string& format) {
            return export_model(self.model(), format);
          },
          nb::arg("format"))
      .def("states", [](const SystemModel& self) { return named(self.symbolic().states()); })
      .def("inputs", [](const SystemModel& self) { return named(self.inputs()); })
      .def("terms", &terms)
      .def("parameters",
           [](const SystemModel& self) {
             std::vector<std::pair<std::string, double>> result;
             for (const Parameter& parameter : self.parameters())
               result.emplace_back(parameter.name, parameter.value);
             return result;
           })
      .def("time_unit", [](const SystemModel& self) { return self.symbolic().time_unit(); })
      .def("is_map", [](const SystemModel& self) { return self.symbolic().is_map(); })
      .def("compile", [](const SystemModel& self) { return self.model().compile(); });
  module.def("export_formats", &export_formats);
}

}  // namespace lacuna::python
