// SPDX-License-Identifier: MIT
// HDF5 files, made by the library itself.
#pragma once

#include <hdf5.h>

#include <string>
#include <vector>

namespace lacuna::testing {

/// A new file, open until this object goes.
class WrittenHdf5 {
 public:
  explicit WrittenHdf5(const std::string& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
  WrittenHdf5(const WrittenHdf5&) = delete;
  WrittenHdf5& operator=(const WrittenHdf5&) = delete;
  ~WrittenHdf5() { H5Fclose(file_); }

  /// Adds rows x columns numbers of a type in memory and in the file; one column: a vector.
  void add(const std::string& name, hid_t type, const void* numbers, hsize_t rows,
           hsize_t columns = 1) const {
    const hsize_t sizes[2] = {rows, columns};
    const hid_t space = H5Screate_simple(columns == 1 ? 1 : 2, sizes, nullptr);
    const hid_t set =
        H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers);
    H5Dclose(set);
    H5Sclose(space);
  }

  /// Adds n numbers that stand in another file, from its first byte on.
  void add_stored_elsewhere(const std::string& name, const std::string& file, hsize_t n) const {
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(made, file.c_str(), 0, H5F_UNLIMITED);
    add_empty(name, made, n);
  }

  /// Adds n numbers that are those of a data set of a file ("." is this one).
  void add_virtual(const std::string& name, const std::string& file, const std::string& set,
                   hsize_t n) const {
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t space = H5Screate_simple(1, &n, nullptr);
    H5Pset_virtual(made, space, file.c_str(), set.c_str(), space);
    H5Sclose(space);
    add_empty(name, made, n);
  }

  void add_group(const std::string& name) const {
    H5Gclose(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }

  void add_soft_link(const std::string& name, const std::string& target) const {
    H5Lcreate_soft(target.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  }

  void add_external_link(const std::string& name, const std::string& file,
                         const std::string& target) const {
    H5Lcreate_external(file.c_str(), target.c_str(), file_, name.c_str(), H5P_DEFAULT,
                       H5P_DEFAULT);
  }

 private:
  /// @param made how it is made, which is closed.
  void add_empty(const std::string& name, hid_t made, hsize_t n) const {
    const hid_t space = H5Screate_simple(1, &n, nullptr);
    H5Dclose(H5Dcreate2(file_, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, made,
                        H5P_DEFAULT));
    H5Sclose(space);
    H5Pclose(made);
  }

  hid_t file_;
};

}  // namespace lacuna::testing
