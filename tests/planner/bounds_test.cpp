#include "planner/bounds.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/angle_scan.h"
#include "planner/goal.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::goal_at;
using testing::Random;

constexpr double kPi = std::numbers::pi;

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

/// Plans of one contact by steering: random chains of sticking moves of a contact end
/// somewhere; the bound for that end must allow them.
TEST(Bounds, AllowEveryChainOfStickingMoves) {
  Random random(3);
  int chains = 0;
  for (int i = 0; i < 3000; ++i) {
    Scene scene = i % 2 == 0 ? published_square(i % 50) : published_tee(i % 50);
    scene.pushers.resize(1 + random.below(3));
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    Work work{.budget = testing::kNoBudget};
    FlatState at = flat_state(scene.start);
    int last = -1;
    double cost = 0.0;
    for (int k = 0; k < 4; ++k) {
      const FlatState to{at.p_OF + random.in_disc(0.03), at.theta + random.in(-2.0, 2.0)};
      const auto move = direct_move(search, at, to, work, last);
      if (!move) continue;
      cost += (move->contact != last) +
              std::hypot((to.p_OF - at.p_OF).norm(), model.c * (to.theta - at.theta)) /
                  model.L;
      last = move->contact;
      at = to;
    }
    if (last < 0) continue;
    ++chains;
    const Goal goal = goal_at(at.p_OF, at.theta);
    EXPECT_LE(lower_bound(model, scene.start, goal), cost + 1e-9) << i;
  }
  EXPECT_GT(chains, 1000);
}

TEST(Bounds, TellAGoalBesideTheConeOfAllContacts) {
  Scene scene = published_square(0);
  scene.g_W.setZero();
  scene.start.X_HO = pose_from_finger({0.0, 0.0}, 0.0);
  const Model model = prepare(scene);
  // The wall at -x moves the finger axis towards -x, floor and ceiling towards -y and +y;
  // +x is only reached by two of them in turn.
  const Goal goal = goal_at({0.03, 0.0}, 0.0);
  EXPECT_GT(lower_bound(model, scene.start, goal), 2.0);
  const Goal ahead = goal_at({-0.03, 0.0}, 0.0);
  EXPECT_LT(lower_bound(model, scene.start, ahead), 1.31);
}

}  // namespace
}  // namespace prehensile
