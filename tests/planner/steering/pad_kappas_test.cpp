#include "planner/steering/pad_kappas.h"

#include <gtest/gtest.h>

#include "planner/steering/chain.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::kNoBudget;
using testing::Random;

/// Share of rotations from the middle of measured intervals that pass the dense check of
/// the real pad, over random moves.
double passing_share(const Scene& scene, int least_moves) {
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  Work work{.budget = kNoBudget};
  Random random(1);
  int moves = 0;
  int passing = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vec2 from = random.in_box(0.03, 0.02);
    const Vec2 to = from + random.in_disc(0.015);
    const int contact = random.below(static_cast<int>(search.contacts.size()));
    const KappaSet set = measured_kappas(search, contact, from, to, work);
    for (int k = 0; k < set.count; ++k) {
      EXPECT_LE(set.intervals[k].lo, set.intervals[k].hi);
      const double kappa = 0.5 * (set.intervals[k].lo + set.intervals[k].hi);
      const double turn = kappa * (to - from).norm() / model.c;
      const double theta = random.in(-3.0, 3.0);
      const Move move{contact, {from, theta}, {to, theta + turn}};
      ++moves;
      passing += move_slack(search, move, 30, work) >= 0.0;
    }
  }
  EXPECT_GE(moves, least_moves);
  return static_cast<double>(passing) / moves;
}

TEST(PadKappas, MostRotationsPassWithTheRealPadAtAnyAngle) {
  Scene scene = testing::walled_square();
  scene.gripper.pad = RectanglePad{{0.02, 0.008}};
  EXPECT_GE(passing_share(scene, 300), 0.9);
  scene.object.shape = CylinderShape{.radius = 0.03, .length = 0.1, .axis = Axis::kX};
  scene.gripper.pad = DiscPad{0.01};
  EXPECT_GE(passing_share(scene, 150), 0.9);
}

TEST(PadKappas, FollowTheClosedFormOfAWholeDisc) {
  const Model model = prepare(testing::walled_square());
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = kNoBudget};
  Random random(2);
  int both = 0;
  int one = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec2 from = random.in_box(0.04, 0.04);
    const Vec2 to = from + random.in_disc(0.02);
    const int contact = random.below(3);
    Leg leg;
    const bool closed = make_leg({search}, contact, {from}, {to}, work, leg);
    const bool measured = !measured_kappas(search, contact, from, to, work).empty();
    if (closed && measured) ++both;
    if (closed != measured) ++one;
  }
  EXPECT_GT(both, 300);
  EXPECT_LT(one, both / 8);
}

}  // namespace
}  // namespace prehensile
