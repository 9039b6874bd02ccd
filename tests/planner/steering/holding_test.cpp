#include "planner/steering/holding.h"

#include <gtest/gtest.h>

#include "mechanics/certificate.h"
#include "primitives/uncertainty.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// The cheap answers agree with the certificate's wherever that is not on the edge.
TEST(Holding, AgreesWithTheSlackOfGravity) {
  Random random(1);
  int held = 0;
  int fallen = 0;
  int counted = 0;
  for (int i = 0; i < 4000; ++i) {
    Scene scene = testing::walled_square();
    const double size = random.in(0.003, 0.012);
    const double angle = random.in(-1.5, 1.5);
    const Pad pads[] = {DiscPad{size}, RectanglePad{{2.0 * size, size}},
                        LinePad{2.0 * size, angle}};
    scene.gripper.pad = pads[random.below(3)];
    scene.overhang = random.chance(0.5) ? Overhang::kClip : Overhang::kIgnore;
    if (random.chance(0.25)) {
      scene.object.shape = CylinderShape{.radius = 0.04, .length = 0.1, .axis = Axis::kX};
      scene.gripper.pad = DiscPad{size};
    }
    scene.gripper.grip_force = random.log_in(2.0, 30.0);
    scene.start.X_HO = pose_from_finger({0.001, 0.002}, 0.0);
    const Model model = prepare(scene);
    const PlanarPose X_HO =
        pose_from_finger(random.in_box(0.049, 0.039), random.in(-3.0, 3.0));
    const Vec2 g_O = 9.81 * random.direction();
    const double slack = gravity_slack(grasp_at(model, X_HO, g_O));
    if (std::abs(slack) < 1e-3) continue;
    Work work;
    EXPECT_EQ(pads_hold_gravity(model, X_HO, g_O, work), slack > 0.0)
        << i << " " << slack;
    counted += work.other > 0 ? 1 : 0;
    (slack > 0.0 ? held : fallen) += 1;
  }
  EXPECT_GT(held, 500);
  EXPECT_GT(fallen, 500);
  EXPECT_GT(counted, 100);  // what is not told cheaply is work
}

/// What is held over a margin is held by the points of the pads at any of its members;
/// and what members show not to be held is not.
TEST(Holding, OverAMarginIsHeldByItsMembers) {
  Random random(9);
  int held = 0;
  int fallen = 0;
  for (int i = 0; i < 600; ++i) {
    Scene scene = testing::walled_square();
    const double size = random.in(0.004, 0.012);
    const Pad pads[] = {DiscPad{size}, RectanglePad{{2.0 * size, size}}};
    scene.gripper.pad = pads[random.below(2)];
    scene.overhang = Overhang::kIgnore;
    scene.gripper.grip_force = random.log_in(4.0, 40.0);
    const Model model = prepare(scene);
    const Margin margin = usual_margin(model);
    const Vec2 p_OF = random.in_box(0.04, 0.03);
    const double theta = random.in(-3.0, 3.0);
    const PlanarPose X_HO = pose_from_finger(p_OF, theta);
    const Vec2 g_O = 9.81 * random.direction();
    Work work;
    const bool all = pads_hold_gravity(model, X_HO, g_O, margin, work);
    bool members = true;
    for (int k = 0; k < 40; ++k) {
      Scene other = scene;
      other.gripper.pad = resized(scene.gripper.pad, 1.0 - margin.torque_radius);
      other.object.mass *= 1.0 + margin.force;
      const Vec2 off = random.direction() * (margin.grasp + margin.centre_of_mass);
      const Model member = prepare(other);
      const Vec2 g = rotated(random.chance(0.5) ? margin.tilt : -margin.tilt, g_O);
      members = members && gravity_slack(grasp_at(
                               member, pose_from_finger(p_OF + off, theta), g)) > 1e-4;
    }
    EXPECT_TRUE(members || !all) << i;
    (all ? held : fallen) += 1;
  }
  EXPECT_GT(held, 100);
  EXPECT_GT(fallen, 100);
}

TEST(Holding, NoGravityIsAlwaysHeld) {
  Scene scene = testing::walled_square();
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  Work work;
  EXPECT_TRUE(
      pads_hold_gravity(search, {0, {{0.04, 0.0}, 0.0}, {{0.0, 0.0}, 1.0}}, work));
  EXPECT_EQ(work.done(), 0);
}

}  // namespace
}  // namespace prehensile
