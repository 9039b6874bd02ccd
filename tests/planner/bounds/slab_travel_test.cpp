#include "planner/bounds/slab_travel.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/steering/chain.h"
#include "planner/steering/goal.h"
#include "tests/planner/law_cases.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::Random;
using testing::random_law_scene;
using testing::random_sticking_move;

/// T among walls, without weight, pads with the friction of the ellipsoid.
Scene weightless_tee() {
  Scene scene = with_soft_points(published_tee(0));
  scene.g_W.setZero();
  return scene;
}

/// Plans by hand in the stem of a T or on a square: random pushes that stick, most of
/// them along the edges of the friction cones, where ways are cheap. After each the way
/// done is no shorter than what the slabs say.
void attack(int scenes, int pushes, std::uint64_t seed) {
  Random random(seed);
  int walks = 0, beyond_straight = 0, sharp = 0;
  for (int i = 0; i < scenes; ++i) {
    const Scene scene = random_law_scene(random);
    const Model model = prepare(scene);
    const Margin margin =
        random.chance(0.5) ? testing::random_margin(random) : Margin::none();
    const SearchModel search = prepare_search(model, margin);
    SlabTravel slabs(model, margin);
    Work work{.budget = testing::kNoBudget};
    FlatState start = flat_state(scene.start);
    start.p_OF = {random.in(-0.045, 0.045), random.in(-0.014, 0.014)};
    FlatState at = start;
    double travel = 0.0, travelled = 0.0;
    for (int k = 0; k < pushes; ++k) {
      const int contact = random.below(static_cast<int>(search.contacts.size()));
      const auto move = random_sticking_move(search, contact, at, random, work);
      if (!move || !testing::sticks_as_checked(search, *move, margin, travelled))
        continue;
      travelled += (move->to.p_OF - at.p_OF).norm();
      travel += flat_distance(model, at, move->to);
      at = move->to;
      ++walks;
      const double turn = at.theta - start.theta;
      const double straight = std::hypot((at.p_OF - start.p_OF).norm(), model.c * turn);
      const double least =
          slabs.least(start.p_OF, {.centre = at.p_OF}, turn, turn + random.in(0.0, 0.2));
      EXPECT_LE(least, travel * (1.0 + 1e-6)) << i;
      beyond_straight += least > straight ? 1 : 0;
      sharp += least > 0.8 * travel ? 1 : 0;
    }
  }
  EXPECT_GT(walks, scenes);
  EXPECT_GT(beyond_straight, walks / 100);
  EXPECT_GT(sharp, walks / 100);
}

TEST(SlabTravel, NoWalkOfStickingPushesIsShorter) { attack(40, 40, 1); }

TEST(SlabTravel, FullNoWalkOfStickingPushesIsShorter) { attack(2000, 100, 2); }

/// Into the stem the walls beside the bar turn the object by a radian and more for each
/// millimetre; out of it the wall at the bar pushes straight.
TEST(SlabTravel, IsLongIntoAStemAndShortOutOfIt) {
  const Model model = prepare(weightless_tee());
  SlabTravel slabs(model, Margin::none());
  const Vec2 mouth(-0.02, 0.0), deep(0.045, 0.0);
  const double inwards = slabs.least(mouth, {.centre = deep}, -10.0, 10.0);
  const double outwards = slabs.least(deep, {.centre = mouth}, -10.0, 10.0);
  EXPECT_GT(inwards, 0.6);
  EXPECT_LT(inwards, 0.8);
  EXPECT_GE(outwards, 0.065 - 1e-6);
  EXPECT_LT(outwards, 0.07);
  EXPECT_EQ(inwards, slabs.least(mouth, {.centre = deep}, -10.0, 10.0));
}

/// A goal that may be nearer, or turn by other angles too, is no farther.
TEST(SlabTravel, LargerGoalsAreNoFarther) {
  const Model model = prepare(weightless_tee());
  SlabTravel slabs(model, Margin::none());
  Random random(4);
  for (int i = 0; i < 30; ++i) {
    const Vec2 from(random.in(-0.05, 0.0), random.in(-0.015, 0.015));
    GoalArc goal{.centre = {random.in(0.0, 0.05), random.in(-0.015, 0.015)}};
    const double turn = random.in(-6.0, 6.0);
    const double least = slabs.least(from, goal, turn, turn);
    EXPECT_LE(slabs.least(from, goal, turn - 1.0, turn + 1.0), least + 1e-9);
    goal.slack.fill(3e-3);
    EXPECT_LE(slabs.least(from, goal, turn, turn), least + 1e-9);
  }
}

TEST(SlabTravel, SaysNothingWhereTheFrictionIsNotKnown) {
  Scene scene = published_tee(0);
  scene.overhang = Overhang::kClip;
  const Model model = prepare(scene);
  SlabTravel slabs(model, Margin::none());
  EXPECT_EQ(slabs.least({-0.02, 0.0}, {.centre = {0.045, 0.0}}, 0.0, 0.0), 0.0);
}

}  // namespace
}  // namespace prehensile
