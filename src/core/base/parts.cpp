// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include <algorithm>
#include <vector>

#include "core/base/parallel.hpp"

namespace lacuna {

OwnParts parts_of(int member, std::size_t parts, const RunContext& context) {
  if (context.team == nullptr) return {0, parts};
  const auto size = static_cast<std::size_t>(context.team->size());
  const auto place = static_cast<std::size_t>(member);
  return {place * parts / size, (place + 1) * parts / size};
}

OwnParts own_parts(std::size_t parts, const RunContext& context) {
  return parts_of(context.team == nullptr ? 0 : context.team->rank(), parts, context);
}

void for_each_own_part(std::size_t parts, const RunContext& context,
                       FunctionRef<void(std::size_t)> work) {
  const OwnParts own = own_parts(parts, context);
  parallel_for(own.end - own.first, context.threads,
               [&](std::size_t i) { work(own.first + i); });
}

void exchange_parts(std::size_t parts, const RunContext& context,
                    FunctionRef<std::span<double>(std::size_t)> numbers) {
  if (context.team == nullptr) return;
  for (int member = 0; member < context.team->size(); ++member) {
    const OwnParts own = parts_of(member, parts, context);
    std::vector<double> all;
    for (std::size_t i = own.first; i < own.end; ++i) {
      const std::span<double> part = numbers(i);
      all.insert(all.end(), part.begin(), part.end());
    }
    context.team->broadcast(all, member);
    auto next = all.begin();
    for (std::size_t i = own.first; i < own.end; ++i) {
      const std::span<double> part = numbers(i);
      std::copy_n(next, part.size(), part.begin());
      next += static_cast<std::ptrdiff_t>(part.size());
    }
  }
}

void exchange_texts(std::vector<std::string>& texts, const RunContext& context) {
  if (context.team == nullptr) return;
  std::vector<double> sizes;
  for (const std::string& text : texts) sizes.push_back(static_cast<double>(text.size()));
  exchange_parts(texts.size(), context, [&](std::size_t i) { return std::span(&sizes[i], 1); });
  std::vector<std::vector<double>> letters;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    letters.emplace_back(texts[i].begin(), texts[i].end());
    letters[i].resize(static_cast<std::size_t>(sizes[i]));
  }
  exchange_parts(texts.size(), context, [&](std::size_t i) { return std::span(letters[i]); });
  for (std::size_t i = 0; i < texts.size(); ++i) {
    texts[i].clear();
    for (const double letter : letters[i]) texts[i] += static_cast<char>(letter);
  }
}

}  // namespace lacuna
