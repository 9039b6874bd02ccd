#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include <Eigen/Cholesky>

#include "scene/checker.h"
#include "scene/constants.h"
#include "scene/contact_region.h"
#include "scene/lying_prism.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr std::size_t kMostPadVertices = 40;
constexpr std::size_t kMostPushers = 64;

void check_solid(Checker& checker, const SolidShape& solid) {
  const std::string field = "object.solid";
  checker.length(field + ".thickness", solid.thickness);
  check_outline(checker, field + ".outline", solid.outline);
  check_outline(checker, field + ".pad_face", solid.pad_face);
  if (solid.heights.size() != solid.outline.size()) {
    std::string what =
        std::to_string(solid.heights.size()) + " members: expected one for ";
    what += "each of the " + std::to_string(solid.outline.size());
    checker.fault(field + ".heights", what + " edges of the outline");
  }
  for (const Vec2& heights : solid.heights) {
    checker.place(field + ".heights", heights);
    if (!(heights.x() <= heights.y())) {
      checker.fault(field + ".heights",
                    text(heights) + ": expected the lower end, then the higher one");
    }
  }
  for (int i = 0; i < 3; ++i) {
    checker.in_range(field + ".centroid", solid.centroid[i], -kLongest, kLongest, "m");
  }
  const bool is_spread = solid.spread.allFinite() &&
                         solid.spread.isApprox(solid.spread.transpose(), 1e-9) &&
                         solid.spread.llt().info() == Eigen::Success;
  if (!is_spread) {
    checker.fault(field + ".spread",
                  "not the second moments of a body: expected a symmetric positive "
                  "matrix");
  }
}

void check_object(Checker& checker, const Object& object) {
  if (const auto* box = std::get_if<BoxShape>(&object.shape)) {
    for (int i = 0; i < 3; ++i) checker.length("object.box.size", box->size[i]);
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&object.shape)) {
    checker.length("object.cylinder.radius", cylinder->radius);
    checker.length("object.cylinder.length", cylinder->length);
  } else if (const auto* prism = std::get_if<PrismShape>(&object.shape)) {
    checker.length("object.prism.thickness", prism->thickness);
    check_outline(checker, "object.prism.outline", prism->outline);
    const std::string fault = checker.clean() ? section_fault(*prism) : std::string();
    if (!fault.empty()) checker.fault("object.prism.outline", fault);
  } else if (const auto* solid = std::get_if<SolidShape>(&object.shape)) {
    check_solid(checker, *solid);
  } else {
    checker.fault("object.mesh",
                  "not loaded: expected a scene that was read from a file");
  }
  checker.in_range("object.mass", object.mass, 1e-9, 1e4, "kg");
  if (object.inertia) {
    checker.in_range("object.inertia", *object.inertia, 0.0, 1e6, "kg m^2");
  }
  if (object.p_OCom) checker.place("object.centre_of_mass", *object.p_OCom);
  if (checker.clean()) {
    const double most = reach_along_z(object.shape);
    checker.in_range("object.centre_of_mass.2", object.z_OCom, -most, most, "m");
    if (object.z_OCom != 0.0 && !object.p_OCom) {
      checker.fault("object.centre_of_mass",
                    "only its height is given: expected all its coordinates");
    }
  }
  if (object.p_OCom && checker.clean()) {
    const std::vector<Vec2> outline = outline_of(object.shape);
    double farthest = 0.0;
    for (const Vec2& v : outline) farthest = std::max(farthest, v.norm());
    if (object.p_OCom->norm() > farthest) {
      checker.fault("object.centre_of_mass",
                    text(*object.p_OCom) + ": expected a point of the object, at most " +
                        text(farthest) + " m from its origin");
    }
  }
}

