// SPDX-License-Identifier: MIT
#include "questions.hpp"

#include <istream>
#include <optional>
#include <ostream>

#include "core/base/text.hpp"
#include "core/base/utf8.hpp"

namespace lacuna::cli {
namespace {

/// The choice that an answer is, or of which alone it is the beginning.
std::optional<std::string> chosen(const std::string& answer,
                                  const std::vector<std::string>& choices) {
  std::optional<std::string> found;
  for (const std::string& choice : choices) {
    if (choice == answer) return choice;
    if (!choice.starts_with(answer)) continue;
    if (found) return std::nullopt;
    found = choice;
  }
  return found;
}

}  // namespace

Questions::Questions(std::ostream& out, std::istream* answers) : out_(out), answers_(answers) {}

std::string Questions::ask(const std::string& question, const std::string& proposed) {
  out_ << printable(question) << " [" << printable(proposed) << "]: " << std::flush;
  std::string line;
  if (answers_ == nullptr || !std::getline(*answers_, line)) {
    out_ << printable(proposed) << "\n";
    return proposed;
  }
  const std::string answer(trim(line));
  return answer.empty() ? proposed : answer;
}

std::string Questions::choose(const std::string& question,
                              const std::vector<std::string>& choices,
                              const std::string& proposed) {
  const std::string names = join(choices, ", ");
  for (;;) {
    const std::string answer = ask(question + " (" + names + ")", proposed);
    if (const auto choice = chosen(answer, choices)) return *choice;
    remark("'" + answer + "' is none of " + names);
  }
}

void Questions::remark(const std::string& text) { out_ << "  " << printable(text) << "\n"; }

}  // namespace lacuna::cli
