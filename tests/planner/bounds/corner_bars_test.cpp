#include "planner/bounds/corner_bars.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "planner/steering/goal.h"
#include "tests/planner/law_cases.h"
#include "tests/planner/no_budget.h"

namespace prehensile {
namespace {

using testing::Random;
using testing::random_law_scene;
using testing::random_margin;
using testing::random_sticking_move;
using testing::sticks_as_checked;

bool is_barred_from(const LocalLaw& law, const Model& model, int contact,
                    const Vec2& start, const Vec2& goal) {
  const std::array goals = {GoalArc{.centre = goal}};
  return is_barred(law, contact, model.pad_face, start, goals);
}

/// A goal with the place among its members, whose middle may be off the object.
GoalArc random_goal_around(const Vec2& p_OF, Random& random) {
  GoalArc goal{.arc = random.log_in(1e-5, 1e-2) * random.direction()};
  const double share = random.in(-1.0, 1.0), slack = random.log_in(1e-6, 2e-2);
  goal.centre = p_OF - share * goal.arc + 0.999 * slack * random.direction();
  goal.slack.fill(slack);
  return goal;
}

/// Random pushes by one contact that stick, most of them along the edges of the friction
/// cone: no bar keeps them from where they lead, with a margin neither; some places are
/// barred.
void attack(int scenes, int pushes, std::uint64_t seed) {
  Random random(seed);
  int walks = 0, barred = 0;
  for (int i = 0; i < scenes; ++i) {
    const Model model = prepare(random_law_scene(random));
    const Margin margin = random.chance(0.5) ? random_margin(random) : Margin::none();
    const SearchModel search = prepare_search(model, margin);
    const LocalLaw law(model, margin);
    ASSERT_TRUE(law.is_known());
    Work work{.budget = testing::kNoBudget};
    const int k = random.below(static_cast<int>(search.contacts.size()));
    const int contact = search.contacts[k].contact;
    FlatState start = flat_state(model.scene.start);
    start.p_OF = {random.in(-0.045, 0.045), random.in(-0.014, 0.014)};
    FlatState at = start;
    double travelled = 0.0;
    for (int step = 0; step < pushes; ++step) {
      const auto move = random_sticking_move(search, k, at, random, work);
      if (!move || !sticks_as_checked(search, *move, margin, travelled)) continue;
      travelled += (move->to.p_OF - at.p_OF).norm();
      at = move->to;
      ++walks;
      EXPECT_FALSE(is_barred_from(law, model, contact, start.p_OF, at.p_OF)) << i;
      const std::array around = {random_goal_around(at.p_OF, random)};
      EXPECT_FALSE(is_barred(law, contact, model.pad_face, start.p_OF, around)) << i;
    }
    const Vec2 elsewhere{random.in(-0.05, -0.02), random.in(-0.05, 0.05)};
    barred += is_barred_from(law, model, contact, start.p_OF, elsewhere) ? 1 : 0;
  }
  EXPECT_GT(walks, scenes);
  EXPECT_GT(barred, scenes / 50);
}

TEST(CornerBars, NoSequenceOfStickingPushesCrossesOne) { attack(60, 20, 1); }

TEST(CornerBars, FullNoSequenceOfStickingPushesCrossesOne) { attack(4000, 40, 2); }

/// The contact on the face -x, which moves the finger axis towards that.
int wall_of(const Model& model) {
  const auto is_wall = [](const PushContact& contact) { return contact.n.x() > 0.99; };
  const auto wall = std::ranges::find_if(model.contacts, is_wall);
  EXPECT_NE(wall, model.contacts.end());
  return static_cast<int>(wall - model.contacts.begin());
}

/// Out of the bar of a T into its stem, and back: the wall at the bar pushes one way.
TEST(CornerBars, AWallDoesNotPull) {
  Scene scene = published_tee(0);
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const LocalLaw law(model);
  const int wall = wall_of(model);
  const Vec2 bar(-0.035, 0.03), stem(0.03, 0.0);
  EXPECT_TRUE(is_barred_from(law, model, wall, bar, stem));
  EXPECT_FALSE(is_barred_from(law, model, wall, stem, Vec2(-0.035, 0.0)));
}

/// A bar has to leave all of the goal on its other side.
TEST(CornerBars, LargeGoalsAreNotBarred) {
  Scene scene = published_tee(0);
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const LocalLaw law(model);
  const Vec2 bar(-0.035, 0.03), stem(0.03, 0.0);
  for (int contact = 0; contact < static_cast<int>(model.contacts.size()); ++contact) {
    std::array goals = {GoalArc{.centre = stem}, GoalArc{.centre = bar}};
    EXPECT_FALSE(is_barred(law, contact, model.pad_face, bar, goals));
    goals[1] = {.centre = stem, .arc = bar - stem};
    EXPECT_FALSE(is_barred(law, contact, model.pad_face, bar, goals));
    goals[1] = {.centre = stem, .slack = {0.1, 0.1}};
    EXPECT_FALSE(is_barred(law, contact, model.pad_face, bar, goals));
  }
}

/// The middle of a goal may be off the object: what counts is which places of the object
/// are among its members.
TEST(CornerBars, GoalsMayReachBeyondTheObject) {
  Scene scene = published_tee(0);
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const LocalLaw law(model);
  const int wall = wall_of(model);
  const Vec2 bar(-0.035, 0.03), stem(0.03, 0.0);
  const auto goal_at = [](double x, double y) {
    return std::array{GoalArc{.centre = {x, y}, .slack = {2e-3, 2e-3}}};
  };
  for (const double y : {-0.01, 0.0, 0.01}) {
    EXPECT_FALSE(is_barred(law, wall, model.pad_face, stem, goal_at(-0.051, y)));
    EXPECT_FALSE(is_barred(law, wall, model.pad_face, bar, goal_at(-0.051, 0.03 + y)));
    EXPECT_TRUE(is_barred(law, wall, model.pad_face, bar, goal_at(0.051, y)));
  }
}

/// Nor is anything on an object without reflex corners.
TEST(CornerBars, ConvexObjectsHaveNone) {
  const Model model = prepare(published_square(0));
  const LocalLaw law(model);
  for (int contact = 0; contact < static_cast<int>(model.contacts.size()); ++contact) {
    EXPECT_FALSE(is_barred_from(law, model, contact, Vec2(-0.03, 0.0), Vec2(0.03, 0.0)));
  }
}

}  // namespace
}  // namespace prehensile