void check_pad(Checker& checker, const Gripper& gripper, const Object& object) {
  const std::string field = "gripper.pad";
  if (const auto* disc = std::get_if<DiscPad>(&gripper.pad)) {
    checker.length(field + ".disc.radius", disc->radius);
  } else if (const auto* rectangle = std::get_if<RectanglePad>(&gripper.pad)) {
    checker.length(field + ".rectangle.size", rectangle->size.x());
    checker.length(field + ".rectangle.size", rectangle->size.y());
  } else if (const auto* line = std::get_if<LinePad>(&gripper.pad)) {
    checker.length(field + ".line.length", line->length);
    checker.angle(field + ".line.angle_deg", line->angle);
  } else if (const auto* point = std::get_if<PointPad>(&gripper.pad)) {
    if (point->spin_radius) {
      checker.length(field + ".point.spin_radius", *point->spin_radius);
    }
  }
  if (const auto* polygon = std::get_if<PolygonPad>(&gripper.pad)) {
    check_outline(checker, field + ".polygon.outline", polygon->outline,
                  kMostPadVertices);
    if (gripper.pressure.profile == PressureProfile::kHertz) {
      checker.fault("gripper.pressure.profile",
                    "hertz over a polygon: expected uniform, and edge_load if the rim "
                    "carries less");
    }
  }
  const bool thin = std::holds_alternative<LinePad>(gripper.pad) ||
                    std::holds_alternative<PointPad>(gripper.pad) ||
                    std::holds_alternative<PolygonPad>(gripper.pad);
  if (thin && can_roll(object)) {
    checker.fault(field,
                  "a line, point or polygon pad on the curved side of a cylinder: "
                  "expected a disc or a rectangle");
  }
}

void check_grip_range(Checker& checker, const Vec2& range) {
  constexpr double kLeast = 1e-3;  // [N]
  checker.in_range("gripper.grip_range", range[0], kLeast, 1e6, "N");
  checker.in_range("gripper.grip_range", range[1], kLeast, 1e6, "N");
  if (range[0] > range[1]) {
    checker.fault("gripper.grip_range",
                  "the least force is greater than the greatest: "
                  "expected [least, greatest]");
  }
}

void check_gripper(Checker& checker, const Gripper& gripper, const Object& object) {
  check_pad(checker, gripper, object);
  checker.in_range("gripper.pressure.compliance", gripper.pressure.compliance, 1e-8, 1e3,
                   "");
  checker.in_range("gripper.pressure.edge_load", gripper.pressure.edge_load, -1.0, 3.0,
                   "");
  for (const double mu : gripper.friction) {
    checker.in_range("gripper.friction", mu, 0.0, 1e3, "");
  }
  checker.in_range("gripper.grip_force", gripper.grip_force, 0.0, 1e6, "N");
  if (gripper.grip_range) check_grip_range(checker, *gripper.grip_range);
  const bool both_driven_alike =
      gripper.jaw_mode == JawMode::kIndependent || gripper.jaw_mode == JawMode::kLocked;
  if (both_driven_alike && can_roll(object)) {
    checker.fault("gripper.jaw_mode",
                  "independent or locked jaws on the curved side of a cylinder: expected "
                  "coupled, fixed_jaw_1 or fixed_jaw_2");
  }
  for (int i = 0; i < 3; ++i) {
    checker.in_range("gripper.tool.position", gripper.tool.p_HT[i], -kLongest, kLongest,
                     "m");
  }
  checker.unit_quaternion("gripper.tool.quaternion_xyzw", gripper.tool.q_HT);
}

void check_faces(Checker& checker, const std::string& path, const Pusher& pusher,
                 const std::vector<Face>& faces) {
  const std::optional<double> length = length_in_plane(pusher.feature);
  for (const std::string& wanted : pusher.faces) {
    const int face = find_face(faces, wanted);
    if (face < 0) {
      std::string known;
      for (const Face& f : faces) known += (known.empty() ? "" : ", ") + f.name;
      if (known.empty()) known = "none, because the rim of the object is round";
      checker.fault(path + ".faces",
                    wanted + ": expected a face of the object (" + known + ")");
      continue;
    }
    const double room = faces[face].length();
    if (length && !faces[face].on_hull && !(*length <= room)) {
      checker.fault(path + ".faces",
                    wanted + ": lies in a notch of " + text(room) +
                        " m: expected a point or a line of at most that length");
    }
  }
}

void check_feature(Checker& checker, const std::string& path,
                   const PusherFeature& feature) {
  const auto size = [&](const char* key, const std::optional<double>& value) {
    if (value) checker.length(path + key, *value);
  };
  if (const auto* line = std::get_if<LineFeature>(&feature)) {
    size(".line.length", line->length);
  } else if (const auto* upright = std::get_if<UprightFeature>(&feature)) {
    size(".upright.length", upright->length);
  } else if (const auto* plane = std::get_if<PlaneFeature>(&feature)) {
    size(".plane.length", plane->length);
    size(".plane.width", plane->width);
  }
}

