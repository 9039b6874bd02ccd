#include "planner/proofs/barrier.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mechanics/pad_law.h"
#include "planner/checks/exact_check.h"
#include "planner/geometry/level_set.h"
#include "planner/pads/clipped_law.h"
#include "planner/proofs/refuse.h"
#include "planner/steering/chain.h"
#include "planner/steering/goal.h"
#include "problems/random_fixtures.h"
#include "scene/constants.h"
#include "tests/planner/law_cases.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::convex_with_walls;
using testing::goal_at;
using testing::Random;
using testing::random_kappa;
using testing::slack_of_pads;
using testing::walled_square;

/// A goal on a way within the friction cone of the one wall left, but not for a wall that
/// has to lift the object as well.
Scene lift_by_one_wall() {
  Scene scene = walled_square();
  scene.pushers.resize(1);
  scene.start.X_HO = pose_from_finger({0.02, 0.0}, 0.0);
  scene.goal = goal_at({-0.01, -0.0252}, 0.3);
  return scene;
}

/// A problem with goals anywhere.
std::optional<Scene> random_problem(std::uint64_t index, Overhang overhang) {
  FixtureRange range;
  range.object = index % 2 == 0 ? FixtureObject::kBox : FixtureObject::kConvex;
  range.count = {1.0, 3.0};
  range.goals = GoalsFrom::kRandom;
  auto problem = random_fixture(range, 11, index);
  if (!problem) return std::nullopt;
  problem->scene.overhang = overhang;
  return problem->scene;
}

TEST(Barrier, RefusesWhatNoPushReaches) {
  const Scene scene = lift_by_one_wall();
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  EXPECT_EQ(plan.status, PlanStatus::kInfeasible);
  ASSERT_EQ(plan.proof.kind, Proof::Kind::kBarrier);
  EXPECT_EQ(plan.message, plan.proof.text);
  EXPECT_TRUE(plan.pushes.empty());
  std::string why;
  EXPECT_TRUE(verify(model, plan.proof, &why)) << why;
}

/// What a barrier says depends on start, goal, contacts and gravity.
TEST(Barrier, HoldsForItsProblemOnly) {
  const Scene scene = lift_by_one_wall();
  const Loops region = find_barrier(prepare(scene));
  ASSERT_FALSE(region.empty());
  const auto refused = [&](const Scene& other) {
    std::string why;
    const bool holds = verify_barrier(prepare(other), region, &why);
    EXPECT_NE(holds, !why.empty());
    return !holds;
  };
  EXPECT_FALSE(refused(scene));
  Scene other = scene;
  other.start.X_HO = pose_from_finger({-0.01, -0.0252}, 0.0);
  EXPECT_TRUE(refused(other));
  other = scene;
  other.goal = goal_at({0.02, 0.001}, 0.0);
  EXPECT_TRUE(refused(other));
  other = scene;
  other.goal->y.reset();
  EXPECT_TRUE(refused(other));
  other = scene;
  other.pushers = walled_square().pushers;
  EXPECT_TRUE(refused(other));
  other = scene;
  other.g_W = -scene.g_W;
  EXPECT_TRUE(refused(other));
  other = scene;
  other.overhang = Overhang::kClip;
  EXPECT_TRUE(refused(other));
}

/// Tolerances of each coordinate leave a square, whose corners are farther off than its
/// sides: what comes no nearer than these is outside.
TEST(Barrier, KnowsHowFarTheTolerancesOfAGoalReach) {
  Scene scene = walled_square();
  scene.start.X_HO = pose_from_finger({-0.02, 0.0}, 0.0);
  scene.goal = goal_at({0.0, 0.0}, 0.0);
  scene.goal->test = GoalTest::kPerCoordinate;
  scene.goal->angle_tolerance = 1e-3;
  const double tolerance = scene.goal->position_tolerance;
  const Model model = prepare(scene);
  const auto holds_goal = [&](const Vec2& normal, double distance) {
    const Vec2 along = perp(normal), at = -distance * normal;
    const Loops region = {{at - 0.1 * along, at + 0.1 * along,
                           at + 0.1 * along - 0.1 * normal,
                           at - 0.1 * along - 0.1 * normal}};
    std::string why;
    EXPECT_FALSE(verify_barrier(model, region, &why));
    return why == "a pose of the goal is in the region";
  };
  EXPECT_FALSE(holds_goal({1.0, 0.0}, 1.05 * tolerance));
  EXPECT_TRUE(holds_goal({1.0, 0.0}, 0.95 * tolerance));
  const Vec2 diagonal = Vec2(1.0, 1.0).normalized();
  EXPECT_FALSE(holds_goal(diagonal, 1.48 * tolerance));
  EXPECT_TRUE(holds_goal(diagonal, 1.35 * tolerance));
}

