// SPDX-License-Identifier: MIT
#include "diagnose/candidates/screening.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "core/base/parallel.hpp"
#include "core/numerics/qr.hpp"
#include "forms/candidate/nelder_mead.hpp"
#include "forms/candidate/shape_scale.hpp"
#include "key_text.hpp"

namespace lacuna {
namespace {

/// Gain less the penalty for the shape parameters.
double net_gain(const ScreenedCandidate& screened, double shape_penalty) {
  return screened.gain - shape_penalty * static_cast<double>(screened.shapes.size());
}

/// One start of one candidate.
struct Start {
  std::size_t candidate;
  Probe probe;
};

/// All starts, those in the same place and equation next to each other.
std::vector<Start> all_starts(const std::vector<Candidate>& candidates) {
  std::vector<Start> starts;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (const Vector& start : candidates[c].starts)
      starts.push_back({c, {&candidates[c], start}});
  std::stable_sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) {
    return std::pair(a.probe.candidate->place, a.probe.candidate->equation) <
           std::pair(b.probe.candidate->place, b.probe.candidate->equation);
  });
  return starts;
}

/// Runs of starts in the same place and equation, of a length that goes through the records
/// well together.
std::vector<std::pair<std::size_t, std::size_t>> batches(const std::vector<Start>& starts) {
  // A fact of the machines.
  constexpr std::size_t kTogether = 8;
  std::vector<std::pair<std::size_t, std::size_t>> result;
  for (std::size_t first = 0, end = 0; first < starts.size(); first = end) {
    const Candidate& head = *starts[first].probe.candidate;
    while (end < starts.size() && end < first + kTogether &&
           starts[end].probe.candidate->place == head.place &&
           starts[end].probe.candidate->equation == head.equation)
      ++end;
    result.emplace_back(first, end);
  }
  return result;
}

/// Every candidate at the best of its starts.
std::vector<ScreenedCandidate> at_best_starts(const std::vector<Candidate>& candidates,
                                              const Screening& screening,
                                              const RunContext& context) {
  const std::vector<Start> starts = all_starts(candidates);
  const auto ranges = batches(starts);
  std::vector<Score> scores(starts.size());
  parallel_for(ranges.size(), context.threads, [&](std::size_t b) {
    context.check_stop();
    std::vector<Probe> probes;
    for (std::size_t i = ranges[b].first; i < ranges[b].second; ++i)
      probes.push_back(starts[i].probe);
    const std::vector<Score> found = screening.scores(probes);
    std::copy(found.begin(), found.end(),
              scores.begin() + static_cast<std::ptrdiff_t>(ranges[b].first));
  });
  std::vector<ScreenedCandidate> all;
  for (const Candidate& candidate : candidates)
    all.push_back({candidate, candidate.starts.front(), 0.0, 0.0, 0});
  for (std::size_t i = 0; i < starts.size(); ++i)
    all[starts[i].candidate].consider(starts[i].probe.shapes, scores[i]);
  return all;
}

/// The memory of one screening.
class Recollection {
 public:
  Recollection(const Screening& screening, ScreeningMemory* memory) : memory_(memory) {
    if (memory_) key_ = screening.key();
  }

  /// @param stage of the screening: what is found of a candidate depends on it.
  bool recall(char stage, ScreenedCandidate& one) const {
    return memory_ && memory_->recall(key_of(stage, one), one);
  }

  void keep(char stage, const ScreenedCandidate& one) const {
    if (memory_) memory_->keep(key_of(stage, one), one);
  }

 private:
  std::string key_of(char stage, const ScreenedCandidate& one) const {
    KeyText key;
    key.add(one.candidate);
    return key_ + stage + key.take();
  }

  ScreeningMemory* memory_;
  std::string key_;
};

// Kinds of keys.
constexpr char kAtStarts = 's', kPolished = 'p';

/// at_best_starts() of what is not known.
std::vector<ScreenedCandidate> all_at_starts(const std::vector<Candidate>& candidates,
                                             const Screening& screening,
                                             const Recollection& known,
                                             const RunContext& context) {
  std::vector<ScreenedCandidate> all;
  std::vector<Candidate> others;
  std::vector<std::size_t> places;
  for (const Candidate& candidate : candidates) {
    all.push_back({candidate, candidate.starts.front(), 0.0, 0.0, 0});
    if (known.recall(kAtStarts, all.back())) continue;
    others.push_back(candidate);
    places.push_back(all.size() - 1);
  }
  std::vector<ScreenedCandidate> found = at_best_starts(others, screening, context);
  for (std::size_t i = 0; i < found.size(); ++i) {
    known.keep(kAtStarts, found[i]);
    all[places[i]] = std::move(found[i]);
  }
  return all;
}

/// Those whose shapes are worth a search: the two best of each family, equation and number of
/// shapes, where they are not so far behind the best of all that no search makes up for it.
std::vector<std::size_t> to_polish(const std::vector<ScreenedCandidate>& sorted,
                                   double worth_shaping) {
  // A fact of the search: forms of one family are shaped to be much alike.
  constexpr int kOfEachFamily = 2;
  double best = 0.0;
  for (const ScreenedCandidate& candidate : sorted) best = std::max(best, candidate.gain);
  std::map<std::tuple<std::string, Place, Index, std::size_t>, int> seen;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Candidate& candidate = sorted[i].candidate;
    if (candidate.shapes.empty() || sorted[i].gain < worth_shaping * best) continue;
    bool has_room = candidate.families.empty();
    for (const std::string& family : candidate.families)
      has_room =
          seen[{family, candidate.place, candidate.equation, candidate.shapes.size()}]++ <
              kOfEachFamily ||
          has_room;
    if (has_room) chosen.push_back(i);
  }
  return chosen;
}

}  // namespace

