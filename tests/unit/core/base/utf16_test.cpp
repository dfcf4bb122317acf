// SPDX-License-Identifier: MIT
#include "core/base/utf16.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lacuna {
namespace {

constexpr std::string_view kMarked = "\xEF\xBB\xBF";

TEST(Utf16, CharactersMayBeCutBetweenBlocks) {
  const std::string text("\xFF\xFE\x3D\xD8\x00\xDE!\x00", 8);  // U+1F600
  auto decode = Utf16Decoder::for_text(text);
  std::string result;
  for (const char byte : text) result += (*decode)({&byte, 1});
  EXPECT_EQ(result, std::string(kMarked) + "\xF0\x9F\x98\x80!");
}

TEST(Utf16, HalvesOfPairsAloneAreReplaced) {
  const std::string text("\xFF\xFE\x00\xDC\x3D\xD8!\x00", 8);
  EXPECT_EQ((*Utf16Decoder::for_text(text))(text),
            std::string(kMarked) + "\xEF\xBF\xBD\xEF\xBF\xBD!");
}

}  // namespace
}  // namespace lacuna
