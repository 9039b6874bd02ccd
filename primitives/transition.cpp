#include "primitives/transition.h"

#include <cmath>

#include "primitives/linear_push.h"
#include "primitives/roll.h"
#include "primitives/seat.h"
#include "scene/lying_prism.h"

namespace prehensile {
namespace {

Guard guard_of(const Push& push) {
  Guard guard;
  if (const auto* slide = std::get_if<Slide>(&push)) guard.angle = slide->guard_angle;
  if (const auto* pivot = std::get_if<Pivot>(&push)) {
    guard.distance = pivot->guard_distance;
  }
  return guard;
}

bool is_finite(const LinearPush& push, const Grasp& start) {
  return std::isfinite(push.place) && push.e.allFinite() && std::isfinite(push.travel) &&
         std::isfinite(push.turn) && std::isfinite(push.bend) &&
         std::isfinite(start.X_HO.x) && std::isfinite(start.X_HO.y) &&
         std::isfinite(start.X_HO.theta);
}

/// Why the push cannot even begin; empty if it can.
std::string_view refusal(const Model& model, const Grasp& start, const LinearPush& push,
                         const Guard& guard, const TransitionOptions& options) {
  if (push.contact < 0 || push.contact >= static_cast<int>(model.contacts.size())) {
    return "the scene has no such contact";
  }
  if (!are_usable(options)) return "an option is out of range";
  if (!is_finite(push, start)) return "a number is not finite";
  if (push.travel < 0.0) return "the travel is negative";
  if (!(guard.angle > 0.0 && guard.distance > 0.0)) return "the guard is not positive";
  if (std::abs(push.e.norm() - 1.0) > 1e-9) return "the direction is not a unit vector";
  if (push.travel == 0.0 && push.turn == 0.0) return "the pusher does not move";
  if (model.prism && !looks_alike(*model.prism, start.psi)) {
    return "the prism has rolled to an attitude for which its sides in the pad plane are "
           "not known";
  }
  if (!pads_on_object(model, start.X_HO)) return "the pads are not on the object";

  const SeatGeometry geometry(model, model.contacts[push.contact], push.place);
  const Seat seat = geometry.first();
  // A point may stand on the very end of the face; a line needs some length of it.
  const double room = geometry.room(seat, 0.0);
  if (room < 0.0 || (seat.kind == SeatKind::kFlush && room == 0.0)) {
    return "the pusher stands beside the face";
  }
  if (geometry.clearance(seat, Vec2::Zero()) < 0.0) {
    return "the pusher cuts the object";
  }
  return {};
}

}  // namespace

bool are_usable(const TransitionOptions& options) {
  return options.tolerance > 0.0 && options.max_step > 0.0 && options.max_step <= 1.0 &&
         options.max_steps > 0 && options.certificate_tolerance > 0.0;
}

std::string_view name(TransitionStatus status) {
  switch (status) {
    case TransitionStatus::kNotRun:
      return "not run";
    case TransitionStatus::kCompleted:
      return "completed";
    case TransitionStatus::kLeftGuard:
      return "left guard";
    case TransitionStatus::kPusherLost:
      return "pusher lost";
    case TransitionStatus::kPadLost:
      return "pad lost";
    case TransitionStatus::kLeavesPlane:
      return "leaves the pad plane";
    case TransitionStatus::kFalls:
      return "falls";
    case TransitionStatus::kJammed:
      return "jammed";
    case TransitionStatus::kAmbiguous:
      return "ambiguous";
    case TransitionStatus::kUncertified:
      return "uncertified";
    case TransitionStatus::kIterationLimit:
      return "iteration limit";
    case TransitionStatus::kRefused:
      return "refused";
  }
  return "unknown";
}

std::string_view name(EventKind kind) {
  switch (kind) {
    case EventKind::kStick:
      return "stick";
    case EventKind::kSlip:
      return "slip";
    case EventKind::kCorner:
      return "corner";
    case EventKind::kFlush:
      return "flush";
    case EventKind::kOverEdge:
      return "over an edge";
    case EventKind::kPusherOffFace:
      return "pusher off face";
    case EventKind::kPadOffFace:
      return "pad off face";
    case EventKind::kContactLost:
      return "contact lost";
    case EventKind::kGravityLost:
      return "gravity lost";
    case EventKind::kOutOfPlane:
      return "out of plane";
    case EventKind::kTips:
      return "tips by itself";
    case EventKind::kGuard:
      return "guard";
  }
  return "unknown";
}

Transition apply(const Model& model, const Grasp& start, const Push& push,
                 const TransitionOptions& options, std::vector<Sample>* trace) noexcept {
  if (const auto* roll = std::get_if<Roll>(&push)) {
    return apply_roll(model, start, *roll, options, trace);
  }
  const LinearPush linear = as_linear(push);
  const Guard guard = guard_of(push);
  const std::string_view reason = refusal(model, start, linear, guard, options);
  if (reason.empty()) return follow(model, start, linear, guard, options, trace);

  Transition refused;
  refused.status = TransitionStatus::kRefused;
  refused.reason = reason;
  refused.end = start;
  return refused;
}

}  // namespace prehensile
