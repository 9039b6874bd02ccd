#include "planner/bounds/bounds.h"

#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "planner/geometry/angle_scan.h"
#include "planner/pads/ring_pads.h"
#include "planner/pads/run_law.h"
#include "planner/steering/goal.h"
#include "scene/constants.h"
#include "tests/planner/law_cases.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::goal_at;
using testing::Random;
using testing::random_margin;

TEST(AngleScan, BoundsTheMinimumFromBelow) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const double a = random.in(0.1, 2.0);
    const double b = random.in(-5.0, 5.0);
    const double d = random.in(0.0, 1.0);
    const auto f = [&](double x) {
      return 2.5 + a * std::sin(3.0 * x + b) + d * x * x / 4;
    };
    const double low = random.in(-2.0, 0.0);
    const double high = low + random.in(0.1, 3.0);
    const double bound = least_over_angle(low, high, 3.0 * a + 2.0 * d, 1e-6, f);
    double least = f(low);
    for (int k = 0; k <= 20'000; ++k) {
      least = std::min(least, f(low + (high - low) * k / 20'000.0));
    }
    EXPECT_LE(bound, least);
    if (least <= 0.0) continue;
    EXPECT_NEAR(bound, least, 1e-5);
  }
}

/// A member of the goal set by drawing until one is found.
bool random_member(const Goal& goal, const Grasp& nominal, Random& random,
                   Grasp& member) {
  member = nominal;
  if (!goal.x) member.X_HO.x += random.in(-0.05, 0.05);
  if (!goal.y) member.X_HO.y += random.in(-0.05, 0.05);
  if (!goal.theta) member.X_HO.theta += random.in(-kPi, kPi);
  member.X_HO.x += random.in(-2e-3, 2e-3);
  member.X_HO.y += random.in(-2e-3, 2e-3);
  member.X_HO.theta += random.in(-0.1, 0.1) + 2.0 * kPi * (random.below(3) - 1);
  return reaches(goal, member);
}

TEST(Bounds, NoMemberOfTheGoalSetIsNearer) {
  const Model model = prepare(published_square(0));
  Random random(2);
  int members = 0;
  for (int i = 0; i < 400; ++i) {
    const Grasp nominal{pose_from_finger(random.in_box(0.05, 0.05), random.in(-kPi, kPi)),
                        0.0};
    Goal goal = goal_at(finger_in_object(nominal.X_HO), nominal.X_HO.theta);
    if (random.chance(0.5)) goal.test = GoalTest::kWeightedSum;
    if (random.chance(0.25)) goal.x.reset();
    if (random.chance(0.25)) goal.y.reset();
    if (random.chance(0.25)) goal.theta.reset();
    const Grasp start{pose_from_finger(random.in_box(0.05, 0.05),
                                       nominal.X_HO.theta + random.in(-2, 2)),
                      0.0};
    const double bound = distance_to_goal(model, start, goal);
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 300; ++k) {
      Grasp member;
      if (!random_member(goal, nominal, random, member)) continue;
      ++members;
      const Vec2 d = finger_in_object(member.X_HO) - finger_in_object(start.X_HO);
      const double distance =
          std::hypot(d.norm(), model.c * (member.X_HO.theta - start.X_HO.theta));
      EXPECT_GE(distance, bound - 1e-12) << i;
      nearest = std::min(nearest, distance);
    }
    const bool fixed = goal.x && goal.y && goal.theta;
    if (!fixed || !std::isfinite(nearest)) continue;
    EXPECT_LE(nearest, bound + 4e-3) << i;
  }
  EXPECT_GT(members, 10'000);
}

struct Walk {
  FlatState end;
  double cost = 0.0;
  int pushes = 0;
};

/// Random pushes that stick with the real pads, whatever the closed form says of them.
/// Over the margin, as the exact check of plans asks.
bool sticks_with_rings(const SearchModel& search, const Move& move) {
  const Model& model = *search.model;
  if (!has_ring_pads(model)) return true;
  const PushContact& contact = model.contacts[search.contacts[move.contact].contact];
  const Vec2 moved = move.from.p_OF - move.to.p_OF;
  const Margin margin =
      margin_of_laws(model, contact, search.margin_from(move.from.p_OF));
  return ring_slack(model, contact, move.from.p_OF, moved.normalized(), moved.norm(),
                    move.to.theta - move.from.theta, margin) >= -kStickTolerance;
}

