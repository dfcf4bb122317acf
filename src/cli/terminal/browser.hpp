// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace lacuna::cli {

/// Shows a file in a browser: by the program in BROWSER, else by xdg-open or open. No shell reads
/// the name.
/// @return whether that program was there and succeeded.
bool open_in_browser(const std::filesystem::path& file);

}  // namespace lacuna::cli
