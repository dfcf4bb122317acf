// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/random.hpp"

namespace lacuna::testing {

/// A copy with one to six random changes: a byte replaced, inserted or removed, a piece cut
/// off, a piece repeated.
/// @param alphabet bytes to put in.
inline std::string mutated(std::string text, std::string_view alphabet, Random& random) {
  const auto changes = 1 + random.below(6);
  for (std::uint64_t i = 0; i < changes && !text.empty(); ++i) {
    const std::size_t at = random.below(text.size());
    const char byte = alphabet[random.below(alphabet.size())];
    switch (random.below(6)) {
      case 0:
        text.insert(at, 1, byte);
        break;
      case 1:
        text.erase(at, 1);
        break;
      case 2:
        text.erase(at, random.below(12));
        break;
      case 3:
        text.insert(at, text.substr(random.below(text.size()), random.below(12)));
        break;
      case 4:
        if (random.below(8) == 0) text.resize(at);
        break;
      default:
        text[at] = byte;
    }
  }
  return text;
}

}  // namespace lacuna::testing