void check_height(Checker& checker, const std::string& path, const Pusher& pusher,
                  double reach) {
  const double most = reach + 0.5 * width_across_plane(pusher.feature);
  if (!std::isfinite(pusher.z_WP) || std::abs(pusher.z_WP) <= most) return;
  checker.fault(path + ".position.2",
                text(pusher.z_WP) +
                    ": expected a height at which the pusher meets the "
                    "object, at most " +
                    text(most) + " m from its mid-plane");
}

void check_pushers(Checker& checker, const Scene& scene) {
  if (scene.pushers.size() > kMostPushers) {
    checker.fault("pushers", std::to_string(scene.pushers.size()) +
                                 " pushers: expected at most " +
                                 std::to_string(kMostPushers));
    return;
  }
  const bool shape_is_sound = checker.clean();
  const std::vector<Face> faces =
      shape_is_sound ? faces_of(scene.object.shape) : std::vector<Face>{};
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.pushers.size(); ++i) {
    const Pusher& pusher = scene.pushers[i];
    const std::string path = "pushers." + std::to_string(i);
    if (pusher.name.empty()) checker.fault(path + ".name", "empty: expected a name");
    if (!names.insert(pusher.name).second) {
      checker.fault(path + ".name",
                    pusher.name + ": expected a name used by one pusher only");
    }
    checker.in_range(path + ".friction", pusher.friction, 0.0, 1e3, "");
    checker.place(path + ".position", pusher.p_WP);
    checker.in_range(path + ".position.2", pusher.z_WP, -kLongest, kLongest, "m");
    checker.angle(path + ".normal_deg", pusher.normal_angle);
    check_feature(checker, path, pusher.feature);
    if (shape_is_sound) {
      check_faces(checker, path, pusher, faces);
      check_height(checker, path, pusher, reach_along_z(scene.object.shape));
    }
  }
}

/// A cylinder on its curved side rests on two lines; what turns it about its axis is the
/// business of the cross-section, which knows no load along the closing direction.
void check_cross_section(Checker& checker, const Scene& scene) {
  const char* expected = ": expected 0 for a cylinder held on its curved side";
  if (scene.g_Wz != 0.0) checker.fault("gravity.2", text(scene.g_Wz) + expected);
  if (scene.object.z_OCom != 0.0) {
    checker.fault("object.centre_of_mass.2", text(scene.object.z_OCom) + expected);
  }
}

void check_pose(Checker& checker, const std::string& path, const Grasp& grasp) {
  checker.in_range(path + ".x", grasp.X_HO.x, -kLongest, kLongest, "m");
  checker.in_range(path + ".y", grasp.X_HO.y, -kLongest, kLongest, "m");
  checker.angle(path + ".theta_deg", grasp.X_HO.theta);
  checker.angle(path + ".roll_deg", grasp.psi);
}

/// A prism is planned to roll from side to side, to where it looks as it did.
void check_roll_goal(Checker& checker, const Object& object, double psi) {
  if (can_roll(object)) return;
  const PrismShape* prism = lying_prism(object.shape);
  if (!prism) {
    checker.fault("goal.roll_deg",
                  "the object cannot roll: expected only for a cylinder held on its "
                  "curved side, and for a prism along x or y");
  } else if (!is_same_section(prism->outline, psi)) {
    const double turn = symmetry_angle(prism->outline);
    checker.fault("goal.roll_deg",
                  "the section looks different there: expected a "
                  "multiple of " +
                      text(turn * 180.0 / kPi) + " deg");
  }
}

void check_goal(Checker& checker, const Goal& goal, const Object& object) {
  if (!goal.x && !goal.y && !goal.theta && !goal.psi) {
    checker.fault("goal",
                  "no coordinate: expected at least one of x, y, theta_deg, roll_deg");
  }
  const Grasp pose{{goal.x.value_or(0.0), goal.y.value_or(0.0), goal.theta.value_or(0.0)},
                   goal.psi.value_or(0.0)};
  check_pose(checker, "goal", pose);
  if (goal.psi) check_roll_goal(checker, object, *goal.psi);
  checker.in_range("goal.tolerance.position", goal.position_tolerance, 1e-9, 1.0, "m");
  checker.in_range("goal.tolerance.angle_deg", goal.angle_tolerance, 1e-9, 4.0, "rad");
  checker.in_range("goal.characteristic_length", goal.characteristic_length, 1e-9,
                   kLongest, "m");
}

