// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace lacuna::benchmarks {

/// A grey box with known numbers.
struct GreyBox {
  std::string name;
  std::string text;           ///< model with the true numbers, as text
  std::vector<double> start;  ///< true initial state
  double step = 0.05;
  int samples = 600;
  bool hidden = false;  ///< whether a state is neither measured nor made of one that is
  bool exact = false;   ///< whether steps of the samples are too long for its record
};

/// Twenty problems, ten of them with hidden states, four chaotic records and a chain of thirty
/// reactions; every free number is determined.
std::vector<GreyBox> grey_boxes();

}  // namespace lacuna::benchmarks
