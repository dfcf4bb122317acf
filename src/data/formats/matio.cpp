// SPDX-License-Identifier: MIT
// MATLAB files by matio.
#include <matio.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "mat.hpp"
#include "named_arrays.hpp"

namespace lacuna {
namespace {

struct CloseMatFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

[[noreturn]] void fail(const std::string& source) {
  throw DataError(source, "the MATLAB file is damaged or cut short",
                  "save it again with save('FILE.mat', '-v7.3'), or the columns as .csv");
}

template <class Number>
Matrix matrix_of(const matvar_t& variable) {
  using Values = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  return Eigen::Map<const Values>(static_cast<const Number*>(variable.data),
                                  static_cast<Index>(variable.dims[0]),
                                  static_cast<Index>(variable.dims[1]))
      .template cast<double>();
}

/// Values of a variable; nothing where it is no real array of at most two dimensions.
std::optional<Matrix> values_of(const matvar_t& variable) {
  if (variable.rank != 2 || variable.isComplex != 0 || variable.data == nullptr)
    return std::nullopt;
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return matrix_of<double>(variable);
    case MAT_C_SINGLE:
      return matrix_of<float>(variable);
    case MAT_C_INT8:
      return matrix_of<mat_int8_t>(variable);
    case MAT_C_UINT8:
      return matrix_of<mat_uint8_t>(variable);
    case MAT_C_INT16:
      return matrix_of<mat_int16_t>(variable);
    case MAT_C_UINT16:
      return matrix_of<mat_uint16_t>(variable);
    case MAT_C_INT32:
      return matrix_of<mat_int32_t>(variable);
    case MAT_C_UINT32:
      return matrix_of<mat_uint32_t>(variable);
    case MAT_C_INT64:
      return matrix_of<mat_int64_t>(variable);
    case MAT_C_UINT64:
      return matrix_of<mat_uint64_t>(variable);
    default:
      return std::nullopt;
  }
}

/// A variable with all that is in it.
using OwnedVariable = std::shared_ptr<const matvar_t>;

template <class Whole>
std::function<Stamp(Index, Index)> stamps_of(const matvar_t& variable, OwnedVariable owner) {
  const auto rows = static_cast<Index>(variable.dims[0]);
  return [owner, rows, data = static_cast<const Whole*>(variable.data)](
             Index row, Index column) { return stamp_of(data[column * rows + row]); };
}

/// How its numbers are written: those of 64 bits as whole numbers, which doubles do not hold.
void add_written(const matvar_t& variable, OwnedVariable owner, NamedArray& array) {
  if (variable.class_type == MAT_C_INT64)
    array.stamp = stamps_of<mat_int64_t>(variable, std::move(owner));
  else if (variable.class_type == MAT_C_UINT64)
    array.stamp = stamps_of<mat_uint64_t>(variable, std::move(owner));
  else if (variable.class_type == MAT_C_DOUBLE)
    array.epsilon = std::numeric_limits<double>::epsilon();
  else if (variable.class_type == MAT_C_SINGLE)
    array.epsilon = static_cast<double>(std::numeric_limits<float>::epsilon());
}

double elements_of(const matvar_t& variable) {
  double count = 1.0;
  for (int d = 0; d < variable.rank; ++d) count *= static_cast<double>(variable.dims[d]);
  return count;
}

/// matio only warns where numbers are missing in a file, and leaves them as they are in memory.
class Warnings {
 public:
  Warnings() {
    seen_ = false;
    Mat_LogInitFunc("lacuna", [](int, char*) { seen_ = true; });
  }
  bool seen() const noexcept { return seen_; }