/// Borders that have to turn with what sticks: neither straight lines nor levels on a
/// grid are any.
TEST(Barrier, FollowsWhatSticks) {
  for (const Scene& scene : {convex_with_walls(1, 53), convex_with_walls(2, 48)}) {
    const Model model = prepare(scene);
    const Loops region = find_barrier(model);
    ASSERT_FALSE(region.empty()) << scene.name;
    std::string why;
    EXPECT_TRUE(verify_barrier(model, region, &why)) << why;
  }
}

TEST(Barrier, RefusesRegionsThatAreNone) {
  const Model model = prepare(lift_by_one_wall());
  const Loops region = find_barrier(model);
  ASSERT_EQ(region.size(), 1u);
  const auto refused = [&](const Loops& other) {
    return !verify_barrier(model, other, nullptr);
  };
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused({{}}));
  EXPECT_TRUE(refused({region[0], region[0]}));
  Loops other = region;
  other[0].resize(2);
  EXPECT_TRUE(refused(other));
  other = region;
  other[0][1].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused(other));
  other = region;
  std::swap(other[0][0], other[0][1]);
  EXPECT_TRUE(refused(other));
  other = region;
  for (Vec2& vertex : other[0]) vertex *= 100.0;  // the goal is in it, too
  EXPECT_TRUE(refused(other));
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  other = {
      {start + Vec2(-1e-3, -1e-3), start + Vec2(1e-3, -1e-3), start + Vec2(0, 1e-3)}};
  EXPECT_TRUE(refused(other));  // its border can be crossed
  const std::vector<Vec2> many(3000, start);
  EXPECT_TRUE(refused({many}));
}

/// Problems that have a plan have no barrier, wherever it is said to be.
TEST(Barrier, FeasibleProblemsHaveNone) {
  Random random(5);
  for (int i = 0; i < 40; ++i) {
    RandomRegrasp regrasp = random_regrasp(static_cast<RegraspFamily>(i % 2), 7, i);
    if (regrasp.scene.overhang != Overhang::kIgnore) continue;
    const Model model = prepare(regrasp.scene);
    EXPECT_TRUE(find_barrier(model).empty()) << i;
    const Vec2 start = finger_in_object(model.scene.start.X_HO);
    for (int k = 0; k < 20; ++k) {
      std::vector<Vec2> invented;
      invented.reserve(8);
      const double size = random.log_in(1e-3, 0.1);
      for (int v = 0; v < 8; ++v) {
        invented.push_back(start +
                           rotated(0.25 * kPi * v, Vec2(size * random.in(0.5, 1), 0)));
      }
      EXPECT_FALSE(verify_barrier(model, {invented}, nullptr)) << i;
    }
  }
}

/// Points push discs that the face clips to goals where pushes by points ended.
void expect_no_barrier_before_points(int problems) {
  FixtureRange range;
  range.pushers = FixturePushers::kPoints;
  range.count = {1.0, 3.0};
  int clipped = 0;
  for (int i = 0; i < problems; ++i) {
    range.object = i % 2 == 0 ? FixtureObject::kConcave : FixtureObject::kBox;
    const auto problem = random_fixture(range, 12, i);
    ASSERT_TRUE(problem);
    const Model model = prepare(problem->scene);
    if (!has_clipped_law(model)) continue;
    ++clipped;
    EXPECT_TRUE(find_barrier(model).empty()) << i;
  }
  EXPECT_GT(clipped, problems / 2);
}

TEST(Barrier, FeasibleProblemsOfPointsHaveNone) { expect_no_barrier_before_points(8); }

TEST(Barrier, FullFeasibleProblemsOfPointsHaveNone) {
  expect_no_barrier_before_points(150);
}

/// Over F: a fall that leaves more than this is none that a check may count on.
constexpr double kBarelyFalls = 0.01;

/// By how much the grasp holds gravity, the pads as the face leaves them.
double slack_of_gravity(const Model& model, const PlanarPose& X_HO, const Vec2& g_O) {
  if (has_round_pads(model)) {
    return holding_slack(model, finger_in_object(X_HO), g_O, Margin::none());
  }
  return gravity_slack_by_pad_law(model, grasp_at(model, X_HO, g_O));
}

/// Tries to cross a proved border at random places, by the pads themselves.
int crossings(const Model& model, const Loops& region, int tries, Random& random) {
  int crossed = 0;
  for (int i = 0; i < tries; ++i) {
    const auto& loop = region[random.below(static_cast<int>(region.size()))];
    const int v = random.below(static_cast<int>(loop.size()));
    const Vec2& a = loop[v];
    const Vec2& b = loop[(v + 1) % loop.size()];
    const Vec2 p_OF = a + random.in(0.0, 1.0) * (b - a);
    if (!contains(model.pad_face, p_OF)) continue;
    Vec2 out = perp((a - b).normalized());
    if (is_between(region, p_OF + 1e-7 * out)) out = -out;
    const Vec2 d = rotated(random.in(-0.5, 0.5) * kPi, out);
    const PushContact& contact =
        model.contacts[random.below(static_cast<int>(model.contacts.size()))];
    const PlanarPose X_HO = pose_from_finger(p_OF, random.in(-kPi, kPi));
    if (slack_of_gravity(model, X_HO, contact.g_O) < -kBarelyFalls) continue;
    const double kappa = random_kappa(random);
    const double advance =
        std::max(contact.n.dot(-d + kappa / model.c * perp(contact.a - p_OF)),
                 contact.n.dot(-d + kappa / model.c * perp(contact.b - p_OF)));
    if (advance < 0.0) continue;
    if (slack_of_pads(model, contact, X_HO, -d, kappa) >= 0.0) ++crossed;
  }
  return crossed;
}

