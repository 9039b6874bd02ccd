/// The forces of a contact that come nearest to balance. Part of the certificate: shares
/// no code with the solvers. Internal to the mechanics layer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/SVD>

#include "mechanics/certificate_evidence.h"

namespace prehensile {

/// Forces that a given twist leaves open, driven as close to balance as they go: a finger
/// point at rest takes any force within its bound, and the pusher's cones give multiples,
/// none negative, of at most four edges. The best multiples use linearly independent
/// edges, so all small subsets of edges are tried; each is a linear least-squares
/// problem.
class ConeBalance {
 public:
  static constexpr double kOnePoint = 4e-6;  ///< levers nearer than this are the same

  explicit ConeBalance(const Vec3& rest) : rest_(rest) {}

  /// `wrench` comes with a normal force of 1.
  void add_edge(const Vec3& wrench) {
    const double size = wrench.norm();
    edges_[count_] = wrench / size;
    normals_[count_++] = 1.0 / size;
  }

  /// The finger point at rest: its lever and bound. Points in the same place add up.
  void add_pivot(const Vec2& lever, double bound) {
    if (has_pivot_ && (lever - pivot_).norm() > kOnePoint) several_ = true;
    has_pivot_ = true;
    pivot_ = lever;
    bound_ += bound;
  }

  void prescribe_normal_sum(double sum) {
    prescribed_ = true;
    normal_sum_ = sum;
  }

  double least_violation() const {
    if (several_) return kFails;  // At rest: not another motion.
    double least = violation(Eigen::Vector4d::Zero());
    for (int subset = 1; subset < (1 << count_); ++subset) {
      least = std::min(least, violation(best_multiples(subset)));
    }
    return least;
  }

 private:
  /// Rows to be made small (first) and to be met (last), as functions of the multiples:
  /// without a pivot the whole wrench is to be small; with one, its moment about the
  /// pivot is to vanish and its force to stay within the bound.
  struct Rows {
    Eigen::Matrix<double, 4, 5> values = Eigen::Matrix<double, 4, 5>::Zero();
    int small = 0;
    int exact = 0;
  };

  Rows rows() const {
    Rows rows;
    Eigen::Matrix<double, 3, 5> wrenches;
    for (int k = 0; k < 4; ++k) wrenches.col(k) = k < count_ ? edges_[k] : Vec3::Zero();
    wrenches.col(4) = rest_;
    if (has_pivot_) {  // Moments about the pivot.
      wrenches.row(2) -= pivot_.x() * wrenches.row(1) - pivot_.y() * wrenches.row(0);
    }
    rows.values.topRows<3>() = wrenches;
    rows.small = has_pivot_ ? 2 : 3;
    rows.exact = has_pivot_ ? 1 : 0;
    if (prescribed_) {
      for (int k = 0; k < count_; ++k)
        rows.values(rows.small + rows.exact, k) = normals_[k];
      rows.values(rows.small + rows.exact, 4) = -normal_sum_;
      ++rows.exact;
    }
    return rows;
  }

  /// Least squares over the edges of a subset; rows to be met weigh more.
  Eigen::Vector4d best_multiples(int subset) const {
    const Rows all = rows();
    Eigen::Matrix4d matrix = all.values.leftCols<4>();
    Eigen::Vector4d right = -all.values.col(4);
    matrix.middleRows(all.small, all.exact) *= kWeight;
    right.segment(all.small, all.exact) *= kWeight;
    for (int k = 0; k < 4; ++k) {
      if (k >= count_ || (subset >> k & 1) == 0) matrix.col(k).setZero();
    }
    const Eigen::JacobiSVD<Eigen::Matrix4d> factors(
        matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return Eigen::Vector4d(factors.solve(right)).cwiseMax(0.0);
  }

  double violation(const Eigen::Vector4d& multiples) const {
    const Rows all = rows();
    const Eigen::Vector4d gap = all.values.leftCols<4>() * multiples + all.values.col(4);
    const double small = gap.head(all.small).norm();
    double worst = has_pivot_ ? std::max(0.0, small - bound_) : small;
    for (int k = 0; k < all.exact; ++k)
      worst = worse(worst, std::abs(gap[all.small + k]));
    return worst;
  }

  static constexpr double kWeight = 1e4;

  Vec3 rest_;
  int count_ = 0;
  std::array<Vec3, 4> edges_;
  std::array<double, 4> normals_{};
  bool has_pivot_ = false;
  bool several_ = false;
  Vec2 pivot_ = Vec2::Zero();
  double bound_ = 0.0;
  bool prescribed_ = false;
  double normal_sum_ = 0.0;
};

}  // namespace prehensile
