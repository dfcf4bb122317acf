// SPDX-License-Identifier: MIT
#include "first_screen.hpp"

#include "core/base/utf8.hpp"

namespace lacuna::cli {

void FirstScreen::show(Time now) {
  // A decision: at half the time both answers pass at once, at double people wait for none.
  constexpr std::chrono::seconds kSoon{1};
  if (text_.empty() || now - begin_ < kSoon) return;
  stream_ << "\r\x1b[K" << printable(text_) << std::flush;
  text_.clear();
}

}  // namespace lacuna::cli
