/// The scene: what is held, what holds it, what it is pushed against, and the regrasp
/// that is wanted. Plain values in SI units; `check` lists everything that is wrong with
/// them. A scene is the only input of `prepare` (mechanics/model.h).
///
/// Source: the inputs named in section III-A of the paper; frames in scene/frames.h.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/confines.h"
#include "scene/cost_weights.h"
#include "scene/frames.h"
#include "scene/shapes.h"
#include "scene/uncertainty.h"

namespace prehensile {

/// A solid body of any form, held at two flat faces that look away from each other; made
/// from a mesh (mesh/face_pairs.h). The mid-plane between the faces is z = 0 in O.
struct SolidShape {
  std::vector<Vec2> outline;   ///< [m] silhouette along z, simple, counter-clockwise
  std::vector<Vec2> pad_face;  ///< [m] where both pads find a flat face, likewise
  /// [m] lowest and highest point of the body's side at each edge of the outline, from
  /// vertex i to i + 1; both outside +/- thickness / 2 where the body is higher there.
  std::vector<Vec2> heights;
  double thickness = 0.0;                            ///< [m] between the two faces
  Vec3 centroid = Vec3::Zero();                      ///< [m] in O
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  ///< [m^2] mean of r r^T over the
                                                     ///< homogeneous body, r from its
                                                     ///< centroid
};

/// A mesh file that is not loaded yet: reading a scene file puts a SolidShape in its
/// place; `check` refuses it.
struct MeshShape {
  std::string file;            ///< STL or OBJ, in the folder of the scene or below
  double unit = 1.0;           ///< [m] that 1 stands for: 0.001 for a file in millimetres
  std::string pair = "pair0";  ///< faces that the jaws hold, see `prehensile mesh`
  std::optional<Vec3> closing;  ///< or: the pair with the nearest closing direction in
                                ///< the frame of the file,
  std::optional<Vec3>
      near_point;  ///< [m] and of these the one that is nearest to a point
};

using Shape = std::variant<BoxShape, CylinderShape, PrismShape, SolidShape, MeshShape>;

struct Object {
  Shape shape;
  double mass = 0.0;           ///< [kg], > 0
  std::optional<Vec2> p_OCom;  ///< [m] centre of mass in O; unset: centroid of the shape
  double z_OCom = 0.0;         ///< [m] its height above the mid-plane, along z of O
  std::optional<double> inertia;  ///< [kg m^2] about z through the centre of mass; unset:
                                  ///< that of the homogeneous shape
};

/// Pad shapes, centred on the finger axis (the origin of H), both pads alike.
struct DiscPad {
  double radius = 0.0;  ///< [m]
};
struct RectanglePad {
  Vec2 size = Vec2::Zero();  ///< [m] along x and y of H
};
struct LinePad {
  double length = 0.0;  ///< [m]
  double angle = 0.0;   ///< [rad] of the line in H
};
/// A hard point carries friction forces only; a soft one a moment about its normal as
/// well, the two bounded together: |f|^2 + (m / spin_radius)^2 <= (mu n)^2.
struct PointPad {
  std::optional<double> spin_radius;  ///< [m] unset: hard; of a round patch: 2/3 of its
                                      ///< radius
};

/// Any flat pad: a half disc, a pad with a notch.
struct PolygonPad {
  std::vector<Vec2> outline;  ///< [m] in H, simple, counter-clockwise, 3 to 40 vertices
};

using Pad = std::variant<DiscPad, RectanglePad, LinePad, PointPad, PolygonPad>;

/// All its lengths times the factor (> 0).
Pad resized(const Pad& pad, double factor);

/// How the normal load of a pad spreads over its points when the push shifts it.
enum class PressureLaw {
  kFoundation,  ///< preloaded elastic foundation; the answer is unique
  kGiven,       ///< the split at rest, whatever happens
  kFree,        ///< rigid, as in the paper; forces, and often motions, are not unique
};

/// How the load of a pad at rest falls off from its middle.
enum class PressureProfile {
  kUniform,
  kHertz,  ///< of rounded bodies: sqrt(1 - r^2) over a disc of radius 1; the product of
           ///< sqrt(1 - x^2) along both sides of a rectangle, or along a line
};

struct PadPressure {
  PressureLaw law = PressureLaw::kFoundation;
  /// Of the foundation, in units of pusher travel over force: elastic deflection of a pad
  /// under the grip force over the travel that the answer is for, > 0. 1e-3 is within a
  /// per mille of rigid pads.
  double compliance = 1e-3;
  PressureProfile profile = PressureProfile::kUniform;
  /// p of the factor max(0.02, 1 + p (r^2 / mean r^2 - 1)) on the profile: the edge of
  /// the pad is loaded more (p > 0) or less (p < 0) than its middle; -1..3.
  double edge_load = 0.0;

