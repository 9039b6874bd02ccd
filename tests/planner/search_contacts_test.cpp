/// The contacts that a search steers by.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "planner/steering/steering.h"
#include "primitives/uncertainty.h"
#include "problems/random_fixtures.h"
#include "tests/planner/walled_scene.h"

namespace prehensile {
namespace {

using testing::kNoBudget;
using testing::scene_with;
using testing::sticking_moves;

TEST(SearchContacts, PointPushersStandAtTheCentreOfPressure) {
  const Model model = prepare(scene_with(DiscPad{0.009}, PointFeature{}));
  const SearchModel search = prepare_search(model, Margin{});
  ASSERT_EQ(search.contacts.size(), 3u);
  const std::vector<Move> moves = sticking_moves(search, 500, 8);
  ASSERT_EQ(moves.size(), 500u);
  int held = 0;
  for (const Move& move : moves) {
    const LinearPush push = push_of(search, move);
    EXPECT_LE(std::abs(push.place), 0.05 - 1e-3 + 1e-12);
    const StickTest test =
        exact_stick_test(model, model.contacts[push.contact], push.place,
                         pose_along(move.from, move.to, 0.5), push.e, push.travel,
                         push.turn, Margin::none());
    held += test.slack >= 0.0;
  }
  std::printf("%d of 500 point pushes have their moment right with the real disc\n",
              held);
  EXPECT_GT(held, 450);
}

TEST(SearchContacts, ShortLinesCoverTheFaceAndStayOnIt) {
  for (const double length : {0.004, 0.02, 0.05, 0.09, 0.1, 0.2}) {
    const Model model = prepare(scene_with(DiscPad{0.009}, LineFeature{length}));
    const SearchModel search = prepare_search(model, Margin{});
    if (length >= 0.1) {
      EXPECT_EQ(search.contacts.size(), 3u);
    }
    double covered = -0.05;
    for (const SearchContact& contact : search.contacts) {
      if (contact.contact != 0) continue;
      const double low = (contact.stick.a - contact.stick.centre).dot(contact.stick.t);
      const double high = (contact.stick.b - contact.stick.centre).dot(contact.stick.t);
      EXPECT_NEAR(high - low, std::min(length, 0.1), 1e-12);
      EXPECT_GE(low, -0.05 - 1e-12);
      EXPECT_LE(high, 0.05 + 1e-12);
      EXPECT_TRUE(length < 0.02 || low <= covered + 1e-12);
      covered = high;
    }
    EXPECT_NEAR(covered, 0.05, 1e-12);
  }
}

TEST(SearchContacts, PointPadsAndFrictionlessGraspsHaveNoContacts) {
  const Model point = prepare(scene_with(PointPad{}, LineFeature{}));
  EXPECT_TRUE(prepare_search(point, Margin{}).contacts.empty());
  Scene loose = scene_with(DiscPad{0.009}, LineFeature{});
  loose.gripper.grip_force = 0.0;
  const Model slack = prepare(loose);
  const SearchModel search = prepare_search(slack, Margin{});
  EXPECT_TRUE(search.contacts.empty());
  Work work{.budget = kNoBudget};
  EXPECT_FALSE(direct_move(search, {{0.02, 0.0}, 0.0}, {{0.0, 0.0}, 0.0}, work));
}

/// Indices of contacts mean the same at every margin.
TEST(SearchContacts, KeepsItsContactsAtOtherMargins) {
  FixtureRange range;
  range.object = FixtureObject::kConcave;
  range.pushers = FixturePushers::kPoints;
  int leave_their_face = 0;
  for (int i = 0; i < 40; ++i) {
    const auto problem = random_fixture(range, 5, i);
    if (!problem) continue;
    const Model model = prepare(problem->scene);
    const SearchModel search = prepare_search(model, usual_margin(model));
    for (const double scale : {0.0, 3.0, 9.0}) {
      const Margin margin = search.margin.scaled(scale);
      const SearchModel other = with_margin(search, margin);
      ASSERT_EQ(other.contacts.size(), search.contacts.size());
      for (std::size_t k = 0; k < search.contacts.size(); ++k) {
        EXPECT_EQ(other.contacts[k].contact, search.contacts[k].contact);
        EXPECT_LE(other.contacts[k].place_low, other.contacts[k].place_high);
      }
      const std::size_t kept = prepare_search(model, margin).contacts.size();
      if (scale > 1.0 && kept < search.contacts.size()) ++leave_their_face;
    }
  }
  EXPECT_GT(leave_their_face, 0);
}

}  // namespace
}  // namespace prehensile
