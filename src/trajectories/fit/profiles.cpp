// SPDX-License-Identifier: MIT
#include "profiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/numerics/least_squares.hpp"
#include "fit_search.hpp"
#include "trajectories/shooting/block_minimum.hpp"

namespace lacuna {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();
constexpr double kFar = 1e3;      // times the estimate: a likelihood as high there has no end
constexpr int kMostSteps = 14;    // outwards on one side
constexpr int kMostHalvings = 12; // between the last two points
constexpr double kOther = 4.0;    // roots of an end: beyond, a root need not be linear at all
constexpr double kNear = 0.02;    // of the root of the deviance at an end
constexpr double kCurve = 5.0;    // points of a curve on each side
constexpr double kFirst = 1e-3;   // of the way: first step where no error is known
constexpr double kFaster = 2.0;     // growth from which steps are made shorter
constexpr int kIterations = 20;   // of a minimisation, which begins near its end

/// The way along which a number moves: its logarithm where its range is positive, as far as it
/// is away from zero; else itself.
class Way {
 public:
  Way(double value, double lower, double upper)
      : value_(value), lower_(lower), upper_(upper), by_factor_(lower >= 0.0 && value > 0.0) {}

  /// The number at a distance from the estimate, within its range.
  double at(double distance) const {
    const double value =
        by_factor_ ? value_ * std::exp(std::clamp(distance, -50.0, 50.0)) : value_ + distance;
    return std::clamp(value, lower_, upper_);
  }

  /// The distance that changes it by about so much.
  double distance(double change) const { return by_factor_ ? change / value_ : change; }

  /// The distance beyond which it is far off. @param least size that it has at least.
  double far(double side, double least) const {
    const double size = std::max(std::abs(value_), least);
    if (!by_factor_) return kFar * size;
    return std::log(side > 0.0 ? kFar * size / value_ : kFar);
  }

  /// The value where a way down ends that never comes to it.
  std::optional<double> end_of_way(double side) const {
    const double end = side < 0.0 ? lower_ : upper_;
    return std::isfinite(end) ? std::optional(end) : std::nullopt;
  }

 private:
  double value_, lower_, upper_;
  bool by_factor_;
};

/// How all numbers change with the global one at `place`, to first order and per unit of it, where
/// the cost rises least. Those at the ends of their ranges stay.
FitPoint ridge_of(FitEngine& engine, const FitUnknowns& unknowns, const FitMinimum& minimum,
                  Index place) {
  const FitLinear linear = linearise(engine, unknowns, minimum.point, minimum.path, {});
  const auto g = static_cast<Index>(unknowns.global.size());
  const Matrix reduced = linear.reduced.topLeftCorner(g, g);
  std::vector<Index> others;
  for (Index i = 0; i < g; ++i) {
    const Index p = unknowns.global[static_cast<std::size_t>(i)];
    const double value = minimum.point.parameters(0, p);
    if (i != place && value > unknowns.lower[p] && value < unknowns.upper[p])
      others.push_back(i);
  }
  Vector change = Vector::Unit(g, place);
  if (!others.empty())
    change(others) = smallest_least_squares(reduced(Eigen::all, others), -reduced.col(place));
  FitPoint ridge{Matrix::Zero(minimum.point.parameters.rows(), minimum.point.parameters.cols()),
                 Matrix::Zero(minimum.point.starts.rows(), minimum.point.starts.cols())};
  for (Index i = 0; i < g; ++i)
    ridge.parameters.col(unknowns.global[static_cast<std::size_t>(i)]).setConstant(change[i]);
  const Index states = engine.states(),
              own = states + static_cast<Index>(unknowns.local.size());
  for (Index r = 0; r < ridge.starts.rows(); ++r) {
    const Matrix& triangle = linear.records[static_cast<std::size_t>(r)];
    const Vector moves = solve_determined(triangle.topLeftCorner(own, own),
                                          -(triangle.block(0, own, own, g) * change));
    ridge.starts.row(r) = moves.head(states).transpose();
    ridge.parameters(r, unknowns.local) = moves.tail(own - states).transpose();
  }
  return ridge;
}

/// The cost with one number held, from the nearest point that was found so far.
class HeldNumber {
 public:
  /// @param most deviance up to which a point is a start of the next ones: beyond the interval
  ///   others may be in another minimum.
  HeldNumber(FitEngine& engine, const FitUnknowns& unknowns, const FitMinimum& minimum,
             Index place, double most, const RunContext& context)
      : engine_(engine),
        unknowns_(unknowns),
        minimum_(minimum),
        parameter_(unknowns.global[static_cast<std::size_t>(place)]),
        others_(unknowns),
        least_(total_cost(unknowns, minimum.point, minimum.path)),
        most_(most),
        context_(context),
        substeps_(engine.signals.scheme.substeps),
        is_implicit_(engine.implicit.has_value()),
        laws_(engine.laws),
        ridge_(ridge_of(engine, unknowns, minimum, place)) {
    others_.global.erase(others_.global.begin() + place);
    if (sizes_move(engine)) {
      // Deviances with sizes that are estimated are as much larger than with known ones as
      // values are more than degrees of freedom.
      share_ = degrees_of_freedom(engine, unknowns) / std::max(1.0, engine.records.valid.sum());
      least_ += of_values();
    }
    restart();
  }

