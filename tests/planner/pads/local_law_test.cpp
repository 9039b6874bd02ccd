#include "planner/pads/local_law.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "scene/constants.h"
#include "tests/planner/law_cases.h"

namespace prehensile {
namespace {

using testing::advance_of;
using testing::PlannedInstant;
using testing::Random;
using testing::random_kappa;
using testing::random_law_scene;
using testing::random_margin;
using testing::random_shape_scene;
using testing::robust_slack_of_pads;
using testing::slack_of_pads;

/// Places around p, of some length in any direction.
PlaceSpan around(const Vec2& p, Random& random) {
  const Vec2 along = random.log_in(1e-6, 1e-2) * random.direction();
  const double share = random.in(0.0, 1.0);
  return {p - share * along, p + (1.0 - share) * along};
}

DirectionSpan around_direction(const Vec2& d, Random& random) {
  const double half = random.log_in(1e-6, 1.0);
  return {rotated(random.in(-half, half), d), half};
}

/// A rectangle that holds p.
std::array<Vec2, 4> corners_around(const Vec2& p, Random& random) {
  const Vec2 u = random.direction();
  const Vec2 size = {random.log_in(1e-6, 1e-2), random.log_in(1e-6, 1e-2)};
  const Vec2 low =
      p - random.in(0.0, 1.0) * size.x() * u - random.in(0.0, 1.0) * size.y() * perp(u);
  const Vec2 along = size.x() * u, across = size.y() * perp(u);
  return {low, low + along, low + along + across, low + across};
}

struct Tally {
  int sticking = 0, denied_nearby = 0, sharp = 0, bounded = 0;
};

/// Whether the instant sticks with the pads themselves, over the margin.
bool sticks(const Model& model, const PushContact& contact, const PlanarPose& X_HO,
            const Vec2& e, double kappa, const Margin& margin, Random& random) {
  if (!(slack_of_pads(model, contact, X_HO, e, kappa) >= 0.0)) return false;
  if (margin.is_none()) return true;
  const PlannedInstant at{.begin = finger_in_object(X_HO),
                          .travelled = random.in(0.0, 0.02)};
  return robust_slack_of_pads(model, contact, X_HO, e, kappa, at, margin) >= 0.0;
}

void check_instant(const Model& model, const LocalLaw& law, const Margin& margin,
                   Random& random, Tally& tally) {
  const int j = random.below(static_cast<int>(model.contacts.size()));
  const PushContact& contact = model.contacts[j];
  const double lean = std::atan(contact.mu) + random.in(-0.3, 0.3);
  const Vec2 e = random.chance(0.5)
                     ? rotated(random.chance(0.5) ? lean : -lean, contact.n)
                     : rotated(random.in(-kPi, kPi), Vec2(1.0, 0.0));
  const double kappa = random_kappa(random);
  const Vec2 p_OF = random.in_box(0.05, 0.05);
  const PlanarPose X_HO = pose_from_finger(p_OF, random.in(-kPi, kPi));
  if (advance_of(contact, p_OF, e, kappa / model.c) < 0.0) return;
  if (!sticks(model, contact, X_HO, e, kappa, margin, random)) return;
  ++tally.sticking;
  EXPECT_TRUE(law.may_move(j, {p_OF, p_OF}, {-e, 0.0})) << kappa;
  EXPECT_TRUE(law.may_move(j, around(p_OF, random), around_direction(-e, random)))
      << kappa;
  const double share = random.in(-0.95, 0.95);
  const double travel = std::hypot(1.0, kappa) - share * kappa;
  const std::array corners = corners_around(p_OF, random);
  const LeastTravel least =
      law.least_travel(j, corners, around_direction(-e, random), share);
  EXPECT_LE(least.cost, travel * (1.0 + 1e-9)) << kappa;
  const double sense = random.chance(0.5) ? 1.0 : -1.0;
  const double most = law.most_turn(j, corners, around_direction(-e, random), sense);
  EXPECT_GE(most, sense * kappa - 1e-9 * (1.0 + std::abs(kappa)));
  const std::array here = {p_OF};
  const double least_here = law.least_travel(j, here, {-e, 0.0}, share).cost;
  EXPECT_EQ(law.least_travel(j, here, {-e, 0.0}, share, least).cost, least_here);
  if (least_here > 0.95 * travel) ++tally.sharp;
  const double range =
      law.most_turn(j, here, {-e, 0.0}, 1.0) + law.most_turn(j, here, {-e, 0.0}, -1.0);
  if (range < 2.0 * (1.0 + std::abs(kappa))) ++tally.bounded;
  const DirectionSpan beside{rotated(random.in(-1.0, 1.0), -e), 0.01};
  if (!law.may_move(j, {p_OF, p_OF}, beside)) ++tally.denied_nearby;
}

/// `one_of`: the share of instants beside which the law has to deny.
void check_instants(int scenes, int instants, std::uint64_t seed,
                    Scene (*random_scene)(Random&) = random_law_scene, int one_of = 20) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < scenes; ++i) {
    const Scene scene = random_scene(random);
    const Model model = prepare(scene, {.points_per_pad = random.chance(0.7) ? 16 : 64});
    const Margin margin = random.chance(0.5) ? random_margin(random) : Margin::none();
    const LocalLaw law(model, margin);
    ASSERT_TRUE(law.is_known());
    for (int k = 0; k < instants; ++k) check_instant(model, law, margin, random, tally);
  }
  EXPECT_GT(tally.sticking, scenes * instants / 20);
  EXPECT_GT(tally.denied_nearby, tally.sticking / one_of);
  EXPECT_GT(tally.sharp, tally.sticking / 50);
  EXPECT_GT(tally.bounded, tally.sticking / 100);
}

