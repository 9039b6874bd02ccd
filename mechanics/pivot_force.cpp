/// The force of a finger point at the centre of rotation, where the motion alone does not
/// determine it.
#include "mechanics/pad_friction.h"

namespace prehensile {
namespace {

/// The pusher's law is linear in the pivot's force k: half planes a.k + c >= 0, and the
/// disc |k| <= bound.
class PivotForces {
 public:
  PivotForces(double bound, const Vec2& objective)
      : bound_(bound), objective_(objective) {}

  void require(const Vec2& a, double c) { planes_[count_++] = {a, c}; }
  void require_zero(const Vec2& a, double c) {
    require(a, c);
    require(-a, -c);
  }

  /// Visits every point at which a linear function or the norm may be extreme.
  void search() {
    consider(Vec2::Zero());
    consider(bound_ * objective_);
    consider(-bound_ * objective_);
    for (int i = 0; i < count_; ++i) {
      const auto& [a, c] = planes_[i];
      const double square = a.squaredNorm();
      if (square == 0.0) continue;
      const Vec2 foot = -c / square * a;
      consider(foot);
      const double room = bound_ * bound_ - foot.squaredNorm();
      if (room >= 0.0) {
        const Vec2 along = std::sqrt(room / square) * perp(a);
        consider(foot + along);
        consider(foot - along);
      }
      for (int j = 0; j < i; ++j) meet(planes_[i], planes_[j]);
    }
  }

  bool found() const { return least_norm_ < std::numeric_limits<double>::infinity(); }
  const Vec2& smallest() const { return smallest_; }
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  struct Plane {
    Vec2 a;
    double c;
  };

  void meet(const Plane& first, const Plane& second) {
    const double det = cross(first.a, second.a);
    if (std::abs(det) <= 1e-14 * first.a.norm() * second.a.norm()) return;
    consider(Vec2(-first.c * second.a.y() + second.c * first.a.y(),
                  -second.c * first.a.x() + first.c * second.a.x()) /
             det);
  }

  void consider(const Vec2& k) {
    if (k.norm() > bound_ * (1.0 + 1e-12)) return;
    for (int i = 0; i < count_; ++i) {
      const double slack = planes_[i].a.dot(k) + planes_[i].c;
      if (slack < -1e-12 * (1.0 + planes_[i].a.norm())) return;
    }
    const double value = objective_.dot(k);
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
    if (k.norm() < least_norm_) {
      least_norm_ = k.norm();
      smallest_ = k;
    }
  }

  double bound_;
  Vec2 objective_;
  int count_ = 0;
  std::array<Plane, 6> planes_;
  Vec2 smallest_ = Vec2::Zero();
  double least_norm_ = std::numeric_limits<double>::infinity();
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

void PadFriction::choose_pivot_force(const ScaledPush& push,
                                     Motion& motion) const noexcept {
  const PlanarWrench rest = resistance(motion.u, {}) - push.w_g + push.inertial_force;
  const Vec2 f = rest.head<2>();
  const Vec2 pivot = at(motion.pivot.index);
  PivotForces forces(merged_bound(motion.pivot.index), push.n);
  for (const int side : {1, -1}) {
    const Vec2 a = push.mu * push.n + side * push.t;
    forces.require(a, a.dot(f));
  }
  if (motion.support == Motion::Support::kBoth) {
    // The moment about one end over the length of the face is the force at the other.
    const double length = cross(push.p[1] - push.p[0], push.n);
    for (const int i : {0, 1}) {
      const double per_length = (i == 0 ? 1.0 : -1.0) / length;
      forces.require(per_length * perp(pivot - push.p[i]),
                     per_length * (rest[2] - cross(push.p[i], f)));
    }
  } else {
    const Vec2& p = push.p[static_cast<int>(motion.support)];
    forces.require_zero(perp(pivot - p), rest[2] - cross(p, f));
  }
  forces.search();
  if (!forces.found()) return;
  motion.pivot.force = forces.smallest();
  motion.force_low = push.n.dot(f) + forces.low();
  motion.force_high = push.n.dot(f) + forces.high();
}

}  // namespace prehensile
