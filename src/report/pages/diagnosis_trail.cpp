// SPDX-License-Identifier: MIT
// Every composite model that was judged, as a table for people.
#include <algorithm>

#include "core/base/text.hpp"
#include "diagnosis_sentences.hpp"
#include "lacuna/report/reports.hpp"

namespace lacuna {
namespace {

/// "criterion 812.3 against 790.1", or the rule that went before the number.
std::string reason(const Rival& rival) {
  if (!rival.rule.empty()) return rival.rule;
  return rival.quantity + " " + format_number(rival.value, 6) + " against " +
         format_number(rival.threshold, 6);
}

}  // namespace

std::string format_trail(const Diagnosis& diagnosis) {
  std::size_t width = 0;
  for (const Rival& rival : diagnosis.rivals) width = std::max(width, rival.hypothesis.size());
  std::string text =
      "Composite models of the records, in the order in which they were judged:\n";
  for (const Rival& rival : diagnosis.rivals)
    text += std::string(rival.taken ? "  + " : "  - ") + padded(rival.hypothesis, width) +
            "  " + readable_formula(rival.composite, {}) + "\n      " + reason(rival) + "\n";
  return text + "(+ taken over what was best before, - not taken)\n";
}

}  // namespace lacuna
