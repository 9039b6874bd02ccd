#include "planner/wound_search.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "mechanics/sticking.h"
#include "planner/goal.h"
#include "planner/planner.h"
#include "tests/planner/walled_scene.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::kUnlimited;
using testing::Random;
using testing::scene_with;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// The end of a straight push of the only wall that winds the object up, as it must by
/// more than the nearest whole turns; none where the draw gives no such push.
std::optional<FlatState> wound_up(const SearchModel& search, const FlatState& from,
                                  Random& random) {
  const Vec2 to = random.in_box(0.045, 0.045);
  const double length = (to - from.p_OF).norm();
  const Vec2 e = (from.p_OF - to) / length;
  const KappaSet kappas = sticking_kappas(search.contacts[0].stick, from.p_OF, e);
  if (kappas.empty()) return std::nullopt;
  const auto& [lo, hi] = kappas.intervals[0];
  const double kappa = std::clamp(random.in(lo, hi), -60.0, 60.0);
  const double turn = kappa * length / search.model->c;
  for (const double less : {-kTurn, 0.0, kTurn}) {
    const double kappa_of_less = (wrapped(turn) + less) * search.model->c / length;
    if (kappas.contains(kappa_of_less)) return std::nullopt;
  }
  const FlatState end{to, from.theta + turn};
  Work work{.budget = kUnlimited};
  if (std::abs(turn) > 13.0 * kTurn || !move_sticks(search, 0, from, end, work)) {
    return std::nullopt;
  }
  return end;
}

/// Far from its middle a face turns the object much or not at all.
TEST(WoundSearch, GoalsOfManyTurnsTakeFewPushesAndLittleWork) {
  Random random(1);
  for (int goals = 0; goals < 40;) {
    Scene scene = scene_with(DiscPad{0.009}, LineFeature{});
    scene.g_W.setZero();
    scene.pushers.resize(1);
    scene.start.X_HO =
        pose_from_finger(random.in_box(0.045, 0.045), random.in(-3.0, 3.0));
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    const auto end = wound_up(search, flat_state(scene.start), random);
    if (!end) continue;
    ++goals;
    const PlanarPose there = grasp_of(*end, 0.0).X_HO;
    scene.goal = Goal{.x = there.x, .y = there.y, .theta = wrapped(there.theta)};
    PlanOptions options;
    options.margin = Margin::none();
    options.budget = 20'000;
    const Plan plan = plan_regrasp(prepare(scene), options);
    ASSERT_TRUE(plan.usable()) << goals << ": " << plan.message;
    EXPECT_LE(plan.pushes.size(), 2u) << goals;
  }
}

}  // namespace
}  // namespace prehensile
