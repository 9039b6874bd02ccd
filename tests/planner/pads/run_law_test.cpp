#include "planner/pads/run_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scene/constants.h"
#include "tests/planner/law_cases.h"

namespace prehensile {
namespace {

using testing::advance_of;
using testing::Random;
using testing::random_kappa;
using testing::random_law_scene;
using testing::random_margin;
using testing::robust_slack_of_pads;
using testing::slack_of_pads;

struct Tally {
  int sticking = 0, edges_near = 0, ends_near = 0, turns_near = 0;
};

/// What the laws of a contact hold for.
struct Promised {
  Margin margin = Margin::none();
  Vec2 begin = Vec2::Zero();  ///< of the plan [m]
};

/// Whether the instant sticks with the pads themselves, within the margin.
bool sticks(const Model& model, const PushContact& contact, const PlanarPose& X_HO,
            const Vec2& e, double kappa, const Promised& promised, Random& random) {
  if (!(slack_of_pads(model, contact, X_HO, e, kappa) >= 0.0)) return false;
  if (promised.margin.is_none()) return true;
  const double travelled = random.chance(0.5) ? random.in(0.0, 0.03) : 0.0;
  const Vec2 push_begin = finger_in_object(X_HO) + travelled * e;
  const double before = (push_begin - promised.begin).norm() * random.in(1.0, 1.5);
  return robust_slack_of_pads(model, contact, X_HO, e, kappa,
                              {promised.begin, before, travelled},
                              promised.margin) >= 0.0;
}

/// One instant that sticks with the pads themselves obeys the law.
void check_instant(const Model& model, const RunLaws& laws, const Promised& promised,
                   Random& random, Tally& tally) {
  const int j = random.below(static_cast<int>(model.contacts.size()));
  const PushContact& contact = model.contacts[j];
  const RunLaw& law = laws.contacts[j];
  const double lean = std::atan(contact.mu) + random.in(-0.3, 0.3);
  const Vec2 e = random.chance(0.5)
                     ? rotated(random.chance(0.5) ? lean : -lean, contact.n)
                     : rotated(random.in(-kPi, kPi), Vec2(1.0, 0.0));
  const double kappa = random_kappa(random);
  const Vec2 p_OF = random.in_box(0.05, 0.05);
  const PlanarPose X_HO = pose_from_finger(p_OF, random.in(-kPi, kPi));
  if (!sticks(model, contact, X_HO, e, kappa, promised, random)) return;
  ++tally.sticking;
  const double dT = std::hypot(1.0, kappa);
  for (int k = 0; k < 2; ++k) {
    const double spare = law.w[k].dot(e) + law.back[k] * dT;
    EXPECT_GE(spare, -1e-9) << kappa;
    if (spare < 0.05 * dT) ++tally.edges_near;
  }
  const Vec2 dp = -e;
  double least = std::numeric_limits<double>::infinity();
  for (int set = 0; set < RunLaw::kSets; ++set) {
    const double turned = laws.C[set] * kappa / model.c;
    const auto slack = [&](const EndLaw& end) {
      return (end.per_travel + end.slope * (p_OF - end.place).norm()) * dT + end.per_path;
    };
    const EndLaw& low = law.end[set][0];
    const EndLaw& high = law.end[set][1];
    const double above = turned - cross(p_OF - low.place, dp) + slack(low);
    const double below = cross(p_OF - high.place, dp) + slack(high) - turned;
    EXPECT_GE(above, -1e-9) << kappa;
    EXPECT_GE(below, -1e-9) << kappa;
    least = std::min({least, above, below});
  }
  if (least < 3e-3 * dT) ++tally.ends_near;
  const Margin margin = margin_of_laws(model, contact, promised.margin);
  if (advance_of(contact, p_OF, e, kappa / model.c, margin) < 0.0) return;
  const double at = law.t.dot(p_OF);
  for (const double turn : {kappa / model.c, -kappa / model.c}) {
    const double beside = turn == kappa / model.c ? law.face[0] - at : at - law.face[1];
    if (beside <= 0.0) continue;
    const double spare = law.n.dot(e) + law.retreat() * dT - turn * beside;
    EXPECT_GE(spare, -1e-9) << kappa;
    if (spare < 0.1 * dT) ++tally.turns_near;
  }
}

void check_instants(int scenes, int instants, std::uint64_t seed) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < scenes; ++i) {
    const Scene scene = random_law_scene(random);
    const Model model = prepare(scene, {.points_per_pad = random.chance(0.7) ? 16 : 64});
    Promised promised;
    if (random.chance(0.6)) {
      promised.margin = random_margin(random);
      promised.begin = random.in_box(0.05, 0.05);
    }
    const RunLaws laws = run_laws(model, promised.margin, promised.begin);
    ASSERT_FALSE(laws.empty());
    for (int k = 0; k < instants; ++k) {
      check_instant(model, laws, promised, random, tally);
    }
  }
  EXPECT_GT(tally.sticking, scenes * instants / 20);
  EXPECT_GT(tally.edges_near, tally.sticking / 100);
  EXPECT_GT(tally.ends_near, tally.sticking / 1000);
  EXPECT_GT(tally.turns_near, tally.sticking / 10'000);
}

TEST(RunLaws, HoldAtEveryInstantThatSticks) { check_instants(100, 4000, 2); }

TEST(RunLaws, FullHoldAtEveryInstantThatSticks) { check_instants(2000, 20'000, 3); }

/// Gravity along a wall that is greater than all friction: no motion by it sticks.
TEST(RunLaws, OfAContactThatGravityOverpowersAllowNothing) {
  Scene scene = published_square(0);
  scene.gripper.grip_force = 0.5;
  scene.g_W = {0.0, -9.81};
  const Model model = prepare(scene);
  const RunLaws laws = run_laws(model);
  int overpowered = 0;
  for (const RunLaw& law : laws.contacts) {
    for (const auto& set : law.end) {
      for (const EndLaw& end : set) {
        EXPECT_TRUE(end.place.allFinite());
        EXPECT_TRUE(std::isfinite(end.per_travel + end.slope + end.per_path));
      }
    }
    const bool nothing =
        law.back[0] == -law.w[0].norm() && law.back[1] == -law.w[1].norm();
    overpowered += nothing ? 1 : 0;
  }
  EXPECT_GT(overpowered, 0);
}

TEST(RunLaws, AreNotMadeForPadsThatChange) {
  Scene scene = published_square(0);
  scene.overhang = Overhang::kClip;
  EXPECT_TRUE(run_laws(prepare(scene)).empty());
  scene.overhang = Overhang::kIgnore;
  scene.gripper.pad = RectanglePad{{0.02, 0.01}};
  EXPECT_TRUE(run_laws(prepare(scene)).empty());
}

}  // namespace
}  // namespace prehensile