TEST(LocalLaw, DeniesNoInstantThatSticks) { check_instants(60, 2000, 1); }

TEST(LocalLaw, FullDeniesNoInstantThatSticks) { check_instants(2000, 20'000, 2); }

TEST(LocalLaw, OfAnyShapeDeniesNoInstantThatSticks) {
  check_instants(60, 2000, 4, random_shape_scene, 30);
}

TEST(LocalLaw, FullOfAnyShapeDeniesNoInstantThatSticks) {
  check_instants(2000, 20'000, 5, random_shape_scene, 30);
}

/// Over soft points the law is exact: what it does not deny sticks for some rotation.
TEST(LocalLaw, OfSoftPointsAllowsWhatSticks) {
  Random random(3);
  int allowed = 0;
  int sticking = 0;
  for (int i = 0; i < 400; ++i) {
    const Scene scene = with_soft_points(random_law_scene(random));
    if (!std::holds_alternative<PointPad>(scene.gripper.pad)) continue;
    const Model model = prepare(scene);
    const LocalLaw law(model);
    const int j = random.below(static_cast<int>(model.contacts.size()));
    const Vec2 p_OF = random.in_box(0.05, 0.05);
    const Vec2 d = random.direction();
    const bool sticks =
        !sticking_kappas(stick_contact(model, model.contacts[j], 0.0), p_OF, -d).empty();
    const bool may = law.may_move(j, {p_OF, p_OF}, {d, 0.0});
    EXPECT_TRUE(may || !sticks);
    allowed += may ? 1 : 0;
    sticking += sticks ? 1 : 0;
  }
  EXPECT_GT(sticking, 50);
  EXPECT_LE(allowed, sticking + sticking / 20);
}

TEST(LocalLaw, IsNotKnownOfPadsThatChange) {
  Scene scene = published_square(0);
  scene.overhang = Overhang::kClip;
  EXPECT_FALSE(LocalLaw(prepare(scene)).is_known());
  scene.overhang = Overhang::kIgnore;
  EXPECT_TRUE(LocalLaw(prepare(scene)).is_known());
  scene.gripper.pad = RectanglePad{{0.02, 0.01}};
  EXPECT_TRUE(LocalLaw(prepare(scene)).is_known());
  scene.gripper.grip_force = 0.0;
  EXPECT_FALSE(LocalLaw(prepare(scene)).is_known());
}

/// Where discs that overhang elsewhere are whole their law is that of discs that count
/// whole everywhere.
TEST(LocalLaw, OfWholeDiscsKnowsNoOverhang) {
  Random random(8);
  int may = 0;
  for (int i = 0; i < 300; ++i) {
    Scene scene = published_square(random.below(50));
    const Model ignoring = prepare(scene);
    scene.overhang = Overhang::kClip;
    const Model clipping = prepare(scene);
    EXPECT_FALSE(LocalLaw(clipping).is_known());
    const LocalLaw law = LocalLaw::of_whole_discs(clipping);
    ASSERT_TRUE(law.is_known());
    const int k = random.below(static_cast<int>(clipping.contacts.size()));
    const PlaceSpan places = around(random.in_box(0.02, 0.02), random);
    const DirectionSpan directions = around_direction(random.direction(), random);
    const bool moves = law.may_move(k, places, directions);
    EXPECT_EQ(moves, LocalLaw(ignoring).may_move(k, places, directions));
    may += moves ? 1 : 0;
  }
  EXPECT_GT(may, 30);
}

}  // namespace
}  // namespace prehensile
