#include "planner/costs.h"

#include <numbers>

#include <gtest/gtest.h>

#include "planner/arm/arm_motion.h"
#include "planner/bounds/bounds.h"
#include "planner/checks/exact_check.h"
#include "planner/checks/replay.h"
#include "planner/finish/loosen_grip.h"
#include "planner/planner.h"
#include "primitives/roll.h"
#include "tests/planner/law_cases.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::Random;
using testing::random_law_scene;

Scene priced(Scene scene, const CostWeights& price) {
  scene.cost = price;
  return scene;
}

/// A straight push of some contact, whether or not it sticks.
PlannedPush random_way(Random& random, const Model& model) {
  const Vec2 d(random.in(-0.01, 0.01), random.in(-0.01, 0.01));
  const double turn = random.in(-1.0, 1.0);
  const Grasp& start = model.scene.start;
  PlannedPush way{.start = start, .end = start};
  const Vec2 p_OF = finger_in_object(start.X_HO) + d;
  way.end.X_HO = pose_from_finger(p_OF, start.X_HO.theta + turn);
  way.push =
      LinearPush{.contact = 0, .e = -d.normalized(), .travel = d.norm(), .turn = turn};
  return way;
}

TEST(Costs, AreSPlusTOverLWithoutPrices) {
  const Model model = prepare(published_square(3));
  const Plan plan = plan_regrasp(model);
  ASSERT_TRUE(plan.usable());
  EXPECT_DOUBLE_EQ(plan.cost, plan.placements + plan.travel / model.L);
  EXPECT_EQ(plan.work, 0.0);
  EXPECT_EQ(placement_length(model), model.L);
  EXPECT_EQ(longest_placement_length(model), model.L);
}

TEST(Costs, SoftPointsTakeForceTimesTravel) {
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    Scene scene = random_law_scene(random);
    scene.gripper.pad = PointPad{.spin_radius = random.in(1e-3, 1e-2)};
    const Model model = prepare(priced(scene, {.work = random.in(0.0, 20.0)}));
    const PlannedPush way = random_way(random, model);
    Plan plan{.pushes = {way}};
    account(model, plan);
    EXPECT_NEAR(plan.work, model.F * plan.travel, 1e-9 * plan.work);
    EXPECT_NEAR(plan.cost, 1.0 + plan.travel / placement_length(model), 1e-9 * plan.cost);
    EXPECT_NEAR(longest_placement_length(model), placement_length(model), 2e-3 * model.L);
  }
}

/// What bounds count with is never more than a way costs, and not far below it.
TEST(Costs, BoundsCountWithNoMoreThanTheyAre) {
  Random random(5);
  double nearest = 0.0;
  for (int i = 0; i < 200; ++i) {
    Scene scene = random_law_scene(random);
    if (random.chance(0.7)) scene.overhang = Overhang::kIgnore;
    const Model model = prepare(priced(
        scene, {.travel = random.log_in(0.1, 10.0), .work = random.log_in(0.1, 50.0)}));
    Plan plan{.pushes = {random_way(random, model)}};
    account(model, plan);
    const double least = 1.0 + plan.travel / longest_placement_length(model);
    EXPECT_LE(least, plan.cost * (1.0 + 1e-9));
    nearest = std::max(nearest, (least - 1.0) / (plan.cost - 1.0));
  }
  EXPECT_GT(nearest, 0.95);
}

