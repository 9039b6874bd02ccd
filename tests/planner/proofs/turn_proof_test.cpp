#include "planner/proofs/turn_proof.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "optimisation/nonlinear_program.h"
#include "planner/geometry/level_set.h"
#include "planner/planner.h"
#include "problems/random_fixtures.h"
#include "scene/constants.h"
#include "scene/outline.h"
#include "tests/planner/law_cases.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::advance_of;
using testing::goal_at;
using testing::Random;
using testing::random_kappa;
using testing::slack_of_pads;

FixtureRange few_pushers(std::uint64_t index) {
  FixtureRange range;
  range.object = index % 2 == 0 ? FixtureObject::kBox : FixtureObject::kConvex;
  range.pushers = index % 3 == 0 ? FixturePushers::kPoints : FixturePushers::kLines;
  range.count = {1.0, 2.0};
  return range;
}

/// A problem whose goal is on the way to a place that pushes reach, at any angle.
std::optional<Scene> random_problem(std::uint64_t index) {
  auto problem = random_fixture(few_pushers(index), 19, index);
  if (!problem) return std::nullopt;
  Scene& scene = problem->scene;
  Random random(index);
  const Goal& far = *scene.goal;
  const Vec2 start = finger_in_object(scene.start.X_HO);
  const Vec2 way = finger_in_object({*far.x, *far.y, *far.theta}) - start;
  const Vec2 place = start + random.in(0.05, 0.3) * way;
  scene.goal = goal_at(place, scene.start.X_HO.theta + random.in(0.5, 5.8));
  if (index % 4 < 2) scene.overhang = Overhang::kIgnore;
  return scene;
}

/// One of those that have a proof.
constexpr std::uint64_t kProved = 9;

/// Its kind is kNone if there is none.
Proof turn_of(const Model& model) {
  Proof proof{.kind = Proof::Kind::kTurn};
  return find_turn(model, proof, {}) ? proof : Proof{};
}

class Turn : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!ipopt_is_built()) GTEST_SKIP() << "built without Ipopt";
  }
};

TEST_F(Turn, RefusesAnAngleThatNoWayMakes) {
  const Model model = prepare(*random_problem(kProved));
  const Plan plan = plan_regrasp(model);
  EXPECT_EQ(plan.status, PlanStatus::kInfeasible);
  ASSERT_EQ(plan.proof.kind, Proof::Kind::kTurn);
  std::string why;
  EXPECT_TRUE(verify(model, plan.proof, &why)) << why;
}

/// What a proof says depends on start, goal and contacts, and on its own bounds.
TEST_F(Turn, HoldsForItsProblemOnly) {
  const Scene scene = *random_problem(kProved);
  const Proof proof = turn_of(prepare(scene));
  ASSERT_TRUE(proof.turn);
  const auto is_refused = [](const Scene& other, const Proof& claimed) {
    std::string why;
    const bool holds = verify(prepare(other), claimed, &why);
    EXPECT_NE(holds, !why.empty());
    return !holds;
  };
  EXPECT_FALSE(is_refused(scene, proof));
  const Model model = prepare(scene);
  const double theta = scene.start.X_HO.theta;
  const Vec2 place =
      finger_in_object({*scene.goal->x, *scene.goal->y, *scene.goal->theta});
  const Vec2 way = place - finger_in_object(scene.start.X_HO);
  const double allowed =
      0.5 * (proof.turn->most.along(way) + proof.turn->least.along(way)) / model.c;
  Scene other = scene;
  other.goal = goal_at(place, theta + allowed);
  EXPECT_TRUE(is_refused(other, proof)) << "an angle within the bounds";
  other = scene;
  other.goal->angle_tolerance = kPi;
  EXPECT_TRUE(is_refused(other, proof)) << "any angle";
  other = scene;
  other.goal->theta.reset();
  EXPECT_TRUE(is_refused(other, proof)) << "no angle";
  other = scene;
  for (auto& pusher : other.pushers) pusher.friction = 2.0;
  EXPECT_TRUE(is_refused(other, proof)) << "more friction";
  other = scene;
  other.start.X_HO = pose_from_finger(finger_in_object(scene.start.X_HO), 1.0);
  other.goal = goal_at(place, *scene.goal->theta + 1.0 - theta);
  EXPECT_FALSE(is_refused(other, proof)) << "all turned alike";
}

