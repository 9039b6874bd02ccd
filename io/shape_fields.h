/// Fields of shapes, of bodies that stand around, and of limits; part of scene_fields.h.
/// Internal to the io layer.
#pragma once

#include <array>

#include "io/fields.h"
#include "scene/scene.h"

namespace prehensile::internal {

inline constexpr Bounds kLengths{1e-6, 10.0, "m"};
inline constexpr Bounds kPlaces{-10.0, 10.0, "m"};
inline constexpr Bounds kAngles{-100.0, 100.0, "rad"};

inline constexpr std::array<Word<Axis>, 3> kAxisWords = {
    {{Axis::kX, "x"}, {Axis::kY, "y"}, {Axis::kZ, "z"}}};
inline constexpr std::array<Word<double>, 4> kUnitWords = {
    {{1.0, "m"}, {0.01, "cm"}, {0.001, "mm"}, {0.0254, "inch"}}};

template <typename Fields>
void visit_solid(Fields& fields, SolidShape& solid) {
  fields.points("outline", solid.outline, Length{3, 200}, kPlaces,
                "Silhouette along z, counter-clockwise.");
  fields.points("pad_face", solid.pad_face, Length{3, 200}, kPlaces,
                "Where both pads find a flat face, counter-clockwise.");
  fields.points("heights", solid.heights, Length{3, 200}, kPlaces,
                "Lowest and highest point of the side at each edge of the outline.");
  fields.number("thickness", solid.thickness, kLengths, kRequired,
                "Between the two faces that the pads hold.");
  fields.vector("centroid", solid.centroid, kPlaces, kRequired,
                "Centre of the homogeneous body.");
  const Eigen::Matrix3d& m = solid.spread;
  std::array<double, 6> spread{m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
  fields.vector("spread", spread, {-100.0, 100.0, "m^2"}, kRequired,
                "Mean of xx, yy, zz, xy, xz, yz over the homogeneous body, from its "
                "centre.");
  solid.spread << spread[0], spread[3], spread[4],  //
      spread[3], spread[1], spread[5],              //
      spread[4], spread[5], spread[2];
}

template <typename Fields>
void visit_mesh(Fields& fields, MeshShape& mesh) {
  fields.text("file", mesh.file, kRequired,
              "STL or OBJ file in the folder of the scene, or below.");
  fields.word("unit", mesh.unit, kUnitWords, kRequired, "Of the numbers in the file.");
  fields.text("pair", mesh.pair, kOptional,
              "Faces that the jaws hold, by the names that `prehensile mesh` lists.");
  fields.vector("closing_direction", mesh.closing, kPlaces,
                "Instead of the name: the pair whose closing direction is nearest to "
                "this, in the frame of the file.");
  fields.vector("near", mesh.near_point, kPlaces,
                "Of several such pairs the one nearest to this place, in metres in the "
                "frame of the file.");
}

template <typename Fields>
void visit_box(Fields& fields, BoxShape& box) {
  fields.vector("size", box.size, kLengths, kRequired,
                "Along x, y (pad plane) and z (between the jaws).");
}

template <typename Fields>
void visit_cylinder(Fields& fields, CylinderShape& cylinder) {
  fields.number("radius", cylinder.radius, kLengths, kRequired, "Radius.");
  fields.number("length", cylinder.length, kLengths, kRequired, "Length.");
  fields.word("axis", cylinder.axis, kAxisWords, kOptional, "Direction of its axis.");
}

template <typename Fields>
void visit_prism(Fields& fields, PrismShape& prism) {
  fields.points("outline", prism.outline, Length{3, 200}, kPlaces,
                "Vertices, counter-clockwise; edges must not cross. [x, y]; of a "
                "section [y, z] (axis x) or [x, z] (axis y).");
  fields.number("thickness", prism.thickness, kLengths, kRequired, "Along the axis.");
  fields.word_if_not(Axis::kZ, "axis", prism.axis, kAxisWords, "Direction of its axis.");
}

template <typename Fields>
void visit_limits(Fields& fields, GraspLimits& limits) {
  fields.angle("theta_low", limits.theta_low, kAngles,
               "Of O in H, as a number: whole turns count. Absent: none.");
  fields.angle("theta_high", limits.theta_high, kAngles, "Likewise.");
  fields.vector("finger_low", limits.finger_low, kPlaces,
                "Of the finger axis in O, along x and along y.");
  fields.vector("finger_high", limits.finger_high, kPlaces, "Likewise.");
  fields.vector("hand_low", limits.hand_low, kPlaces,
                "Of the origin of H in W while it pushes, approaches and retreats.");
  fields.vector("hand_high", limits.hand_high, kPlaces, "Likewise.");
  fields.angle("hand_angle_low", limits.hand_angle_low, kAngles,
               "Of H in W while it pushes, as an angle: whole turns do not count.");
  fields.angle("hand_angle_high", limits.hand_angle_high, kAngles, "Likewise.");
}

template <typename Fields>
void visit_body(Fields& fields, ConvexBody& body) {
  fields.text("name", body.name, kRequired, "Name, used in reports.");
  fields.choice(
      body.shape,
      alternative<BoxShape>("box", "Box, centred.",
                            [](auto& f, BoxShape& box) { visit_box(f, box); }),
      alternative<SphereShape>("sphere", "Sphere.",
                               [](auto& f, SphereShape& sphere) {
                                 f.number("radius", sphere.radius, kLengths, kRequired,
                                          "Radius.");
                               }),
      alternative<CylinderShape>(
          "cylinder", "Cylinder, centred.",
          [](auto& f, CylinderShape& cylinder) { visit_cylinder(f, cylinder); }),
      alternative<CapsuleShape>(
          "capsule", "All points within a radius of a segment, centred.",
          [](auto& f, CapsuleShape& capsule) {
            f.number("radius", capsule.radius, kLengths, kRequired, "Radius.");
            f.number("length", capsule.length, kLengths, kRequired, "Of the segment.");
            f.word("axis", capsule.axis, kAxisWords, kOptional, "Direction of its axis.");
          }),
      alternative<PrismShape>("prism", "Straight prism over a convex polygon.",
                              [](auto& f, PrismShape& prism) { visit_prism(f, prism); }),
      alternative<HalfSpaceShape>(
          "half_space", "All points on one side of a plane: a table. Fixture only.",
          [](auto& f, HalfSpaceShape& half_space) {
            f.vector("normal", half_space.normal, {-1.001, 1.001, ""}, kOptional,
                     "Of unit length, out of the solid.");
          }));
  fields.vector("position", body.position, kPlaces, kOptional,
                "Of its centre, or of a point of its plane.");
  fields.vector("quaternion_xyzw", body.quaternion, {-1.001, 1.001, ""}, kOptional,
                "Orientation, unit length, order x, y, z, w.");
  fields.angle("turn", body.turn, kAngles, "About +z, after that orientation.");
}

template <typename Fields>
void visit_obstacles(Fields& fields, Obstacles& obstacles) {
  fields.number("clearance", obstacles.clearance, {0.0, 1.0, "m"}, kOptional,
                "Least distance of the hand from the fixture, and of its bodies between "
                "the object's faces from the object.");
  fields.number("approach", obstacles.approach, {1e-4, 1.0, "m"}, kOptional,
                "Way along the pusher's normal that is free before and after a push.");
  constexpr Length kBodies{0, 64};
  fields.list("fixture", obstacles.fixture, kBodies, kOptional,
              "Bodies that stand still in W.",
              [](auto& f, ConvexBody& body) { visit_body(f, body); });
  fields.list("hand", obstacles.hand, kBodies, kOptional,
              "Bodies of fingers and hand, in H. The object keeps clear of those that "
              "reach between its faces, a palm for one.",
              [](auto& f, ConvexBody& body) { visit_body(f, body); });
}

}  // namespace prehensile::internal
