// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

/// A ModelError that knows the column in the formula, for callers that know where the formula
/// is.
class FormulaError : public ModelError {
 public:
  /// @param column from 1.
  FormulaError(std::string_view formula, std::size_t column, const std::string& problem,
               const std::string& remedy);

  std::size_t column() const noexcept { return column_; }

 private:
  std::size_t column_;
};

}  // namespace lacuna
