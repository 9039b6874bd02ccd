/// What confines a regrasp besides contact: limits on the grasp and the hand, and bodies
/// that nothing may hit.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/shapes.h"

namespace prehensile {

/// Where grasp and hand may get to, ends included; what is unset does not limit. They
/// hold all along every push, those of the hand in the approach and retreat, too.
struct GraspLimits {
  /// [rad] of O in H, as a number: 350 deg is beyond 90 deg, however it was reached.
  std::optional<double> theta_low, theta_high;
  std::optional<Vec2> finger_low, finger_high;  ///< [m] of the finger axis in O
  std::optional<Vec2> hand_low, hand_high;      ///< [m] of the origin of H in W
  /// [rad] of H in W, as an angle; both or none, high - low <= 2 pi.
  std::optional<double> hand_angle_low, hand_angle_high;
};

struct SphereShape {
  double radius = 0.0;  ///< [m]
};

/// All points within `radius` of a segment of this length, centred.
struct CapsuleShape {
  double radius = 0.0;  ///< [m]
  double length = 0.0;  ///< [m] of the segment
  Axis axis = Axis::kZ;
};

/// All points p with normal.p <= 0: a table.
struct HalfSpaceShape {
  Vec3 normal = Vec3::UnitZ();  ///< of unit length
};

/// Convex: the outline of a prism is.
using BodyShape = std::variant<BoxShape, SphereShape, CylinderShape, CapsuleShape,
                               PrismShape, HalfSpaceShape>;

/// A body at rest in its frame: first turned by the quaternion, then by `turn` about +z,
/// then moved.
struct ConvexBody {
  std::string name;
  BodyShape shape;
  Vec3 position = Vec3::Zero();                             ///< [m]
  std::array<double, 4> quaternion = {0.0, 0.0, 0.0, 1.0};  ///< unit, x, y, z, w
  double turn = 0.0;                                        ///< [rad]
};

/// Bodies that keep apart: those of the fixture from those of the hand, and from the held
/// object but where it touches the pusher; those of the hand that reach between the faces
/// which the pads touch, as a palm does, from the held object.
struct Obstacles {
  double clearance = 1e-3;  ///< [m] of the hand from the fixture and the object, >= 0
  double approach = 0.03;   ///< [m] along the pusher's normal, free before and after
  std::vector<ConvexBody> fixture;  ///< in W
  std::vector<ConvexBody> hand;     ///< in H
};

}  // namespace prehensile
