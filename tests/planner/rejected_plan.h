/// Plans as the search finds them, of which some fail their exact check.
#pragma once

#include <gtest/gtest.h>

#include "planner/checks/exact_check.h"
#include "planner/search/push_search.h"
#include "primitives/uncertainty.h"
#include "tests/planner/planner_cases.h"

namespace prehensile::testing {

/// With the usual margin, over the ellipsoid.
struct RejectedPlan {
  explicit RejectedPlan(const Scene& scene)
      : model(prepare(scene)), search(search_over_ellipsoid(model, usual_margin(model))) {
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

/// Expects pushes by the same contacts, with the same start and end.
inline void expect_same_way(const Plan& plan, const Plan& other) {
  const auto expect_same = [](const Grasp& a, const Grasp& b) {
    EXPECT_NEAR(a.X_HO.x, b.X_HO.x, 1e-12);
    EXPECT_NEAR(a.X_HO.y, b.X_HO.y, 1e-12);
    EXPECT_NEAR(a.X_HO.theta, b.X_HO.theta, 1e-12);
  };
  ASSERT_EQ(plan.pushes.size(), other.pushes.size());
  expect_same(plan.pushes.front().start, other.pushes.front().start);
  expect_same(plan.pushes.back().end, other.pushes.back().end);
  for (std::size_t i = 0; i < other.pushes.size(); ++i) {
    EXPECT_EQ(contact_of(plan.pushes[i].push), contact_of(other.pushes[i].push));
  }
}

/// A way to repair plans, as repair() and repair_as_trajectory() are.
using Repair = bool (*)(const SearchModel&, const Limits&, Work&, Plan&);

/// Expects that a plan that sticks stays as it is.
inline void expect_sticking_plans_stay(Repair repair, const Scene& scene) {
  RejectedPlan one(scene);
  ASSERT_TRUE(one.passes(one.plan));
  const Limits limits(one.options, one.work);
  EXPECT_FALSE(repair(one.search, limits, one.work, one.plan));
  EXPECT_TRUE(one.passes(one.plan));
}

/// Expects that nothing is repaired once the work is spent.
inline void expect_end_with_the_work(Repair repair, const Scene& scene) {
  RejectedPlan one(scene);
  ASSERT_FALSE(one.passes(one.plan));
  one.work.budget = one.work.done();
  const Limits limits(one.options, one.work);
  EXPECT_FALSE(repair(one.search, limits, one.work, one.plan));
}

}  // namespace prehensile::testing
