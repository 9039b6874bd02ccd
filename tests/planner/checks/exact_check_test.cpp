#include "planner/checks/exact_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mechanics/sticking.h"
#include "planner/pads/ring_pads.h"
#include "planner/pads/run_law.h"
#include "planner/pads/spread_pads.h"
#include "planner/steering/chain.h"
#include "planner/steering/goal.h"
#include "planner/steering/steering.h"
#include "primitives/uncertainty.h"
#include "problems/random_pushes.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

/// What a disc, whose friction is the same at every angle, leaves along the way on which
/// an object turns about a point, as differences of its poses tell; infinity of pads that
/// are none.
double slack_of_disc(const Model& model, const Grasp& start, const Push& push) {
  double least = std::numeric_limits<double>::infinity();
  if (!has_ring_pads(model) && !has_clipped_discs(model)) return least;
  std::vector<Sample> trace;
  apply(model, start, as_linear(push), {.max_step = 1e-3}, &trace);
  for (std::size_t i = 1; i + 1 < trace.size(); ++i) {  // the last one is cut short
    const PlanarPose& from = trace[i - 1].grasp.X_HO;
    const PlanarPose& to = trace[i].grasp.X_HO;
    const Vec2 p_OF = finger_in_object(from);
    const Vec2 moved = p_OF - finger_in_object(to);
    const double turned = to.theta - from.theta;
    if (moved.norm() + model.c * std::abs(turned) < 1e-9) continue;
    const double slack =
        has_ring_pads(model)
            ? ring_slack(model, model.contacts[0], p_OF, moved.normalized(), moved.norm(),
                         turned)
            : spread_slack(model, model.contacts[0], p_OF, moved, turned);
    least = std::min(least, slack);
  }
  return least;
}

RandomPush random_push_by_point(std::uint64_t seed, std::uint64_t index) {
  RandomPush made = random_push(seed, index);
  made.scene.pushers[0].feature = PointFeature{};
  return made;
}

/// The points of discs pull aside where rings do not, and leave what rings deny.
TEST(ExactCheck, PushesOverDiscsSurviveTheMarginWithRingsToo) {
  testing::Random random(3);
  const Model model = prepare(testing::walled_square());
  const SearchModel search = prepare_search(model, usual_margin(model));
  int tried = 0, by_rings = 0;
  for (int i = 0; i < 40'000; ++i) {
    const FlatState from{random.in_box(0.04, 0.04), 0.3};
    const Vec2 way = random.in_disc(0.03);
    const int index = random.below(static_cast<int>(search.contacts.size()));
    Leg leg;
    Work work{.budget = testing::kNoBudget};
    if (!make_leg({search}, index, {from.p_OF}, {from.p_OF + way}, work, leg)) continue;
    // A little beyond the ends of what rings allow, where points may still stick.
    const auto [lo, hi] = leg.kappas.intervals[0];
    const double kappa = (random.chance(0.5) ? lo : hi) + random.in(-0.02, 0.02);
    const double turn = kappa * leg.length / model.c;
    const Grasp start = grasp_of(from, 0.0);
    const Move move{index, from, {from.p_OF + way, from.theta + turn}};
    const LinearPush push = push_of(search, move);
    const Margin margin = search.margin;
    const PushContact& contact = model.contacts[push.contact];
    const double slack = push_slack(model, start, push, margin);
    const double of_rings = ring_slack(model, contact, from.p_OF, push.e, push.travel,
                                       push.turn, margin_of_laws(model, contact, margin));
    EXPECT_LE(slack, of_rings + 1e-12) << i;
    ++tried;
    by_rings += slack == of_rings;
  }
  EXPECT_GT(tried, 2000);
  EXPECT_GT(by_rings, 10);
}

/// Along the way of an object that turns about a point, the slack says what the
/// transition function found by following its contact modes, whether the point slips, and
/// whether a disc would.
TEST(ExactCheck, SlackOfAPointTellsWhetherItSlips) {
  int sticks = 0;
  int slips = 0;
  for (std::uint64_t i = 0; i < 600; ++i) {
    const RandomPush c = random_push_by_point(7, i);
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
      if (slack_of_disc(model, c.scene.start, c.push) < 5e-3) continue;
      ++sticks;
      EXPECT_GE(slack, -1e-9) << i;
    }
  }
  EXPECT_GE(sticks, 50);
  EXPECT_GE(slips, 50);
}

