/// Where flat jaws can hold a body: pairs of flat faces that look away from each other,
/// and the body between them as the mechanics wants it.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "mesh/triangle_mesh.h"
#include "scene/scene.h"

namespace prehensile {

/// Two parallel faces. The closing direction is the outward normal of the second.
struct FacePair {
  std::string name;                ///< "pair0", "pair1", ...: largest area first
  Vec3 closing = Vec3::UnitZ();    ///< unit, in M
  Vec3 centre = Vec3::Zero();      ///< [m] in M, of the region, half way between faces
  double thickness = 0.0;          ///< [m] between the faces
  double area = 0.0;               ///< [m^2] of the region that both pads reach
  std::array<double, 2> offset{};  ///< [m] of the faces along `closing` in M
};

/// All pairs, largest area first; empty for a body without flat opposite faces (a fruit,
/// a ball). Faces within a degree of parallel count. A pair needs a region of at least
/// `least_area` [m^2] that jaws reach from both sides, nothing of the body being in front
/// of it. Of bodies with very many such pairs the 32 with the largest faces are looked
/// at.
std::vector<FacePair> find_face_pairs(const TriangleMesh& mesh, double least_area = 2e-5);

/// The body as held by a pair. O has its origin at the centroid, put into the plane half
/// way between the faces; z along the closing direction; x along the longer side of the
/// smallest rectangle around the silhouette.
struct HeldBody {
  SolidShape shape;
  Eigen::Isometry3d X_MO = Eigen::Isometry3d::Identity();
  std::vector<std::string> notes;  ///< what was simplified, for people
};

/// Throws BadMesh where the silhouette cannot be described by at most 200 vertices within
/// a hundredth of the body's size.
HeldBody body_between(const TriangleMesh& mesh, const FacePair& pair);

}  // namespace prehensile
