#include "planner/arm/push_load.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "planner/arm/arm_motion.h"
#include "planner/planner.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// A can between pads at a height above its axis, on a floor that rolls it, in a hand
/// with a tool.
Scene random_can(Random& random) {
  Scene scene;
  scene.object.shape = CylinderShape{random.in(0.02, 0.04), 0.1, Axis::kX};
  scene.object.mass = random.in(0.1, 0.5);
  scene.gripper.pad = RectanglePad{{0.02, 0.02}};
  scene.gripper.friction = {random.in(0.2, 0.5), random.in(0.2, 0.5)};
  scene.gripper.grip_force = 20.0;
  scene.gripper.tool.p_HT = {random.in(-0.1, 0.1), random.in(-0.1, 0.1), 0.02};
  scene.gripper.tool.q_HT = {std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};
  scene.pushers = {{.name = "floor",
                    .feature = LineFeature{},
                    .friction = random.in(0.6, 1.0),
                    .normal_angle = 0.5 * std::numbers::pi}};
  scene.goal.emplace();
  scene.goal->psi = random.chance(0.5) ? 1.0 : -1.0;
  return scene;
}

/// The jaws' forces on the object, by the instant of the section: the tool bears their
/// opposite, and their moment about the axis of the can.
struct JawLoad {
  Vec3 force;          ///< [N] on the tool, in H of a hand upright on the floor
  double about = 0.0;  ///< [N m] about +x through the middle of the section
};

JawLoad jaw_load(const Model& model, const Roll& roll) {
  CrossSectionModel section = *model.cross_section;
  section.grip_force = grip_force_of(model, roll);
  const double weight = model.mass * model.scene.g_W.norm();
  const CrossSectionDrive drive{model.contacts[roll.contact].mu, roll.travel, weight};
  const CrossSectionInstant instant = solve_cross_section(section, drive);
  const auto& N = instant.normal_force;
  const auto& f = instant.tangential_force;
  // u is +y. A force along y at z has the moment -z f about x.
  return {{0.0, -f[kJaw1] - f[kJaw2], N[kJaw2] - N[kJaw1]},
          section.radius * (f[kJaw2] - f[kJaw1])};
}

TEST(PushLoad, OfRolledCansIsWhatTheJawsTake) {
  Random random(21);
  int rolls = 0;
  for (int i = 0; i < 60; ++i) {
    const Scene scene = random_can(random);
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model);
    if (!plan.usable() || plan.pushes.size() != 1) continue;
    const Roll& roll = std::get<Roll>(plan.pushes[0].push);
    const JawLoad expected = jaw_load(model, roll);
    ++rolls;
    double most = 0.0;
    for (const ArmSample& sample : arm_motion(model, plan).samples) {
      if (sample.phase != ArmPhase::kPush) continue;
      const Vec3 force = sample.X_WT.orientation * sample.force;
      const Vec3 moment = sample.X_WT.orientation * sample.moment;
      EXPECT_LT((force - expected.force).norm(), 1e-8) << i;
      const Vec3 from_axis = sample.X_WT.position - sample.X_WH.position;
      EXPECT_NEAR((moment + from_axis.cross(force)).x(), expected.about, 1e-9) << i;
      most = std::max(most, force.norm());
      EXPECT_NEAR(sample.guard_force, 1.5 * expected.force.norm() + 2.0, 1e-6);
    }
    EXPECT_GT(most, std::abs(expected.force.z()));
  }
  EXPECT_GT(rolls, 30);
}

/// The middle of a square, where its weight hangs, stays over the edge on which it tips.
TEST(PushLoad, TurnsTheMassOfAPrismWithIt) {
  Scene scene = testing::bar_on_sheet();
  scene.gripper.grip_force = 1.0;
  const Model model = prepare(scene);
  const double side = 0.25 * model.prism->circumference;
  const PlannedPush planned{.push = Roll{0, side}, .start = scene.start};
  ASSERT_TRUE(apply(model, planned.start, planned.push).completed());
  const PushLoads loads(model, planned, 0.0);
  for (int i = 1; i < 200; ++i) {
    const double s = 0.005 * i;
    const HeldLoad load = loads.at(s);
    const Vec3 off = load.p_HCom - load.p_HP;
    if (s > 0.02 && s < 0.98) {
      EXPECT_NEAR(off.tail<2>().norm(), std::sqrt(0.5) * side, 1e-4 * side) << s;
    }
    EXPECT_NEAR(load.p_HP.y(), loads.at(0.0).p_HP.y(), 1e-12);
    EXPECT_GT(load.f_H.y(), 0.0);
  }
}

/// A push by a line or a point: the forces of the test that it was planned with.
TEST(PushLoad, OfPushesIsThatOfTheStickTest) {
  for (int i = 0; i < 10; ++i) {
    const Model model = prepare(published_tee(i));
    for (const PlannedPush& planned : plan_regrasp(model).pushes) {
      const PushLoads loads(model, planned, 0.0);
      for (const double s : {0.0, 0.5, 1.0}) {
        const Transition done =
            apply(model, planned.start, planned.push, {.max_step = 0.5});
        EXPECT_NEAR(
            loads.at(s).f_H.norm(), done.max_push_force,
            1e-4 * done.max_push_force + (done.max_push_force - done.min_push_force));
      }
    }
  }
}

}  // namespace
}  // namespace prehensile
