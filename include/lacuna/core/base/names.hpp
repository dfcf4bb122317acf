// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace lacuna {

/// Whether a text is an identifier: a letter or underscore, then letters, digits, underscores
/// (ASCII, whatever the locale).
bool is_identifier(std::string_view text) noexcept;

/// Whether a name is a word of the expression language (`sin`, `pi`, `t`, ...), so that no
/// state and no input can have it.
bool is_reserved_name(std::string_view name) noexcept;

}  // namespace lacuna
