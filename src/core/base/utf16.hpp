// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lacuna {

/// Makes UTF-8 of a text in UTF-16 that begins with a byte order mark, as "Unicode text" of
/// Excel does. Bytes come in blocks that may end within a character.
class Utf16Decoder {
 public:
  /// The decoder of a text; nothing for one that does not begin with such a mark.
  static std::optional<Utf16Decoder> for_text(std::string_view begin);

  /// The next bytes as UTF-8, the mark too. Halves of surrogate pairs that stand alone become
  /// U+FFFD.
  std::string operator()(std::string_view bytes);

 private:
  explicit Utf16Decoder(bool low_first) : low_first_(low_first) {}

  void take(char32_t unit, std::string& text);

  bool low_first_;
  std::optional<char> byte_ = {};      ///< the first one of a unit whose second one comes
  std::optional<char32_t> high_ = {};  ///< the first half of a surrogate pair
};

}  // namespace lacuna
