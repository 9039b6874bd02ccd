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
