#include "scene/scene.h"

#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

Scene sound_scene() {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.06, 0.03}};
  scene.object.mass = 0.2;
  scene.gripper.pad = DiscPad{0.009};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  Pusher wall;
  wall.name = "wall";
  wall.feature = LineFeature{};
  wall.friction = 0.5;
  scene.pushers.push_back(wall);
  scene.goal = Goal{.x = 0.01};
  return scene;
}

TEST(Scene, SoundSceneHasNoFaults) { EXPECT_TRUE(check(sound_scene()).empty()); }

struct BrokenCase {
  const char* field;
  std::function<void(Scene&)> spoil;
};

TEST(Scene, EachFaultNamesItsField) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<BrokenCase> cases = {
      {"object.mass", [](Scene& s) { s.object.mass = -1.0; }},
      {"object.mass", [nan](Scene& s) { s.object.mass = nan; }},
      {"object.box.size",
       [](Scene& s) {
         s.object.shape = BoxShape{{0.1, 0.0, 0.1}};
       }},
      {"object.cylinder.radius",
       [](Scene& s) {
         s.object.shape = CylinderShape{-0.1, 0.1, Axis::kX};
       }},
      {"object.prism.outline",
       [](Scene& s) {
         s.object.shape = PrismShape{{}, 0.1};
       }},
      {"object.prism.outline",
       [](Scene& s) {
         s.object.shape = PrismShape{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 0.1};
       }},
      {"object.centre_of_mass", [](Scene& s) { s.object.p_OCom = Vec2(1.0, 0.0); }},
      {"gripper.pad.disc.radius", [nan](Scene& s) { s.gripper.pad = DiscPad{nan}; }},
      {"gripper.friction", [](Scene& s) { s.gripper.friction[1] = -0.1; }},
      {"gripper.grip_force", [](Scene& s) { s.gripper.grip_force = -1.0; }},
      {"gripper.grip_range", [](Scene& s) { s.gripper.grip_range = Vec2(2.0, 1.0); }},
      {"gripper.grip_range", [](Scene& s) { s.gripper.grip_range = Vec2(0.0, 1.0); }},
      {"gripper.grip_range", [nan](Scene& s) { s.gripper.grip_range = Vec2(1.0, nan); }},
      {"gripper.grip_range",
       [](Scene& s) {
         s.gripper.grip_range = Vec2(1.0, 2.0);
         s.g_Wz = -1.0;
       }},
      {"gripper.jaw_mode",
       [](Scene& s) {
         s.object.shape = CylinderShape{.radius = 0.02, .length = 0.1, .axis = Axis::kX};
         s.gripper.jaw_mode = JawMode::kLocked;
       }},
      {"gripper.tool.quaternion_xyzw", [](Scene& s) { s.gripper.tool.q_HT[3] = 2.0; }},
      {"pushers.0.friction", [](Scene& s) { s.pushers[0].friction = -0.5; }},
      {"pushers.0.faces", [](Scene& s) { s.pushers[0].faces = {"top"}; }},
      {"pushers.1.name", [](Scene& s) { s.pushers.push_back(s.pushers[0]); }},
      {"gravity", [nan](Scene& s) { s.g_W.x() = nan; }},
      {"start", [](Scene& s) { s.start.X_HO.x = 0.06; }},
      {"start.roll_deg", [](Scene& s) { s.start.psi = 0.1; }},
      {"goal", [](Scene& s) { s.goal = Goal{}; }},
      {"goal.roll_deg", [](Scene& s) { s.goal->psi = 0.1; }},
      {"goal.tolerance.position", [](Scene& s) { s.goal->position_tolerance = 0.0; }},
      {"limits.theta_low_deg",
       [](Scene& s) { s.limits = GraspLimits{.theta_low = 1.0, .theta_high = -1.0}; }},
      {"limits.theta_high_deg",
       [nan](Scene& s) { s.limits = GraspLimits{.theta_high = nan}; }},
      {"limits.finger_low",
       [](Scene& s) {
         s.limits =
             GraspLimits{.finger_low = Vec2(-0.1, 0.1), .finger_high = Vec2(0.1, -0.1)};
       }},
      {"limits.hand_high",
       [nan](Scene& s) { s.limits = GraspLimits{.hand_high = Vec2(0.0, nan)}; }},
      {"limits.hand_angle_low_deg",
       [](Scene& s) { s.limits = GraspLimits{.hand_angle_high = 1.0}; }},
      {"limits.hand_angle_high_deg",
       [](Scene& s) {
         s.limits = GraspLimits{.hand_angle_low = -4.0, .hand_angle_high = 4.0};
       }},
      {"start.theta_deg", [](Scene& s) { s.limits = GraspLimits{.theta_low = 0.1}; }},
      {"start",
       [](Scene& s) { s.limits = GraspLimits{.finger_high = Vec2(-0.01, 1.0)}; }},
      {"obstacles.clearance",
       [](Scene& s) { s.obstacles = Obstacles{.clearance = -1e-3}; }},
      {"obstacles.approach",
       [nan](Scene& s) { s.obstacles = Obstacles{.approach = nan}; }},
      {"obstacles.fixture.0.name",
       [](Scene& s) {
         s.obstacles = Obstacles{.fixture = {{.name = "", .shape = SphereShape{0.1}}}};
       }},
      {"obstacles.fixture.0.prism.outline",
       [](Scene& s) {
         const PrismShape arrow{{{0, 0}, {0.2, 0.1}, {0, 0.2}, {0.1, 0.1}}, 0.1};
         s.obstacles = Obstacles{.fixture = {{.name = "arrow", .shape = arrow}}};
       }},
      {"obstacles.fixture.0.half_space.normal",
       [](Scene& s) {
         s.obstacles = Obstacles{
             .fixture = {{.name = "table", .shape = HalfSpaceShape{Vec3::Zero()}}}};
       }},
      {"obstacles.hand.0.capsule.radius",
       [](Scene& s) {
         s.obstacles =
             Obstacles{.hand = {{.name = "finger", .shape = CapsuleShape{0.0, 0.1}}}};
       }},
      {"obstacles.hand.0.half_space",
       [](Scene& s) {
         s.obstacles = Obstacles{.hand = {{.name = "palm", .shape = HalfSpaceShape{}}}};
       }},
      {"obstacles.hand.0.position",
       [](Scene& s) {
         s.obstacles = Obstacles{.hand = {{.name = "finger",
                                           .shape = SphereShape{0.01},
                                           .position = {0.0, 0.0, 1e3}}}};
       }},
  };
  for (const BrokenCase& broken : cases) {
    Scene scene = sound_scene();
    broken.spoil(scene);
    const std::vector<Fault> faults = check(scene);
    ASSERT_FALSE(faults.empty()) << broken.field;
    EXPECT_EQ(faults.front().field, broken.field) << faults.front().what;
    EXPECT_NE(faults.front().what.find("expected"), std::string::npos)
        << faults.front().what;
  }
}