void check_calibration(Checker& checker, const CalibrationRecord& record) {
  const std::string field = "calibration.";
  checker.place(field + "registration", record.registration);
  checker.in_range(field + "friction", record.friction, 0.0, 1.0, "");
  checker.in_range(field + "finger_friction", record.finger_friction, 0.0, 1.0, "");
  checker.in_range(field + "torque_radius", record.torque_radius, 0.0, 1.0, "");
  checker.in_range(field + "place", record.place, 0.0, 1.0, "m");
  checker.in_range(field + "scatter", record.scatter, 0.0, 1.0, "m");
  checker.in_range(field + "scatter_angle", record.scatter_angle, 0.0, 4.0, "rad");
  for (const double factor : record.factors_50.value_or(Vec3::Zero())) {
    checker.in_range(field + "factors_50", factor, 0.0, 1e3, "");
  }
  for (const double factor : record.factors_90.value_or(Vec3::Zero())) {
    checker.in_range(field + "factors_90", factor, 0.0, 1e3, "");
  }
}

/// A place far from the border of a face, on a grid; of equal ones the nearest to p_OF.
Vec2 middle_of(const std::vector<Vec2>& face, const Vec2& p_OF) {
  constexpr int kGrid = 25;
  constexpr double kPerDistance = 0.01;
  Vec2 low = face.front(), high = face.front();
  for (const Vec2& p : face) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const auto worth = [&](const Vec2& p) {
    return depth_inside(face, p) - kPerDistance * (p - p_OF).norm();
  };
  Vec2 best = low;
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i) {
      const Vec2 share((i + 0.5) / kGrid, (j + 0.5) / kGrid);
      const Vec2 p = low + share.cwiseProduct(high - low);
      if (worth(p) > worth(best)) best = p;
    }
  }
  return best;
}

void check_start_is_held(Checker& checker, const Scene& scene) {
  const std::vector<Vec2> face = pad_face_of(scene.object.shape);
  const Vec2 p_OF = finger_in_object(scene.start.X_HO);
  if (contains(face, p_OF) && ContactRegion(scene, 16).at(scene.start.X_HO).count > 0) {
    return;
  }
  const Vec2 middle = -rotated(scene.start.X_HO.theta, middle_of(face, p_OF));
  char hint[64];
  std::snprintf(hint, sizeof hint, " (say x: %.3g, y: %.3g)", middle.x() + 0.0,
                middle.y() + 0.0);
  const Vec2 shown = p_OF.array() + 0.0;  // -0 becomes 0
  checker.fault("start", "the finger axis is at " + text(shown) +
                             " in the object: expected the pads on the object" + hint);
}

}  // namespace

std::vector<Fault> check(const Scene& scene) {
  Checker checker;
  const bool rolls = can_roll(scene.object);
  check_object(checker, scene.object);
  check_pushers(checker, scene);
  check_gripper(checker, scene.gripper, scene.object);
  if (scene.gripper.grip_range && scene.g_Wz != 0.0) {
    checker.fault(
        "gripper.grip_range",
        "gravity has a part along the closing direction: expected none, for the "
        "forces of the jaws would not scale with the grip");
  }
  checker.in_range("gravity", std::hypot(scene.g_W.x(), scene.g_W.y(), scene.g_Wz), 0.0,
                   1e3, "m/s^2");
  if (rolls) check_cross_section(checker, scene);
  check_pose(checker, "start", scene.start);
  if (scene.start.psi != 0.0 && !rolls) {
    checker.fault(
        "start.roll_deg",
        "the object cannot roll: expected only for a cylinder held on its curved side");
  }
  if (scene.goal) check_goal(checker, *scene.goal, scene.object);
  if (scene.calibration) check_calibration(checker, *scene.calibration);
  if (scene.uncertainty) {
    for (const UncertaintyWidth& w : widths_of(*scene.uncertainty)) {
      checker.in_range("uncertainty." + w.field, w.value, w.least, w.most, w.unit);
    }
  }
  if (scene.cost) {
    checker.in_range("cost.travel", scene.cost->travel, 0.01, 100.0, "");
    checker.in_range("cost.work", scene.cost->work, 0.0, 1e4, "1/J");
    checker.in_range("cost.grip_change", scene.cost->grip_change, 0.0, 100.0, "");
  }
  if (scene.limits) check_limits(checker, scene);
  if (scene.obstacles) check_obstacles(checker, *scene.obstacles);
  if (checker.clean()) check_start_is_held(checker, scene);
  return checker.take();
}

}  // namespace prehensile
