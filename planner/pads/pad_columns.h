/// The points of pads in columns, whose friction is added up several at once. Internal to
/// the planner.
#pragma once

#include <limits>

#include "mechanics/pad_drag.h"
#include "mechanics/planar_problem.h"
#include "scene/frames.h"

namespace prehensile {

/// Room for so many points, in numbers of some kind. No heap.
template <class Scalar, int kMost>
class PadColumns {
 public:
  bool is_empty() const { return share_.size() == 0; }

  /// The points of a grasp at an angle theta of the object, as they lie about the finger
  /// axis in O, in lengths of `unit` [m]; their bounds over `total` [N].
  void add(const PlanarGrasp& grasp, double theta, double unit, double total) noexcept {
    Eigen::Index next = share_.size();
    for (Column* column : {&x_, &y_, &share_}) {
      column->conservativeResize(next + grasp.count);
    }
    for (int j = 0; j < grasp.count; ++j, ++next) {
      const Vec2 r = rotated(-theta, Vec2(grasp.x[j], grasp.y[j])) / unit;
      x_[next] = static_cast<Scalar>(r.x());
      y_[next] = static_cast<Scalar>(r.y());
      share_[next] = static_cast<Scalar>(grasp.bound[j] / total);
    }
  }

  /// Force over the total, and moment about the finger axis over that and the unit, that
  /// overcome them in a motion of the object in the hand, in O, of any scale: `omega` is
  /// the rate of turn times the unit.
  PadDrag drag(const Vec2& velocity, double omega) const noexcept {
    const auto turning = static_cast<Scalar>(omega);
    const Column vx = static_cast<Scalar>(velocity.x()) - turning * y_;
    const Column vy = static_cast<Scalar>(velocity.y()) + turning * x_;
    const Column rate = share_ / (vx.square() + vy.square() + kAtRest).sqrt();
    return {{(rate * vx).sum(), (rate * vy).sum()}, (rate * (x_ * vy - y_ * vx)).sum()};
  }

  /// Power over the total that they take in the same motion.
  double power(const Vec2& velocity, double omega) const noexcept {
    const auto turning = static_cast<Scalar>(omega);
    const auto vx = static_cast<Scalar>(velocity.x()) - turning * y_;
    const auto vy = static_cast<Scalar>(velocity.y()) + turning * x_;
    return (share_ * (vx.square() + vy.square()).sqrt()).sum();
  }

 private:
  using Column = Eigen::Array<Scalar, Eigen::Dynamic, 1, 0, kMost, 1>;

  /// Keeps the friction of a point at rest from being no number: it adds nothing.
  static constexpr Scalar kAtRest = std::numeric_limits<Scalar>::min();

  Column x_, y_, share_;
};

}  // namespace prehensile
