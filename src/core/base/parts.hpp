// SPDX-License-Identifier: MIT
// Work in parts that the members of a team divide among them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Parts first .. end - 1 of so many: those of one member. Members have neighbours, in order.
struct OwnParts {
  std::size_t first = 0;
  std::size_t end = 0;
};

OwnParts parts_of(int member, std::size_t parts, const RunContext& context);

/// Those of this process.
OwnParts own_parts(std::size_t parts, const RunContext& context);

/// Calls work(i) for the parts that are this process' own, on the threads of the context.
void for_each_own_part(std::size_t parts, const RunContext& context,
                       FunctionRef<void(std::size_t)> work);

/// Gives every member of the team the numbers of all parts, as those have them who made them.
/// @param numbers of a part; the same count in every member.
void exchange_parts(std::size_t parts, const RunContext& context,
                    FunctionRef<std::span<double>(std::size_t)> numbers);

/// The same for a text of each part.
void exchange_texts(std::vector<std::string>& texts, const RunContext& context);

/// The numbers of a matrix or a vector.
template <class Dense>
std::span<double> numbers_of(Dense& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

}  // namespace lacuna
