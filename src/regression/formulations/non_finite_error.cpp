// SPDX-License-Identifier: MIT
#include "non_finite_error.hpp"

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {

void throw_non_finite(const NonFiniteEntry& entry) {
  const std::string where = entry.term.empty() ? "derivative" : "term '" + entry.term + "'";
  const std::string source = entry.source.empty() ? "" : " of " + entry.source;
  const std::string values = entry.values.empty() ? "" : ", " + entry.values;
  throw DataError(where,
                  "is not finite at sample " + std::to_string(entry.sample + 1) + source +
                      " (t = " + format_number(entry.time, 8) + values + ")",
                  "leave the term out or cut the record there");
}

}  // namespace lacuna
