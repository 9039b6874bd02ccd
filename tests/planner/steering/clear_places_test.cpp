#include "planner/steering/clear_places.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "planner/obstacles/placement.h"
#include "planner/planner.h"
#include "planner/steering/confines.h"
#include "planner/steering/goal.h"
#include "primitives/uncertainty.h"
#include "problems/confined_regrasps.h"
#include "problems/random_regrasps.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

Scene among_posts(std::uint64_t index) {
  return with_obstacles(random_among_walls(true, RegraspRange::kWide, false, 1, index), 6,
                        1, index);
}

bool is_clear_at(const SearchModel& search, int contact, const FlatState& at) {
  Work work{.budget = testing::kNoBudget};
  return !search.confines->broken_by(search, {contact, at, at}, work);
}

/// The first contact that is clear, of so many; -1: none.
int clear_contact(const SearchModel& search, std::size_t count, const FlatState& at) {
  for (int i = 0; i < static_cast<int>(count); ++i) {
    if (is_clear_at(search, i, at)) return i;
  }
  return -1;
}

/// All places of a line pusher, 0.25 mm apart.
SearchModel everywhere_along(const SearchModel& search, int contact) {
  SearchModel along = search;
  along.contacts.clear();
  const double room = farthest_place(search.model->contacts[contact]);
  for (double place = -room; place <= room; place += 2.5e-4) {
    SearchContact there = search.contacts[0];
    there.contact = contact;
    there.place = there.place_low = there.place_high = place;
    along.contacts.push_back(there);
  }
  along.confines = Confines::of(along);
  return along;
}

/// Where the hand is clear at the start along two millimetres of any face, the search has
/// a contact there.
TEST(ClearPlaces, AreFoundWhereThereAreAny) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  int added = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Model model = prepare(among_posts(i));
    const SearchModel search = prepare_search(model, Margin::none());
    const FlatState start = flat_state(model.scene.start);
    const int clear = clear_contact(search, search.contacts.size(), start);
    added += clear >= 0 && search.contacts.size() > 21;  // 3 walls, 7 places each
    if (clear >= 0) continue;
    for (int contact = 0; contact < 3; ++contact) {
      const SearchModel along = everywhere_along(search, contact);
      int run = 0;
      for (int k = 0; k < static_cast<int>(along.contacts.size()); ++k) {
        run = is_clear_at(along, k, start) ? run + 1 : 0;
        ASSERT_LT(run, 9) << i << ", contact " << contact;
      }
    }
  }
  std::printf("%d of 40 begin between the places of other scenes\n", added);
  EXPECT_GT(added, 0);
}

/// None where those that are there do.
TEST(ClearPlaces, AreNotAddedWithoutNeed) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  const Model model = prepare(among_posts(0));
  const SearchModel search = prepare_search(model, Margin::none());
  ASSERT_GE(clear_contact(search, 21, flat_state(model.scene.start)), 0);
  EXPECT_EQ(search.contacts.size(), 21u);
  Scene free = model.scene;
  free.obstacles.reset();
  const Model without = prepare(free);
  EXPECT_EQ(prepare_search(without, Margin::none()).contacts.size(), 3u);
}

/// The hand is clear at the start along 4 mm of one of three walls.
TEST(ClearPlaces, LeadToAPlan) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  const Model model = prepare(among_posts(20));
  const SearchModel search = prepare_search(model, usual_margin(model));
  const FlatState start = flat_state(model.scene.start);
  EXPECT_EQ(clear_contact(search, 21, start), -1);
  EXPECT_GE(clear_contact(search, search.contacts.size(), start), 21);
  const Plan plan = plan_regrasp(model, {});
  ASSERT_EQ(plan.status, PlanStatus::kReachedGoal);
  EXPECT_EQ(plan.promise, Promise::kMargin);
}

/// The same place as the goal.
TEST(ClearPlaces, AreFoundForGoals) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  Scene scene = among_posts(20);
  const PlanarPose blocked = scene.start.X_HO;
  scene.start.X_HO = {*scene.goal->x, *scene.goal->y, *scene.goal->theta};
  scene.goal->x = blocked.x;
  scene.goal->y = blocked.y;
  scene.goal->theta = blocked.theta;
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin::none());
  const FlatState goal = flat_state({blocked, 0.0});
  EXPECT_GE(clear_contact(search, 21, flat_state(scene.start)), 0);
  EXPECT_EQ(clear_contact(search, 21, goal), -1);
  EXPECT_GE(clear_contact(search, search.contacts.size(), goal), 21);
}

}  // namespace
}  // namespace prehensile