TEST(Scene, LongWallsDoNotReachIntoNotches) {
  Scene scene = sound_scene();
  scene.object.shape = PrismShape{{{-0.05, -0.05},
                                   {-0.02, -0.05},
                                   {-0.02, -0.015},
                                   {0.05, -0.015},
                                   {0.05, 0.015},
                                   {-0.05, 0.015}},
                                  0.03};
  scene.start.X_HO.x = 0.03;
  scene.pushers[0].faces = {"edge2"};
  ASSERT_EQ(check(scene).size(), 1u);
  EXPECT_EQ(check(scene)[0].field, "pushers.0.faces");
  scene.pushers[0].feature = PointFeature{};
  EXPECT_TRUE(check(scene).empty());
}

TEST(Frames, ProductsOfPoses) {
  const PlanarPose X_HO{0.1, -0.2, 0.7};
  const PlanarPose identity = compose(X_HO, inverse(X_HO));
  EXPECT_NEAR(identity.x, 0.0, 1e-15);
  EXPECT_NEAR(identity.y, 0.0, 1e-15);
  EXPECT_EQ(identity.theta, 0.0);
  const Vec2 p_OF = finger_in_object(X_HO);
  EXPECT_NEAR(transform(X_HO, p_OF).norm(), 0.0, 1e-15);
  const PlanarPose again = pose_from_finger(p_OF, X_HO.theta);
  EXPECT_NEAR(again.x, X_HO.x, 1e-15);
  EXPECT_NEAR(again.y, X_HO.y, 1e-15);
}

TEST(Frames, TwistOrderIsVxVyOmega) {
  const PlanarTwist quarter_turn_per_second(0.0, 0.0, 1.0);
  const Vec2 v = point_velocity(quarter_turn_per_second, {1.0, 0.0});
  EXPECT_EQ(v.x(), 0.0);
  EXPECT_EQ(v.y(), 1.0);
}

TEST(Frames, WrappedAngles) {
  EXPECT_NEAR(wrapped(7.0), 7.0 - 2.0 * 3.14159265358979323846, 1e-14);
  EXPECT_NEAR(wrapped(-3.2), 2.0 * 3.14159265358979323846 - 3.2, 1e-14);
}

}  // namespace
}  // namespace prehensile