  ~HeldNumber() {
    engine_.laws = laws_;
    if (!is_implicit_) engine_.implicit.reset();
    set_substeps(engine_, substeps_);
  }

  HeldNumber(const HeldNumber&) = delete;
  HeldNumber& operator=(const HeldNumber&) = delete;

  double value() const { return minimum_.point.parameters(0, parameter_); }
  void restart() {
    before_ = last_ = minimum_.point;
    last_laws_ = laws_;
  }

  /// Least cost at a value, less that of the minimum; infinite where no run is finite.
  double deviance(double value) {
    engine_.laws = last_laws_;
    FitPoint start = extrapolated(value);
    refine_steps(start, value);
    FitMinimum found = minimise(engine_, others_, start, {}, kIterations, context_);
    if (!std::isfinite(found.path.cost)) {
      start = last_;
      start.parameters.col(parameter_).setConstant(value);
      found = minimise(engine_, others_, start, {}, kIterations, context_);
    }
    if (!std::isfinite(found.path.cost)) return kNowhere;
    if (share_) settle_sizes(found);
    found_ = std::move(found);
    const double cost = total_cost(unknowns_, found_.point, found_.path);
    const double deviance = share_ ? *share_ * (cost + of_values() - least_) : cost - least_;
    if (deviance <= most_) {
      before_ = std::exchange(last_, found_.point);
      last_laws_ = engine_.laws;
    }
    return deviance;
  }

  const FitMinimum& found() const { return found_; }

 private:
  /// What costs lack of -2 log-likelihoods that have other sizes of the noise.
  double of_values() const {
    double sum = 0.0;
    for (Index c = 0; c < engine_.count(); ++c) {
      const auto& law = engine_.laws[static_cast<std::size_t>(c)];
      for (Index n = 0; law && n < engine_.records.samples(); ++n)
        if (engine_.records.valid(n, c) > 0.0) sum += law->offset(engine_.records.values(n, c));
    }
    return sum;
  }

  /// Sizes of the noise in turn with the other numbers, until they stay: they are numbers that
  /// the likelihood is largest over, too.
  void settle_sizes(FitMinimum& found) {
    constexpr int kRounds = 10;
    constexpr double kSettled = 0.003;  // as in the search
    for (int round = 0; round < kRounds; ++round) {
      const double change = estimate_laws(engine_, unknowns_, found.path);
      found.path = follow(engine_, found.point, {});
      if (change < kSettled) return;
      FitMinimum next = minimise(engine_, others_, found.point, {}, kIterations, context_);
      if (!std::isfinite(next.path.cost)) return;
      found = std::move(next);
    }
  }

