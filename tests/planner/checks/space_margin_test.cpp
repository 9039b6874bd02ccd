/// The margin of pushes in space, by members of its box.
#include "planner/checks/space_margin.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/checks/exact_check.h"

namespace prehensile {
namespace {

/// A wall pushes a square that hangs sideways on its friction: 0.3 x 40 N carry `weight`.
Scene hanging_scene(double height, double weight) {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  scene.object.mass = 1.0;
  scene.gripper.pad = DiscPad{0.012};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 40.0;
  scene.g_W = {0.0, -weight};
  scene.pushers.resize(1);
  scene.pushers[0] = {.name = "wall", .feature = LineFeature{}, .friction = 0.3};
  scene.pushers[0].z_WP = height;
  return scene;
}

PlannedPush planned() { return {.push = LinearPush{.travel = 0.01}}; }

TEST(SpaceMargin, MembersSlipWhereTheFrictionIsSpent) {
  const TransitionOptions options;
  const Model tight = prepare(hanging_scene(0.0005, 11.5));
  EXPECT_EQ(space_margin_fault(tight, planned(), Margin::none(), options), "");
  EXPECT_EQ(space_margin_fault(tight, planned(), Margin{}, options),
            "it slips in space within the margin");
  const Model easy = prepare(hanging_scene(0.0005, 6.0));
  EXPECT_EQ(space_margin_fault(easy, planned(), Margin{}, options), "");
}

TEST(SpaceMargin, PushesInThePadPlaneHaveTheirSlack) {
  const Model level = prepare(hanging_scene(0.0, 11.5));
  EXPECT_EQ(space_margin_fault(level, planned(), Margin{}, {}), "");
}

// What the search believes in the pad plane is refused where the object tilts in space.
TEST(SpaceMargin, TheExactCheckRefusesWhatOnlyThePadPlaneAllows) {
  for (const double height : {0.0, 0.003, 0.0149}) {
    Scene scene = hanging_scene(height, 0.0);
    scene.pushers[0].friction = 0.05;
    scene.gripper.pad = DiscPad{0.005};
    const Model model = prepare(scene);
    Plan plan;
    plan.margin = Margin::none();
    plan.pushes = {planned()};
    plan.pushes[0].end.X_HO.x = 0.01;
    std::string why;
    const bool holds = check_exactly(model, {}, plan, &why);
    EXPECT_EQ(holds, height < 0.01) << why;
    if (!holds) {
      EXPECT_EQ(why, "push 1: leaves the pad plane: the object tilts between the jaws");
    }
  }
}

}  // namespace
}  // namespace prehensile
