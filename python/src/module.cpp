// SPDX-License-Identifier: MIT
// The extension module lacuna._lacuna. Python adds no mathematics: what is here hands arguments
// to the library and values back.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "call.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/roles.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna::python {
namespace {

using Column = nb::ndarray<const double, nb::ndim<1>, nb::device::cpu>;

/// Raises lacuna.errors.NAME(where, problem, remedy).
void raise(const char* name, const Error& error) {
  const nb::object type = nb::module_::import_("lacuna.errors").attr(name);
  const nb::object value = type(error.where(), error.problem(), error.remedy());
  PyErr_SetObject(type.ptr(), value.ptr());
}

void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const DataError& error) {
    raise("DataError", error);
  } catch (const ConfigError& error) {
    raise("ConfigError", error);
  } catch (const ModelError& error) {
    raise("ModelError", error);
  } catch (const ArgumentError& error) {
    raise("ArgumentError", error);
  } catch (const FileError& error) {
    raise("FileError", error);
  } catch (const Error& error) {
    raise("Error", error);
  }
}

/// A table with names from headers such as "x [V]"; a unit that is given goes before.
Table make_table(std::string source, const std::vector<std::string>& headers,
                 const std::vector<std::string>& units, Index rows) {
  Table table;
  table.source = std::move(source);
  std::vector<Quantity> columns;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    columns.push_back(split_header(headers[i]));
    if (!units.at(i).empty()) columns.back().unit = units[i];
  }
  table.values.resize(rows, static_cast<Index>(columns.size()));
  name_columns(table, columns, std::nullopt);
  return table;
}

void fill(Table& table, Index column, const Column& values) {
  if (column < 0 || column >= table.values.cols() ||
      static_cast<Index>(values.shape(0)) != table.values.rows())
    throw ArgumentError(table.source, "the columns have different numbers of values",
                        "give arrays of one length");
  const auto view = values.view();
  for (Index i = 0; i < table.values.rows(); ++i)
    table.values(i, column) = view(static_cast<std::size_t>(i));
}

/// The number of the column that is the time by its name, as in a file with these headers.
std::optional<Index> time_column(const std::vector<std::string>& headers) {
  std::vector<std::string> all = headers;
  all.emplace_back("any state [1]");  // as there is no record without one
  const Table table = make_table("frame", all, std::vector<std::string>(all.size()), 0);
  ColumnRoles roles;
  roles.states = {table.columns.back().name};
  const ColumnIndices found = find_columns(table, roles);
  return found.time_by_position ? std::nullopt : found.time;
}

std::vector<std::string> units_of_columns(const Table& table) {
  std::vector<std::string> units;
  for (const Quantity& column : table.columns) units.push_back(column.unit);
  return units;
}

}  // namespace

const Registry& registry() {
  static const auto* const instance = new Registry(default_registry());  // work may outlive it
  return *instance;
}

void bind_errors(nb::module_&) { nb::register_exception_translator(translate); }

void bind_tables(nb::module_& module) {
  nb::class_<Table>(module, "Table", "Columns of numbers with names and units, rows x columns.")
      .def(nb::new_(&make_table), nb::arg("source"), nb::arg("headers"), nb::arg("units"),
           nb::arg("rows"))
      .def("fill", &fill, nb::arg("column"), nb::arg("values"),
           "Copy an array of any strides into one column.")
      .def_ro("source", &Table::source)
      .def_ro("headers", &Table::headers, "Names of the columns as they were given.")
      .def_prop_ro(
          "names", [](const Table& self) { return names_of(self.columns); },
          "Names of the columns as the library has them.")
      .def_prop_ro("units", &units_of_columns)
      .def_prop_ro("values", [](const Table& self) { return array_of(self.values); });
  module.def("time_column", &time_column, nb::arg("headers"),
             "The number of the column whose name says that it is the time.");
}

}  // namespace lacuna::python

NB_MODULE(_lacuna_of_process, module) {
  using namespace lacuna::python;
  module.doc() = "The library in process: arguments in, values out.";
  bind_errors(module);
  bind_tables(module);
  bind_model(module);
  bind_stages(module);
  bind_answers(module);
  bind_designs(module);
  module.def("wait_for_abandoned_work", &wait_for_abandoned_work,
             "Wait for calls that were interrupted and have not ended yet.");
  module.attr("version") = LACUNA_VERSION;
  module.attr("back_ends") = LACUNA_BACK_ENDS;
  module.attr("compiler") = LACUNA_COMPILER;
}

/// The module in the first interpreter of a process. nanobind has one state for all of them,
/// which the module of a second one would replace.
extern "C" NB_EXPORT PyObject* PyInit__lacuna() {
  if (PyInterpreterState_GetID(PyInterpreterState_Get()) == 0)
    return PyInit__lacuna_of_process();
  PyErr_SetString(PyExc_ImportError,
                  "lacuna works in the first interpreter of a process only, as NumPy does; use "
                  "threads or multiprocessing");
  return nullptr;
}