  /// Steps in proportion to the number: where a rate is larger than that of the estimate,
  /// motions are faster, and a run that is not finite would be one of the steps, not the model.
  void refine_steps(const FitPoint& start, double point) {
    const double growth = std::abs(point) / std::max(std::abs(value()), 1e-300);
    if (is_implicit_ || !(growth > kFaster)) return;
    const double factor = std::min(std::ceil(growth), static_cast<double>(kMostSubsteps));
    set_substeps(engine_, std::min<Index>(kMostSubsteps,
                                          substeps_ * static_cast<Index>(factor)));
    choose_method(engine_, start);
  }

  /// The others on the line through the last two points, along the ridge where there is one, within
  /// their ranges.
  FitPoint extrapolated(double value) const {
    const double a = before_.parameters(0, parameter_),
                 b = last_.parameters(0, parameter_);
    FitPoint start = last_;
    if (a == b) {
      start.parameters += (value - b) * ridge_.parameters;
      start.starts += (value - b) * ridge_.starts;
    } else {
      const double fraction = std::clamp((value - b) / (b - a), -2.0, 2.0);
      start.parameters += fraction * (last_.parameters - before_.parameters);
      start.starts += fraction * (last_.starts - before_.starts);
    }
    for (Index p = 0; p < start.parameters.cols(); ++p)
      start.parameters.col(p) = start.parameters.col(p)
                                    .cwiseMax(unknowns_.lower[p])
                                    .cwiseMin(unknowns_.upper[p])
                                    .eval();
    for (std::size_t k = 0; k < unknowns_.initial.size(); ++k)
      if (unknowns_.initial[k] && unknowns_.initial[k]->fixed)
        start.starts.col(static_cast<Index>(k)) = last_.starts.col(static_cast<Index>(k));
    start.parameters.col(parameter_).setConstant(value);
    return start;
  }

  FitEngine& engine_;
  const FitUnknowns& unknowns_;
  const FitMinimum& minimum_;
  Index parameter_;
  FitUnknowns others_;
  double least_, most_;
  const RunContext& context_;
  Index substeps_;
  bool is_implicit_;
  std::vector<std::optional<ChannelNoise>> laws_, last_laws_;
  FitPoint ridge_;
  std::optional<double> share_ = {};  ///< of degrees of freedom, where sizes are estimated anew
  FitPoint before_, last_;
  FitMinimum found_;
};

/// One side of a profile: distance from the estimate and root of the deviance.
struct SidePoint {
  double distance = 0.0, root = 0.0;
};

/// Follows one side of a profile.
class Side {
 public:
  Side(HeldNumber& held, const Way& way, double side, double root, NumberProfile& profile)
      : held_(held), way_(way), side_(side), root_(root), profile_(profile) {}

  /// The end of the interval; nothing where the likelihood has none.
  /// @param step first distance. @param far where the way ends.
  std::optional<double> end(double step, double far) {
    SidePoint inside, outside{kNowhere, kNowhere};
    for (int i = 0; i < kMostSteps && std::isinf(outside.distance); ++i) {
      step = std::min(step, far);
      const SidePoint point = look(step);
      if (is_lower_) return std::nullopt;
      if (point.root >= root_) {
        outside = point;
        break;
      }
      inside = point;
      if (step >= far || at_end(step)) return std::nullopt;
      const double more = point.root > 0.0 ? 1.1 * root_ / point.root : kMost;
      step *= std::clamp(more, kLeast, kMost);
    }
    if (std::isinf(outside.distance)) return std::nullopt;
    return refined(inside, outside);
  }

  /// Points between the estimate and the farthest one.
  void fill(double distance) {
    held_.restart();
    for (double i = 1.0; i < kCurve; ++i) look(distance * i / kCurve);
  }

  bool is_lower() const { return is_lower_; }  ///< whether a lower minimum was met
  double farthest() const { return farthest_; }

