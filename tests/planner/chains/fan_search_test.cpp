#include "planner/chains/fan_search.h"

#include <gtest/gtest.h>

#include "planner/steering/chain.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::kNoBudget;

struct Result {
  int found = 0;
  int runs = 0;
  std::size_t longest = 0;
};

/// Searches wide problems with the fans alone and holds every plan to what it promises.
Result search_wide(bool square, bool gravity, const Margin& margin, int runs) {
  Result result;
  for (int i = 0; i < runs; ++i) {
    const Scene scene = random_among_walls(square, RegraspRange::kWide, gravity, 2, i);
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, margin);
    const PadEnvelope envelope(model, margin);
    const FlatState start = flat_state(scene.start);
    const GoalPlaces goals = goal_places(model, *scene.goal, start);
    Work work{.budget = kNoBudget};
    const PlanOptions options;
    const Limits limits(options, work);
    const auto moves = search_fan(search, envelope, start, goals, limits, work);
    ++result.runs;
    if (!moves) continue;
    ++result.found;
    result.longest = std::max(result.longest, moves->size());
    EXPECT_EQ(moves->front().from.p_OF, start.p_OF);
    EXPECT_EQ(moves->front().from.theta, start.theta);
    for (std::size_t k = 0; k < moves->size(); ++k) {
      EXPECT_TRUE(move_passes(search, (*moves)[k], work)) << i << " move " << k;
      if (k == 0) continue;
      EXPECT_EQ((*moves)[k].from.p_OF, (*moves)[k - 1].to.p_OF);
      EXPECT_EQ((*moves)[k].from.theta, (*moves)[k - 1].to.theta);
    }
    EXPECT_TRUE(reaches(*scene.goal, grasp_of(moves->back().to, 0.0)));
  }
  return result;
}

TEST(FanSearch, ReachesAnyPoseOfTheSquare) {
  for (const bool gravity : {true, false}) {
    const Result result = search_wide(true, gravity, Margin::none(), 15);
    EXPECT_EQ(result.found, result.runs) << (gravity ? "gravity" : "no gravity");
  }
}

TEST(FanSearch, ReachesPosesOfTheTeeThatNeedManyPushes) {
  const Result none = search_wide(false, false, Margin::none(), 15);
  EXPECT_EQ(none.found, none.runs);
  const Result gravity = search_wide(false, true, Margin::none(), 15);
  EXPECT_EQ(gravity.found, gravity.runs);
  EXPECT_GE(std::max(none.longest, gravity.longest), 4u);
}

TEST(FanSearch, EndsAtTheBudget) {
  const Scene scene = random_among_walls(false, RegraspRange::kWide, false, 1, 13);
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  const PadEnvelope envelope(model, search.margin);
  const FlatState start = flat_state(scene.start);
  Work work{.budget = 10'000};
  const PlanOptions options;
  const Limits limits(options, work);
  EXPECT_FALSE(search_fan(search, envelope, start, goal_places(model, *scene.goal, start),
                          limits, work));
  EXPECT_LE(work.stick_tests, 60'000);
}

}  // namespace
}  // namespace prehensile