Screening::Screening(const Assimilation& assimilation)
    : assimilation_(assimilation), system_(assimilation) {
  nominal_ = orthonormal_basis(system_.fitted_columns());
  innovations_ = system_.innovations();
  innovations_ -= nominal_ * (nominal_.transpose() * innovations_);
}

std::vector<Score> Screening::scores(std::span<const Probe> probes) const {
  // Below this fraction of its length a column is one of the nominal terms, up to rounding.
  constexpr double kIndependent = 1e-10;
  const ProbeColumns found = probe_columns(probes, assimilation_, system_);
  const Vector inner = found.columns.transpose() * innovations_;
  const Vector length = found.columns.colwise().squaredNorm();
  const Vector shared = (nominal_.transpose() * found.columns).colwise().squaredNorm();
  std::vector<Score> result(probes.size());
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const auto i = static_cast<Index>(p);
    const double own = length[i] - shared[i];
    if (!found.finite[p] || !(own > kIndependent * length[i])) continue;
    const Candidate& candidate = *probes[p].candidate;
    const double coefficient = std::clamp(inner[i] / own, candidate.least, candidate.most);
    result[p] = {std::max(0.0, coefficient * (2.0 * inner[i] - coefficient * own)),
                 coefficient};
  }
  return result;
}

Score Screening::score(const Candidate& candidate, std::span<const double> shapes) const {
  const Probe probe{&candidate,
                    Eigen::Map<const Vector>(shapes.data(), static_cast<Index>(shapes.size()))};
  return scores({&probe, 1}).front();
}

ScreenedCandidate Screening::at_starts(const Candidate& candidate) const {
  ScreenedCandidate best{candidate, candidate.starts.front(), 0.0, 0.0, 0};
  for (const Vector& start : candidate.starts)
    best.consider(start, score(candidate, as_span(start)));
  return best;
}

void Screening::polish(ScreenedCandidate& screened) const {
  if (screened.shapes.size() == 0) return;
  // A fact of the search: enough to rank shapes, which are fitted again.
  constexpr int kEvaluationsOfShapes = 40;
  const ShapeScale scale(screened.candidate.shapes);
  int evaluations = 0;
  const auto loss = [&](const Vector& unit) {
    ++evaluations;
    return -score(screened.candidate, as_span(scale.shapes(unit))).gain;
  };
  const int budget = kEvaluationsOfShapes * static_cast<int>(screened.shapes.size());
  const Vector best =
      scale.shapes(nelder_mead(loss, scale.unit(screened.shapes),
                               {.unnoticed = kUnnoticedDeviance, .evaluations = budget}));
  screened.consider(best, score(screened.candidate, as_span(best)));
  screened.tried += evaluations;
}

std::string Screening::key() const {
  KeyText text;
  text.add(assimilation_);
  KeyText digest;
  digest.add_all(std::hash<std::string>{}(text.take()), assimilation_.deviance);
  return digest.take();
}

bool ScreeningMemory::recall(const std::string& key, ScreenedCandidate& candidate) {
  const std::lock_guard lock(guard_);
  const auto found = found_.find(key);
  if (found == found_.end()) return false;
  candidate.shapes = found->second.shapes;
  candidate.gain = found->second.score.gain;
  candidate.coefficient = found->second.score.coefficient;
  candidate.tried = found->second.tried;
  return true;
}

void ScreeningMemory::keep(const std::string& key, const ScreenedCandidate& candidate) {
  const std::lock_guard lock(guard_);
  found_.emplace(
      key, Found{candidate.shapes, {candidate.gain, candidate.coefficient}, candidate.tried});
}

void ScreenedCandidate::consider(const Vector& at, const Score& score) {
  ++tried;
  if (score.gain <= gain) return;
  shapes = at;
  gain = score.gain;
  coefficient = score.coefficient;
}

std::vector<ScreenedCandidate> screen(const std::vector<Candidate>& candidates,
                                      const Screening& screening,
                                      const ScreeningOptions& options,
                                      const RunContext& context, ScreeningMemory* memory) {
  context.report("screening candidates", 0.0);
  const Recollection known(screening, memory);
  std::vector<ScreenedCandidate> all = all_at_starts(candidates, screening, known, context);
  const auto better = [&](const ScreenedCandidate& a, const ScreenedCandidate& b) {
    return net_gain(a, options.shape_penalty) > net_gain(b, options.shape_penalty);
  };
  std::stable_sort(all.begin(), all.end(), better);
  context.report("searching shapes", 0.5);
  const std::vector<std::size_t> chosen = to_polish(all, options.worth_shaping);
  parallel_for(chosen.size(), context.threads, [&](std::size_t i) {
    context.check_stop();
    ScreenedCandidate& one = all[chosen[i]];
    if (known.recall(kPolished, one)) return;
    screening.polish(one);
    known.keep(kPolished, one);
  });
  std::stable_sort(all.begin(), all.end(), better);
  return all;
}

}  // namespace lacuna