Walk random_walk(const SearchModel& search, const FlatState& start, int pushes,
                 Random& random) {
  const Model& model = *search.model;
  Work work{.budget = testing::kNoBudget};
  Walk walk{.end = start};
  int last = -1;
  for (int k = 0; k < 40 && walk.pushes < pushes; ++k) {
    const int contact = last >= 0 && random.chance(0.5)
                            ? last
                            : random.below(static_cast<int>(search.contacts.size()));
    const FlatState to{walk.end.p_OF + random.in_disc(0.04),
                       walk.end.theta + random.in(-3.0, 3.0)};
    if (!segment_on_object(model, walk.end.p_OF, to.p_OF)) continue;
    const Move move{contact, walk.end, to};
    if (!(move_slack(search, move, 12, work) >= -kStickTolerance)) continue;
    if (!sticks_with_rings(search, move)) continue;
    walk.cost += (contact != last) + std::hypot((to.p_OF - walk.end.p_OF).norm(),
                                                model.c * (to.theta - walk.end.theta)) /
                                         model.L;
    last = contact;
    walk.end = to;
    ++walk.pushes;
  }
  return walk;
}

Scene random_bound_scene(int i, Random& random) {
  Scene scene = i % 2 == 0 ? published_square(i % 50) : published_tee(i % 50);
  scene.pushers.resize(1 + random.below(3));
  if (random.chance(0.5)) scene.g_W = rotated(random.in(-kPi, kPi), {9.81, 0.0});
  if (random.chance(0.3)) scene.g_W.setZero();
  for (auto& pusher : scene.pushers) {
    pusher.friction = random.in(0.1, 1.0);
    pusher.normal_angle += random.chance(0.3) ? random.in(-0.1, 0.1) : 0.0;
  }
  scene.gripper.grip_force = random.log_in(15.0, 80.0);
  if (random.chance(0.3)) return with_soft_points(scene);
  return scene;
}

/// A walk is a plan: the bound for its end must allow it, and must refuse to prove a
/// little more than its cost.
void attack_with_walks(int count, std::uint64_t seed) {
  Random random(seed);
  int walks = 0, sharp = 0, strong = 0;
  for (int i = 0; i < count; ++i) {
    const Scene scene = random_bound_scene(i, random);
    const Model model = prepare(scene);
    Margin margin = random.chance(0.5) ? random_margin(random) : Margin::none();
    margin.weightless = random.chance(0.3);
    const BoundOptions bounded{.nodes = 800, .margin = margin};
    const SearchModel search = prepare_search(model, margin);
    if (search.contacts.empty()) continue;
    const Walk walk =
        random_walk(search, flat_state(scene.start), 1 + random.below(4), random);
    if (walk.pushes == 0) continue;
    ++walks;
    Goal goal = goal_at(walk.end.p_OF, walk.end.theta);
    if (random.chance(0.5)) {  // a plan may stop at the edge of the tolerance
      goal.position_tolerance = random.log_in(1e-5, 3e-3);
      goal.angle_tolerance = random.log_in(1e-4, 0.2);
      goal.test = random.chance(0.5) ? GoalTest::kWeightedSum : GoalTest::kPerCoordinate;
      *goal.x += 0.9 * goal.position_tolerance;
    }
    if (random.chance(0.2)) goal.theta.reset();
    EXPECT_LE(trivial_bound(model, scene.start, goal), walk.cost + 1e-9) << i;
    const LowerBound bound =
        lower_bound(model, scene.start, goal, 1.2 * walk.cost, bounded);
    EXPECT_LE(bound.value, walk.cost + 1e-9) << i;
    EXPECT_FALSE(bound_holds(model, scene.start, goal, 1.03 * walk.cost, bounded)) << i;
    strong += !bound.is_trivial;
    sharp += bound.value > walk.cost / 1.1;
  }
  EXPECT_GT(walks, count / 2);
  EXPECT_GT(strong, count / 20);
  EXPECT_GT(sharp, count / 20);
}

TEST(Bounds, AllowEveryWalkOfStickingPushes) { attack_with_walks(200, 3); }

