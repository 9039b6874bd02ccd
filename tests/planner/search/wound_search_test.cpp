#include "planner/search/wound_search.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "mechanics/sticking.h"
#include "planner/chains/direct_push.h"
#include "planner/chains/shorten.h"
#include "planner/costs.h"
#include "planner/planner.h"
#include "planner/search/cheapen.h"
#include "planner/search/plane_search.h"
#include "planner/steering/chain.h"
#include "planner/steering/goal.h"
#include "planner/walks/walk_lattice.h"
#include "primitives/uncertainty.h"
#include "problems/published_regrasps.h"
#include "tests/planner/planner_cases.h"
#include "tests/planner/walled_scene.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::kNoBudget;
using testing::Random;
using testing::scene_with;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// The end of a straight push of the only wall that winds the object up, as it must by
/// more than the nearest whole turns; none where the draw gives no such push.
std::optional<FlatState> wound_up(const SearchModel& search, const FlatState& from,
                                  Random& random) {
  const Vec2 to = random.in_box(0.045, 0.045);
  const double length = (to - from.p_OF).norm();
  const Vec2 e = (from.p_OF - to) / length;
  const KappaSet kappas = sticking_kappas(search.contacts[0].stick, from.p_OF, e);
  if (kappas.empty()) return std::nullopt;
  const auto& [lo, hi] = kappas.intervals[0];
  const double kappa = std::clamp(random.in(lo, hi), -60.0, 60.0);
  const double turn = kappa * length / search.model->c;
  for (const double less : {-kTurn, 0.0, kTurn}) {
    const double kappa_of_less = (wrapped(turn) + less) * search.model->c / length;
    if (kappas.contains(kappa_of_less)) return std::nullopt;
  }
  const FlatState end{to, from.theta + turn};
  Work work{.budget = kNoBudget};
  if (std::abs(turn) > 13.0 * kTurn || !move_sticks(search, 0, from, end, work)) {
    return std::nullopt;
  }
  return end;
}

/// Far from its middle a face turns the object much or not at all.
TEST(WoundSearch, FindsPushesNoDearerThanTheOneThatWindsUp) {
  Random random(1);
  int found = 0;
  for (int goals = 0; goals < 40;) {
    Scene scene = scene_with(DiscPad{0.009}, LineFeature{});
    scene.g_W.setZero();
    scene.pushers.resize(1);
    scene.start.X_HO =
        pose_from_finger(random.in_box(0.045, 0.045), random.in(-3.0, 3.0));
    const FlatState from = flat_state(scene.start);
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    const auto end = wound_up(search, from, random);
    if (!end) continue;
    ++goals;
    const PlanarPose there = grasp_of(*end, 0.0).X_HO;
    const Goal goal{.x = there.x, .y = there.y, .theta = wrapped(there.theta)};
    const double cost_of_one = cost_of(search, {{0, from, *end}});
    if (cost_of_one >= kDearPair) continue;
    ++found;
    PlanOptions options;
    Work work{.budget = kNoBudget};
    const Limits limits(options, work);
    const auto moves = search_wound(search, from, goal, goal_places(model, goal, from),
                                    1.0, limits, work);
    ASSERT_TRUE(moves) << goals;
    EXPECT_LE(cost_of(search, *moves), cost_of_one + 1e-9) << goals;
    EXPECT_TRUE(reaches(goal, grasp_of(moves->back().to, 0.0))) << goals;
    for (const Move& move : *moves) {
      EXPECT_GE(exact_slack(search, move, work), -kStickTolerance) << goals;
    }
    EXPECT_LT(work.done(), 200'000) << goals;
  }
  EXPECT_GT(found, 10);
}

/// One push winds the object up to a place beside the goal; none does to the goal itself.
TEST(WoundSearch, EndsBesideTheGoalWhereThatIsAllThatOnePushMeets) {
  const Scene scene = random_among_walls(false, RegraspRange::kWide, false, 1, 376);
  const Model model = prepare(scene);
  const SearchModel search = testing::search_over_ellipsoid(model, usual_margin(model));
  const Goal& goal = *scene.goal;
  const FlatState from = flat_state(scene.start);
  PlanOptions options;
  Work work{.budget = kNoBudget};
  const Limits limits(options, work);
  ASSERT_FALSE(direct_push(search, from, wound_places(model, goal, from), work));
  const auto moves =
      search_wound(search, from, goal, goal_places(model, goal, from), 1.0, limits, work);
  ASSERT_TRUE(moves);
  ASSERT_EQ(moves->size(), 1u);
  EXPECT_GT(std::abs(moves->front().to.theta - from.theta), 1.4 * kTurn);
  EXPECT_TRUE(reaches(goal, grasp_of(moves->front().to, 0.0)));
  EXPECT_GT(
      (moves->front().to.p_OF - goal_places(model, goal, from).places[0].p_OF).norm(),
      1e-6);
  EXPECT_GE(exact_slack(search, moves->front(), work), -kStickTolerance);
  EXPECT_LT(work.done(), 50'000);
}

/// A search for cheaper plans does not end with one that winds the object up.
TEST(WoundSearch, IsNoEndOfASearchForCheaperPlans) {
  const Scene scene = random_among_walls(true, RegraspRange::kWide, true, 1, 124);
  const Model model = prepare(scene);
  const SearchModel search = testing::search_over_ellipsoid(model, usual_margin(model));
  PlanOptions options;
  const auto moves_found = [&] {
    Work work{.budget = 2'000'000};
    WalkLattices lattices;
    return search_plane(search, scene.start, *scene.goal, lattices, Limits(options, work),
                        work);
  };
  const auto first = moves_found();
  ASSERT_TRUE(first);
  EXPECT_GT(std::abs(first->back().to.theta - first->front().from.theta), 2.0 * kTurn);
  options.improve = true;
  const auto better = moves_found();
  ASSERT_TRUE(better);
  EXPECT_LT(cost_of(search, *better), 0.8 * cost_of(search, *first));
}

}  // namespace
}  // namespace prehensile
