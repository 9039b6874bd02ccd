/// Every field of a scene file: key, type, unit, range, default (the value that the
/// struct starts with) and one line of documentation. Reader, --set, writer and JSON
/// Schema all come from this list. Internal to the io layer.
#pragma once

#include <array>

#include "io/fields.h"
#include "io/shape_fields.h"
#include "scene/scene.h"

namespace prehensile::internal {

inline constexpr int kSceneVersion = 1;

inline constexpr Bounds kFrictions{0.0, 1e3, ""};
inline constexpr std::array<Word<JawMode>, 5> kJawModeWords = {
    {{JawMode::kCoupled, "coupled"},
     {JawMode::kFixedJaw1, "fixed_jaw_1"},
     {JawMode::kFixedJaw2, "fixed_jaw_2"},
     {JawMode::kIndependent, "independent"},
     {JawMode::kLocked, "locked"}}};
inline constexpr std::array<Word<PressureLaw>, 3> kPressureLawWords = {
    {{PressureLaw::kFoundation, "foundation"},
     {PressureLaw::kGiven, "given"},
     {PressureLaw::kFree, "free"}}};
inline constexpr std::array<Word<PressureProfile>, 2> kPressureProfileWords = {
    {{PressureProfile::kUniform, "uniform"}, {PressureProfile::kHertz, "hertz"}}};
inline constexpr std::array<Word<Overhang>, 2> kOverhangWords = {
    {{Overhang::kClip, "clip"}, {Overhang::kIgnore, "ignore"}}};
inline constexpr std::array<Word<GoalTest>, 2> kGoalTestWords = {
    {{GoalTest::kPerCoordinate, "per_coordinate"},
     {GoalTest::kWeightedSum, "weighted_sum"}}};

inline constexpr std::array<Word<ThetaMeaning>, 2> kThetaWords = {
    {{ThetaMeaning::kAngle, "angle"}, {ThetaMeaning::kNumber, "number"}}};
inline constexpr std::array<Word<Spread>, 2> kSpreadWords = {
    {{Spread::kBox, "box"}, {Spread::kNormal, "normal"}}};

template <typename Fields>
void visit_object(Fields& fields, Object& object) {
  fields.choice(
      object.shape,
      alternative<BoxShape>("box", "Box centred on the origin of the object frame O.",
                            [](auto& f, BoxShape& box) { visit_box(f, box); }),
      alternative<CylinderShape>(
          "cylinder",
          "Cylinder centred on the origin of O, held at its flat ends (axis z) or on "
          "its curved side (x or y), where it can roll.",
          [](auto& f, CylinderShape& cylinder) { visit_cylinder(f, cylinder); }),
      alternative<PrismShape>(
          "prism",
          "Straight prism over a polygon: along z, the polygon in the pad plane of O; or "
          "lying along x or y, the polygon its convex section, which a support can roll "
          "over its edges.",
          [](auto& f, PrismShape& prism) { visit_prism(f, prism); }),
      alternative<SolidShape>("solid",
                              "Any solid body held at two flat faces, as made from a "
                              "mesh.",
                              [](auto& f, SolidShape& solid) { visit_solid(f, solid); }),
      alternative<MeshShape>("mesh",
                             "A mesh file; it becomes a solid, and its mass is read from "
                             "a URDF file of the same name if the scene gives none.",
                             [](auto& f, MeshShape& mesh) { visit_mesh(f, mesh); }));
  fields.number("mass", object.mass, {1e-9, 1e4, "kg"}, kRequired, "Mass.");
  fields.place("centre_of_mass", object.p_OCom, object.z_OCom, kPlaces,
               "In O; a third number is its height above the mid-plane. Absent: centroid "
               "of the shape.");
  fields.number("inertia", object.inertia, {0.0, 1e6, "kg m^2"},
                "About z through the centre of mass. Absent: of the homogeneous shape.");
}

template <typename Fields>
void visit_pad(Fields& fields, Pad& pad) {
  fields.choice(
      pad,
      alternative<DiscPad>("disc", "Round pad.",
                           [](auto& f, DiscPad& disc) {
                             f.number("radius", disc.radius, kLengths, kRequired,
                                      "Radius.");
                           }),
      alternative<RectanglePad>("rectangle", "Rectangular pad.",
                                [](auto& f, RectanglePad& rectangle) {
                                  f.vector("size", rectangle.size, kLengths, kRequired,
                                           "Along x and y of the hand frame H.");
                                }),
      alternative<LinePad>(
          "line", "Line contact.",
          [](auto& f, LinePad& line) {
            f.number("length", line.length, kLengths, kRequired, "Length.");
            f.angle("angle", line.angle, kAngles, "Of the line in H, from its x axis.");
          }),
      alternative<PolygonPad>(
          "polygon", "Flat pad of any shape.",
          [](auto& f, PolygonPad& polygon) {
            f.points("outline", polygon.outline, Length{3, 40}, kPlaces,
                     "Vertices [x, y] in H, counter-clockwise; edges must not cross.");
          }),
      alternative<PointPad>("point", "Point contact.", [](auto& f, PointPad& point) {
        f.number("spin_radius", point.spin_radius, kLengths,
                 "Absent: a hard point, without friction moment. Else a soft one: "
                 "friction moment over this radius and friction force are "
                 "bounded together.");
      }));
}

template <typename Fields>
void visit_pressure(Fields& fields, PadPressure& pressure) {
  fields.word(
      "law", pressure.law, kPressureLawWords, kOptional,
      "How the load of a pad shifts under a push. foundation: elastic, preloaded; "
      "given: not at all; free: as rigid contact allows, not unique.");
  fields.number("compliance", pressure.compliance, {1e-8, 1e3, ""}, kOptional,
                "Of the foundation: deflection of a pad under the grip force over the "
                "pusher's travel.");
  fields.word("profile", pressure.profile, kPressureProfileWords, kOptional,
              "Load at rest. uniform; hertz: falls off to nothing at the rim.");
  fields.number("edge_load", pressure.edge_load, {-1.0, 3.0, ""}, kOptional,
                "p of the factor 1 + p (r^2 / mean r^2 - 1) on the profile: more (p > 0) "
                "or less load at the rim.");
}

template <typename Fields>
void visit_gripper(Fields& fields, Gripper& gripper) {
  fields.text("name", gripper.name, kOptional, "Name shown in reports.");
  fields.group("pad", gripper.pad, kRequired,
               "Shape of both pads, centred on the finger axis.",
               [](auto& f, Pad& pad) { visit_pad(f, pad); });
  fields.one_or_two("friction", gripper.friction, kFrictions,
                    "Of both jaws, or of [jaw 1, jaw 2].");
  fields.number("grip_force", gripper.grip_force, {0.0, 1e6, "N"}, kRequired,
                "Of each finger.");
  fields.vector("grip_range", gripper.grip_range, {1e-3, 1e6, "N"},
                "Least and greatest grip force that a plan may push with, beside "
                "grip_force; gravity along the closing direction has to be 0. Absent: "
                "grip_force only.");
  fields.word("jaw_mode", gripper.jaw_mode, kJawModeWords, kOptional,
              "coupled: symmetric jaws; fixed_jaw_1 or fixed_jaw_2: that jaw stands "
              "still, the other one presses; independent: each presses by itself; "
              "locked: both stand still.");
  fields.group_if_set(
      "pressure", gripper.pressure, "How the load of a pad spreads over it.",
      [](auto& f, PadPressure& pressure) { visit_pressure(f, pressure); });
  fields.group("tool", gripper.tool, kOptional,
               "Fixed transform from H to the tool frame T of the robot.",
               [](auto& f, ToolTransform& tool) {
                 f.vector("position", tool.p_HT, kPlaces, kOptional, "Of T in H.");
                 f.vector("quaternion_xyzw", tool.q_HT, {-1.001, 1.001, ""}, kOptional,
                          "Orientation of T in H, unit length, order x, y, z, w.");
               });
}

template <typename Fields>
void visit_pusher(Fields& fields, Pusher& pusher) {
  fields.text("name", pusher.name, kRequired, "Name, used by plans and reports.");
  fields.choice(
      pusher.feature, alternative<PointFeature>("point", "A point.", kNoFields),
      alternative<LineFeature>("line", "A straight edge in the pad plane.",
                               [](auto& f, LineFeature& line) {
                                 f.number("length", line.length, kLengths,
                                          "Absent: longer than any face.");
                               }),
      alternative<UprightFeature>("upright",
                                  "A straight edge along the closing direction.",
                                  [](auto& f, UprightFeature& upright) {
                                    f.number("length", upright.length, kLengths,
                                             "Absent: longer than the object is thick.");
                                  }),
      alternative<PlaneFeature>(
          "plane", "A flat face.", [](auto& f, PlaneFeature& plane) {
            f.number("length", plane.length, kLengths,
                     "In the pad plane. Absent: longer than any face.");
            f.number("width", plane.width, kLengths,
                     "Along the closing direction. Absent: wider than the object is "
                     "thick.");
          }));
  fields.number("friction", pusher.friction, kFrictions, kRequired,
                "Between pusher and object.");
  fields.place("position", pusher.p_WP, pusher.z_WP, kPlaces,
               "Centre of the feature in the world W; a third number is its height above "
               "the mid-plane of the object.");
  fields.angle("normal", pusher.normal_angle, kAngles,
               "Direction in W of the normal, into the object.");
  fields.names("faces", pusher.faces, Length{0, 200},
               "Faces of the object it may touch: -x, +x, -y, +y, edge0, ... Absent: the "
               "one opposite to its normal at the start.");
}

template <typename Fields>
void visit_start(Fields& fields, Grasp& start) {
  fields.number("x", start.X_HO.x, kPlaces, kOptional, "Of O in H.");
  fields.number("y", start.X_HO.y, kPlaces, kOptional, "Of O in H.");
  fields.angle("theta", start.X_HO.theta, kAngles, "Of O in H, about +z.");
  fields.angle("roll", start.psi, kAngles,
               "About the long axis; only for a cylinder that can roll.");
}

template <typename Fields>
void visit_goal(Fields& fields, Goal& goal) {
  fields.number("x", goal.x, kPlaces, "Of O in H. Absent: free.");
  fields.number("y", goal.y, kPlaces, "Of O in H. Absent: free.");
  fields.angle("theta", goal.theta, kAngles, "Of O in H. Absent: free.");
  fields.word_if_not(ThetaMeaning::kAngle, "theta_is", goal.theta_is, kThetaWords,
                     "angle: any number of whole turns counts; number: the turns made "
                     "count, too (a cable hangs on the object).");
  fields.angle(
      "roll", goal.psi, kAngles,
      "About the long axis; only for an object that can roll, of a prism to where "
      "its section looks as at 0. Absent: free.");
  fields.group("tolerance", goal, kOptional, "How near is near enough.",
               [](auto& f, Goal& g) {
                 f.number("position", g.position_tolerance, {1e-9, 1.0, "m"}, kOptional,
                          "Of x and y; for weighted_sum of the whole sum.");
                 f.angle("angle", g.angle_tolerance, {1e-9, 4.0, "rad"},
                         "Of theta and roll, per_coordinate only.");
               });
  fields.number("characteristic_length", goal.characteristic_length, {1e-9, 10.0, "m"},
                kOptional, "1 rad counts like this distance, weighted_sum only.");
  fields.word("test", goal.test, kGoalTestWords, kOptional,
              "per_coordinate: each fixed coordinate within its tolerance; weighted_sum: "
              "distance + characteristic_length * angle within the position tolerance.");
}

template <typename Fields>
void visit_calibration(Fields& fields, CalibrationRecord& record) {
  constexpr Bounds kShares{0.0, 1.0, ""};
  constexpr Bounds kFactors{0.0, 1e3, ""};
  fields.text("data", record.data, kOptional, "Where the measurements are from.");
  fields.count("pushes", record.pushes, "How many, or readings.");
  fields.vector("registration", record.registration, kPlaces, kOptional,
                "In H: true place of a pusher minus measured place.");
  fields.number("friction", record.friction, kShares, kOptional,
                "Of the pushers: half width of what stayed uncertain, 90 %, as a share.");
  fields.number("finger_friction", record.finger_friction, kShares, kOptional,
                "Half width, as a share.");
  fields.number("torque_radius", record.torque_radius, kShares, kOptional,
                "Half width, as a share.");
  fields.number("place", record.place, {0.0, 1.0, "m"}, kOptional,
                "Half width, along the face and towards it.");
  fields.number("scatter", record.scatter, {0.0, 1.0, "m"}, kOptional,
                "What no parameter explains of where pushes end, measurement included.");
  fields.angle("scatter_angle", record.scatter_angle, {0.0, 4.0, "rad"},
               "The same of how far they turn.");
  fields.vector("factors_50", record.factors_50, kFactors,
                "On intervals of the end of a push (normal, tangential, angle) that made "
                "them cover 50 % of the measured ends. Absent: too few.");
  fields.vector("factors_90", record.factors_90, kFactors, "The same for 90 %.");
}

template <typename Fields>
void visit_uncertainty(Fields& fields, Uncertainty& uncertainty) {
  fields.word("spread", uncertainty.spread, kSpreadWords, kOptional,
              "box: the numbers below are half widths; normal: standard deviations.");
  fields.number("sigmas", uncertainty.sigmas, {0.1, 10.0, ""}, kOptional,
                "Of a normal distribution, that a robust plan survives.");
  const Bounds share{0.0, 0.9, ""};
  const Bounds length{0.0, 1.0, "m"};
  const Bounds angle{0.0, 1.0, "rad"};
  fields.number("friction", uncertainty.friction, share, kOptional,
                "Of the pushers, as a share.");
  fields.number("finger_friction", uncertainty.finger_friction, share, kOptional,
                "Of the fingers, as a share.");
  fields.number("grip_force", uncertainty.grip_force, share, kOptional, "As a share.");
  fields.number("mass", uncertainty.mass, share, kOptional, "As a share.");
  fields.number("torque_radius", uncertainty.torque_radius, share, kOptional,
                "Of the pads' load, as a share.");
  fields.number("centre_of_mass", uncertainty.centre_of_mass, length, kOptional,
                "Along x and along y of O.");
  fields.number("start_position", uncertainty.start_position, length, kOptional,
                "Of the object in the hand, along x and along y.");
  fields.angle("start_angle", uncertainty.start_angle, angle,
               "Of the object in the hand.");
  fields.number("pusher_place", uncertainty.pusher_place, length, kOptional,
                "Of the pushers along the face.");
  fields.angle("pusher_tilt", uncertainty.pusher_tilt, angle,
               "Of the pushers in the world.");
}

template <typename Fields>
void visit_cost(Fields& fields, CostWeights& cost) {
  fields.number("travel", cost.travel, {0.01, 100.0, ""}, kOptional,
                "Of travel as long as the object's longer side.");
  fields.number("work", cost.work, {0.0, 1e4, "1/J"}, kOptional,
                "Of each joule that the friction of the pads takes.");
  fields.number("grip_change", cost.grip_change, {0.0, 100.0, ""}, kOptional,
                "Of each change of the grip force.");
}

template <typename Fields>
void visit_scene(Fields& fields, Scene& scene) {
  fields.version(kSceneVersion);
  fields.text("name", scene.name, kOptional, "Name shown in reports.");
  fields.text("origin", scene.origin, kOptional, "Where the numbers come from.");
  fields.group("object", scene.object, kRequired, "What is held.",
               [](auto& f, Object& object) { visit_object(f, object); });
  fields.group("gripper", scene.gripper, kRequired, "What holds it.",
               [](auto& f, Gripper& gripper) { visit_gripper(f, gripper); });
  fields.list("pushers", scene.pushers, Length{0, 64}, kOptional,
              "What it is pushed against: features that stand still in the world W, "
              "which is aligned with O at the start.",
              [](auto& f, Pusher& pusher) { visit_pusher(f, pusher); });
  fields.place("gravity", scene.g_W, scene.g_Wz, {-1e3, 1e3, "m/s^2"},
               "In W: in the pad plane, and along the closing direction.");
  fields.word("overhang", scene.overhang, kOverhangWords, kOptional,
              "clip: only the part of a pad on the face presses; ignore: the whole pad, "
              "as long as its centre is on the face.");
  fields.group("start", scene.start, kOptional,
               "Pose in the hand before; absent: object and hand frames coincide.",
               [](auto& f, Grasp& start) { visit_start(f, start); });
  fields.group("goal", scene.goal,
               "Pose wanted in the hand; absent coordinates are free.",
               [](auto& f, Goal& goal) { visit_goal(f, goal); });
  fields.group("cost", scene.cost,
               "What a plan pays beside 1 for each placement of a pusher. Absent: 1 for "
               "travel as long as the object's longer side.",
               [](auto& f, CostWeights& cost) { visit_cost(f, cost); });
  fields.group("limits", scene.limits,
               "Where grasp and hand may get to. Absent: anywhere.",
               [](auto& f, GraspLimits& limits) { visit_limits(f, limits); });
  fields.group("obstacles", scene.obstacles,
               "What the hand and the held object must not hit. Absent: nothing.",
               [](auto& f, Obstacles& obstacles) { visit_obstacles(f, obstacles); });
  fields.group("calibration", scene.calibration,
               "What measurements said, beside the values that they changed; written by "
               "`prehensile calibrate`. Absent: not calibrated.",
               [](auto& f, CalibrationRecord& record) { visit_calibration(f, record); });
  fields.group(
      "uncertainty", scene.uncertainty,
      "What is not known exactly: `plan --robust` and `check --samples` use it.",
      [](auto& f, Uncertainty& uncertainty) { visit_uncertainty(f, uncertainty); });
}

}  // namespace prehensile::internal
