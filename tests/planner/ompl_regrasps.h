/// Small regrasps for the tests of the OMPL frame.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "planner/planner.h"
#include "planner/steering/steering.h"
#include "tests/planner/planner_cases.h"

namespace prehensile::testing {

inline Pusher wall(const std::string& name, double normal_angle,
                   const std::string& face) {
  Pusher pusher;
  pusher.name = name;
  pusher.feature = LineFeature{};
  pusher.friction = 0.9;
  pusher.normal_angle = normal_angle;
  pusher.faces = {face};
  return pusher;
}

/// A square of 0.1 m among three walls, held by discs of 9 mm radius.
inline Scene square_scene() {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  scene.object.mass = 0.5;
  scene.gripper.pad = DiscPad{0.009};
  scene.gripper.friction = {0.9, 0.9};
  scene.gripper.grip_force = 25.0;
  scene.overhang = Overhang::kIgnore;
  const double quarter = 0.5 * std::numbers::pi;
  scene.pushers = {wall("wall", 0.0, "-x"), wall("floor", quarter, "-y"),
                   wall("ceiling", -quarter, "+y")};
  scene.start.X_HO = pose_from_finger({0.02, 0.003}, 0.1);
  return scene;
}

/// A T inside the same square: bar at x < -0.02, stem of 30 mm width.
inline Scene tee_scene() {
  Scene scene = square_scene();
  const std::vector<Vec2> outline = {{-0.05, -0.05}, {-0.02, -0.05}, {-0.02, -0.015},
                                     {0.05, -0.015}, {0.05, 0.015},  {-0.02, 0.015},
                                     {-0.02, 0.05},  {-0.05, 0.05}};
  scene.object.shape = PrismShape{outline, 0.03};
  return scene;
}

/// A can on its side, held on its curved side, on a floor that can roll it and between
/// two walls at its ends.
inline Scene can_scene() {
  Scene scene;
  scene.object.shape = CylinderShape{.radius = 0.033, .length = 0.1, .axis = Axis::kX};
  scene.object.mass = 0.35;
  scene.gripper.pad = RectanglePad{{0.022, 0.022}};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {wall("floor", 0.5 * std::numbers::pi, "-y"), wall("left", 0.0, "-x"),
                   wall("right", std::numbers::pi, "+x")};
  return scene;
}

inline Scene with_goal(Scene scene, const Goal& goal) {
  scene.goal = goal;
  return scene;
}

/// Single pushes with little and with much rotation, and the T, which takes two.
inline std::vector<Scene> regrasps() {
  return {with_goal(square_scene(), goal_at({-0.03, -0.02}, -0.1)),
          with_goal(square_scene(), goal_at({0.03, 0.03}, 0.2)),
          with_goal(square_scene(), goal_at({-0.03, 0.02}, 2.5)),
          with_goal(tee_scene(), goal_at({-0.035, 0.03}, 0.1)),
          with_goal(tee_scene(), goal_at({-0.04, -0.035}, -0.2))};
}

/// Only one wall, which pushes the object the other way: no plan exists.
inline Scene hopeless_regrasp() {
  Scene scene = with_goal(square_scene(), goal_at({0.03, 0.003}, 0.1));
  scene.pushers.resize(1);
  scene.g_W = Vec2::Zero();
  return scene;
}

}  // namespace prehensile::testing
