// SPDX-License-Identifier: MIT
#include "diagnosis_sentences.hpp"
#include "lacuna/report/reports.hpp"

namespace lacuna {

std::string format_text(const Diagnosis& diagnosis) {
  const DiagnosisSentences all = sentences_of(diagnosis);
  std::string text;
  for (const std::string& hint : all.hints) text += hint + "\n";
  text += all.headline + "\n";
  for (const std::string& finding : all.findings) text += finding + "\n";
  for (const std::string& note : all.notes) text += "Note: " + note + "\n";
  return text;
}

}  // namespace lacuna
