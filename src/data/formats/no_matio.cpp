// SPDX-License-Identifier: MIT
// Without matio.
#include "lacuna/core/base/error.hpp"
#include "mat.hpp"

namespace lacuna {

Table read_mat(const std::filesystem::path& path, const TimeFinder&) {
  throw DataError(path.string(),
                  "this is a MATLAB file, and the program was built without matio",
                  "build it with matio (libmatio-dev), or save the columns as .csv");
}

}  // namespace lacuna
