#include "planner/bounds/run_slabs.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/steering/chain.h"
#include "planner/steering/goal.h"
#include "problems/random_fixtures.h"
#include "tests/planner/law_cases.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::Random;
using testing::random_law_scene;
using testing::random_sticking_move;

RunQuestion question_of(const Model& model, int contact, const FlatState& from,
                        const FlatState& to, double cap) {
  const double turn = to.theta - from.theta;
  return {.contact = contact,
          .c = model.c,
          .outline = &model.pad_face,
          .start = from.p_OF,
          .goal = {.centre = to.p_OF},
          .turn_low = turn,
          .turn_high = turn,
          .cap = cap};
}

/// Random pushes by one contact that stick: what the slabs say never forbids them, for
/// any cap, and sometimes is nearly as long as the way.
void attack(int scenes, int pushes, std::uint64_t seed) {
  Random random(seed);
  int walks = 0, sharp = 0, lost = 0;
  for (int i = 0; i < scenes; ++i) {
    const Model model = prepare(random_law_scene(random));
    const Margin margin =
        random.chance(0.5) ? testing::random_margin(random) : Margin::none();
    const SearchModel search = prepare_search(model, margin);
    const LocalLaw law(model, margin);
    ASSERT_TRUE(law.is_known());
    Work work{.budget = testing::kNoBudget};
    FlatState start = flat_state(model.scene.start);
    start.p_OF = {random.in(-0.045, 0.045), random.in(-0.014, 0.014)};
    const int contact = random.below(static_cast<int>(search.contacts.size()));
    FlatState at = start;
    double travel = 0.0, travelled = 0.0;
    for (int k = 0; k < pushes; ++k) {
      const auto move = random_sticking_move(search, contact, at, random, work);
      if (!move || !testing::sticks_as_checked(search, *move, margin, travelled))
        continue;
      travelled += (move->to.p_OF - at.p_OF).norm();
      travel += flat_distance(model, at, move->to);
      at = move->to;
      ++walks;
      const double cap = travel * random.in(1.001, 1.5);
      RunQuestion run =
          question_of(model, search.contacts[contact].contact, start, at, cap);
      const double least = travel_across_slabs(law, run);
      EXPECT_LE(least, travel * (1.0 + 1e-6)) << i;
      sharp += least > 0.9 * travel ? 1 : 0;
      const double known = random.in(0.5, 1.1) * travel;
      const double more = std::max(known, travel_across_slabs(law, run, known));
      EXPECT_GE(more, 0.9 * std::max(known, least));
      lost += more < 0.999 * std::max(known, least) ? 1 : 0;
      run.goal.slack.fill(1e-3);  // nor for goals around this one
      run.turn_low -= random.in(0.0, 0.3);
      EXPECT_LE(travel_across_slabs(law, run), travel * (1.0 + 1e-6)) << i;
    }
  }
  EXPECT_GT(walks, scenes);
  EXPECT_GT(sharp, walks / 20);
  EXPECT_LE(lost, walks / 50);
}

TEST(RunSlabs, NoRunOfStickingPushesIsShorter) { attack(25, 20, 1); }

TEST(RunSlabs, FullNoRunOfStickingPushesIsShorter) { attack(4000, 40, 2); }

/// A wall does not pull: where it would have to, no way is short enough, whatever the
/// cap; a way ahead of it is as long as it is straight.
TEST(RunSlabs, AWallOnlyPushes) {
  Scene scene = with_soft_points(published_square(0));
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const LocalLaw law(model);
  for (int contact = 0; contact < static_cast<int>(model.contacts.size()); ++contact) {
    const Vec2 ahead = -0.02 * model.contacts[contact].n;
    for (const double cap : {0.03, 0.1, 1.0}) {
      const auto travel_to = [&](const Vec2& p_OF) {
        return travel_across_slabs(law,
                                   question_of(model, contact, {}, {p_OF, 0.0}, cap));
      };
      EXPECT_EQ(travel_to(-ahead), cap);
      EXPECT_NEAR(travel_to(ahead), 0.02, 1e-4);
    }
  }
}

/// Gravity would help with each inequality of a sticking instant, in motions that another
/// one denies: a contact for which the program, that has them one by one, says little.
TEST(RunSlabs, AskForAllInequalitiesTogether) {
  const FixtureRange range{.object = FixtureObject::kConvex};
  const Model model = prepare(random_fixture(range, 1, 234)->scene);
  const LocalLaw law(model);
  const RunLaws laws = run_laws(model);
  const FlatState start = flat_state(model.scene.start);
  const GoalPlaces goals = goal_places(model, *model.scene.goal, start);
  const FlatState to{goals.places[0].p_OF, goals.places[0].theta[0]};
  const double cap = 2.0 * flat_distance(model, start, to);
  int more = 0;
  for (int contact = 0; contact < static_cast<int>(model.contacts.size()); ++contact) {
    RunQuestion run = question_of(model, contact, start, to, cap);
    run.laws = &laws;
    more += travel_across_slabs(law, run) > 1.2 * run_bound(run) ? 1 : 0;
  }
  EXPECT_GT(more, 0);
}

TEST(RunSlabs, NoWayIsLongerThanTheCapAsked) {
  Scene scene = with_soft_points(published_square(0));
  const Model model = prepare(scene);
  const LocalLaw law(model);
  const FlatState to{{0.02, 0.01}, 0.3};
  EXPECT_EQ(travel_across_slabs(law, question_of(model, 0, {}, to, 0.02)), 0.02);
}

TEST(RunSlabs, SaysNothingWhereTheFrictionIsNotKnown) {
  Scene scene = published_tee(0);
  scene.overhang = Overhang::kClip;
  const Model model = prepare(scene);
  const LocalLaw law(model);
  const FlatState to{{0.02, 0.01}, 0.3};
  EXPECT_EQ(travel_across_slabs(law, question_of(model, 0, {}, to, 1.0)), 0.0);
}

}  // namespace
}  // namespace prehensile
