// SPDX-License-Identifier: MIT
#include "core/base/utf16.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lacuna {
namespace {

constexpr std::string_view kMarked = "\xEF\xBB\xBF";

TEST(Utf16, BothOrdersOfBytes) {
  const std::string low("\xFF\xFE\x41\x00\xE9\x00\xAC\x20", 8);
  const std::string high("\xFE\xFF\x00\x41\x00\xE9\x20\xAC", 8);
  for (const std::string& text : {low, high}) {
    auto decode = Utf16Decoder::for_text(text);
    ASSERT_TRUE(decode);
    EXPECT_EQ((*decode)(text), std::string(kMarked) + "A\xC3\xA9\xE2\x82\xAC");
  }
}

TEST(Utf16, OtherTextsHaveNoDecoder) {
  for (const std::string_view text : {"t,x\n", "\xEF\xBB\xBFt", "\xFF", ""})
    EXPECT_FALSE(Utf16Decoder::for_text(text));
}

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
