#include "planner/repair.h"

#include <gtest/gtest.h>

#include "optimisation/nonlinear_program.h"
#include "planner/exact_check.h"
#include "planner/goal.h"
#include "planner/push_search.h"
#include "planner/stretch.h"
#include "primitives/uncertainty.h"
#include "problems/published_regrasps.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

/// A plan as the search finds it, with the usual margin.
struct Case {
  explicit Case(const Scene& scene)
      : model(prepare(scene)), search(prepare_search(model, usual_margin(model))) {
    plan = search_pushes(search, scene.start, *scene.goal, options, work);
    plan.margin = search.margin;
  }

  bool passes(Plan one) const {
    return check_exactly(model, options.transition, one, nullptr);
  }

  Model model;
  SearchModel search;
  PlanOptions options;
  Work work{.budget = 5'000'000};
  Plan plan;
};

void expect_same(const Grasp& a, const Grasp& b) {
  EXPECT_NEAR(a.X_HO.x, b.X_HO.x, 1e-12);
  EXPECT_NEAR(a.X_HO.y, b.X_HO.y, 1e-12);
  EXPECT_NEAR(a.X_HO.theta, b.X_HO.theta, 1e-12);
}

/// Ways of many pushes over a T, which drift by more than the search counts.
TEST(Repair, MakesPushesStickThatSlipWithinTheMargin) {
  int repaired = 0;
  for (const int index : {56, 68, 112, 119}) {
    Case one(random_among_walls(false, RegraspRange::kWide, true, 1, index));
    ASSERT_EQ(one.plan.status, PlanStatus::kReachedGoal) << index;
    ASSERT_FALSE(one.passes(one.plan)) << index;
    const Plan before = one.plan;
    const Limits limits(one.options, one.work);
    const bool found = repair(one.search, limits, one.work, one.plan);
    ASSERT_EQ(found, nlopt_is_built());
    if (!found) continue;
    EXPECT_TRUE(one.passes(one.plan)) << index;
    EXPECT_EQ(one.plan.pushes.size(), before.pushes.size());
    expect_same(one.plan.pushes.front().start, before.pushes.front().start);
    expect_same(one.plan.pushes.back().end, before.pushes.back().end);
    for (std::size_t i = 0; i < before.pushes.size(); ++i) {
      EXPECT_EQ(contact_of(one.plan.pushes[i].push), contact_of(before.pushes[i].push));
    }
    ++repaired;
  }
  EXPECT_EQ(repaired, nlopt_is_built() ? 4 : 0);
}

/// A plan of two pushes with a way-point that the first cannot push to.
TEST(Repair, BringsAWayPointBack) {
  Case one(published_tee(20));
  ASSERT_EQ(one.plan.pushes.size(), 2U);
  Stretch stretch;
  ASSERT_TRUE(read_stretch(one.search, one.plan.pushes, stretch));
  FlatState middle = flat_state(one.plan.pushes[0].end);
  middle.p_OF.y() -= 0.012;
  Plan moved = one.plan;
  moved.pushes.clear();
  append_move(one.search, {stretch.contacts[0], stretch.start, middle}, moved);
  append_move(one.search, {stretch.contacts[1], middle, stretch.end}, moved);
  ASSERT_FALSE(one.passes(moved));
  const Limits limits(one.options, one.work);
  ASSERT_EQ(repair(one.search, limits, one.work, moved), nlopt_is_built());
  EXPECT_EQ(one.passes(moved), nlopt_is_built());
}

TEST(Repair, LeavesPlansAloneThatStick) {
  Case one(published_tee(20));
  ASSERT_TRUE(one.passes(one.plan));
  const Limits limits(one.options, one.work);
  EXPECT_FALSE(repair(one.search, limits, one.work, one.plan));
  EXPECT_TRUE(one.passes(one.plan));
}

TEST(Repair, EndsWithTheWork) {
  Case one(random_among_walls(false, RegraspRange::kWide, true, 1, 56));
  one.work.budget = one.work.done();
  const Limits limits(one.options, one.work);
  EXPECT_FALSE(repair(one.search, limits, one.work, one.plan));
}

}  // namespace
}  // namespace prehensile
