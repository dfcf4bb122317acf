// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/plot/figure.hpp"

namespace lacuna {

/// A table of numbers as shaded cells, the darker the larger the shade.
struct HeatFigure {
  std::string name, title;
  std::vector<std::string> rows, columns;
  std::vector<std::vector<std::string>> texts;                 ///< row by row, in the cells
  std::vector<std::vector<std::optional<double>>> shades = {};  ///< 0..1; nothing: left empty
};

/// The picture; its numbers are those of a figure of rows, one for each cell.
/// @throws ArgumentError when texts or shades are not one for each cell.
Picture draw(const HeatFigure& figure);

}  // namespace lacuna
