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

std::function<void(const Progress&)> beside(FirstScreen& screen,
                                            std::function<void(const Progress&)> shown) {
  return [&screen, shown = std::move(shown)](const Progress& progress) {
    screen.show(std::chrono::steady_clock::now());
    shown(progress);
  };
}

}  // namespace lacuna::cli