  friend bool operator==(const PadPressure&, const PadPressure&) = default;
};

/// How the two jaws are driven along the closing direction.
enum class JawMode {
  kCoupled,    ///< one actuator, symmetric jaws; their forces sum to twice the grip force
  kFixedJaw1,  ///< jaw 1 stands still, jaw 2 presses with the grip force
  kFixedJaw2,  ///< jaw 2 stands still, jaw 1 presses with the grip force
  kIndependent,  ///< two actuators, each presses with the grip force
  kLocked,  ///< both jaws stand still; the squeeze is what the pads' elasticity holds
};

/// Fixed transform from H to the robot's tool frame T.
struct ToolTransform {
  Vec3 p_HT = Vec3::Zero();                           ///< [m]
  std::array<double, 4> q_HT = {0.0, 0.0, 0.0, 1.0};  ///< unit quaternion x, y, z, w
};

struct Gripper {
  std::string name = "gripper";
  Pad pad;
  std::array<double, 2> friction = {0.0, 0.0};  ///< of jaw 1 and jaw 2, >= 0
  double grip_force = 0.0;                      ///< [N] of each finger, >= 0
  /// [N] least and greatest grip force that a plan may push with beside grip_force, > 0,
  /// for gravity in the pad plane. Unset: grip_force only.
  std::optional<Vec2> grip_range;
  JawMode jaw_mode = JawMode::kCoupled;
  PadPressure pressure;
  ToolTransform tool;
};

/// A point of the environment.
struct PointFeature {};

/// A straight edge in the pad plane. Unset length: longer than any face.
struct LineFeature {
  std::optional<double> length;  ///< [m]
};

/// A straight edge along the closing direction. Unset length: longer than the object is
/// thick. In the pad plane it is a point.
struct UprightFeature {
  std::optional<double> length;  ///< [m]
};

/// A flat face. Unset: longer than any face, wider than the object is thick. In the pad
/// plane it is a line.
struct PlaneFeature {
  std::optional<double> length;  ///< [m] in the pad plane
  std::optional<double> width;   ///< [m] along the closing direction
};

using PusherFeature =
    std::variant<PointFeature, LineFeature, UprightFeature, PlaneFeature>;

/// A feature that stands still in the world W. W is aligned with O at the start.
struct Pusher {
  std::string name;
  PusherFeature feature;
  double friction = 0.0;      ///< >= 0
  Vec2 p_WP = Vec2::Zero();   ///< [m] centre of the feature in W
  double z_WP = 0.0;          ///< [m] its height above the object's mid-plane, along z
  double normal_angle = 0.0;  ///< [rad] in W of the normal, into the object
  std::vector<std::string> faces;  ///< faces of the object it may touch; empty: the one
                                   ///< opposite to its normal at the start
};

/// What becomes of the part of a pad that leaves the face.
enum class Overhang {
  kClip,    ///< only the part on the face presses
  kIgnore,  ///< the whole pad presses as long as its centre is on the face
};

/// Pose in the hand, with the roll angle of a round object about its own axis.
struct Grasp {
  PlanarPose X_HO;
  double psi = 0.0;  ///< [rad] about the object's long axis; 0 unless the object can roll

