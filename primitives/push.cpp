#include "primitives/push.h"

#include <cmath>

namespace prehensile {
namespace {

LinearPush linear(const LinearPush& push) { return push; }

LinearPush linear(const Slide& slide) {
  return {slide.contact, slide.place, slide.e, slide.travel, 0.0};
}

LinearPush linear(const Pivot& pivot) {
  return {pivot.contact, pivot.place, {1.0, 0.0}, 0.0, pivot.turn};
}

/// What a unit vector e that turns by `bend` at a constant rate has covered at s.
Vec2 path_along(const Vec2& e, double bend, double s) {
  const double half = 0.5 * bend * s;
  const double chord = std::abs(half) < 1e-8 ? 1.0 : std::sin(half) / half;
  return s * chord * rotated(half, e);
}

/// A roll leaves the pad plane alone.
LinearPush linear(const Roll& roll) { return {roll.contact, 0.0, {1.0, 0.0}, 0.0, 0.0}; }

}  // namespace

int contact_of(const Push& push) {
  return std::visit([](const auto& kind) { return kind.contact; }, push);
}

LinearPush as_linear(const Push& push) {
  return std::visit([](const auto& kind) { return linear(kind); }, push);
}

PlanarPose pusher_pose(const LinearPush& push, const PlanarPose& X_HO_start,
                       double s) noexcept {
  const Vec2 p_PF =
      finger_in_object(X_HO_start) - push.travel * path_along(push.e, push.bend, s);
  return pose_from_finger(p_PF, X_HO_start.theta + s * push.turn);
}

PlanarTwist pusher_twist(const LinearPush& push, const PlanarPose& X_HO_start,
                         double s) noexcept {
  // The point of P on the finger axis moves along +e, for the axis runs along -e (turned)
  // in P.
  const Vec2 v =
      rotated(X_HO_start.theta + s * (push.turn + push.bend), push.travel * push.e);
  return {v.x(), v.y(), push.turn};
}

const char* kind_name(double travel, double turn, double roll, double travel_tolerance,
                      double turn_tolerance) {
  const bool travels = std::abs(travel) > travel_tolerance;
  const bool turns = std::abs(turn) > turn_tolerance;
  const bool rolls = std::abs(roll) > turn_tolerance;
  if (rolls && !travels && !turns) return "roll";
  if (travels && !turns && !rolls) return "slide";
  if (turns && !travels && !rolls) return "pivot";
  return "push";
}

}  // namespace prehensile
