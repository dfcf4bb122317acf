// SPDX-License-Identifier: MIT
#include "bases/term_list.hpp"

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Term parse_entry(const std::string& place, const std::string& text,
                 const Variables& variables) {
  try {
    return Term::parse(text, variables);
  } catch (const ModelError& error) {
    throw ModelError(place + ", " + error.where(), error.problem(), error.remedy());
  }
}

}  // namespace

std::vector<Term> parse_term_list(const std::string& place,
                                  const std::vector<std::string>& texts,
                                  const Variables& variables) {
  std::vector<Term> terms;
  terms.reserve(texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i)
    terms.push_back(parse_entry(place + "[" + std::to_string(i) + "]", texts[i], variables));
  return terms;
}

}  // namespace lacuna
