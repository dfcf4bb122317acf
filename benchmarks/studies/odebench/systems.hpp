// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna::odebench {

/// A system with its two solutions.
struct System {
  std::string name;
  Vector time;
  std::array<Matrix, 2> states;  ///< n x m
};

/// Systems of a file: JSON as ODEBench has it (may be packed by gzip), or, where it ends in
/// ".txt", blocks of text that are solved here:
///   system NAME / AREA / SOURCE
///   span T              512 samples on [0, T]
///   start X0, Y0, ...   twice
///   dx/dt = ...         a text model
/// @throws FileError, ModelError, DataError where it is none.
std::vector<System> read_systems(const std::filesystem::path& path);

}  // namespace lacuna::odebench