/// A push by a point that the points which stand for a disc alone make stick is none.
TEST(ExactCheck, ADiscHasToStickToAPointAsWell) {
  int sticks = 0;
  int discs_slip = 0;
  for (std::uint64_t i = 0; i < 1500; ++i) {
    const RandomPush c = random_push_by_point(8, i);
    const Model model = prepare(c.scene);
    const Transition done = apply(model, c.scene.start, c.push);
    if (!done.completed() || done.slipped > 1e-12) continue;
    const double of_disc = slack_of_disc(model, c.scene.start, c.push);
    const double slack = push_slack(model, c.scene.start, c.push, Margin::none());
    if (of_disc < -5e-3) {
      ++discs_slip;
      EXPECT_LT(slack, 0.0) << i;
    } else if (of_disc > 5e-3 && std::holds_alternative<DiscPad>(c.scene.gripper.pad)) {
      ++sticks;
      EXPECT_GE(slack, -1e-9) << i;
    }
  }
  EXPECT_GE(sticks, 50);
  EXPECT_GE(discs_slip, 1);
}

/// Two pushes by points, each right by itself: where the second one begins beside the end
/// of the first, the object is carried beside its end.
TEST(ExactCheck, PushesByPointsStayWithThePlan) {
  int right = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const RandomPush c = random_push_by_point(9, i);
    const Model model = prepare(c.scene);
    const TransitionOptions options;
    const auto follow = [&](const Grasp& start) {
      const Transition done = apply(model, start, c.push, options);
      return PlannedPush{.push = c.push, .start = start, .end = done.end};
    };
    Plan plan;
    plan.start = c.scene.start;
    plan.margin = Margin::none();
    plan.pushes = {follow(c.scene.start)};
    plan.pushes.push_back(follow(plan.pushes[0].end));
    std::string why;
    if (!check_exactly(model, options, plan, &why)) continue;
    Grasp beside = plan.pushes[0].end;
    beside.X_HO.x += 2e-4;
    Plan apart = plan;
    apart.pushes[1] = follow(beside);
    Plan alone = apart;
    alone.pushes.erase(alone.pushes.begin());
    alone.start = beside;
    if (!check_exactly(model, options, alone, &why)) continue;
    ++right;
    EXPECT_FALSE(check_exactly(model, options, apart, &why)) << i;
    EXPECT_EQ(why, "push 2: the object ends elsewhere");
  }
  EXPECT_GE(right, 5);
}

/// Half a millimetre from the border: as the goal has it, or as the planner chose.
TEST(ExactCheck, AnEndThatThePlannerChoseKeepsTheMargin) {
  Scene scene = testing::walled_square();
  double top = 0.0;
  for (const Vec2& p : prepare(scene).pad_face) top = std::max(top, p.y());
  const FlatState end{{0.0, top - 5e-4}, scene.start.X_HO.theta};
  Plan plan{.start = scene.start};
  plan.margin.grasp = 1e-3;
  plan.pushes.push_back({});
  plan.pushes.back().start = scene.start;
  plan.pushes.back().end = grasp_of(end, 0.0);
  plan.pushes.back().push = LinearPush{.travel = 0.03};
  scene.goal = testing::goal_at(end.p_OF, end.theta);
  std::string why;
  EXPECT_TRUE(stays_on_object(prepare(scene), plan, &why)) << why;
  for (const int free : {0, 1, 2}) {
    Goal goal = *scene.goal;
    std::optional<double>* const all[] = {&goal.x, &goal.y, &goal.theta};
    all[free]->reset();
    Scene freed = scene;
    freed.goal = goal;
    EXPECT_FALSE(stays_on_object(prepare(freed), plan, &why)) << free;
  }
}

}  // namespace
}  // namespace prehensile
