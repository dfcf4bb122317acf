// SPDX-License-Identifier: MIT
#include "utf16.hpp"

#include <utility>

#include "utf8.hpp"

namespace lacuna {
namespace {

// Facts of Unicode.
constexpr char32_t kReplacement = 0xFFFD, kHighBegin = 0xD800, kLowBegin = 0xDC00,
                   kLowEnd = 0xE000, kFirstPair = 0x10000;

}  // namespace

std::optional<Utf16Decoder> Utf16Decoder::for_text(std::string_view begin) {
  if (begin.starts_with("\xFF\xFE")) return Utf16Decoder(true);
  if (begin.starts_with("\xFE\xFF")) return Utf16Decoder(false);
  return std::nullopt;
}

std::string Utf16Decoder::operator()(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() / 2 + 1);
  for (const char byte : bytes) {
    if (!byte_) {
      byte_ = byte;
      continue;
    }
    const auto first = static_cast<unsigned char>(*byte_);
    const auto second = static_cast<unsigned char>(byte);
    byte_.reset();
    take(low_first_ ? first | second << 8U : second | first << 8U, text);
  }
  return text;
}

void Utf16Decoder::take(char32_t unit, std::string& text) {
  const bool is_low = unit >= kLowBegin && unit < kLowEnd;
  const auto high = std::exchange(high_, std::nullopt);
  if (high && is_low) {
    text += utf8_of(kFirstPair + ((*high - kHighBegin) << 10U) + (unit - kLowBegin));
    return;
  }
  if (high) text += utf8_of(kReplacement);
  if (unit >= kHighBegin && unit < kLowBegin)
    high_ = unit;
  else
    text += utf8_of(is_low ? kReplacement : unit);
}

}  // namespace lacuna
