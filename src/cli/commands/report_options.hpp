// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/model/equations/rounding.hpp"
#include "report/pages/page.hpp"

namespace lacuna::cli {

/// Where a page and its pictures go.
struct ReportOptions {
  std::optional<std::string> page;      ///< HTML file
  std::optional<std::string> pictures;  ///< folder
  bool open = false;                    ///< shows the page in a browser
};

/// The options `--report`, `--open` and `--plot`.
void declare_report_options(Command& command, ReportOptions& options);

/// The option `--digits`. @param description of what has them.
void declare_digits_option(Command& command, Digits& digits,
                           const std::string& description =
                               "Digits of a model's numbers in text and .ode files: auto "
                               "(two of the 95 % interval), full, or so many; JSON has "
                               "all [default: auto]");

/// A model as a file of that name holds it: text (.ode), which people read, with these digits,
/// JSON with all.
std::string model_text(const std::string& path, const SystemModel& model, const Digits& digits);

/// @throws ConfigError where a browser is asked for and there is no file to show.
void check_open(const ReportOptions& options);

/// Writes what is asked for; the page is only made then. The folder is made where there is
/// none. Where no browser can be opened that is said, and the file is there.
void write_report(const Session& session, const ReportOptions& options,
                  FunctionRef<Page()> make_page);

}  // namespace lacuna::cli
