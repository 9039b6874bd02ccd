/// The object seen along the closing direction: its outline in the pad plane of O, and
/// the straight faces of that outline that a pusher can touch.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace prehensile {

/// A straight face. n is the unit normal into the object, t = perp(n); the ends are
/// ordered so that b lies after a along t. All in O.
struct Face {
  std::string name;  ///< by its outward side "-x", "+x", "-y", "+y" where that is unique,
                     ///< else "edge0", ...: from vertex 0 to vertex 1 of the outline, ...
  Vec2 a, b;         ///< [m]
  Vec2 n, t;
  bool on_hull =
      true;  ///< false: in a notch, a wall longer than the notch cannot reach it
  double z_low = 0.0;  ///< [m] extent along z of O of the body's side there
  double z_high = 0.0;

  double length() const { return (b - a).norm(); }
  Vec2 centre() const { return 0.5 * (a + b); }
};

/// Mass properties of the homogeneous outline.
struct OutlineProperties {
  double area = 0.0;                                 ///< [m^2]
  Vec2 centroid = Vec2::Zero();                      ///< [m] in O
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();  ///< [m^4] integral of r r^T about
                                                     ///< the centroid
};

/// Counter-clockwise outline in O [m]. A cylinder held at its flat ends gives the regular
/// polygon of 64 edges with the area of its circle.
std::vector<Vec2> outline_of(const Shape& shape);

/// The part of the outline where both pads find a flat face.
std::vector<Vec2> pad_face_of(const Shape& shape);

/// Flush faces; empty for a cylinder held at its flat ends, whose rim is round.
std::vector<Face> faces_of(const Shape& shape);

/// "edge3": the name by which every face can be called, besides Face::name.
std::string edge_name(int edge);

/// Index of the face with this name, or -1.
int find_face(const std::vector<Face>& faces, const std::string& name);

/// The face on the hull whose normal is closest to n; -1 if there is none.
int face_towards(const std::vector<Face>& faces, const Vec2& n);

OutlineProperties properties_of(const std::vector<Vec2>& outline);

/// Inside or on the border.
bool contains(const std::vector<Vec2>& outline, const Vec2& p_O);

/// Distance from p to the border, positive inside, negative outside [m].
double depth_inside(const std::vector<Vec2>& outline, const Vec2& p_O);

/// Whether segments ab and cd cross or touch. Where rounding hides it: that they do.
bool segments_touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// Whether no two edges of the polygon cross or touch beyond their shared vertex.
bool is_simple(const std::vector<Vec2>& outline);

/// Whether a polygon turns left at every vertex; counter-clockwise and simple: convex.
bool is_convex(const std::vector<Vec2>& outline);

/// Whether a counter-clockwise polygon turns right at vertex i.
bool is_reflex(const std::vector<Vec2>& outline, std::size_t i);

/// Longer side of the object in the pad plane: L of the plan cost [m].
double longer_side(const std::vector<Vec2>& outline);

/// How far the object reaches from its mid-plane along z [m]; more than half_thickness
/// for a solid with parts beside the faces that the jaws hold.
double reach_along_z(const Shape& shape);

/// Half of the object's size between the jaws [m]: the pads touch at z = -/+ this.
double half_thickness(const Shape& shape);

/// Centre of mass in O: as given, or of the homogeneous shape [m].
Vec2 centre_of_mass(const Object& object);

/// Height of the centre of mass above the mid-plane, along z of O [m].
double height_of_mass(const Object& object);

/// Inertia about the centre of mass, in O [kg m^2]: of the homogeneous shape, but its
/// moment about z as given.
Eigen::Matrix3d inertia_of(const Object& object);

/// Moment of inertia about z through the centre of mass [kg m^2].
double moment_of_inertia(const Object& object);

}  // namespace prehensile
