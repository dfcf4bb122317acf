// SPDX-License-Identifier: MIT
// Without HDF5.
#include "hdf5.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {

namespace {

[[noreturn]] void fail_without_hdf5(const std::string& source) {
  throw DataError(source, "this is an HDF5 file, and the program was built without HDF5",
                  "build it with HDF5 (libhdf5-dev), or save the columns as .csv");
}

}  // namespace

Table parse_hdf5(std::string_view, const std::string& source, const TimeFinder&) {
  fail_without_hdf5(source);
}

std::unique_ptr<RowBlocks> hdf5_blocks(const std::filesystem::path& path, BlockSizes,
                                       const TimeFinder&) {
  fail_without_hdf5(path.string());
}

}  // namespace lacuna