/// A plan made for some prices is, at these, about as cheap as plans made for others
/// and no plan is cheaper than its bound. Where travel is
/// dear there is less of it, where it is cheap there are fewer placements.
TEST(Costs, PlansArePlannedForThePricesOfTheScene) {
  const std::array<CostWeights, 3> prices = {
      {{.travel = 0.05}, {.travel = 1.0}, {.travel = 20.0}}};
  constexpr double kAsGood = 1.15;  // planning stops at a gap of a tenth
  std::array<double, 3> travel{}, placements{};
  for (int i = 0; i < 100; i += 3) {
    const Scene scene = i < 50 ? published_square(i) : published_tee(i - 50);
    std::array<Plan, 3> plans;
    for (std::size_t k = 0; k < 3; ++k) {
      const Model model = prepare(priced(scene, prices[k]));
      plans[k] = plan_regrasp(model);
      ASSERT_TRUE(plans[k].usable()) << plans[k].message;
      const Replay replayed = replay(model, plans[k]);
      EXPECT_TRUE(replayed.agrees) << replayed.why;
      travel[k] += plans[k].travel;
      placements[k] += plans[k].placements;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Model model = prepare(priced(scene, prices[k]));
      for (Plan other : plans) {
        account(model, other);
        EXPECT_GE(other.cost, plans[k].cost / kAsGood) << scene.name << k;
        EXPECT_GE(other.cost, plans[k].lower_bound * (1.0 - 1e-9)) << scene.name << k;
      }
    }
  }
  EXPECT_LT(placements[0], placements[2]);
  EXPECT_GT(travel[0], travel[2]);
}

/// Whether the grasp alone holds the object before and after every push.
bool is_held(const Model& model, const Plan& plan) {
  double travelled = 0.0;
  for (const PlannedPush& push : plan.pushes) {
    const Vec2& g_O = model.contacts[contact_of(push.push)].g_O;
    for (const Grasp& grasp : {push.start, push.end}) {
      const Margin margin = carried(plan.margin, travelled);
      const Vec2 p_OF = finger_in_object(grasp.X_HO);
      if (!(holding_slack(model, p_OF, g_O, margin) > 0.0)) return false;
    }
    travelled += travel_in_pad_plane(push.push);
  }
  return true;
}

/// The grips of a plan against all others that its placements might have.
TEST(Costs, GripsAreTheCheapestThatPass) {
  int cheaper = 0;
  for (const CostWeights& price :
       {CostWeights{.work = 30.0}, CostWeights{.grip_change = 0.3},
        CostWeights{.work = 3.0, .grip_change = 0.05}}) {
    for (int i = 0; i < 50; i += 7) {
      Scene scene = priced(published_tee(i), price);
      scene.gripper.grip_range = Vec2(0.2, 1.0) * scene.gripper.grip_force;
      const Model model = prepare(scene);
      const Plan plan = plan_regrasp(model);
      ASSERT_TRUE(plan.usable()) << plan.message;
      EXPECT_TRUE(replay(model, plan).agrees);
      for (std::size_t k = 0; k < plan.pushes.size(); ++k) {
        for (std::size_t c = 0; c < model.contacts.size(); ++c) {
          Plan other = plan;
          for (std::size_t n = k; n < plan.pushes.size(); ++n) {
            if (n > k && !same_placement(plan.pushes[n].push, plan.pushes[k].push)) break;
            const auto& own = model.contacts[contact_of(plan.pushes[k].push)];
            if (own.pusher != model.contacts[c].pusher) break;
            auto& push = std::get<LinearPush>(other.pushes[n].push);
            push.contact = static_cast<int>(c);
          }
          account(model, other);
          if (!(other.cost < plan.cost - 1e-9)) continue;
          ++cheaper;
          EXPECT_FALSE(is_held(model, other) && check_exactly(model, {}, other, nullptr))
              << other.cost << plan.cost;
        }
      }
    }
  }
  EXPECT_GT(cheaper, 0);
}

TEST(Costs, DearChangesOfGripAreFew) {
  double changes = 0.0, changes_if_dear = 0.0;
  for (int i = 0; i < 50; i += 5) {
    Scene scene = priced(published_tee(i), {});
    scene.gripper.grip_range = Vec2(0.2, 1.0) * scene.gripper.grip_force;
    const Plan plan = plan_regrasp(prepare(scene));
    scene.cost->grip_change = 10.0;
    const Plan dear = plan_regrasp(prepare(scene));
    ASSERT_TRUE(plan.usable() && dear.usable());
    EXPECT_EQ(dear.pushes.size(), plan.pushes.size());
    EXPECT_LE(dear.grip_changes, plan.grip_changes);
    changes += plan.grip_changes;
    changes_if_dear += dear.grip_changes;
  }
  EXPECT_GT(changes, 2.0);
  EXPECT_EQ(changes_if_dear, 0.0);
}

