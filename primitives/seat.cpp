#include "primitives/seat.h"

#include <algorithm>
#include <cmath>

namespace prehensile {
namespace {

/// Relative to the size of the object.
constexpr double kTouchDepth = 1e-7;

}  // namespace

SeatGeometry::SeatGeometry(const Model& model, const PushContact& contact, double place)
    : outline_(&model.outline),
      n_(contact.n),
      t_(contact.t),
      centre_(0.5 * (contact.a + contact.b)),
      half_face_(0.5 * (contact.b - contact.a).norm()),
      half_length_(contact.half_length),
      place_(place),
      is_point_(contact.is_point),
      touch_depth_(kTouchDepth * model.L) {}

Seat SeatGeometry::first() const {
  if (!is_point_) return {SeatKind::kFlush, centre_, centre_, 0};
  return {SeatKind::kPusherPoint, point(place_), point(place_), 0};
}

Seat SeatGeometry::tipped(const Seat& flush, double slide, int end) const {
  const double offset = along(flush.p_P) + slide - along(flush.p_O);
  const bool upper = end == 1;
  const double face_end = upper ? face(offset).high : face(offset).low;
  const double pusher_end = upper ? pusher().high : pusher().low;
  const bool on_face_end = upper ? face_end <= pusher_end : face_end >= pusher_end;
  const double touch = on_face_end ? face_end : pusher_end;
  // n points into the object and t lies a quarter turn behind it: about the upper end a
  // positive turn lifts the rest of the face.
  return {on_face_end ? SeatKind::kFaceEnd : SeatKind::kPusherPoint, point(touch),
          point(touch - offset), upper ? 1 : -1};
}

Seat SeatGeometry::flush(const Seat& tipped, double slide) const {
  const Vec2 q(slide, 0.0);
  return {SeatKind::kFlush, centre_ + translation(object(tipped, q)), centre_, 0};
}

PlanarPose SeatGeometry::object(const Seat& seat, const Vec2& q) const {
  const bool pusher_fixed = seat.kind == SeatKind::kPusherPoint;
  const Vec2 p_P = pusher_fixed ? seat.p_P : Vec2(seat.p_P + q[0] * t_);
  const Vec2 p_O = pusher_fixed ? Vec2(seat.p_O - q[0] * t_) : seat.p_O;
  const double tilt = seat.kind == SeatKind::kFlush ? 0.0 : q[1];
  const Vec2 p = tilt == 0.0 ? Vec2(p_P - p_O) : Vec2(p_P - rotated(tilt, p_O));
  return {p.x(), p.y(), tilt};
}

SeatGeometry::Touch SeatGeometry::touch(const Seat& seat, const Vec2& q) const {
  switch (seat.kind) {
    case SeatKind::kPusherPoint:
      return {1, {seat.p_P, seat.p_P}, rotated(q[1], n_)};
    case SeatKind::kFaceEnd: {
      const Vec2 p_P = seat.p_P + q[0] * t_;
      return {1, {p_P, p_P}, n_};
    }
    case SeatKind::kFlush:
      break;
  }
  const Range on_face = face(along(seat.p_P) + q[0] - along(seat.p_O));
  const double low = std::max(on_face.low, pusher().low);
  const double high = std::min(on_face.high, pusher().high);
  return {2, {point(low), point(high)}, n_};
}

double SeatGeometry::room(const Seat& seat, double slide) const {
  switch (seat.kind) {
    case SeatKind::kPusherPoint:
      return half_face_ - std::abs(along(seat.p_O) - slide);
    case SeatKind::kFaceEnd:
      return half_length_ - std::abs(along(seat.p_P) + slide - place_);
    case SeatKind::kFlush:
      break;
  }
  const Range on_face = face(along(seat.p_P) + slide - along(seat.p_O));
  return std::min(on_face.high, pusher().high) - std::max(on_face.low, pusher().low);
}

double SeatGeometry::clearance(const Seat& seat, const Vec2& q) const {
  double least = std::numeric_limits<double>::infinity();
  if (is_point_) return least;
  const PlanarPose X_PO = object(seat, q);
  for (const Vec2& vertex : *outline_) {
    const Vec2 p_P = transform(X_PO, vertex);
    if (std::abs(along(p_P) - place_) > half_length_) continue;
    least = std::min(least, n_.dot(p_P - centre_) + touch_depth_);
  }
  if (std::isinf(half_length_)) return least;
  const PlanarPose X_OP = inverse(X_PO);
  for (const double end : {pusher().low, pusher().high}) {
    const double depth = depth_inside(*outline_, transform(X_OP, point(end)));
    least = std::min(least, touch_depth_ - depth);
  }
  return least;
}

}  // namespace prehensile