 private:
  static constexpr double kLeast = 1.2, kMost = 4.0;  // growth of steps outwards

  SidePoint look(double distance) {
    const double value = way_.at(side_ * distance), deviance = held_.deviance(value);
    constexpr double kLower = 0.01;  // of a deviance: a tenth of one standard error, squared
    is_lower_ = is_lower_ || deviance < -kLower;
    farthest_ = std::max(farthest_, distance);
    profile_.values.push_back(value);
    profile_.deviance.push_back(deviance);
    return {distance, std::sqrt(std::max(deviance, 0.0))};
  }

  bool at_end(double distance) const {
    const auto end = way_.end_of_way(side_);
    return end && way_.at(side_ * distance) == *end;
  }

  /// Between a point inside and one outside, where the root of the deviance, which is nearly
  /// linear, is that of the limit.
  double refined(SidePoint inside, SidePoint outside) {
    for (int i = 0; i < kMostHalvings; ++i) {
      const double width = outside.distance - inside.distance;
      const double fraction = outside.root < kOther * root_
                         ? (root_ - inside.root) / (outside.root - inside.root)
                         : 0.5;
      const double distance = inside.distance + std::clamp(fraction, 0.05, 0.95) * width;
      if (std::abs(outside.root - root_) <= kNear * root_) return value(outside.distance);
      if (std::abs(inside.root - root_) <= kNear * root_) return value(inside.distance);
      const SidePoint point = look(distance);
      (point.root >= root_ ? outside : inside) = point;
    }
    return value(outside.distance);
  }

  double value(double distance) const { return way_.at(side_ * distance); }

  HeldNumber& held_;
  const Way& way_;
  double side_, root_;
  NumberProfile& profile_;
  bool is_lower_ = false;
  double farthest_ = 0.0;
};

/// The points in the order of their values, that of the estimate among them.
void sort_points(double estimate, NumberProfile& profile) {
  profile.values.push_back(estimate);
  profile.deviance.push_back(0.0);
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < profile.values.size(); ++i)
    points.emplace_back(profile.values[i], profile.deviance[i]);
  std::sort(points.begin(), points.end());
  for (std::size_t i = 0; i < points.size(); ++i)
    std::tie(profile.values[i], profile.deviance[i]) = points[i];
}

}  // namespace

NumberProfile profile_of(FitEngine& engine, const FitUnknowns& unknowns,
                         const FitMinimum& minimum, Index place, const ProfileTask& task,
                         std::optional<FitMinimum>& better, const RunContext& context) {
  NumberProfile profile{.limit = task.reach * task.reach * task.inflation};
  HeldNumber held(engine, unknowns, minimum, place, profile.limit, context);
  const Index p = unknowns.global[static_cast<std::size_t>(place)];
  const double value = held.value();
  const Way way(value, unknowns.lower[p], unknowns.upper[p]);
  const double root = std::sqrt(profile.limit);
  const double given = way.distance(task.reach * task.error);
  for (const double side : {-1.0, 1.0}) {
    held.restart();
    bool& open = side < 0.0 ? profile.is_open_below : profile.is_open_above;
    std::optional<double>& end = side < 0.0 ? profile.low : profile.high;
    const double far = way.far(side, std::max(task.error, task.size));
    const double step = given > 0.0 && given < 0.5 * far ? given : kFirst * far;
    Side one(held, way, side, root, profile);
    if (way.end_of_way(side) != value) end = one.end(step, far);
    open = !end.has_value();
    if (one.is_lower()) {
      better = held.found();
      return profile;
    }
    if (task.whole_curve && one.farthest() > 0.0) one.fill(one.farthest());
  }
  sort_points(value, profile);
  return profile;
}

double profile_work(const FitEngine& engine, const FitUnknowns& unknowns) {
  return static_cast<double>(engine.states() + engine.parameters()) *
         static_cast<double>(engine.records.samples()) *
         static_cast<double>(unknowns.global.size());
}

}  // namespace lacuna
