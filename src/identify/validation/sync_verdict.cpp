// SPDX-License-Identifier: MIT
#include "lacuna/identify/validation/sync_verdict.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/numerics/sampled_signal.hpp"
#include "lacuna/identify/options.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "trajectories/windows/window_gap.hpp"

namespace lacuna {
namespace {

/// What to try where steps get too small.
constexpr const char* kOtherSteps = "try fixed steps (--integrator rk4)";

/// A synchronisation beside what errors are compared with.
struct Case {
  const Dataset& record;
  const SyncResult& result;
  Vector floor;  ///< m: noise and what the slave makes of it, or what is resolved where that is
                 ///< more; 0: not measured
  Vector spread;  ///< m
  const SyncVerdictOptions& options;
};

/// Slave minus record of one trajectory, as far as it went, without what steps are off by.
Matrix errors_of(const Case& c, std::size_t r) {
  const Matrix& slave = c.result.states[r];
  Matrix errors = slave - c.record.trajectories[r].states.topRows(slave.rows());
  if (!c.result.step_errors.empty()) errors -= c.result.step_errors[r];
  return errors;
}

double rms(const Eigen::Ref<const Vector>& values) {
  return std::sqrt(values.squaredNorm() /
                   static_cast<double>(std::max<Index>(values.size(), 1)));
}

Case case_of(const Dataset& record, const SyncResult& result,
             const SyncVerdictOptions& options) {
  std::vector<Matrix> states;
  for (const Trajectory& run : record.trajectories) states.push_back(run.states);
  const Vector spread = column_deviations(states);
  Vector floor = result.noise;
  for (Index k = 0; k < floor.size(); ++k)
    if (result.response[k] < options.follows * spread[k])
      floor[k] = std::max(floor[k], options.above_response / options.above_noise *
                                        std::hypot(result.noise[k], result.response[k]));
  floor = floor.cwiseMax(options.resolution * spread);
  for (Index k = 0; k < floor.size(); ++k)
    if (!record.is_measured(k)) floor[k] = 0.0;
  return {record, result, floor, spread, options};
}

/// State with the largest ratio of the error to its floor, and that ratio.
struct Worst {
  Index state = 0;
  double ratio = 0.0;
};

Worst worst_in(const Case& c, const Matrix& errors) {
  Worst worst;
  for (Index k = 0; k < errors.cols(); ++k) {
    if (!(c.floor[k] > 0.0)) continue;
    const double ratio = rms(errors.col(k)) / c.floor[k];
    if (!(ratio <= worst.ratio)) worst = {k, ratio};
  }
  return worst;
}

/// The last three quarters of each record: the slave has to come to the record first.
/// @param whole of one trajectory, by its number.
template <class Whole>
Matrix late_rows(const Case& c, Whole whole) {
  std::vector<Matrix> late;
  Index rows = 0;
  for (std::size_t r = 0; r < c.result.states.size(); ++r) {
    const Matrix errors = whole(r);
    late.push_back(errors.bottomRows(errors.rows() - errors.rows() / 4));
    rows += late.back().rows();
  }
  Matrix all(rows, c.floor.size());
  Index begin = 0;
  for (const Matrix& errors : late) {
    all.middleRows(begin, errors.rows()) = errors;
    begin += errors.rows();
  }
  return all;
}

/// What the steps of the integrator add in each state, rms; 0 where steps adapt.
Vector step_sizes(const Case& c) {
  if (c.result.step_errors.empty()) return Vector::Zero(c.floor.size());
  const Matrix late = late_rows(c, [&](std::size_t r) { return c.result.step_errors[r]; });
  return (late.colwise().squaredNorm().transpose() / static_cast<double>(late.rows()))
      .cwiseSqrt();
}

/// State by state; one that is not measured says nothing.
Adequacy adequacy_of_slave(const OdeModel& model, const Case& c, const Matrix& errors) {
  std::vector<AdequacyPart> parts;
  for (Index k = 0; k < errors.cols(); ++k) {
    const bool is_judged = c.floor[k] > 0.0;
    const bool fits =
        c.result.settled && rms(errors.col(k)) < c.options.above_noise * c.floor[k];
    parts.push_back({model.states()[static_cast<std::size_t>(k)].name,
                     !is_judged ? Adequate::Undetermined
                     : fits     ? Adequate::Yes
                                : Adequate::No,
                     is_judged ? errors.rows() : 0, c.result.noise[k] > 0.0});
  }
  return adequacy_of(std::move(parts));
}

/// The time from which on most pieces of the first record are off, where it held long enough.
std::optional<double> holds_until(const Case& c) {
  const Matrix errors = errors_of(c, 0);
  const Trajectory& run = c.record.trajectories.front();
  const Index pieces = std::min<Index>(c.options.pieces, errors.rows() / 20);
  if (pieces < 10) return std::nullopt;
  std::vector<bool> off;
  for (Index p = 0; p < pieces; ++p) {
    const Index begin = p * errors.rows() / pieces, end = (p + 1) * errors.rows() / pieces;
    off.push_back(worst_in(c, errors.middleRows(begin, end - begin)).ratio >=
                  c.options.above_noise);
  }
  const auto first = std::find(off.begin(), off.end(), true);
  const auto held = static_cast<double>(first - off.begin());
  if (first == off.end() || held < c.options.least_held * static_cast<double>(pieces))
    return std::nullopt;
  const auto bad = std::count(first, off.end(), true);
  if (2 * bad <= off.end() - first) return std::nullopt;
  return run.time[(first - off.begin()) * errors.rows() / pieces];
}

/// Rate that the coupling adds to an equation beyond what noise makes, over its own rate.
double help(const Case& c, Index k) {
  double added = 0.0, own = 0.0;
  const Matrix& coupling = c.result.coupling;
  const double noise = coupling.row(k).cwiseProduct(c.result.noise.transpose()).norm();
  for (std::size_t r = 0; r < c.result.states.size(); ++r) {
    const Matrix errors = errors_of(c, r);
    const Matrix& slave = c.result.states[r];
    const Vector& time = c.record.trajectories[r].time;
    for (Index n = 1; n < errors.rows(); ++n) {
      const double rate = (slave(n, k) - slave(n - 1, k)) / (time[n] - time[n - 1]);
      const double pull = coupling.row(k).dot(errors.row(n));
      added += pull * pull - noise * noise;
      own += rate * rate;
    }
  }
  return own > 0.0 ? added / own : 0.0;
}

std::optional<Index> helped_most(const OdeModel& model, const Case& c) {
  std::optional<Index> most;
  if (c.result.conditional_exponent) return most;
  double largest = 0.0;
  for (Index k = 0; k < model.dimension(); ++k) {
    if (identity_of(model, k)) continue;
    const double own = help(c, k);
    if (own <= largest) continue;
    largest = own;
    most = k;
  }
  return most;
}

/// "1.1 times the noise", or "0.02 % of the spread of x" where no noise is seen.
std::string size_of(const OdeModel& model, const Case& c, const Worst& worst) {
  const double noise = c.result.noise[worst.state], floor = c.floor[worst.state];
  if (noise >= floor) return format_number(worst.ratio, 2) + " times the noise";
  if (noise > 0.0 && floor > c.options.resolution * c.spread[worst.state])
    return format_number(worst.ratio * floor / noise, 2) +
           " times the noise, which this orbit amplifies to " +
           format_number(std::hypot(1.0, c.result.response[worst.state] / noise), 2) + " times";
  const double fraction = worst.ratio * c.floor[worst.state] / c.spread[worst.state];
  return format_number(100.0 * fraction, 2) + " % of the spread of " +
         model.states()[static_cast<std::size_t>(worst.state)].name;
}

/// ", without 0.09 % of the spread of z that ...": what steps add, where that is more than what
/// is resolved or noise of any state.
std::string steps_phrase(const OdeModel& model, const Case& c, const Vector& steps) {
  Worst worst;
  for (Index k = 0; k < steps.size(); ++k)
    if (c.floor[k] > 0.0 && steps[k] > worst.ratio * c.floor[k])
      worst = {k, steps[k] / c.floor[k]};
  if (!(worst.ratio > 1.0)) return "";
  return ", without " + size_of(model, c, worst) + " that the integrator's steps add";
}

/// Whether any sample of a measured state differs from the first of its record.
bool moves(const Dataset& record) {
  for (const Trajectory& run : record.trajectories)
    for (Index k = 0; k < record.state_count(); ++k) {
      const auto& x = run.states.col(k);
      if (record.is_measured(k) && (x.array() != x[0]).any()) return true;
    }
  return false;
}

/// rms of what a cubic through every second sample misses at the others, of each state: more
/// than what one through all samples misses between them.
Vector missed_between_samples(const Dataset& record) {
  Vector squares = Vector::Zero(record.state_count());
  Index count = 0;
  for (const Trajectory& run : record.trajectories) {
    const Index halves = run.samples() / 2;
    if (halves < 2) continue;
    const auto known = Eigen::seqN(0, halves, 2), between = Eigen::seqN(1, halves - 1, 2);
    const Vector times = run.time(between);
    for (Index k = 0; k < squares.size(); ++k)
      squares[k] += (interpolate_cubic(run.time(known), run.states(known, k), times) -
                     run.states(between, k))
                        .squaredNorm();
    count += halves - 1;
  }
  return (squares / static_cast<double>(std::max<Index>(count, 1))).cwiseSqrt();
}

/// Whether no state is off by more than what something else may make of it.
/// @param others m: rms.
bool is_off_within(const Case& c, const Matrix& errors, const Vector& others) {
  for (Index k = 0; k < errors.cols(); ++k) {
    const double off = rms(errors.col(k));
    if (c.floor[k] > 0.0 && off >= c.options.above_noise * c.floor[k] && !(off < others[k]))
      return false;
  }
  return true;
}

/// Whether slaves that begin elsewhere in hidden states are together soon enough.
bool determines_hidden(const Trajectory& first, const SyncResult& result,
                       const SyncVerdictOptions& options) {
  if (!result.conditional_exponent) return true;
  const double quarter = 0.25 * (first.time[first.samples() - 1] - first.time[0]);
  return *result.conditional_exponent * quarter <= std::log(options.forgotten);
}

/// A verdict as it may be given: none where something leaves it in doubt.
SyncVerdict admitted(SyncVerdict claimed, std::vector<Doubt> doubts = {}) {
  const Claim claim = claimed.holds ? Claim::Fits : Claim::WrongStructure;
  const Admission admission = admit({.claim = claim, .doubts = std::move(doubts)});
  if (admission.stands()) return claimed;
  const std::string remedy = admission.remedy.empty() ? "" : "; " + admission.remedy;
  return {.decided = false, .sentence = "Undecided: " + admission.why + remedy + "."};
}

/// Whether `diagnose` takes a record of this length.
bool may_be_diagnosed(const Dataset& record) {
  return std::any_of(
      record.trajectories.begin(), record.trajectories.end(),
      [](const Trajectory& run) { return run.samples() >= GapOptions{}.shortest_record; });
}

/// Where to look for what a model lacks.
std::string where_to_look(const Dataset& record) {
  return may_be_diagnosed(record) ? "see `lacuna diagnose`"
                                  : "`lacuna fit ONE.ode TWO.ode DATA` compares structures";
}

/// Why errors above the noise need not be of the model: too few samples, or a slave that has not
/// forgotten by how much its first sample is off.
/// @param late errors of the samples that are judged.
std::vector<Doubt> doubts_of_begin(const OdeModel& model, const Case& c, const Matrix& late,
                                   const std::string& size) {
  // A fact of chance: one sample in 400 is off by more than so many standard deviations.
  constexpr double kMostByChance = 3.0;
  const auto judged = (c.floor.array() > 0.0).count();
  if (late.rows() * judged < ValidationOptions{}.least_freedom)
    return {{size + ", but " + std::to_string(late.rows()) + " samples behind the first quarter " +
                 "are too few to distinguish that from chance and from the begin of the slave",
             where_to_look(c.record)}};
  if (c.result.start_response.size() == 0) return {};
  Vector others = kMostByChance * c.result.start_response;
  for (Index k = 0; k < others.size(); ++k)
    others[k] = others[k] > c.floor[k] ? std::hypot(others[k], c.floor[k]) : 0.0;
  if (!is_off_within(c, late, others)) return {};
  return {{size + ", but the slave still feels by how much its first sample is off",
           "try " + stronger_coupling(model.states(), c.result.coupling) + ", or " +
               "`lacuna fit`, which estimates the begin"}};
}

/// The verdict on a slave that is off by more than noise, or what is resolved.
SyncVerdict failing(const OdeModel& model, const Case& c, const std::string& size,
                    Adequacy adequacy) {
  SyncVerdict verdict{.sentence = {}, .adequacy = std::move(adequacy)};
  const auto most = helped_most(model, c);
  if (most) verdict.equation = model.states()[static_cast<std::size_t>(*most)].name;
  verdict.until = holds_until(c);
  const std::string where = verdict.equation ? "equation " + *verdict.equation : "";
  if (verdict.until)
    verdict.sentence = "Holds up to " + format_number(*verdict.until, 4) + " " +
                       c.record.time_unit + "; from there on " + size +
                       (where.empty() ? "." : ", " + where + ".");
  else
    verdict.sentence = "Does not hold" + (where.empty() ? "" : ": " + where) + "; " + size +
                       " (" + where_to_look(c.record) + ").";
  return verdict;
}

/// By the errors of a slave that came to the end.
SyncVerdict judge_errors(const OdeModel& model, const Case& c) {
  const Matrix late = late_rows(c, [&](std::size_t r) { return errors_of(c, r); });
  const Vector steps = step_sizes(c);
  Adequacy adequacy = adequacy_of_slave(model, c, late);
  const std::string size =
      "the error is " + size_of(model, c, worst_in(c, late)) + steps_phrase(model, c, steps);
  if (adequacy.fits == Adequate::Yes)
    return admitted(
        {.holds = true, .sentence = "Holds: " + size + ".", .adequacy = std::move(adequacy)});
  std::vector<Doubt> doubts = doubts_of_begin(model, c, late, size);
  // The slave follows a curve of nobody's making between samples.
  if (c.result.stiff && is_off_within(c, late, missed_between_samples(c.record)))
    doubts.push_back({size + ", but the slave is faster than the samples, and a curve through "
                             "every second one misses the others by more",
                      "sample faster"});
  if (c.result.settled && is_off_within(c, late, steps))
    doubts.push_back({size, "let steps adapt (--integrator auto)"});
  return admitted(failing(model, c, size, std::move(adequacy)), std::move(doubts));
}

/// A slave that ran away shows that the model does not hold; an integrator that cannot go on
/// shows nothing.
SyncVerdict judge_broken_off(const SyncResult& result) {
  SyncVerdict claimed{.sentence = "Does not hold: " + result.message + "."};
  if (result.status == IntegrationStatus::Diverged) return admitted(std::move(claimed));
  return admitted(std::move(claimed), {{result.message, kOtherSteps}});
}

}  // namespace

void SyncVerdictOptions::describe(OptionVisitor& v) {
  v.field(
      {"above_noise", "",
       "A model holds below so many times the noise: what a complete model can leave, twice.",
       1.0, 100.0},
      above_noise);
  v.field({"above_response", "",
           "Or below so many times what noise and the slave's response to it make together, "
           "which are known to some per cent.",
           1.0, 100.0},
          above_response);
  v.field({"follows", "",
           "As long as that response is below this fraction of a state's spread: a slave that "
           "noise drives further off has lost the record, whatever the model is.",
           0.0, 1.0},
          follows);
  v.field({"resolution", "",
           "Fraction of a state's spread that the interpolation of a record and the steps "
           "between its samples may leave, half of it.",
           0.0, 1.0},
          resolution);
  v.field({"pieces", "", "Of a record, to decide when a model ceases to hold.", 10, 10000},
          pieces);
  v.field({"least_held", "", "Fraction of a record that `holds up to` needs.", 0.0, 1.0},
          least_held);
  v.field({"forgotten", "",
           "Fraction of their distance that slaves which begin elsewhere in hidden states may "
           "be apart after a quarter of the record; else the record does not determine these "
           "states, and there is no verdict.",
           0.0, 1.0},
          forgotten);
}

std::string stronger_coupling(const std::vector<Quantity>& states, const Matrix& coupling) {
  const auto m = static_cast<Index>(states.size());
  check_argument(coupling.rows() == m && coupling.cols() == m, "stronger_coupling",
                 "the coupling is no matrix of states by states");
  std::vector<std::string> parts;
  for (Index k = 0; k < m; ++k)
    if (coupling(k, k) != 0.0)
      parts.push_back(states[static_cast<std::size_t>(k)].name + "=" +
                      format_number(2.0 * std::abs(coupling(k, k)), 3));
  const bool drives_away = (coupling.diagonal().array() < 0.0).any();
  return "--coupling " + (parts.empty() ? "NAME=K" : join(parts, ",")) +
         (drives_away ? " (below 0 it drives the slave away from the record)"
                      : ", which is stronger");
}

Admission admission_of(const SyncResult& result) {
  return admit({.claim = Claim::Fits, .stages = result.stages});
}

SyncVerdict judge(const OdeModel& model, const Dataset& record, const SyncResult& result,
                  const SyncVerdictOptions& options) {
  if (const Admission cut = admission_of(result); !cut.stands())
    return {.decided = false, .sentence = "Incomplete: " + cut.why + "; " + cut.remedy + "."};
  if (result.status != IntegrationStatus::Completed)
    return judge_broken_off(result);
  if (!determines_hidden(record.trajectories.front(), result, options))
    return admitted({}, {{"slaves that begin elsewhere in hidden states do not come together "
                          "(conditional Lyapunov exponent " +
                              format_number(*result.conditional_exponent, 2) + " 1/" +
                              record.time_unit + ")",
                          "try " + stronger_coupling(model.states(), result.coupling) +
                              ", or measure one of them"}});
  if (!moves(record)) return admitted({}, {{"nothing that is measured moves"}});
  return judge_errors(model, case_of(record, result, options));
}

SyncVerdict left_open(const SyncVerdict& verdict, Doubt doubt) {
  return admitted(verdict, {std::move(doubt)});
}

SyncVerdict beside(const Adequacy& predictions, SyncVerdict verdict) {
  std::vector<Doubt> doubts;
  if (verdict.holds && predictions.fits == Adequate::No)
    doubts.push_back(
        {"the slave holds, but the coupling may make up for what predictions are "
         "off by"});
  const bool is_off = verdict.decided && !verdict.holds && !verdict.until;
  if (is_off && predictions.fits == Adequate::Yes)
    doubts.push_back({"the slave does not stay with the record, but predictions fit it",
                      "try a stronger coupling (`lacuna sync --coupling`)"});
  if (doubts.empty()) return verdict;
  SyncVerdict open = admitted(verdict, doubts);
  open.adequacy = std::move(verdict.adequacy);
  return open;
}

}  // namespace lacuna
