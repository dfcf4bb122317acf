// SPDX-License-Identifier: MIT
// Without matio.
#include "lacuna/core/error.hpp"
#include "mat.hpp"

namespace lacuna {

Table read_mat(const std::filesystem::path& path) {
  throw DataError(path.string(),
                  "this program was built without matio, which reads MATLAB files",
                  "build it with matio (libmatio-dev), or save the columns as .csv");
}

}  // namespace lacuna