TEST(Bounds, FullAllowEveryWalkOfStickingPushes) { attack_with_walks(20'000, 4); }

/// The planner's own plans, nominal, of the problems that are measured.
void attack_with_plans(int count, int from) {
  int plans = 0;
  for (int i = from; i < from + count; ++i) {
    const bool square = i % 2 == 0;
    const auto range = i % 4 < 2 ? RegraspRange::kWide : RegraspRange::kPublished;
    const Scene scene = random_among_walls(square, range, i % 8 < 4, 5, i);
    const Model model = prepare(scene);
    PlanOptions options;
    if (i % 2 == 0) options.margin = Margin::none();
    if (i % 6 == 0) options.margin->weightless = true;
    const Plan plan = plan_regrasp(model, options);
    if (plan.status != PlanStatus::kReachedGoal) continue;
    if (plan.promise == Promise::kNominalOnly) continue;
    ++plans;
    EXPECT_LE(plan.lower_bound, plan.cost * (1.0 + 1e-9)) << i;
    EXPECT_GE(plan.lower_bound, trivial_bound(model, scene.start, *scene.goal)) << i;
    EXPECT_FALSE(bound_holds(model, scene.start, *scene.goal, 1.03 * plan.cost,
                             {.nodes = 800, .margin = plan.margin}))
        << i;
  }
  EXPECT_GT(plans, 0.9 * count);
}

TEST(Bounds, NoPlanBeatsItsBound) { attack_with_plans(64, 0); }

TEST(Bounds, FullNoPlanBeatsItsBound) { attack_with_plans(6000, 1000); }

/// What is proved for a set of goals holds for every part of it.
TEST(Bounds, OfALargerGoalHoldForASmallerOne) {
  int proved = 0;
  for (int i = 0; i < 30; ++i) {
    const Scene scene =
        random_among_walls(i % 2 == 0, RegraspRange::kWide, i % 4 < 2, 6, i);
    const Model model = prepare(scene);
    Goal goal = *scene.goal;
    goal.position_tolerance = 5e-3;
    const LowerBound larger = lower_bound(model, scene.start, goal, 4.0, {.nodes = 2000});
    goal.position_tolerance = 1e-4;
    EXPECT_TRUE(bound_holds(model, scene.start, goal, larger.value)) << i;
    proved += larger.is_trivial ? 0 : 1;
  }
  EXPECT_GT(proved, 5);
}

/// Plans that survive a margin are some of all plans: what is proved of all holds for
/// them, and now and then more is.
TEST(Bounds, GrowWithTheMargin) {
  int greater = 0;
  for (int i = 0; i < 60; ++i) {
    Scene scene = random_among_walls(i % 2 == 0, RegraspRange::kWide, i % 4 < 2, 7, i);
    if (i % 3 == 0) scene = with_soft_points(scene);
    const Model model = prepare(scene);
    const auto bound = [&](const Margin& margin) {
      return lower_bound(model, scene.start, *scene.goal, 4.0,
                         {.nodes = 3000, .margin = margin})
          .value;
    };
    const double nominal = bound(Margin::none());
    const double robust = bound(Margin{.grasp = 0.7e-3, .tilt = 0.009});
    EXPECT_GE(robust, 0.98 * nominal) << i;  // the work ends
    greater += robust > 1.01 * nominal;
  }
  EXPECT_GT(greater, 10);
}

/// Another zero of the hand's angle changes nothing: whole discs feel alike.
TEST(Bounds, DoNotDependOnTheFrameOfTheHand) {
  Random random(7);
  for (int i = 0; i < 30; ++i) {
    Scene scene = random_among_walls(i % 2 == 0, RegraspRange::kWide, i % 4 < 2, 8, i);
    const Model model = prepare(scene);
    const LowerBound bound =
        lower_bound(model, scene.start, *scene.goal, 3.0, {.nodes = 1000});
    const double turn = random.in(-kPi, kPi);
    for (PlanarPose* X_HO : {&scene.start.X_HO}) {
      *X_HO = pose_from_finger(finger_in_object(*X_HO), X_HO->theta + turn);
    }
    const PlanarPose X_HO{*scene.goal->x, *scene.goal->y, *scene.goal->theta};
    const PlanarPose turned = pose_from_finger(finger_in_object(X_HO), X_HO.theta + turn);
    scene.goal->x = turned.x;
    scene.goal->y = turned.y;
    scene.goal->theta = turned.theta;
    const LowerBound other =
        lower_bound(prepare(scene), scene.start, *scene.goal, 3.0, {.nodes = 1000});
    EXPECT_NEAR(bound.value, other.value, 1e-3) << i;
  }
}

TEST(Bounds, AreTrivialWhereTheLawsDoNotHold) {
  Scene scene = published_tee(3);
  scene.overhang = Overhang::kClip;
  const Model clipped = prepare(scene);
  EXPECT_TRUE(lower_bound(clipped, scene.start, *scene.goal, 9.0).is_trivial);
  scene = published_tee(3);
  scene.goal->x.reset();
  EXPECT_TRUE(lower_bound(prepare(scene), scene.start, *scene.goal, 9.0).is_trivial);
}

/// No contact does these alone, which the program of single placements does not see:
/// without slabs the bounds are 1.2 and 1.3.
TEST(Bounds, TellThatOnePlacementDoesNotDo) {
  for (const auto& [object, index] : {std::pair{FixtureObject::kConvex, 282},
                                      std::pair{FixtureObject::kConcave, 104}}) {
    const FixtureRange range{.object = object};
    const Model model = prepare(random_fixture(range, 1, index)->scene);
    const LowerBound bound =
        lower_bound(model, model.scene.start, *model.scene.goal, 2.3);
    EXPECT_GT(bound.value, 2.0) << index;
    EXPECT_TRUE(bound_holds(model, model.scene.start, *model.scene.goal, bound.value));
  }
}

/// Without gravity an object turns about a point as it does not with it, so that pushes
/// that need no help of gravity are not bound by how they would move it without.
TEST(Bounds, OfPointsAskNothingMoreWithoutHelpOfGravity) {
  int proved = 0;
  for (std::uint64_t i = 0; i < 24; ++i) {
    const FixtureRange range{.strength = {1.5, 3.0},
                             .pushers = FixturePushers::kPoints,
                             .weightless = 0.0,
                             .goals = GoalsFrom::kRandom};
    Scene scene = random_fixture(range, 7, i)->scene;
    scene.overhang = Overhang::kIgnore;
    if (i % 2 == 0) scene = with_soft_points(scene);
    const Model model = prepare(scene);
    const auto bound = [&](bool weightless) {
      Margin margin = Margin::none();
      margin.weightless = weightless;
      return lower_bound(model, scene.start, *scene.goal, 3.0,
                         {.nodes = 500, .margin = margin});
    };
    EXPECT_DOUBLE_EQ(bound(true).value, bound(false).value) << i;
    proved += bound(false).is_trivial ? 0 : 1;
  }
  EXPECT_GT(proved, 0);
}

/// A plan file may claim anything: a claim that would have questions without number is
/// no proof.
TEST(Bounds, AbsurdClaimsAreRefused) {
  const Scene scene = published_tee(3);
  const Model model = prepare(scene);
  for (const double claim : {1e3, 1e9, 1e300}) {
    EXPECT_FALSE(bound_holds(model, scene.start, *scene.goal, claim)) << claim;
    EXPECT_LT(lower_bound(model, scene.start, *scene.goal, claim).value, 1e3) << claim;
  }
}

TEST(Bounds, TellAGoalBesideTheConeOfAllContacts) {
  Scene scene = published_square(0);
  scene.g_W.setZero();
  scene.start.X_HO = pose_from_finger({0.0, 0.0}, 0.0);
  const Model model = prepare(scene);
  // The wall at -x moves the finger axis towards -x, floor and ceiling towards -y and +y;
  // +x is only reached by two of them in turn.
  const Goal goal = goal_at({0.03, 0.0}, 0.0);
  EXPECT_GT(lower_bound(model, scene.start, goal, 3.0).value, 2.0);
  const Goal ahead = goal_at({-0.03, 0.0}, 0.0);
  EXPECT_LT(lower_bound(model, scene.start, ahead, 3.0).value, 1.31);
  EXPECT_FALSE(bound_holds(model, scene.start, ahead, 1.35));
}

}  // namespace
}  // namespace prehensile
