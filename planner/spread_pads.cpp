#include "planner/spread_pads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mechanics/sticking.h"
#include "planner/ring_pads.h"

namespace prehensile {
namespace {

/// Places along a push are less than this apart, in torque radii.
constexpr double kApart = 0.125;

/// [m^2/s^2] Keeps the friction of a point at rest from being no number: it adds nothing.
template <class Scalar>
constexpr Scalar kAtRest = std::numeric_limits<Scalar>::min();

}  // namespace

bool has_clipped_discs(const Model& model) {
  return model.region.is_isotropic() && !model.region.is_fixed_in_hand() &&
         !can_roll(model.scene.object) && model.F > 0.0 && model.c > 0.0;
}

template <class Scalar>
SpreadPadsOf<Scalar>::SpreadPadsOf(const Model& model, const Vec2& p_OF,
                                   int angles) noexcept {
  for (Column* column : {&x_, &y_, &share_}) column->resize(column->MaxSizeAtCompileTime);
  Eigen::Index count = 0;
  for (int k = 0; k < angles; ++k) {
    const double theta = 2.0 * std::numbers::pi * k / angles;
    const PlanarGrasp grasp =
        grasp_at(model, pose_from_finger(p_OF, theta), Vec2::Zero());
    if (grasp.count == 0) {
      count = 0;
      break;
    }
    for (int j = 0; j < grasp.count; ++j) {
      const Vec2 r = rotated(-theta, Vec2(grasp.x[j], grasp.y[j]));
      x_[count] = static_cast<Scalar>(r.x());
      y_[count] = static_cast<Scalar>(r.y());
      share_[count] = static_cast<Scalar>(grasp.bound[j] / (angles * model.F));
      ++count;
    }
  }
  for (Column* column : {&x_, &y_, &share_}) column->conservativeResize(count);
}

template <class Scalar>
PadDrag SpreadPadsOf<Scalar>::drag(const Vec2& velocity, double omega) const noexcept {
  const auto rate_of_turn = static_cast<Scalar>(omega);
  const Column vx = static_cast<Scalar>(velocity.x()) - rate_of_turn * y_;
  const Column vy = static_cast<Scalar>(velocity.y()) + rate_of_turn * x_;
  const Column rate = share_ / (vx.square() + vy.square() + kAtRest<Scalar>).sqrt();
  return {{(rate * vx).sum(), (rate * vy).sum()}, (rate * (x_ * vy - y_ * vx)).sum()};
}

template <class Scalar>
double SpreadPadsOf<Scalar>::power(const Vec2& velocity, double omega) const noexcept {
  const auto rate_of_turn = static_cast<Scalar>(omega);
  const auto vx = static_cast<Scalar>(velocity.x()) - rate_of_turn * y_;
  const auto vy = static_cast<Scalar>(velocity.y()) + rate_of_turn * x_;
  return (share_ * (vx.square() + vy.square()).sqrt()).sum();
}

template class SpreadPadsOf<double>;
template class SpreadPadsOf<float>;

double spread_slack(const Model& model, const PushContact& contact, const Vec2& p_OF,
                    const Vec2& velocity, double omega) noexcept {
  if (velocity.isZero(0.0) && omega == 0.0) return kNan;
  const SpreadPads pads(model, p_OF);
  if (pads.are_lost()) return -std::numeric_limits<double>::infinity();
  return slack_of_friction(model, contact, p_OF, pads.drag(velocity, omega));
}

double spread_slack_along(const Model& model, const PushContact& contact,
                          const Vec2& p_OF, const Vec2& e, double travel, double turn,
                          int most, int* clipped) noexcept {
  const double whole = ring_slack(model, contact, p_OF, e, travel, turn);
  const auto slack_at = [&](double share) {
    const Vec2 at = p_OF - share * travel * e;
    if (model.region.is_whole(pose_from_finger(at, 0.0))) return whole;
    if (clipped) ++*clipped;
    return spread_slack(model, contact, at, travel * e, turn);
  };
  const double wanted = std::ceil(travel / (kApart * model.c));
  const int parts = static_cast<int>(std::min(std::max(wanted, 2.0), 1.0 * most));
  double slack = std::min(slack_at(0.0), slack_at(1.0));
  for (int i = 1; i < parts && slack >= -kStickTolerance; ++i) {
    slack = std::min(slack, slack_at(static_cast<double>(i) / parts));
  }
  return slack;
}

}  // namespace prehensile
