#include "planner/exact_check.h"

#include <gtest/gtest.h>

#include "mechanics/sticking.h"
#include "problems/random_pushes.h"

namespace prehensile {
namespace {

/// Along the way of an object that turns about a point, the slack says what the
/// transition function found by following its contact modes: whether the point slips.
TEST(ExactCheck, SlackOfAPointTellsWhetherItSlips) {
  int sticks = 0;
  int slips = 0;
  for (std::uint64_t i = 0; i < 600; ++i) {
    RandomPush c = random_push(7, i);
    c.scene.pushers[0].feature = PointFeature{};
    const Model model = prepare(c.scene);
    const Transition done = apply(model, c.scene.start, c.push);
    const auto held = [&](const Grasp& grasp) {
      return holding_slack(model, finger_in_object(grasp.X_HO), model.contacts[0].g_O,
                           Margin::none()) > 0.1;
    };
    if (!held(c.scene.start) || !held(done.end)) continue;
    const double slack = push_slack(model, c.scene.start, c.push, Margin::none());
    if (!done.completed()) {
      EXPECT_LT(slack, 0.0) << i;
    } else if (done.slipped > 1e-5) {  // maybe between two of the places looked at
      ++slips;
      EXPECT_LT(slack, 5e-3) << i;
    } else if (done.slipped < 1e-12) {
      ++sticks;
      EXPECT_GE(slack, -1e-9) << i;
    }
  }
  EXPECT_GE(sticks, 50);
  EXPECT_GE(slips, 50);
}

}  // namespace
}  // namespace prehensile