TEST_F(Turn, RefusesBoundsThatAreNone) {
  const Scene scene = *random_problem(kProved);
  const Model model = prepare(scene);
  const Proof proof = turn_of(model);
  ASSERT_TRUE(proof.turn);
  const auto why_not = [&](const Proof& claimed) {
    std::string why;
    EXPECT_FALSE(verify(model, claimed, &why));
    return why;
  };
  Proof broken = proof;
  broken.turn.reset();
  EXPECT_EQ(why_not(broken), "there are no bounds on the turn");
  broken = proof;
  broken.turn->most.bend[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(why_not(broken), "a bound on the turn is not finite");
  broken = proof;
  broken.turn->most = broken.turn->least = {};
  EXPECT_EQ(why_not(broken), "a push may turn the object by more, or by less");
  broken = proof;
  broken.region.clear();
  broken.turn->beyond.clear();
  EXPECT_EQ(why_not(broken), "a push may turn the object by more, or by less");
  if (!proof.region.empty()) {
    broken = proof;
    for (auto& vertex : broken.region.front()) vertex *= 0.5;
    EXPECT_FALSE(why_not(broken).empty());
  }
}

/// What the start reaches holds no more than a corner of the goal's square: the regions
/// have to follow it closely, and bounds that a few places suggest are mended where their
/// check breaks them.
TEST_F(Turn, RefusesACornerThatTurnsOtherwise) {
  for (const Scene& scene :
       {testing::convex_with_walls(1, 43), testing::convex_with_walls(3, 20)}) {
    const Model model = prepare(scene);
    const Proof proof = turn_of(model);
    ASSERT_TRUE(proof.turn) << scene.name;
    std::string why;
    EXPECT_TRUE(verify(model, proof, &why)) << why;
    Proof wrong = proof;
    wrong.turn->most.at_start *= 0.98;
    wrong.turn->least.at_start *= 0.98;
    TurnBreaks breaks;
    EXPECT_FALSE(verify_turn(model, wrong, &why, &breaks));
    EXPECT_FALSE(breaks.pushes.empty() && breaks.ends.empty());
    for (const TurnBreaks::Push& push : breaks.pushes) {
      const Vec2 way = push.place - finger_in_object(scene.start.X_HO);
      const double allowed = 1e-3 * (1.0 + std::abs(push.most) + std::abs(push.least));
      const Vec2& direction = push.directions.middle;
      EXPECT_TRUE(push.most > wrong.turn->most.at(way).dot(direction) - allowed ||
                  push.least < wrong.turn->least.at(way).dot(direction) + allowed);
    }
  }
}

/// Goals that pushes made.
void expect_none_before_goals_of_pushes(int problems) {
  int looked_at = 0;
  for (int i = 0; i < problems; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    const auto problem = random_fixture(few_pushers(index), 23, index);
    if (!problem) continue;
    for (const Overhang overhang : {Overhang::kIgnore, Overhang::kClip}) {
      Scene scene = problem->scene;
      scene.overhang = overhang;
      if (overhang == Overhang::kIgnore && i % 8 != 0) continue;
      ++looked_at;
      EXPECT_EQ(turn_of(prepare(scene)).kind, Proof::Kind::kNone) << i;
    }
  }
  EXPECT_GT(looked_at, problems / 2);
}

TEST_F(Turn, FeasibleProblemsHaveNone) { expect_none_before_goals_of_pushes(6); }

TEST_F(Turn, FullFeasibleProblemsHaveNone) { expect_none_before_goals_of_pushes(300); }

/// Random instants between the regions keep within the bounds if they stick with the pads
/// themselves, and another planner finds no way.
void attack(int problems, int instants, int least_proofs) {
  int proofs = 0;
  int stuck = 0;
  for (int i = 0; i < problems; ++i) {
    const auto scene = random_problem(static_cast<std::uint64_t>(i));
    if (!scene) continue;
    const Model model = prepare(*scene);
    const Proof proof = turn_of(model);
    if (!proof.turn) continue;
    ++proofs;
    PlanOptions other;
    other.planner = "two-trees";
    other.margin = Margin::none();
    other.prove = false;
    other.budget = 300'000;
    EXPECT_FALSE(plan_regrasp(model, other).usable()) << i;
    Random random(static_cast<std::uint64_t>(i));
    const Vec2 start = finger_in_object(scene->start.X_HO);
    for (int k = 0; k < instants; ++k) {
      const Vec2 p_OF = start + random.in_box(0.03, 0.03);
      if (!contains(model.pad_face, p_OF)) continue;
      if (!proof.region.empty() && !is_between(proof.region, p_OF)) continue;
      if (is_between(proof.turn->beyond, p_OF)) continue;
      const int j = random.below(static_cast<int>(model.contacts.size()));
      const PushContact& contact = model.contacts[j];
      const Vec2 e = random.direction();
      const double kappa = random_kappa(random);
      if (advance_of(contact, p_OF, e, kappa / model.c) < 0.0) continue;
      const PlanarPose X_HO = pose_from_finger(p_OF, random.in(-kPi, kPi));
      if (!(slack_of_pads(model, contact, X_HO, e, kappa) >= 0.0)) continue;
      ++stuck;
      const Vec2 way = p_OF - start;
      EXPECT_LE(kappa, proof.turn->most.at(way).dot(-e)) << i;
      EXPECT_GE(kappa, proof.turn->least.at(way).dot(-e)) << i;
    }
  }
  EXPECT_GE(proofs, least_proofs);
  EXPECT_GT(stuck, 5 * proofs);
}

TEST_F(Turn, NoInstantBreaksIt) { attack(10, 40'000, 2); }

TEST_F(Turn, FullNoInstantBreaksIt) { attack(400, 200'000, 20); }

}  // namespace
}  // namespace prehensile
