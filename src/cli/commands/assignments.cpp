// SPDX-License-Identifier: MIT
#include "assignments.hpp"

#include <algorithm>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna::cli {
namespace {

Assignment assignment_of(const AssignmentForm& form, const std::string& part) {
  const std::size_t equals = part.find('=');
  const std::string_view text = part;
  const std::string name(trim(text.substr(0, equals)));
  if (equals == std::string::npos || name.empty())
    throw ConfigError(std::string(form.option) + " " + part,
                      "this is not " + std::string(form.form),
                      "write e.g. " + std::string(form.example));
  return {part, name, std::string(trim(text.substr(equals + 1)))};
}

}  // namespace

std::vector<Assignment> read_assignments(const AssignmentForm& form,
                                         const std::vector<std::string>& texts) {
  std::vector<Assignment> assignments;
  for (const std::string& text : texts)
    for (const std::string& part : split_list(text)) {
      Assignment next = assignment_of(form, part);
      const auto same =
          std::find_if(assignments.begin(), assignments.end(),
                       [&](const Assignment& other) { return other.name == next.name; });
      if (same != assignments.end())
        throw ConfigError(std::string(form.option) + " " + part,
                          "'" + next.name + "' is given twice, first in '" + same->text + "'",
                          "keep one");
      assignments.push_back(std::move(next));
    }
  return assignments;
}

}  // namespace lacuna::cli
