/// How far two convex bodies are apart, from below, with a proof: the direction along
/// which they are. Internal to the planner.
///
/// Source: the distance subalgorithm over simplices of the Minkowski difference, E. G.
/// Gilbert, D. W. Johnson and S. S. Keerthi, 1988. Whatever that finds, the answer is the
/// width of the gap between the bodies' supports along one direction, which is never more
/// than their distance.
#pragma once

#include <Eigen/Geometry>

#include "scene/confines.h"

namespace prehensile {

/// A body and the pose of its frame.
struct PlacedBody {
  const ConvexBody* body = nullptr;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the body itself in W
};

/// The point of a body that lies farthest along a direction; of a half-space only along
/// its normal.
Vec3 support(const PlacedBody& placed, const Vec3& direction);

/// At most the distance between the bodies, and nearly that; 0 or less where no plane was
/// found between them [m]. At most one of them is a half-space.
double separation(const PlacedBody& a, const PlacedBody& b);

}  // namespace prehensile
