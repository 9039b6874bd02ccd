/// `prepare(scene)`: the scene compiled into constants, with everything that the scene
/// lacks left out, and the reasons written down.
///
/// A Model never changes afterwards and may be shared between threads.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mechanics/cross_section.h"
#include "mechanics/limit_surface.h"
#include "mechanics/planar_problem.h"
#include "scene/constants.h"
#include "scene/contact_region.h"
#include "scene/outline.h"
#include "scene/scene.h"

namespace prehensile {

/// A pusher flush with a face of the object: the pair that a push names. In O. While a
/// line touches, the object's attitude in W is fixed, and with it gravity in O; about a
/// point the object turns, and gravity in O with it.
struct PushContact {
  int pusher = 0;  ///< index in Scene::pushers
  int face = 0;    ///< index in Model::faces
  Vec2 n, t;       ///< of the face; n into the object
  Vec2 a, b;       ///< [m] ends of the face, b after a along t
  double mu = 0.0;
  bool is_point = false;
  double half_length =
      0.0;              ///< [m] of the pusher; infinity: longer than the face; 0: point
  double z_low = 0.0;   ///< [m] extent of the contact along z of O; both 0 where the
  double z_high = 0.0;  ///< pusher touches in the mid-plane only
  /// Grip force while it touches, over Gripper::grip_force. Under a grip k times as
  /// strong the object moves as under 1/k of its weight, and all forces are k times as
  /// great.
  double grip_share = 1.0;
  /// [m/s^2] gravity in O while flush, over grip_share.
  Vec2 g_O = Vec2::Zero();
  double theta_WO = 0.0;  ///< [rad] attitude of the object in W during contact

  /// The pusher pushes as much above the mid-plane as below.
  bool is_symmetric() const { return std::abs(z_low + z_high) < 1e-9; }

  /// Ends of the part of the face that carries load when the centre of the pusher stands
  /// at `place` [m along t from the centre of the face]. One point for a point pusher (a
  /// == b).
  struct Segment {
    Vec2 a, b;
  };
  Segment segment(double place) const;
};

/// One thing that was left out, or decided, and why: shown by `prehensile inspect`.
struct Decision {
  std::string what;
  std::string why;
};

/// A prism that lies in the pad plane, between the jaws.
struct LyingPrism {
  std::vector<Vec2> section;      ///< [m] (lateral axis, z), convex, counter-clockwise
  Vec2 com = Vec2::Zero();        ///< [m] centre of mass in the section
  Vec2 axis = {1.0, 0.0};         ///< in the pad plane of O
  Vec2 lateral = {0.0, 1.0};      ///< likewise
  double length = 0.0;            ///< [m]
  double circumference = 0.0;     ///< [m] of the section
  double same_after = 2.0 * kPi;  ///< [rad] least roll after which it looks alike
};

/// Rolled by psi [rad], section and centre of mass look as they do at 0.
bool looks_alike(const LyingPrism& prism, double psi) noexcept;

struct PrepareOptions {
  int points_per_pad = 16;  ///< quadrature of an unclipped pad: 1, 4, 8, 16, 32 or 64
  bool other_grips = true;  ///< contacts with the grip forces of gripper.grip_range, too
};

struct Model {
  Scene scene;
  PrepareOptions options;

  std::vector<Vec2> outline;   ///< in O
  std::vector<Vec2> pad_face;  ///< in O: the pads' centre has to stay on it
  std::vector<Face> faces;     ///< in O
  /// Everything a planar push may name: with the grip force of the scene, then again with
  /// each other one of its grip_range that is tried.
  std::vector<PushContact> contacts;
  ContactRegion region;

