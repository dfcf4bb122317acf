// SPDX-License-Identifier: MIT
// A file of the C library that closes itself.
#pragma once

#include <cstdio>
#include <memory>

namespace lacuna {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

using File = std::unique_ptr<std::FILE, CloseFile>;

}  // namespace lacuna
