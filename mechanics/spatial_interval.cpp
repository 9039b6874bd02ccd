#include "mechanics/spatial_interval.h"

#include <algorithm>

#include <Eigen/LU>

namespace prehensile {
namespace {

constexpr double kTouching = 1e-7;   ///< gap rates and slip rates below this are none
constexpr double kInside = 1e-9;     ///< friction this far below its bound sticks
constexpr double kUnbounded = 1e6;   ///< forces beyond this have no end
constexpr double kConverged = 1e-9;  ///< change of the sum that ends the iteration
constexpr double kBalanced = 1e-12;
constexpr double kNearly = 1e-9;
constexpr int kCentres = 60;
constexpr int kSteps = 100;

using Force = Eigen::Vector4d;  // along (n, t, o), and spin moment / spin radius
using Matrix8 = Eigen::Matrix<double, 8, 8>;

/// What the motion leaves open at one point.
struct FreePoint {
  enum class Kind { kRay, kDisc, kCone };
  Kind kind;
  double mu;
  double bound;  ///< radius of the disc
  Force ray;     ///< with normal part 1
  Force centre;  ///< its force in the last round
  Force now;
  bool pushes;
  Eigen::Matrix<double, 4, 8> rows;
};

/// Nearest point of the set, and the derivative of that.
Force project(const FreePoint& point, const Force& z, Eigen::Matrix4d& slope) {
  slope.setZero();
  Force result = Force::Zero();
  if (point.kind == FreePoint::Kind::kRay) {
    const double square = point.ray.squaredNorm();
    const double along = point.ray.dot(z) / square;
    if (along <= 0.0) return result;
    slope = point.ray * point.ray.transpose() / square;
    return along * point.ray;
  }
  const Vec3 friction = z.tail<3>();
  const double size = friction.norm();
  const Vec3 u = size > 0.0 ? Vec3(friction / size) : Vec3::Zero();
  if (point.kind == FreePoint::Kind::kDisc) {
    result[0] = point.now[0];
    if (size <= point.bound) {
      result.tail<3>() = friction;
      slope.bottomRightCorner<3, 3>().setIdentity();
    } else {
      result.tail<3>() = point.bound * u;
      slope.bottomRightCorner<3, 3>() =
          point.bound / size * (Eigen::Matrix3d::Identity() - u * u.transpose());
    }
    return result;
  }
  if (size <= point.mu * z[0]) {
    slope.setIdentity();
    return z;
  }
  const double share = 1.0 / (1.0 + point.mu * point.mu);
  const double normal = share * (z[0] + point.mu * size);
  if (normal <= 0.0) return result;
  Force edge;
  edge << 1.0, point.mu * u;
  slope = share * (edge * edge.transpose());
  slope.bottomRightCorner<3, 3>() +=
      point.mu * normal / size * (Eigen::Matrix3d::Identity() - u * u.transpose());
  return normal * edge;
}

class Interval {
 public:
  Interval(const ScaledSpatial& problem, const SpatialRates& v,
           const SpatialForces& forces)
      : freedoms_(problem.freedoms) {
    for (int k = 0; k < problem.patch_count; ++k) {
      add_patch(problem, problem.patch[k], v, forces);
    }
  }

  bool pads_are_free() const { return pads_are_free_; }
  double given_sum() const { return given_sum_; }

  /// The greatest (side = 1) or least (-1) sum of the pusher's normal forces.
  bool find_end(double side, double& end) {
    for (int i = 0; i < count_; ++i) point_[i].centre = point_[i].now = start_[i];
    double before = sum();
    double r = 1.0;
    SpatialRates y = SpatialRates::Zero();
    int still = 0;
    for (int round = 0; round < kCentres; ++round) {
      if (!settle(side, r, y)) return false;
      for (int i = 0; i < count_; ++i) point_[i].centre = point_[i].now;
      const double now = sum();
      still =
          std::abs(now - before) <= kConverged * (1.0 + std::abs(now)) ? still + 1 : 0;
      before = now;
      if (std::abs(now) > kUnbounded) {
        end = side * std::numeric_limits<double>::infinity();
        return true;
      }
      if (still == 2) break;
      r = std::max(1e-6, 0.3 * r);
    }
    end = before;
    return still == 2;
  }

