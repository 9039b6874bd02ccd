/// The motion cone of a pusher at a pose: all motions of the pusher with which the object
/// moves as one body (a line pusher), or with which the point of contact sticks and the
/// object turns about it freely (a point pusher). Over the ellipsoid, edges in closed
/// form (mechanics/sticking.h).
///
/// A motion is the direction in which the pusher moves and, for a line, how fast it turns
/// for that. The robust cone is the intersection over members of a box of uncertainty:
/// its corners and points drawn inside it. It is as large as these members allow, so a
/// member in between may still slip; drawing more makes that less likely.
///
/// Source: motion cones of Chavan-Dafle, Holladay and Rodriguez (RSS 2018).
#pragma once

#include <functional>
#include <vector>

#include "mechanics/sticking.h"
#include "primitives/uncertainty.h"

namespace prehensile {

/// One member, compiled: everything that decides about sticking.
struct ConeMember {
  StickContact contact;
  LimitSurface surface;
  Vec2 p_OF = Vec2::Zero();
  PlanarWrench w_g = PlanarWrench::Zero();  ///< about the origin of H
  PlanarDrive drive;                        ///< its V_HP is filled per question
  double theta = 0.0;                       ///< [rad] of O in H
  double turned = 0.0;                      ///< [rad] error of the direction of the push
};

/// The contact at a pose. The model's F and c must be positive.
ConeMember cone_member(const Model& model, int contact, double place,
                       const PlanarPose& X_HO);

/// A member of the box around a straight push with this contact and place; `usable` is
/// false where the scene is none, the pads are off the object or have no friction.
struct CompiledMember {
  bool usable = false;
  ConeMember member;
};
CompiledMember cone_member(const Scene& scene, const Grasp& start, int contact,
                           double place, const UncertaintyBox& box, const BoxPoint& at);

/// Directions [rad] from the normal of the face, counter-clockwise, lo <= hi.
struct DirectionRange {
  double lo = 0.0;
  double hi = 0.0;
};

/// Line pusher: the object follows the pusher that moves along `direction` at the finger
/// axis while it turns by `omega_per_speed` [rad/m]. Point pusher: the point sticks while
/// it moves along `direction`; the turning makes no difference.
bool sticks(const ConeMember& member, double direction, double omega_per_speed);

/// One direction of the cone of a line pusher: the rates of turn [rad/m] that stick.
struct ConeSlice {
  double direction = 0.0;
  KappaSet nominal, robust;  ///< here in rad/m, not times c
};

struct MotionCone {
  bool is_point = false;
  double c = 0.0;  ///< [m] nominal torque radius
  /// Directions that stick: of a line pusher that does not turn; of a point.
  std::vector<DirectionRange> nominal, robust;
  std::vector<ConeSlice> slices;  ///< of a line pusher, by ascending direction
  int members = 0;                ///< behind the robust cone
};

/// The cone with `slices` >= 2 directions over the whole turn. `members` may be empty:
/// then robust is nominal. Edges of directions are found to 1e-9 rad; ranges narrower
/// than half a degree may be missed.
MotionCone motion_cone(const ConeMember& nominal, const std::vector<ConeMember>& members,
                       int slices = 181);

/// All directions of the whole turn for which `holds`, looked at every half degree, edges
/// by bisection.
std::vector<DirectionRange> ranges_where(const std::function<bool(double)>& holds);

/// Both sets have this kappa.
KappaSet intersection(const KappaSet& a, const KappaSet& b);

}  // namespace prehensile
