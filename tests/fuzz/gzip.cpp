// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "core/files/file_bytes.hpp"
#include "fuzz/target.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna::fuzz {

std::vector<std::string> seeds() {
  const std::string text = "t,x\n0,1\n1,2\n2,3\n";
  return {gzip(text), gzip(text) + gzip(text), gzip(std::string(5000, 'a')), gzip("")};
}

void take(std::string_view input) {
  try {
    gunzip(input, "input");
  } catch (const Error&) {
  }
  if (gunzip(gzip(input), "input").view() != input) std::abort();
}

}  // namespace lacuna::fuzz
