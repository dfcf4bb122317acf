// SPDX-License-Identifier: MIT
// A linearised record with its noise written out as one Gaussian distribution: what filter and
// smoother have to find, without a recursion.
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/trajectories/smoother/innovation_filter.hpp"

namespace lacuna::support {

/// A linearised record of no model in particular, with what was measured along it.
struct GaussianCase {
  LinearisedRecord record;
  Matrix measured;  ///< n x m
  Matrix omitted;   ///< n x m, or empty
  NoiseModel noise;
};

inline Matrix random_matrix(Random& random, Index rows, Index columns, double size) {
  Matrix matrix(rows, columns);
  for (double& entry : matrix.reshaped()) entry = size * random.normal();
  return matrix;
}

/// Random maps of m states over n samples; all states are measured, all equations disturbed.
inline GaussianCase random_case(Index m, Index n, std::uint64_t seed) {
  constexpr double kStep = 0.1;
  Random random(seed);
  GaussianCase made;
  LinearisedRecord& record = made.record;
  record.time = Vector::LinSpaced(n, 2.0, 2.0 + kStep * static_cast<double>(n - 1));
  record.path = random_matrix(random, n, m, 1.0);
  record.transition = random_matrix(random, m * m, n - 1, 0.2);
  for (Index k = 0; k < m; ++k) record.transition.row(k * m + k).array() += 0.9;
  record.response = random_matrix(random, 3 * m * m, n - 1, kStep / 6.0);
  for (Index k = 0; k < m; ++k)
    for (Index part = 0; part < 3; ++part)
      record.response.row((3 * k + part) * m + k).array() += kStep / 3.0;
  record.defect = random_matrix(random, m, n - 1, 0.05);
  record.range =
      (record.path.colwise().maxCoeff() - record.path.colwise().minCoeff()).transpose();
  made.measured = record.path + random_matrix(random, n, m, 0.3);
  made.noise.coloured.resize(static_cast<std::size_t>(m));
  made.noise.disturbance.resize(m);
  for (Index k = 0; k < m; ++k) {
    made.noise.measurement.push_back(0.1 + 0.05 * static_cast<double>(k));
    made.noise.disturbance[k] = 0.4 + 0.2 * static_cast<double>(k);
  }
  return made;
}

/// The deviations d (m of each sample, sample by sample) and the coloured noises c as linear
/// functions of independent standard normal numbers z, and what was measured of both.
struct JointGaussian {
  Vector mean;                ///< of d, m n
  Matrix deviations;          ///< d = mean + deviations z
  std::vector<Matrix> noise;  ///< per state: c = noise z, n entries; 0 x 0 where there is none
  Matrix rates;               ///< disturbance of equation k in step i: row i m + k, rates z
  Matrix reads;               ///< measured - path - d's mean = reads z + white noise
  Vector white;               ///< its variances
  Vector left;                ///< measured - path - d's mean, sample by sample
};

/// Standard deviation of the disturbance of an equation as a mean rate in a step.
inline double disturbance_in(const GaussianCase& made, Index step, Index equation) {
  const LinearisedRecord& record = made.record;
  const double length = record.time[step + 1] - record.time[step];
  const double own = std::pow(made.noise.disturbance[equation], 2);
  const double bridge = record.bridge.size() > 0 ? record.bridge(equation, step) : 0.0;
  return std::sqrt(std::max(own, bridge) / length);
}

/// Coloured noise of a channel: stationary, its correlation exp(-steps * step / time).
inline Matrix colour_map(const ColouredNoise& colour, Index n, double step, Index first,
                         Index size) {
  Matrix map = Matrix::Zero(n, size);
  const double decay = std::exp(-step / colour.time);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j <= i; ++j)
      map(i, first + j) = colour.deviation * (j > 0 ? std::sqrt(1.0 - decay * decay) : 1.0) *
                          std::pow(decay, static_cast<double>(i - j));
  return map;
}