  Vec2 p_OCom = Vec2::Zero();  ///< [m]
  double mass = 0.0;           ///< [kg]
  double z_OCom = 0.0;         ///< [m] of the centre of mass above the mid-plane
  Eigen::Matrix3d inertia_O = Eigen::Matrix3d::Zero();  ///< [kg m^2] about the centre of
                                                        ///< mass, in O
  /// [N] of each jaw on the object at rest: grip force, and gravity along the closing
  /// direction; 0 where the jaws cannot carry that.
  std::array<double, 2> jaw_force{0.0, 0.0};
  double F = 0.0;  ///< [N] mu_1 jaw_force_1 + mu_2 jaw_force_2
  double c = 0.0;  ///< [m] torque radius of the whole pad region
  double L = 0.0;  ///< [m] longer side of the object: unit of travel in costs
  double half_thickness = 0.0;  ///< [m] the pads touch the object at z = -/+ this
  LimitSurface surface() const { return {F, c}; }

  /// Pads that are soft points on flat faces: their friction in the pad plane is the
  /// ellipsoid `surface()`, wherever they are. Of all other pads it is a stand-in.
  bool has_soft_points() const {
    const auto* point = std::get_if<PointPad>(&scene.gripper.pad);
    return point && point->spin_radius && !cross_section;
  }

  /// Rolling; absent unless the object is round and lies between the jaws.
  std::optional<CrossSectionModel> cross_section;

  /// Rolling over edges: section (scene/lying_prism.h), present for a prism that lies in
  /// the pad plane. Plans roll it by multiples of its `same_after` only.
  std::optional<LyingPrism> prism;

  /// [m] that a support travels while the object rolls by a radian: the radius of a
  /// cylinder; of a prism, over whole multiples of `same_after`, its circumference over a
  /// turn. 0: nothing rolls it.
  double roll_radius = 0.0;

  std::vector<Decision> decisions;

  /// Why the load of a pad shifts within it under any push, so that the pad plane alone
  /// cannot say exactly how the object moves; empty if only pushers might do that.
  std::vector<std::string> load_shifts;
  bool load_shifts_in_push = false;  ///< for other reasons than free pressure

  /// A push by this contact needs the spatial mechanics.
  bool needs_space(const PushContact& contact) const {
    return !load_shifts.empty() || !contact.is_symmetric();
  }

  /// So does a finite push by it, which free pressure alone does not ask for: of the
  /// answers that the free law allows, a push follows the one with the load at rest.
  bool push_needs_space(const PushContact& contact) const {
    return load_shifts_in_push || !contact.is_symmetric();
  }

  /// Dimensions of the planner's state: 3 (x, y, theta), 4 with roll. A prism rolls from
  /// side to side, which is no dimension: everything else stays as it was.
  int state_dimensions() const { return cross_section ? 4 : 3; }
};

/// Thrown by prepare for a scene that `check` rejects; cold path only.
class BadScene : public std::runtime_error {
 public:
  explicit BadScene(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// Compiles a scene. Throws BadScene with all faults.
Model prepare(const Scene& scene, const PrepareOptions& options = {});

/// Forces of both jaws on an object at rest between them [N]: w [N] is gravity along the
/// closing direction, away from jaw 1. Both 0 where the jaws cannot carry that.
std::array<double, 2> jaw_forces(const Gripper& gripper, double w);

/// The grasp at a pose, with gravity g_O [m/s^2] in O; no heap. `count` is 0 where the
/// pads have lost the face, or have no friction or no grip force.
PlanarGrasp grasp_at(const Model& model, const PlanarPose& X_HO,
                     const Vec2& g_O) noexcept;

/// Fills the inertia of a grasp, so that rates become accelerations from rest.
void add_inertia(const Model& model, const PlanarPose& X_HO, PlanarGrasp& grasp) noexcept;

/// The contact as a drive at a pose: `place` as in PushContact::segment, V_HP the twist
/// of the pusher in H.
PlanarDrive drive_at(const PushContact& contact, double place, const PlanarPose& X_HO,
                     const PlanarTwist& V_HP) noexcept;

/// The pose is valid: the centre of each pad lies on the face, and the pads touch.
bool pads_on_object(const Model& model, const PlanarPose& X_HO) noexcept;

/// Index of the contact of this pusher (by name) with this face (empty: its first), with
/// this share of the scene's grip force, or -1.
int find_contact(const Model& model, const std::string& pusher, const std::string& face,
                 double grip_share = 1.0);

}  // namespace prehensile
