// SPDX-License-Identifier: MIT
#include "folded_text.hpp"

#include <algorithm>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

/// "a.csv:97:3" and what is said of it; the place of a sentence without one is empty.
struct Said {
  std::vector<std::string> places;
  std::string what;
};

Said parts_of(const std::string& sentence) {
  const std::size_t end = sentence.find(": ");
  if (end == std::string::npos) return {{}, sentence};
  return {{sentence.substr(0, end)}, sentence.substr(end)};
}

}  // namespace

std::string briefly(const std::vector<std::string>& names, const std::string& separator) {
  return names.size() > 2 ? names.front() + " and " + std::to_string(names.size() - 1) + " more"
                          : join(names, separator);
}

std::vector<std::string> said_once(const std::vector<std::string>& sentences) {
  std::vector<Said> all;
  for (const std::string& sentence : sentences) {
    const Said next = parts_of(sentence);
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const Said& one) { return one.what == next.what; });
    if (same == all.end()) {
      all.push_back(next);
    } else {
      for (const std::string& place : next.places)
        if (std::find(same->places.begin(), same->places.end(), place) == same->places.end())
          same->places.push_back(place);
    }
  }
  std::vector<std::string> result;
  for (const Said& one : all) result.push_back(briefly(one.places) + one.what);
  return result;
}

}  // namespace lacuna
