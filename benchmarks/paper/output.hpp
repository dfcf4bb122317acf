// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {

/// The folder the results go to, and the page that shows them all, report.md.
class Output {
 public:
  explicit Output(std::filesystem::path folder);

  const std::filesystem::path& folder() const noexcept { return folder_; }

  /// A chapter with a text of its own.
  void chapter(const std::string& title, const std::string& text);

  /// `stem`.csv and `stem`.md, and the table in the report.
  void table(const std::string& stem, const std::string& title, const ResultTable& table);

  /// Numbers for pictures: `stem`.csv with one column per name.
  void data(const std::string& stem, const std::vector<std::string>& names,
            const Matrix& columns);

  /// `stem`.gp and, where gnuplot is installed, `stem`.png of the given size in pixels.
  void picture(const std::string& stem, const std::string& title, int width, int height,
               const std::string& script);

  /// Says in the report what was not made, and why.
  void skip(const std::string& what, const std::string& reason);

  /// Writes report.md. @return what was skipped, one sentence each.
  std::vector<std::string> finish(double seconds);

 private:
  std::filesystem::path folder_;
  std::string report_;
  std::vector<std::string> skipped_;
};

/// A number with four significant digits.
std::string cell(double value);

/// found / printed.
std::string ratio_cell(double found, double printed);

}  // namespace lacuna::benchmarks