  friend bool operator==(const Grasp&, const Grasp&) = default;
};

enum class GoalTest {
  kPerCoordinate,  ///< each fixed coordinate within its own tolerance
  kWeightedSum,    ///< distance + characteristic_length * |angle| within the tolerance
};

enum class ThetaMeaning {
  kAngle,   ///< any number of whole turns counts
  kNumber,  ///< the turns made count, too: a cable hangs on the object
};

/// The wanted pose; an unset coordinate is free.
struct Goal {
  std::optional<double> x, y;   ///< [m] of O in H
  std::optional<double> theta;  ///< [rad] of O in H
  ThetaMeaning theta_is = ThetaMeaning::kAngle;
  std::optional<double> psi;  ///< [rad] roll angle; only for an object that can roll
  double position_tolerance = 1e-3;     ///< [m], > 0
  double angle_tolerance = 0.02;        ///< [rad], > 0
  double characteristic_length = 0.01;  ///< [m], > 0: 1 rad counts like this distance
  GoalTest test = GoalTest::kPerCoordinate;
};

/// What measurements said about a set-up, beside the values that they changed: written by
/// `prehensile calibrate`, used by `query spread`.
struct CalibrationRecord {
  std::string data;          ///< where the measurements are from
  std::uint64_t pushes = 0;  ///< how many, or readings
  /// [m] in H: true place of a pusher minus measured place.
  Vec2 registration = Vec2::Zero();
  /// Half widths of what stayed uncertain, 90 %: as shares, 0..1.
  double friction = 0.0, finger_friction = 0.0, torque_radius = 0.0;
  double place = 0.0;  ///< [m] of a pusher along the face and towards it, >= 0
  /// What no parameter explains of where pushes end, measurement included: [m] and [rad].
  double scatter = 0.0, scatter_angle = 0.0;
  /// Factors on intervals of the end pose of a push (normal, tangential, angle) that made
  /// them cover 50 and 90 % of measured pushes; unset: too few were measured.
  std::optional<Vec3> factors_50, factors_90;
};

struct Scene {
  std::string name = "scene";
  std::string origin;  ///< where the numbers come from, for people
  Object object;
  Gripper gripper;
  std::vector<Pusher> pushers;
  Vec2 g_W = {0.0, -9.81};  ///< [m/s^2] gravity in W, in the pad plane
  double g_Wz = 0.0;        ///< [m/s^2] gravity along the closing direction
  Overhang overhang = Overhang::kClip;
  Grasp start;
  std::optional<Goal> goal;
  std::optional<CostWeights> cost;  ///< unset: those of CostWeights
  std::optional<GraspLimits> limits;
  std::optional<Obstacles> obstacles;
  std::optional<CalibrationRecord> calibration;
  std::optional<Uncertainty> uncertainty;
};

/// One thing that is wrong: which field (dotted path as in a scene file), what its value
/// is and what was expected.
struct Fault {
  std::string field;
  std::string what;
};

/// Everything wrong with the values of a scene; empty when it can be prepared. Checks
/// ranges, finiteness, simplicity of the outline, names of faces, and that the pads are
/// on the object at the start. A goal off the object is no fault: the planner refuses it.
std::vector<Fault> check(const Scene& scene);

/// True for a cylinder that the pads hold on its curved side.
bool can_roll(const Object& object);

/// Length in the pad plane of a feature that is a line there [m]: infinity if it is
/// longer than any face; nothing for one that is a point there.
std::optional<double> length_in_plane(const PusherFeature& feature);

/// Extent along the closing direction [m]: infinity if wider than any object, 0 for a
/// point and an edge in the pad plane.
double width_across_plane(const PusherFeature& feature);

}  // namespace prehensile
