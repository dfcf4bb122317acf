// SPDX-License-Identifier: MIT
#include "lacuna/core/base/error.hpp"

#include <utility>

namespace lacuna {
namespace {

std::string one_line(const std::string& where, const std::string& problem,
                     const std::string& remedy) {
  std::string line = where.empty() ? problem : where + ": " + problem;
  if (!remedy.empty()) line += "; " + remedy;
  return line;
}

}  // namespace

Error::Error(std::string where, std::string problem, std::string remedy)
    : std::runtime_error(one_line(where, problem, remedy)),
      where_(std::move(where)),
      problem_(std::move(problem)),
      remedy_(std::move(remedy)) {}

}  // namespace lacuna
