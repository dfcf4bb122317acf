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
  hid_t file_;
};

}  // namespace lacuna::testing
