#include "planner/finish/word_plans.h"

#include <gtest/gtest.h>

#include "planner/costs.h"
#include "planner/search/push_search.h"
#include "problems/published_regrasps.h"
#include "tests/planner/executed_pushes.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

/// The nearest turn of the goal only, soft points: bounds are closest there.
Scene wide_tee(int index) {
  Scene scene =
      with_soft_points(random_among_walls(false, RegraspRange::kWide, false, 1, index));
  Goal& goal = *scene.goal;
  goal.theta = scene.start.X_HO.theta + wrapped(*goal.theta - scene.start.X_HO.theta);
  goal.theta_is = ThetaMeaning::kNumber;
  return scene;
}

/// What the search finds first, before it is polished.
Plan first_plan(const SearchModel& search, Work& work) {
  const Scene& scene = search.model->scene;
  return search_pushes(search, scene.start, *scene.goal, {}, work);
}

/// Plans of several placements become cheaper, by pushes that the exact mechanics does.
TEST(WordPlans, FindsCheaperSequencesOfContacts) {
  testing::Directions directions;
  int improved = 0, dear = 0;
  for (const int index : {22, 37, 46, 52, 60, 98, 0, 1, 2, 3}) {
    const Model model = prepare(wide_tee(index));
    const SearchModel search = prepare_search(model, Margin::none());
    Work work{.budget = testing::kNoBudget};
    const PlanOptions options;
    Plan plan = first_plan(search, work);
    ASSERT_EQ(plan.status, PlanStatus::kReachedGoal) << index;
    account(model, plan);
    const double before = plan.cost;
    if (before > 4.0) ++dear;
    const std::int64_t done = work.done();
    const bool is_better = improve_by_words(search, Limits(options, work), work, plan);
    account(model, plan);
    EXPECT_EQ(is_better, plan.cost < 0.99 * before) << index;
    if (!is_better) {
      EXPECT_EQ(plan.cost, before) << index;
      continue;
    }
    ++improved;
    EXPECT_GT(work.done(), done);
    testing::expect_executable(model, plan, directions);
  }
  EXPECT_GE(dear, 5);
  EXPECT_GE(improved, 3);
}

TEST(WordPlans, LeavesPlansNearTheirBoundAlone) {
  Scene scene = with_soft_points(published_square(0));
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = testing::kNoBudget};
  const PlanOptions options;
  Plan plan = first_plan(search, work);
  const std::int64_t done = work.done();
  EXPECT_FALSE(improve_by_words(search, Limits(options, work), work, plan));
  EXPECT_EQ(work.done(), done);
}

}  // namespace
}  // namespace prehensile