 private:
  static thread_local bool seen_;
};

thread_local bool Warnings::seen_ = false;

bool is_structure(const matvar_t& variable) {
  return variable.class_type == MAT_C_STRUCT && variable.data != nullptr;
}

/// A cell array, of runs for instance.
bool is_cells(const matvar_t& variable) {
  return variable.class_type == MAT_C_CELL && variable.data != nullptr;
}

/// The name of one of several elements: "run1", "run2"; the only one has the name alone.
std::string name_of_element(const std::string& name, std::size_t element, std::size_t count) {
  return count == 1 ? name : name + std::to_string(element + 1);
}

/// What is found in a file.
struct Found {
  std::vector<NamedArray> arrays;
  std::vector<std::string> others;  ///< names of variables that are no arrays of numbers
};

void collect(const matvar_t& variable, const OwnedVariable& owner, const std::string& name,
             Found& found);

/// Adds what stands in the fields of a structure, or of each of an array of them.
void collect_fields(const matvar_t& variable, const OwnedVariable& owner,
                    const std::string& name, Found& found) {
  auto* structure = const_cast<matvar_t*>(&variable);  // matio's getters only read
  const char* const* fields = Mat_VarGetStructFieldnames(structure);
  const std::size_t count = Mat_VarGetNumberOfFields(structure);
  const auto elements = static_cast<std::size_t>(elements_of(variable));
  for (std::size_t i = 0; i < elements; ++i)
    for (std::size_t f = 0; f < count; ++f)
      if (const matvar_t* field = Mat_VarGetStructFieldByIndex(structure, f, i))
        collect(*field, owner, name_of_element(name, i, elements) + "." + fields[f], found);
}

/// Adds what stands in the cells of an array.
void collect_cells(const matvar_t& variable, const OwnedVariable& owner,
                   const std::string& name, Found& found) {
  auto* cells = const_cast<matvar_t*>(&variable);  // matio's getters only read
  const auto elements = static_cast<std::size_t>(elements_of(variable));
  for (std::size_t i = 0; i < elements; ++i)
    if (const matvar_t* cell = Mat_VarGetCell(cells, static_cast<int>(i)))
      collect(*cell, owner, name_of_element(name, i, elements), found);
}

void collect(const matvar_t& variable, const OwnedVariable& owner, const std::string& name,
             Found& found) {
  if (is_structure(variable)) {
    collect_fields(variable, owner, name, found);
  } else if (is_cells(variable)) {
    collect_cells(variable, owner, name, found);
  } else if (std::optional<Matrix> values = values_of(variable)) {
    found.arrays.push_back({name, std::move(*values)});
    add_written(variable, owner, found.arrays.back());
  } else {
    found.others.push_back(name);
  }
}

/// Whether a file of so many bytes can hold a variable. What is damaged may say any number.
bool can_hold(std::size_t file_bytes, const matvar_t& variable) {
  constexpr double kPacked =
      1032.0;  // zlib makes one byte of so many at most (its documentation)
  if (elements_of(variable) > kPacked * static_cast<double>(file_bytes)) return false;
  if (!is_structure(variable)) return true;
  auto* structure = const_cast<matvar_t*>(&variable);
  const std::size_t count = Mat_VarGetNumberOfFields(structure);
  const auto elements = static_cast<std::size_t>(elements_of(variable));
  for (std::size_t i = 0; i < elements; ++i)
    for (std::size_t f = 0; f < count; ++f)
      if (const matvar_t* field = Mat_VarGetStructFieldByIndex(structure, f, i))
        if (!can_hold(file_bytes, *field)) return false;
  return true;
}

}  // namespace

Table read_mat(const std::filesystem::path& path, const TimeFinder& find) {
  const std::string source = path.string();
  const Warnings warnings;
  const std::unique_ptr<mat_t, CloseMatFile> file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!file) fail(source);
  Found found;
  const auto bytes = static_cast<std::size_t>(std::filesystem::file_size(path));
  while (const std::shared_ptr<matvar_t> variable{Mat_VarReadNextInfo(file.get()),
                                                  FreeVariable()}) {
    if (variable->name == nullptr) fail(source);
    if (!can_hold(bytes, *variable))
      throw DataError(source,
                      "the variable '" + std::string(variable->name) + "' is said to have " +
                          format_number(elements_of(*variable)) +
                          " numbers, more than a file of " + std::to_string(bytes) +
                          " bytes can hold",
                      "the file is damaged; save it again");
    if (Mat_VarReadDataAll(file.get(), variable.get()) != 0) fail(source);
    collect(*variable, variable, variable->name, found);
  }
  if (warnings.seen()) fail(source);
  Table table = table_of_arrays(found.arrays, source, find);
  for (const std::string& name : found.others)
    table.notes.push_back(source + ": the variable '" + name +
                          "' is neither a vector nor a matrix of real numbers and is left out");
  return table;
}

}  // namespace lacuna
