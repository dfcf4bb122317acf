// SPDX-License-Identifier: MIT
// Without HDF5.
#include "hdf5.hpp"
#include "lacuna/core/error.hpp"

namespace lacuna {

Table parse_hdf5(std::string_view, const std::string& source) {
  throw DataError(source, "this is an HDF5 file, and the program was built without HDF5",
                  "build it with HDF5 (libhdf5-dev), or save the columns as .csv");
}

}  // namespace lacuna
