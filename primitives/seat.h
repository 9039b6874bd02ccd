/// Where and how a pusher touches the object: the seat. Within a seat two coordinates fix
/// the object in P exactly, so a slipping push is integrated in them and no gap can open:
///
///   slide [m]    displacement of the object along the pusher since the seat was taken
///   tilt [rad]   angle of O in P; stays zero on a flush seat
///
/// All geometry is in P, which coincides with O at the start of the push.
#pragma once

#include <array>

#include "primitives/push.h"

namespace prehensile {

enum class SeatKind {
  kFlush,        ///< a line pusher lies on the face
  kPusherPoint,  ///< a point, or an end of a line, of the pusher on the face
  kFaceEnd,      ///< an end of the face on the line of the pusher
};

struct Seat {
  SeatKind kind = SeatKind::kFlush;
  Vec2 p_P = Vec2::Zero();  ///< the seat on the pusher, in P, at slide = 0
  Vec2 p_O = Vec2::Zero();  ///< the seat on the object, in O, at slide = 0
  int side = 0;             ///< sign of the tilt that a tipped seat allows; 0: any
};

/// The shape of a contact along the face, and the seats on it.
class SeatGeometry {
 public:
  SeatGeometry(const Model& model, const PushContact& contact, double place);

  /// The seat in which every push begins.
  Seat first() const;

  /// The seat after a flush line has tipped about its lower (0) or upper (1) end.
  Seat tipped(const Seat& flush, double slide, int end) const;

  /// Flush again after the tilt came back to zero.
  Seat flush(const Seat& tipped, double slide) const;

  /// Pose of O in P; q = (slide, tilt).
  PlanarPose object(const Seat& seat, const Vec2& q) const;

  /// The points that touch, in P, and the normal there; a flush seat has two, lower end
  /// first.
  struct Touch {
    int count = 1;
    std::array<Vec2, 2> p_P;
    Vec2 n_P;
  };
  Touch touch(const Seat& seat, const Vec2& q) const;

  /// Room left until the pusher runs off the face [m]; negative beyond.
  double room(const Seat& seat, double slide) const;

  /// Room left until another part of the object meets the pusher [m].
  double clearance(const Seat& seat, const Vec2& q) const;

 private:
  /// Range along t, measured from the centre of the face at the start.
  struct Range {
    double low, high;
  };
  Range face(double slide) const { return {slide - half_face_, slide + half_face_}; }
  Range pusher() const { return {place_ - half_length_, place_ + half_length_}; }
  double along(const Vec2& p) const { return t_.dot(p - centre_); }
  Vec2 point(double along) const { return centre_ + along * t_; }

  const std::vector<Vec2>* outline_;
  Vec2 n_, t_, centre_;
  double half_face_, half_length_, place_;
  bool is_point_;
  double touch_depth_;  ///< [m] depth below which two bodies count as touching
};

}  // namespace prehensile
