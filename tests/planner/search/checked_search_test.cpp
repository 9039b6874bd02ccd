#include "planner/search/checked_search.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "planner/checks/exact_check.h"
#include "planner/planner.h"
#include "primitives/uncertainty.h"
#include "problems/random_fixtures.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

Scene points_around_a_polygon(std::uint64_t index) {
  FixtureRange range;
  range.object = FixtureObject::kConcave;
  range.pushers = FixturePushers::kPoints;
  return random_fixture(range, 1, index)->scene;
}

TEST(CheckedSearch, AContactThatIsLeftOutMakesNoPush) {
  const Model model = prepare(points_around_a_polygon(3));
  const SearchModel whole = prepare_search(model, Margin::none());
  for (const SearchContact& left_out : whole.contacts) {
    const SearchModel search = prepare_search(model, Margin::none(), left_out.contact);
    EXPECT_LT(search.contacts.size(), whole.contacts.size());
    for (const SearchContact& contact : search.contacts) {
      EXPECT_NE(contact.contact, left_out.contact);
    }
  }
}

/// No push by some point of these scenes survives the margin, whichever way the search is
/// kept clear of slipping: a plan without it does.
TEST(CheckedSearch, LeavesOutAContactThatFailsEveryCheck) {
  for (const std::uint64_t index : {71, 148}) {
    const Model model = prepare(points_around_a_polygon(index));
    PlanOptions options;
    const Margin margin = usual_margin(model);
    Work work;
    work.budget = options.budget;
    Found found;
    const Plan plan = search_and_check(model, options, margin, work, found);
    ASSERT_TRUE(plan.usable()) << index << ": " << plan.message;
    Plan checked = plan;
    EXPECT_TRUE(check_exactly(model, options.transition, checked, nullptr)) << index;
    int unused = 0;
    for (std::size_t i = 0; i < model.contacts.size(); ++i) {
      unused += std::ranges::none_of(plan.pushes, [&](const PlannedPush& push) {
        return contact_of(push.push) == static_cast<int>(i);
      });
    }
    EXPECT_GE(unused, 1) << index;
    EXPECT_EQ(plan_regrasp(model).promise, Promise::kMargin) << index;
  }
}

}  // namespace
}  // namespace prehensile
