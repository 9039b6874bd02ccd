#include "primitives/grip_range.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "problems/random_pushes.h"

namespace prehensile {
namespace {

constexpr double kGravity = 9.81;

/// A square of 100 mm, gravity along -y of O: contact 0 is a wall at the face -x, contact
/// 1 a floor at -y.
Scene square_scene(double mass) {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  scene.object.mass = mass;
  scene.gripper.pad = DiscPad{0.02};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 40.0;
  scene.overhang = Overhang::kIgnore;
  scene.pushers.resize(2);
  scene.pushers[0] = {.name = "wall", .feature = LineFeature{}, .friction = 0.4};
  scene.pushers[1] = {.name = "floor", .feature = LineFeature{}, .friction = 0.5};
  scene.pushers[1].normal_angle = 0.5 * std::numbers::pi;
  return scene;
}

// Straight slide along a wall: the wall carries the weight by friction, m g <= mu_p 2 mu
// N, and the couple of the weight about the face by its two ends, which share 2 mu N:
// d m g <= L mu N with d from the face to the centre of mass (MECHANICS 8 A).
TEST(GripRange, StraightSlideOfTheClosedForm) {
  const double mass = 1.5;
  const Model model = prepare(square_scene(mass));
  const Slide slide{0, 0.0, {1.0, 0.0}, 0.004, 0.5};
  GripRangeOptions options;
  options.tolerance = 1e-9;
  const GripRange range = grip_range(model, {}, slide, options);
  ASSERT_TRUE(range.found) << range.reason;
  const double weight = mass * kGravity;
  const double by_friction = weight / (0.4 * 2.0 * 0.5);
  const double by_couple = 0.05 * weight / (0.1 * 0.5);
  const double least = std::max(by_friction, by_couple);
  EXPECT_NEAR(range.low.force, least, 2e-6 * least);
  EXPECT_TRUE(range.high.is_open);
  ASSERT_EQ(range.profile.size(), 21u);
  for (const GripSample& sample : range.profile) {
    EXPECT_NEAR(sample.stick_low, least, 1e-9 * least);
    EXPECT_EQ(sample.stick_high, std::numeric_limits<double>::infinity());
  }
  // Evidence at the end: inside it does what it should, beyond it slips.
  EXPECT_TRUE(range.low.inside.completed());
  EXPECT_LT(range.low.inside.slipped, 1e-9);
  EXPECT_LT(range.low.beyond, range.low.force);
  EXPECT_TRUE(!range.low.outside.completed() || range.low.strayed > options.tolerance);
  // Held by the finger axis through the centre of mass: friction alone, 2 mu N = m g.
  EXPECT_NEAR(range.hold_start, weight, 1e-6 * weight);
  EXPECT_GT(range.hold_end, range.hold_start);
  EXPECT_NEAR(range.hold_end, range.profile.back().hold, 1e-9 * weight);
}

// Pivot on a floor that the weight presses on: friction of the pads is a pure moment F c,
// which the two ends of the floor take as long as F c <= m g l, l half the face; and the
// pads hold the weight alone from F = m g on.
TEST(GripRange, PivotOfTheClosedForm) {
  const double mass = 1.0;
  Scene scene = square_scene(mass);
  scene.gripper.grip_force = 15.0;
  const Model model = prepare(scene);
  const double weight = mass * kGravity;
  GripRangeOptions options;
  options.tolerance = 1e-9;
  const GripRange range = grip_range(model, {}, Pivot{1, 0.0, 0.3, 1e-3}, options);
  ASSERT_TRUE(range.found) << range.reason;
  EXPECT_NEAR(range.low.force, weight, 3e-6 * weight);
  EXPECT_EQ(range.low.outside.status, TransitionStatus::kFalls);
  const double greatest = weight * 0.05 / model.c;  // F = 2 mu N = N
  EXPECT_NEAR(range.high.force, greatest, 3e-6 * greatest);
  EXPECT_GT(range.high.beyond, range.high.force);
  for (const GripSample& sample : range.profile) {
    EXPECT_NEAR(sample.stick_high, greatest, 1e-6 * greatest);
    EXPECT_NEAR(sample.hold, weight, 1e-6 * weight);
  }
}

// The profile and the range answer the same question where the pusher is to stick.
TEST(GripRange, RangeOfAStickingPushIsWhatItsProfileAllows) {
  int compared = 0;
  for (int index = 0; index < 200 && compared < 6; ++index) {
    RandomPush c = random_push(14, index);
    c.scene.overhang = Overhang::kIgnore;
    const Model model = prepare(c.scene);
    if (model.contacts[0].is_point || c.push.turn != 0.0) continue;
    GripRangeOptions options;
    options.tolerance = 1e-10;
    options.samples = 8;
    const GripRange range = grip_range(model, c.scene.start, c.push, options);
    if (!range.found) continue;
    double low = 0.0;
    double high = std::numeric_limits<double>::infinity();
    for (const GripSample& sample : range.profile) {
      low = std::max({low, sample.stick_low, sample.hold});
      high = std::min(high, sample.stick_high);
    }
    EXPECT_NEAR(range.low.force, std::max(low, options.least), 1e-5 * range.low.force)
        << index;
    if (range.high.is_open) {
      EXPECT_GE(high, options.greatest * (1.0 - 1e-5)) << index;
    } else {
      EXPECT_NEAR(range.high.force, high, 1e-5 * high) << index;
    }
    ++compared;
  }
  EXPECT_EQ(compared, 6);
}

// Every end comes with a push that does, and one a little beyond it that does not.
TEST(GripRange, EvidenceAtBothEnds) {
  int ends = 0;
  for (int index = 0; index < 15; ++index) {
    const RandomPush c = random_push(15, index);
    const Model model = prepare(c.scene);
    const GripRangeOptions options;
    const GripRange range = grip_range(model, c.scene.start, c.push, options);
    if (!range.found) {
      EXPECT_FALSE(range.reason.empty());
      continue;
    }
    for (const GripEnd& end : {range.low, range.high}) {
      EXPECT_TRUE(end.inside.completed()) << index;
      EXPECT_LE(end.inside.worst_certificate, 1e-6) << index;
      if (end.is_open) continue;
      ++ends;
      EXPECT_NEAR(end.beyond / end.force, 1.0, 2.0 * options.precision);
      EXPECT_TRUE(!end.outside.completed() || end.strayed > options.tolerance) << index;
    }
    EXPECT_LE(range.low.force, range.high.force);
  }
  EXPECT_GT(ends, 6);
}

TEST(GripRange, RefusesWhatMakesNoSense) {
  const Model model = prepare(square_scene(1.0));
  const Slide slide{0, 0.0, {1.0, 0.0}, 0.004, 0.5};
  EXPECT_FALSE(grip_range(model, {}, Roll{0, 0.01}).found);
  EXPECT_FALSE(grip_range(model, {}, Slide{7, 0.0, {1.0, 0.0}, 0.004}).found);
  EXPECT_FALSE(grip_range(model, {}, slide, {.tolerance = 0.0}).found);
  EXPECT_FALSE(grip_range(model, {}, slide, {.least = 10.0, .greatest = 1.0}).found);
  EXPECT_FALSE(grip_range(model, {}, slide, {.samples = 0}).found);
  // A push that moves away from the object does nothing with any grip.
  const Slide away{0, 0.0, {-1.0, 0.0}, 0.004, 0.5};
  const GripRange none = grip_range(model, {}, away);
  EXPECT_FALSE(none.found);
  EXPECT_FALSE(none.reason.empty());
}

// In space: gravity along the closing direction takes half the weight off one jaw's
// force, so the object falls through jaws that grip with less than that, and tilts
// between them a little above.
TEST(GripRange, JawsThatCarryTheWeight) {
  Scene scene = square_scene(1.5);
  scene.g_W.setZero();
  scene.g_Wz = -kGravity;
  const Model model = prepare(scene);
  const GripRange range = grip_range(model, {}, Slide{0, 0.0, {1.0, 0.0}, 0.004, 0.5});
  ASSERT_TRUE(range.found) << range.reason;
  const double half_weight = 0.5 * 1.5 * kGravity;
  EXPECT_GE(range.low.force, half_weight);
  EXPECT_LT(range.low.force, 4.0 * half_weight);
  EXPECT_TRUE(range.low.inside.in_space);
  EXPECT_FALSE(range.low.outside.completed());
  EXPECT_TRUE(range.high.is_open);
}

}  // namespace
}  // namespace prehensile