inline JointGaussian joint_of(const GaussianCase& made) {
  const LinearisedRecord& record = made.record;
  const Index n = record.samples(), m = record.states(), steps = n - 1;
  const Index size = m + m * steps + m * n;  // start, disturbances, coloured noises
  JointGaussian joint{Vector::Zero(m * n), Matrix::Zero(m * n, size), {}, {}, {}, {}, {}};
  joint.rates = Matrix::Zero(m * steps, size);
  const Vector span = record.path.colwise().maxCoeff() - record.path.colwise().minCoeff();
  for (Index k = 0; k < m; ++k) joint.deviations(k, k) = span[k] > 0.0 ? span[k] : 1.0;
  for (Index i = 0; i < steps; ++i) {
    const Eigen::Map<const Matrix> phi(record.transition.col(i).data(), m, m);
    joint.mean.segment((i + 1) * m, m) =
        phi * joint.mean.segment(i * m, m) + record.defect.col(i);
    auto next = joint.deviations.middleRows((i + 1) * m, m);
    next = phi * joint.deviations.middleRows(i * m, m);
    for (Index k = 0; k < m; ++k) {
      const Eigen::Map<const Matrix> w(record.response.col(i).data() + 3 * m * k, m, 3);
      const Index own = m + i * m + k;
      joint.rates(i * m + k, own) = disturbance_in(made, i, k);
      next.col(own) += w.rowwise().sum() * joint.rates(i * m + k, own);
    }
  }
  const double step = (record.time[n - 1] - record.time[0]) / static_cast<double>(steps);
  for (Index k = 0; k < m; ++k) {
    const auto& colour = made.noise.coloured[static_cast<std::size_t>(k)];
    joint.noise.push_back(colour ? colour_map(*colour, n, step, m + m * steps + k * n, size)
                                 : Matrix());
  }
  std::vector<Vector> reads;
  std::vector<double> white, left;
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < m; ++k) {
      const auto state = static_cast<std::size_t>(k);
      if (!made.noise.measurement[state]) continue;
      if (made.omitted.size() > 0 && made.omitted(i, k) != 0.0) continue;
      Vector read = joint.deviations.row(i * m + k);
      if (joint.noise[state].size() > 0) read += joint.noise[state].row(i).transpose();
      reads.push_back(read);
      white.push_back(std::pow(*made.noise.measurement[state], 2));
      left.push_back(made.measured(i, k) - record.path(i, k) - joint.mean[i * m + k]);
    }
  joint.reads.resize(static_cast<Index>(reads.size()), size);
  for (std::size_t r = 0; r < reads.size(); ++r)
    joint.reads.row(static_cast<Index>(r)) = reads[r].transpose();
  joint.white = Eigen::Map<const Vector>(white.data(), static_cast<Index>(white.size()));
  joint.left = Eigen::Map<const Vector>(left.data(), static_cast<Index>(left.size()));
  return joint;
}

/// The case with a record drawn from its own distribution.
inline GaussianCase drawn(GaussianCase made, std::uint64_t seed) {
  const JointGaussian joint = joint_of(made);
  Random random(seed);
  const Vector z = random_matrix(random, joint.deviations.cols(), 1, 1.0);
  const Vector d = joint.mean + joint.deviations * z;
  const Index m = made.record.states();
  for (Index k = 0; k < m; ++k) {
    const auto state = static_cast<std::size_t>(k);
    made.measured.col(k) = made.record.path.col(k) + d(Eigen::seq(k, Eigen::last, m));
    if (joint.noise[state].size() > 0) made.measured.col(k) += joint.noise[state] * z;
    for (double& value : made.measured.col(k))
      value += made.noise.measurement[state].value_or(0.0) * random.normal();
  }
  return made;
}

/// Cholesky factor of the covariance of what was measured.
inline Eigen::LLT<Matrix> measured_covariance(const JointGaussian& joint) {
  return Eigen::LLT<Matrix>(joint.reads * joint.reads.transpose() +
                            Matrix(joint.white.asDiagonal()));
}

/// -2 log likelihood: log det S + r' S^-1 r.
inline double joint_deviance(const GaussianCase& made) {
  const JointGaussian joint = joint_of(made);
  const Eigen::LLT<Matrix> factor = measured_covariance(joint);
  return 2.0 * Matrix(factor.matrixL()).diagonal().array().log().sum() +
         joint.left.dot(factor.solve(joint.left));
}

/// The least joint deviance over factors of some deviations, which `entries(noise)` points to:
/// a search along the axes by ever smaller factors.
template <class Entries>
double least_joint_deviance(GaussianCase made, Entries entries) {
  double best = joint_deviance(made);
  for (double reach = 0.5; reach > 2e-3; reach *= 0.5)
    for (bool better = true; better;) {
      better = false;
      for (double* entry : entries(made.noise))
        for (const double factor : {std::exp(reach), std::exp(-reach)}) {
          const double before = *entry;
          *entry *= factor;
          const double now = joint_deviance(made);
          if (now < best - 1e-9) {
            best = now;
            better = true;
          } else {
            *entry = before;
          }
        }
    }
  return best;
}

/// Mean of z when everything measured is known.
inline Vector posterior(const JointGaussian& joint) {
  return joint.reads.transpose() * measured_covariance(joint).solve(joint.left);
}

}  // namespace lacuna::support
