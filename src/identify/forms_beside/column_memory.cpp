// SPDX-License-Identifier: MIT
#include "form_rows.hpp"

#include <utility>

namespace lacuna {

Matrix ColumnMemory::columns(const std::vector<Expression>& forms, Index rows,
                             Maker make) const {
  Matrix result(rows, static_cast<Index>(forms.size()));
  std::vector<std::string> names;
  for (const Expression& form : forms) names.push_back(form.to_string());
  std::vector<std::size_t> missing;
  {
    const std::lock_guard lock(guard_);
    for (std::size_t i = 0; i < forms.size(); ++i) {
      const auto found = kept_.find(names[i]);
      if (found != kept_.end())
        result.col(static_cast<Index>(i)) = found->second;
      else
        missing.push_back(i);
    }
  }
  if (missing.empty()) return result;
  std::vector<Expression> others;
  for (const std::size_t i : missing) others.push_back(forms[i]);
  const Matrix made = make(others);
  const std::lock_guard lock(guard_);
  made_ += made.cols();
  for (std::size_t j = 0; j < missing.size(); ++j) {
    const auto column = made.col(static_cast<Index>(j));
    result.col(static_cast<Index>(missing[j])) = column;
    if (numbers_ + rows > most_) continue;
    if (kept_.emplace(std::move(names[missing[j]]), column).second) numbers_ += rows;
  }
  return result;
}

Index ColumnMemory::made() const {
  const std::lock_guard lock(guard_);
  return made_;
}

}  // namespace lacuna
