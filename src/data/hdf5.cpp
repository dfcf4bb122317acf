// SPDX-License-Identifier: MIT
#include "hdf5.hpp"

#include <hdf5.h>

#include <utility>
#include <vector>

#include "lacuna/core/error.hpp"
#include "named_arrays.hpp"

namespace lacuna {
namespace {

/// A number by which HDF5 knows something that is open, closed with this object.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  bool is_open() const noexcept { return id_ >= 0; }
  hid_t get() const noexcept { return id_; }

 private:
  hid_t id_;
  Close close_;
};

[[noreturn]] void fail(const std::string& source) {
  throw DataError(source, "the HDF5 file is damaged or cut short",
                  "make or copy the file again, or save the columns as .csv");
}

/// The file, out of its bytes in memory.
Handle open_file(std::string_view bytes, const std::string& source) {
  constexpr std::size_t kIncrement = std::size_t{1} << 20U;  // asked for; it never grows
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.get(), kIncrement, 0);
  H5Pset_file_image(access.get(), const_cast<char*>(bytes.data()), bytes.size());  // is copied
  // A name that no file has.
  return {H5Fopen((source + "/in memory").c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
}

/// Rows and columns of a data set; no columns where it has more dimensions.
std::pair<hsize_t, hsize_t> extent_of(const Handle& set) {
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank != 1 && rank != 2) return {0, 0};
  hsize_t sizes[2] = {0, 1};
  H5Sget_simple_extent_dims(space.get(), sizes, nullptr);
  return {sizes[0], sizes[1]};
}

bool has_real_numbers(const Handle& set) {
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

/// What is found in a file.
struct Found {
  std::vector<NamedArray> arrays;
  std::vector<std::string> others;  ///< names of data sets that are no arrays of numbers
};

void collect_set(const Handle& set, const std::string& name, const std::string& source,
                 Found& found) {
  const auto [rows, columns] = extent_of(set);
  if (columns == 0 || !has_real_numbers(set)) {
    found.others.push_back(name);
    return;
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(
      static_cast<Index>(rows), static_cast<Index>(columns));
  if (H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(source);
  found.arrays.push_back({name, values});
}

/// Data sets of a group and of the groups in it.
void collect_group(const Handle& group, const std::string& before, int depth,
                   const std::string& source, Found& found) {
  constexpr int kDeepest = 16;  // links may lead in a circle
  H5G_info_t info{};
  if (depth > kDeepest || H5Gget_info(group.get(), &info) < 0) fail(source);
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    char link[1024] = "";
    if (H5Lget_name_by_idx(group.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i, link, sizeof link,
                           H5P_DEFAULT) < 0)
      fail(source);
    if (link[0] == '#') continue;  // MATLAB's own: contents of cells
    const Handle object(H5Oopen(group.get(), link, H5P_DEFAULT), H5Oclose);
    const std::string name = before + link;
    const H5I_type_t kind = object.is_open() ? H5Iget_type(object.get()) : H5I_BADID;
    if (kind == H5I_GROUP)
      collect_group(object, name + ".", depth + 1, source, found);
    else if (kind == H5I_DATASET)
      collect_set(object, name, source, found);
    else
      found.others.push_back(name);
  }
}

}  // namespace

Table parse_hdf5(std::string_view bytes, const std::string& source) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are told by us
  const Handle file = open_file(bytes, source);
  if (!file.is_open()) fail(source);
  const Handle root(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose);
  if (!root.is_open()) fail(source);
  Found found;
  collect_group(root, "", 0, source, found);
  Table table = table_of_arrays(std::move(found.arrays), source);
  for (const std::string& name : found.others)
    table.notes.push_back(source + ": the data set '" + name +
                          "' is neither a vector nor a matrix of real numbers and is left out");
  return table;
}

}  // namespace lacuna