/// The changes that a plan pays for are those of the arm that does it.
TEST(Costs, GripChangesAreThoseOfTheArm) {
  int changes = 0;
  for (int i = 0; i < 50; i += 3) {
    Scene scene = priced(published_tee(i), {});
    scene.gripper.grip_range = Vec2(0.2, 2.0) * scene.gripper.grip_force;
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model);
    ASSERT_TRUE(plan.usable());
    int of_arm = 0;
    const ArmSample* last = nullptr;
    const ArmMotion motion = arm_motion(model, plan);
    for (const ArmSample& sample : motion.samples) {
      const bool begins = sample.phase == ArmPhase::kGrip &&
                          (last == nullptr || last->phase != ArmPhase::kGrip);
      of_arm += begins ? 1 : 0;
      last = &sample;
    }
    EXPECT_EQ(plan.grip_changes, of_arm) << i;
    changes += of_arm;
  }
  EXPECT_GT(changes, 0);
}

/// What the support gives in a roll is what both jaws, which slip by as much, resist.
TEST(Costs, RollsTakeWhatTheJawsResist) {
  Random random(4);
  int rolls = 0;
  for (int i = 0; i < 300; ++i) {
    Scene scene;
    scene.object.shape = CylinderShape{.radius = 0.03, .length = 0.1, .axis = Axis::kX};
    scene.object.mass = random.log_in(0.1, 2.0);
    scene.gripper.pad = RectanglePad{{0.02, 0.02}};
    scene.gripper.friction = {random.in(0.1, 0.9), random.in(0.1, 0.9)};
    scene.gripper.grip_force = 20.0;
    scene.gripper.jaw_mode = static_cast<JawMode>(random.below(3));
    scene.pushers = {{.name = "floor",
                      .feature = LineFeature{},
                      .friction = 1.0,
                      .normal_angle = 0.5 * std::numbers::pi}};
    const Model model = prepare(scene);
    const Roll roll{.contact = 0,
                    .travel = random.chance(0.5) ? 0.01 : -0.02,
                    .grip_force = random.log_in(0.1, 2.0)};
    if (!apply(model, scene.start, roll).completed()) continue;
    CrossSectionModel section = *model.cross_section;
    section.grip_force = roll.grip_force;
    const double weight = roll_section(model, 0, scene.start).weight;
    const auto& [mu_1, mu_2] = section.friction;
    const double work =
        friction_work(model, {.push = roll, .start = scene.start, .end = scene.start});
    const CrossSectionInstant instant = solve_cross_section(
        section, {.mu = 1.0, .sheet_rate = roll.travel, .weight = weight});
    const double resisted =
        mu_1 * instant.normal_force[kJaw1] + mu_2 * instant.normal_force[kJaw2];
    EXPECT_NEAR(work, resisted * std::abs(roll.travel), 1e-6 * work) << i;
    const double load = instant.normal_force[kSheet];
    EXPECT_NEAR(
        work,
        rolling_threshold(section, roll.travel, weight) * load * std::abs(roll.travel),
        1e-6 * work);
    ++rolls;
  }
  EXPECT_GT(rolls, 50);
}

TEST(Costs, ReplayCountsThemAgain) {
  Scene scene = priced(published_tee(20), {.work = 2.0, .grip_change = 0.1});
  scene.gripper.grip_range = Vec2(0.2, 1.0) * scene.gripper.grip_force;
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  ASSERT_TRUE(plan.usable());
  EXPECT_TRUE(replay(model, plan).agrees);
  EXPECT_GT(plan.work, 0.0);
  Plan wrong = plan;
  wrong.work *= 0.9;
  EXPECT_FALSE(replay(model, wrong).agrees);
  wrong = plan;
  wrong.grip_changes += 1.0;
  EXPECT_FALSE(replay(model, wrong).agrees);
  EXPECT_FALSE(replay(prepare(published_tee(20)), plan).agrees);
}

}  // namespace
}  // namespace prehensile
