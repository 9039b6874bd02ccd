/// The bodies of a scene that must keep apart, as convex solids with their poses: what
/// the search, the check of collisions and pictures begin with.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "mechanics/model.h"

namespace prehensile {

/// The convex solids that make up the held object, in O; not smaller than it: a solid
/// from a mesh counts as its silhouette over its whole height.
std::vector<ConvexBody> object_bodies(const Model& model);

/// How far a body of the hand may reach below a face that the pads touch and still lie
/// beside it [m].
inline constexpr double kBeside = 1e-4;

/// The bodies of the hand that the held object could meet as it moves between the pads, a
/// palm for one: those that reach between its faces, past kBeside. All others, fingers
/// for one, lie beside the faces, where they may touch them, and a motion in the pad
/// plane brings them no nearer.
std::vector<ConvexBody> palm_bodies(const Model& model);

/// Pose of a body in its frame.
Eigen::Isometry3d pose_of(const ConvexBody& body);

/// Pose in space of a frame that moves in the pad plane, at a height [m].
Eigen::Isometry3d in_space(const PlanarPose& pose, double z);

/// Corners of a prism in its own frame [m]: those of the outline at one end of the axis,
/// then at the other, so that the outline turns counter-clockwise about the way from the
/// first end to the second.
std::vector<Vec3> corners_of(const PrismShape& prism);

/// Turns z into the axis.
Eigen::Matrix3d turned_to(Axis axis);

/// Least distance from the z axis of its frame within which a body lies [m]; for bodies
/// that end somewhere.
double reach_about_z(const ConvexBody& body);

/// How far an object stands off its pusher when it is looked at for collisions [m]: what
/// it touches there is no obstacle to it.
inline constexpr double kTouch = 1e-4;

}  // namespace prehensile
