#include "planner/walks/walk_rows.h"

#include <cmath>

#include <gtest/gtest.h>

#include "problems/published_regrasps.h"
#include "scene/constants.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

/// A box between walls against two faces at a right angle, without gravity: each pushes
/// within its friction cone, as the friction of soft points lies along the motion.
Scene box_between_two_walls(double mu) {
  const FixtureRange range{.object = FixtureObject::kBox,
                           .pusher_friction = {mu, mu},
                           .count = {2.0, 2.0},
                           .weightless = 1.0};
  for (std::uint64_t index = 0;; ++index) {
    Scene scene = random_fixture(range, 1, index)->scene;
    const Model model = prepare(scene);
    if (std::abs(model.contacts[0].n.dot(model.contacts[1].n)) > 1e-6) continue;
    return with_soft_points(scene);
  }
}

std::vector<Rows> rows_in(const Scene& scene, double gap_spacings) {
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin::none());
  const FlatState start = flat_state(scene.start);
  const WalkLattice lattice(search, start, goal_places(model, *scene.goal, start), {8},
                            Steepness::kUsual);
  Work work{.budget = testing::kNoBudget};
  const WalkGap gap{gap_spacings, Vec2(-0.002, 0.001), Vec2(0.003, 0.002)};
  return rows_across(lattice, {{gap}}, work);
}

/// Headings within atan(mu) of two normals at a right angle take up 2 atan(mu) + 90
/// degrees, and what that is beyond half a turn is the width of the way.
TEST(RowsAcross, LieWhereTwoFrictionConesLeaveLittleMoreThanHalfATurn) {
  for (const double mu : {1.04, 1.1, 1.2}) {
    const Scene scene = box_between_two_walls(mu);
    const Model model = prepare(scene);
    const std::vector<Rows> rows = rows_in(scene, 5.0);
    ASSERT_EQ(rows.size(), 1) << mu;
    const Vec2 middle = (model.contacts[0].n + model.contacts[1].n).normalized();
    EXPECT_NEAR(rows[0].place({1.0, 0.0}).dot(middle), 0.0, 0.01) << mu;
    const double width = 2.0 * std::atan(mu) - 0.5 * kPi;
    EXPECT_NEAR(1.0 / rows[0].closer, width, 0.01) << mu;
    EXPECT_LT(1.0 / rows[0].closer, width) << mu;
  }
}

/// None where the cones leave more than half a turn out, where they leave much less, and
/// where walks leave no gap.
TEST(RowsAcross, AreNoneWhereNoWayIsNarrow) {
  EXPECT_TRUE(rows_in(box_between_two_walls(0.9), 5.0).empty());
  EXPECT_TRUE(rows_in(box_between_two_walls(2.0), 5.0).empty());
  EXPECT_TRUE(rows_in(box_between_two_walls(1.1), 0.0).empty());
}

}  // namespace
}  // namespace prehensile
