/// Object, pads and pushers as solids to draw. What has no end in the scene is given one
/// here, out of the size of the object, and marked as going on.
#pragma once

#include <string>
#include <vector>

#include "mechanics/model.h"

namespace prehensile::viewer {

/// A straight prism; outline counter-clockwise in the pad plane of its frame, or, for an
/// object that lies, its section (lateral axis, z).
struct PrismBody {
  std::vector<Vec2> outline;  ///< [m]
  double low = 0.0;           ///< [m] along the axis
  double high = 0.0;
  Axis axis = Axis::kZ;
};

struct CylinderBody {
  double radius = 0.0;  ///< [m]
  double length = 0.0;  ///< [m]
  Axis axis = Axis::kZ;
};

/// The object in O. A solid from a mesh is drawn by what the mechanics keeps of it: the
/// plate between the faces that the jaws hold, and the side at the heights it has there.
struct ObjectBody {
  std::vector<PrismBody> prisms;
  std::vector<CylinderBody> cylinders;
  std::vector<Face> sides;  ///< of a solid from a mesh: strips of the body's side
};
ObjectBody object_body(const Model& model);

/// A pad in H, behind the surface of its jaw: a plate over this outline. A line or a
/// point is drawn as wide as `width`, which the mechanics does not know.
struct PadBody {
  std::vector<Vec2> outline;  ///< [m]
  bool is_round = false;
};
PadBody pad_body(const Model& model);

/// A feature in the frame of its centre: t to the side, z as everywhere, the object on
/// the side of +n, all of it at n <= 0.
struct PusherBody {
  enum class Kind { kPoint, kLine, kUpright, kPlane } kind = Kind::kPoint;
  double length = 0.0;  ///< [m] along t; 0: a point there
  double width = 0.0;   ///< [m] along z; 0: likewise
  bool goes_on_along = false;
  bool goes_on_across = false;
};
PusherBody pusher_body(const Model& model, const Pusher& pusher);

/// "point", "line", "upright", "plane".
std::string_view name(PusherBody::Kind kind);

/// How far the object reaches from the origin of O in any direction [m].
double reach_of(const Model& model);

}  // namespace prehensile::viewer
