/// The hand on its way from one placement to the next, with the object at rest in it.
/// Internal to the planner.
#pragma once

#include <cmath>

#include "scene/frames.h"

namespace prehensile {

/// A planar pose of H in W, lifted along z [m]. Its angle is a number.
struct HandPose {
  PlanarPose X_WH;
  double z = 0.0;
};

/// The share s in [0, 1] of a straight way: linear in x, y, z and the angle.
inline HandPose between(const HandPose& from, const HandPose& to, double s) {
  return {{std::lerp(from.X_WH.x, to.X_WH.x, s), std::lerp(from.X_WH.y, to.X_WH.y, s),
           std::lerp(from.X_WH.theta, to.X_WH.theta, s)},
          std::lerp(from.z, to.z, s)};
}

/// How the hand holds the object meanwhile.
struct HeldObject {
  PlanarPose X_HO;
  double grip_share = 1.0;  ///< grip force over that of the scene, > 0
};

}  // namespace prehensile