 private:
  void add_patch(const ScaledSpatial& problem, const ScaledPatch& patch,
                 const SpatialRates& v, const SpatialForces& forces) {
    Eigen::Matrix<double, 6, 8> T;
    for (int j = 0; j < 8; ++j) T.col(j) = patch.local_rates(SpatialRates::Unit(j));
    T.rightCols(8 - freedoms_).setZero();
    const LocalRates y = patch.relative_rates(v);
    const bool pushes = patch.body == ContactBody::kPusher;
    const bool fixed_normal = patch.given || patch.R > 0.0;
    for (int j = patch.first; j < patch.first + patch.count; ++j) {
      const double a = problem.a[j];
      const double b = problem.b[j];
      FreePoint& point = point_[count_];
      point.now << forces.n[j], forces.t[j], forces.o[j], patch.soft ? forces.s[j] : 0.0;
      point.mu = patch.mu;
      point.bound = patch.mu * point.now[0];
      point.pushes = pushes;
      const Vec3 slip(y[3] - b * y[5], y[4] + a * y[5], patch.e * y[5]);
      const double gap = y[0] + b * y[1] - a * y[2];
      const double friction = point.now.tail<3>().norm();
      const bool slips = slip.norm() > kTouching ||
                         (friction > 0.0 && friction >= (1.0 - kInside) * point.bound);
      const bool loaded = point.now[0] > 0.0;
      if (pushes) given_sum_ += point.now[0];
      if (fixed_normal ? slips || !loaded : !loaded && gap > kTouching) continue;
      if (fixed_normal) {
        point.kind = FreePoint::Kind::kDisc;
      } else if (slips) {
        point.kind = FreePoint::Kind::kRay;
        const Vec3 along = loaded ? Vec3(point.now.tail<3>() / point.now[0])
                                  : Vec3(-patch.mu * slip.normalized());
        point.ray << 1.0, along;
      } else {
        point.kind = FreePoint::Kind::kCone;
      }
      if (pushes && !fixed_normal) given_sum_ -= point.now[0];
      pads_are_free_ = pads_are_free_ || !pushes;
      point.rows.row(0) = T.row(0) + b * T.row(1) - a * T.row(2);
      point.rows.row(1) = T.row(3) - b * T.row(5);
      point.rows.row(2) = T.row(4) + a * T.row(5);
      point.rows.row(3) = patch.e * T.row(5);
      start_[count_++] = point.now;
    }
  }

  double sum() const {
    double total = given_sum_;
    for (int i = 0; i < count_; ++i) {
      const bool counts = point_[i].pushes && point_[i].kind != FreePoint::Kind::kDisc;
      if (counts) total += point_[i].now[0];
    }
    return total;
  }

  /// Change of the balance, and its derivative.
  SpatialRates evaluate(double side, double r, const SpatialRates& y, Matrix8* slope) {
    SpatialRates change = SpatialRates::Zero();
    if (slope != nullptr) slope->setZero();
    Eigen::Matrix4d by_force;
    for (int i = 0; i < count_; ++i) {
      FreePoint& point = point_[i];
      Force z = point.centre - point.rows * y / r;
      if (point.pushes) z[0] += side / r;
      point.now = project(point, z, by_force);
      change += point.rows.transpose() * (point.now - start_[i]);
      if (slope != nullptr) {
        *slope += point.rows.transpose() * (by_force / r) * point.rows;
      }
    }
    return change;
  }

  /// Newton's method for the rates that keep the balance; damped where it does not help.
  bool settle(double side, double r, SpatialRates& y) {
    Matrix8 slope;
    SpatialRates change = evaluate(side, r, y, &slope);
    double damping = 1e-12;
    for (int step = 0; step < kSteps; ++step) {
      const double before = change.norm();
      if (before <= kBalanced) return true;
      Matrix8 damped = slope;
      damped.diagonal().array() += damping * (1e-3 / r + slope.trace());
      const SpatialRates stride = damped.partialPivLu().solve(change);
      if (!stride.allFinite()) return false;
      double share = 1.0;
      bool better = false;
      for (; share > 0.05 && !better; share *= 0.5) {
        Matrix8 there_slope;
        const SpatialRates there = y + share * stride;
        const SpatialRates there_change = evaluate(side, r, there, &there_slope);
        better = there_change.norm() <= (1.0 - 1e-4 * share) * before;
        if (!better) continue;
        y = there;
        change = there_change;
        slope = there_slope;
      }
      if (better) {
        damping = std::max(1e-12, 0.01 * damping);
      } else {
        if (before <= kNearly || damping > 1e3) break;
        damping = std::max(1e-9, 30.0 * damping);
      }
    }
    evaluate(side, r, y, nullptr);
    return change.norm() <= kNearly;
  }

  int freedoms_;
  int count_ = 0;
  bool pads_are_free_ = false;
  double given_sum_ = 0.0;
  std::array<FreePoint, SpatialProblem::kMaxPoints> point_;
  std::array<Force, SpatialProblem::kMaxPoints> start_;
};

}  // namespace

ForceInterval force_interval(const ScaledSpatial& problem, const SpatialRates& v,
                             const SpatialForces& forces) noexcept {
  Interval interval(problem, v, forces);
  ForceInterval result;
  result.free_forces = interval.pads_are_free();
  if (!result.free_forces) return result;
  result.found =
      interval.find_end(1.0, result.high) && interval.find_end(-1.0, result.low);
  return result;
}

}  // namespace prehensile