/// As a plan has to: of pads that change at close places.
bool sticks_all_along(const SearchModel& search, const Move& move, Work& work) {
  const Model& model = *search.model;
  if (has_round_pads(model)) {
    return move_sticks(search, move.contact, move.from, move.to, work);
  }
  return move_holds(search, move, work) &&
         push_slack(model, grasp_of(move.from, 0.0), push_of(search, move),
                    Margin::none()) >= 0.0;
}

/// Pads that are alike everywhere propose what sticks, others have no closed form.
KappaSet proposed(const Model& model, const StickContact& contact, const Vec2& p_OF,
                  const Vec2& e, Random& random) {
  if (has_round_pads(model)) return sticking_kappas(contact, p_OF, e);
  KappaSet set;
  set.count = 1;
  const double kappa = random_kappa(random);
  set.intervals[0] = {kappa, kappa};
  return set;
}

/// Random plans by hand: pushes in random directions, as far as they stick. Whether one
/// carries the finger axis out of the region.
bool escapes(const Model& model, const Loops& region, int pushes, Random& random) {
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = testing::kNoBudget};
  FlatState at{finger_in_object(model.scene.start.X_HO), model.scene.start.X_HO.theta};
  for (int i = 0; i < pushes; ++i) {
    const int k = random.below(static_cast<int>(search.contacts.size()));
    const double lean = std::atan(search.contacts[k].stick.mu);
    const Vec2 e = random.chance(0.7)
                       ? rotated(random.in(-lean, lean), search.contacts[k].stick.n)
                       : random.direction();
    const KappaSet kappas = proposed(model, search.contacts[k].stick, at.p_OF, e, random);
    if (kappas.empty()) continue;
    const auto& interval = kappas.intervals[random.below(kappas.count)];
    const double low = std::max(interval.lo, -30.0);
    const double high = std::min(interval.hi, 30.0);
    if (low > high) continue;
    const double travel = random.log_in(1e-4, 0.05);
    const double turn = random.in(low, high) * travel / model.c;
    const FlatState to{at.p_OF - travel * e, at.theta + turn};
    if (!sticks_all_along(search, {k, at, to}, work)) continue;
    at = to;
    if (!is_between(region, at.p_OF)) return true;
  }
  return false;
}

struct Attack {
  int problems, tries, walks;
};

void attack(Overhang overhang, const Attack& size, std::string_view pads = "") {
  const auto [problems, tries, walks] = size;
  Random random(3);
  int proved = 0;
  for (int i = 0; i < problems; ++i) {
    auto scene = random_problem(i, overhang);
    if (!scene) continue;
    if (!pads.empty()) scene = with_pads(*scene, *pad_of_shape(pads));
    const Model model = prepare(*scene);
    const Loops region = find_barrier(model);
    if (region.empty()) continue;
    ++proved;
    EXPECT_EQ(crossings(model, region, tries, random), 0) << i;
    for (int k = 0; k < walks; ++k) {
      EXPECT_FALSE(escapes(model, region, 200, random)) << i;
    }
  }
  const bool are_discs = pads.empty();
  const int one_of = !are_discs ? 16 : overhang == Overhang::kClip ? 10 : 6;
  EXPECT_GT(proved, problems / one_of);
}

TEST(Barrier, NothingCrossesIt) { attack(Overhang::kIgnore, {40, 2000, 20}); }

TEST(Barrier, NothingCrossesThatOfPadsOfOtherShapes) {
  for (const auto pads : {"1:2", "line", "half_disc"}) {
    attack(Overhang::kIgnore, {24, 1000, 2}, pads);
  }
}

TEST(Barrier, FullNothingCrossesThatOfPadsOfOtherShapes) {
  for (const auto pads : kPadShapes) attack(Overhang::kIgnore, {300, 5000, 20}, pads);
}

TEST(Barrier, NothingCrossesItWhereTheFaceClips) {
  attack(Overhang::kClip, {24, 1000, 10});
}

TEST(Barrier, FullNothingCrossesIt) { attack(Overhang::kIgnore, {2000, 20'000, 100}); }

TEST(Barrier, FullNothingCrossesItWhereTheFaceClips) {
  attack(Overhang::kClip, {400, 10'000, 50});
}

}  // namespace
}  // namespace prehensile
