// SPDX-License-Identifier: MIT
#include "diagnose/candidates/fit_memory.hpp"

#include <utility>

#include "key_text.hpp"

namespace lacuna {
namespace {

/// Numbers that an explanation takes, as good as all of them.
Index numbers_of(const Explanation& explanation) {
  Index numbers = 0;
  for (const LinearisedRecord& record : explanation.fit.records)
    numbers += record.path.size() + record.slots.size() + record.transition.size() +
               record.response.size() + record.defect.size();
  for (const Matrix& measured : explanation.fit.measured) numbers += measured.size();
  for (const Matrix& omitted : explanation.fit.omitted) numbers += omitted.size();
  return numbers;
}

}  // namespace

std::string fit_key(const std::string& kind, const JointFitTask& task,
                    const Assimilation& start, const std::vector<FittedEffect>& effects) {
  KeyText key;
  key.add_all(kind, task.nominal, task.data, task.options, task.bare_deviance, start, effects);
  return key.take();
}

Explanation FitMemory::explanation(const std::string& key, FunctionRef<Explanation()> fit) {
  {
    const std::lock_guard lock(guard_);
    if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
  }
  Explanation explanation = fit();
  const std::lock_guard lock(guard_);
  const Index numbers = numbers_of(explanation);
  const bool has_room = numbers <= most_ / kFewest && numbers_ + numbers <= most_;
  if (has_room && kept_.emplace(key, explanation).second) numbers_ += numbers;
  return explanation;
}

}  // namespace lacuna
