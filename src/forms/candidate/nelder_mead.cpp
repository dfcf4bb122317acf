// SPDX-License-Identifier: MIT
#include "nelder_mead.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace lacuna {
namespace {

using Vertex = std::pair<double, Vector>;

class Simplex {
 public:
  Simplex(FunctionRef<double(const Vector&)> function, const Vector& start, double reach)
      : function_(function) {
    add(start);
    for (Index i = 0; i < start.size(); ++i) {
      Vector corner = start;
      corner[i] += corner[i] + reach <= 1.0 ? reach : -reach;
      add(corner);
    }
    sort();
  }

  bool settled(double unnoticed) const {
    return vertices_.back().first - vertices_.front().first < unnoticed ||
           (vertices_.back().second - vertices_.front().second).cwiseAbs().maxCoeff() < 1e-7;
  }

  void improve() {
    Vector centre = Vector::Zero(vertices_.front().second.size());
    for (std::size_t i = 0; i + 1 < vertices_.size(); ++i) centre += vertices_[i].second;
    centre /= static_cast<double>(vertices_.size() - 1);
    const Vector away = centre - vertices_.back().second;
    Vertex reflected = evaluate(centre + away);
    if (reflected.first < vertices_.front().first) {
      Vertex further = evaluate(centre + 2.0 * away);
      vertices_.back() = std::min(further, reflected, by_value);
    } else if (reflected.first < vertices_[vertices_.size() - 2].first) {
      vertices_.back() = reflected;
    } else {
      contract(centre, away, reflected);
    }
    sort();
  }

  /// Whether all vertices lie on one face of the cube, which no step of theirs leaves.
  bool is_on_a_face() const {
    for (Index i = 0; i < best().size(); ++i)
      for (const double face : {0.0, 1.0})
        if (std::all_of(vertices_.begin(), vertices_.end(),
                        [&](const Vertex& vertex) { return vertex.second[i] == face; }))
          return true;
    return false;
  }

  const Vector& best() const { return vertices_.front().second; }
  double least() const { return vertices_.front().first; }
  int evaluations() const { return evaluations_; }

 private:
  static bool by_value(const Vertex& a, const Vertex& b) { return a.first < b.first; }
  void sort() { std::stable_sort(vertices_.begin(), vertices_.end(), by_value); }
  void add(const Vector& point) { vertices_.push_back(evaluate(point)); }

  Vertex evaluate(const Vector& point) {
    const Vector inside = point.cwiseMax(0.0).cwiseMin(1.0);
    ++evaluations_;
    return {function_(inside), inside};
  }

  void contract(const Vector& centre, const Vector& away, const Vertex& reflected) {
    const bool outside = reflected.first < vertices_.back().first;
    const Vertex inner = evaluate(centre + (outside ? 0.5 : -0.5) * away);
    if (inner.first < std::min(reflected.first, vertices_.back().first)) {
      vertices_.back() = inner;
      return;
    }
    for (std::size_t i = 1; i < vertices_.size(); ++i)
      vertices_[i] = evaluate(0.5 * (vertices_[i].second + vertices_.front().second));
  }

  FunctionRef<double(const Vector&)> function_;
  std::vector<Vertex> vertices_;
  int evaluations_ = 0;
};

}  // namespace

Vector nelder_mead(FunctionRef<double(const Vector&)> function, const Vector& start,
                   const SimplexSettings& settings) {
  Vector best = start;
  int left = settings.evaluations;
  for (double least = std::numeric_limits<double>::infinity();;) {
    Simplex simplex(function, best, settings.reach);
    while (simplex.evaluations() < left && !simplex.settled(settings.unnoticed))
      simplex.improve();
    best = simplex.best();
    left -= simplex.evaluations();
    const bool improved = simplex.least() < least - settings.unnoticed;
    if (!simplex.is_on_a_face() || !improved || left <= 0) return best;
    least = simplex.least();
  }
}

}  // namespace lacuna
