#include "scene/confines.h"

#include <cmath>
#include <numbers>
#include <set>

#include "scene/checker.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr std::size_t kMostBodies = 64;

using Bound = std::optional<double>;

/// Ranges, and low <= high where both are given.
void check_box(Checker& checker, const std::string& field, const std::optional<Vec2>& low,
               const std::optional<Vec2>& high) {
  if (low) checker.place(field + "_low", *low);
  if (high) checker.place(field + "_high", *high);
  if (!low || !high || (low->array() <= high->array()).all()) return;
  checker.fault(field + "_low", text(*low) + ": expected at most " + field + "_high, " +
                                    text(*high) + ", along x and along y");
}

void check_angles(Checker& checker, const std::string& field, const Bound& low,
                  const Bound& high) {
  if (low) checker.angle(field + "_low_deg", *low);
  if (high) checker.angle(field + "_high_deg", *high);
  if (!low || !high || *low <= *high) return;
  checker.fault(field + "_low_deg", text(*low) + " rad: expected at most " + field +
                                        "_high_deg, " + text(*high) + " rad");
}

void check_start(Checker& checker, const GraspLimits& limits, const Grasp& start) {
  const double theta = start.X_HO.theta;
  const auto beyond = [&](const Bound& limit, double sign) {
    return limit && sign * (theta - *limit) > 0.0;
  };
  if (beyond(limits.theta_low, -1.0) || beyond(limits.theta_high, 1.0)) {
    checker.fault("start.theta_deg",
                  text(theta) +
                      " rad: expected a start within limits.theta_low_deg "
                      "and limits.theta_high_deg");
  }
  const Vec2 p_OF = finger_in_object(start.X_HO);
  const bool off =
      (limits.finger_low && (p_OF.array() < limits.finger_low->array()).any()) ||
      (limits.finger_high && (p_OF.array() > limits.finger_high->array()).any());
  if (off) {
    checker.fault("start", "the finger axis is at " + text(p_OF) +
                               " in the object: expected it within limits.finger_low "
                               "and limits.finger_high");
  }
}

struct ShapeChecker {
  Checker& checker;
  std::string path;

  void operator()(const BoxShape& box) const {
    for (int i = 0; i < 3; ++i) checker.length(path + ".box.size", box.size[i]);
  }
  void operator()(const SphereShape& sphere) const {
    checker.length(path + ".sphere.radius", sphere.radius);
  }
  void operator()(const CylinderShape& cylinder) const {
    checker.length(path + ".cylinder.radius", cylinder.radius);
    checker.length(path + ".cylinder.length", cylinder.length);
  }
  void operator()(const CapsuleShape& capsule) const {
    checker.length(path + ".capsule.radius", capsule.radius);
    checker.length(path + ".capsule.length", capsule.length);
  }
  void operator()(const PrismShape& prism) const {
    const std::string field = path + ".prism.outline";
    checker.length(path + ".prism.thickness", prism.thickness);
    check_outline(checker, field, prism.outline);
    if (checker.clean() && !is_convex(prism.outline)) {
      checker.fault(field,
                    "not convex: expected a convex outline, or several bodies that "
                    "make up the shape");
    }
  }
  void operator()(const HalfSpaceShape& half_space) const {
    if (std::abs(half_space.normal.norm() - 1.0) < 1e-3) return;
    checker.fault(
        path + ".half_space.normal",
        "length " + text(half_space.normal.norm()) + ": expected a unit vector x, y, z");
  }
};

void check_bodies(Checker& checker, const std::string& list,
                  const std::vector<ConvexBody>& bodies) {
  if (bodies.size() > kMostBodies) {
    checker.fault(list, std::to_string(bodies.size()) + " bodies: expected at most " +
                            std::to_string(kMostBodies));
    return;
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const ConvexBody& body = bodies[i];
    const std::string path = list + '.' + std::to_string(i);
    if (body.name.empty()) checker.fault(path + ".name", "empty: expected a name");
    if (!names.insert(body.name).second) {
      checker.fault(path + ".name",
                    body.name + ": expected a name used by one body only");
    }
    std::visit(ShapeChecker{checker, path}, body.shape);
    for (int k = 0; k < 3; ++k) {
      checker.in_range(path + ".position", body.position[k], -kLongest, kLongest, "m");
    }
    checker.unit_quaternion(path + ".quaternion_xyzw", body.quaternion);
    checker.angle(path + ".turn_deg", body.turn);
  }
}

}  // namespace

void check_limits(Checker& checker, const Scene& scene) {
  const GraspLimits& limits = *scene.limits;
  check_angles(checker, "limits.theta", limits.theta_low, limits.theta_high);
  check_box(checker, "limits.finger", limits.finger_low, limits.finger_high);
  check_box(checker, "limits.hand", limits.hand_low, limits.hand_high);
  const Bound& low = limits.hand_angle_low;
  const Bound& high = limits.hand_angle_high;
  check_angles(checker, "limits.hand_angle", low, high);
  if (low.has_value() != high.has_value()) {
    checker.fault("limits.hand_angle_low_deg",
                  "only one end is given: expected hand_angle_low_deg and "
                  "hand_angle_high_deg, or none");
  } else if (low && *high - *low > 2.0 * std::numbers::pi) {
    checker.fault("limits.hand_angle_high_deg",
                  text(*high) +
                      " rad: expected at most a whole turn above "
                      "limits.hand_angle_low_deg");
  }
  if (checker.clean()) check_start(checker, limits, scene.start);
}

void check_obstacles(Checker& checker, const Obstacles& obstacles) {
  checker.in_range("obstacles.clearance", obstacles.clearance, 0.0, 1.0, "m");
  checker.in_range("obstacles.approach", obstacles.approach, 1e-4, 1.0, "m");
  check_bodies(checker, "obstacles.fixture", obstacles.fixture);
  check_bodies(checker, "obstacles.hand", obstacles.hand);
  for (std::size_t i = 0; i < obstacles.hand.size(); ++i) {
    if (!std::holds_alternative<HalfSpaceShape>(obstacles.hand[i].shape)) continue;
    checker.fault("obstacles.hand." + std::to_string(i) + ".half_space",
                  "part of a hand: expected a body that ends somewhere");
  }
}

}  // namespace prehensile
