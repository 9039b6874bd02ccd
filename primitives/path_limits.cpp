#include "primitives/path_limits.h"

#include <algorithm>
#include <cmath>

namespace prehensile {

PathLimits::PathLimits(const Model& model, const Grasp& start, const Guard& guard,
                       double reach)
    : model_(&model),
      guard_(guard),
      p_OF_start_(finger_in_object(start.X_HO)),
      theta_start_(start.X_HO.theta),
      reach_(reach) {}

PathLimits::Values PathLimits::at(const SeatGeometry& geometry, const Seat& seat,
                                  const Vec2& q, const PlanarPose& X_HO,
                                  bool whole) const noexcept {
  const Vec2 p_OF = finger_in_object(X_HO);
  // Beyond flush the face itself enters the pusher; kFlush has to report that.
  const double open_tilt = seat.side * q[1] < 0.0 ? 0.0 : q[1];
  const double drifted = (p_OF - p_OF_start_).norm();
  const double turned = std::abs(X_HO.theta - theta_start_);
  return {geometry.room(seat, q[0]),
          depth_inside(model_->pad_face, p_OF),
          std::min(reach_ * (guard_.angle - turned), guard_.distance - drifted),
          geometry.clearance(seat, {q[0], open_tilt}),
          seat.side == 0 ? std::numeric_limits<double>::infinity()
                         : seat.side * q[1] * reach_,
          whole ? model_->region.whole_margin(X_HO) : -model_->region.whole_margin(X_HO)};
}

bool PathLimits::are_kept(const Values& one, const Values& other, const StepBound& bound,
                          double width, double depth) const noexcept {
  const auto sum = [&](Limit limit) {
    const auto i = static_cast<std::size_t>(limit);
    return std::max(one[i], -depth) + std::max(other[i], -depth) + 4.0 * depth;
  };
  const auto least = [&](Limit limit) {
    const auto i = static_cast<std::size_t>(limit);
    return std::max(std::min(one[i], other[i]), -depth) + 2.0 * depth;
  };
  // Depth and drift change no faster than the finger axis moves in the object.
  if (sum(Limit::kPad) < width * bound.way) return false;
  const double turned = std::isinf(guard_.angle) ? 0.0 : reach_ * bound.turn;
  const double drifted = std::isinf(guard_.distance) ? 0.0 : bound.way;
  if (sum(Limit::kGuard) < width * std::max(turned, drifted)) return false;
  // Room is concave in the slide, and the way to flush linear in the tilt: they are least
  // at the ends, or where the motion has come back from.
  return !(least(Limit::kRoom) < width * bound.slide_back ||
           least(Limit::kFlush) < width * bound.tilt_back * reach_ ||
           width > bound.spacing);
}

PushStop PathLimits::why_not(Limit limit, const Seat& seat) const {
  using enum TransitionStatus;
  switch (limit) {
    case Limit::kRoom:
      return {kPusherLost, EventKind::kPusherOffFace,
              seat.side == 0 ? "the pusher runs off the face"
                             : "a corner of the object meets one of the pusher"};
    case Limit::kPad:
      return {kPadLost, EventKind::kPadOffFace, "the centre of the pads leaves the face"};
    case Limit::kGuard:
      return {kLeftGuard, EventKind::kGuard,
              std::isinf(guard_.angle) ? "the finger axis drifts in the object"
                                       : "the object turns"};
    case Limit::kClearance:
      return {kPusherLost, EventKind::kContactLost,
              "another part of the object meets the pusher"};
    case Limit::kFlush:
    case Limit::kWholePad:
      break;
  }
  return {};
}

}  // namespace prehensile
