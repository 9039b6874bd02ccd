/// Grip forces along a push where the loads of the pads shift.
#include "primitives/space_grip.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "problems/random_pushes.h"

namespace prehensile {
namespace {

/// Relative; both ways of asking have their own grazing cases.
constexpr double kAlike = 1e-3;

bool alike(double a, double b) { return a == b || std::abs(a - b) <= kAlike * b; }

// Where the scene is symmetric the forces are the closed forms of the pad plane.
void compare_with_the_pad_plane(int scenes) {
  const GripRangeOptions options;
  int held = 0;
  int sticking = 0;
  int bounded = 0;
  for (int index = 0; index < scenes; ++index) {
    const RandomPush c = random_push(61, index);
    const Model model = prepare(c.scene);
    const GripSample flat = grip_sample(model, c.scene.start, c.push, 0.0);
    const GripSample space =
        grip_sample_in_space(model, c.scene.start, c.push, 0.0, options);
    if (flat.hold < options.greatest) {
      ++held;
      EXPECT_TRUE(alike(space.hold, flat.hold)) << index << ' ' << space.hold;
    }
    if (std::isnan(flat.stick_low)) continue;
    // In space the pusher sticks only where the grasp would hold without it.
    const double low = std::max(flat.stick_low, flat.hold);
    if (!(low < 0.99 * std::min(flat.stick_high, options.greatest))) continue;
    // The search begins at the scene's own force and looks at five per decade.
    if (flat.stick_high < 1.7 * low) continue;
    ++sticking;
    EXPECT_TRUE(alike(space.stick_low, low)) << index << ' ' << space.stick_low;
    EXPECT_TRUE(alike(space.stick_high, flat.stick_high))
        << index << ' ' << space.stick_high;
    bounded += std::isfinite(flat.stick_high) ? 1 : 0;
  }
  EXPECT_GT(3 * held, 2 * scenes);
  EXPECT_GT(5 * sticking, scenes);
  EXPECT_GT(20 * bounded, scenes);
}

TEST(SpaceGrip, IsThatOfThePadPlaneWhereTheSceneIsSymmetric) {
  compare_with_the_pad_plane(20);
}

TEST(SpaceGrip, FullIsThatOfThePadPlaneWhereTheSceneIsSymmetric) {
  compare_with_the_pad_plane(60);
}

// Short pushes with a little more and a little less say the same.
void try_both_sides_of_the_forces(int scenes) {
  const GripRangeOptions options;
  int ends = 0;
  for (int index = 0; index < scenes; ++index) {
    RandomPush c = random_spatial_push(62, index);
    const Model model = prepare(c.scene);
    if (!model.push_needs_space(model.contacts[0])) continue;
    const GripSample sample =
        grip_sample_in_space(model, c.scene.start, c.push, 0.0, options);
    if (!(sample.stick_low <= sample.stick_high)) continue;
    EXPECT_GE(sample.stick_low, (1.0 - kAlike) * sample.hold) << index;
    LinearPush brief = c.push;
    brief.travel *= 1e-4;
    brief.turn *= 1e-4;
    brief.bend *= 1e-4;
    const auto sticks = [&](double force) {
      const Transition t = apply(gripped(model, force), c.scene.start, brief);
      return t.completed() && t.event_count == 0 && t.slipped == 0.0;
    };
    if (sample.stick_low > 0.0) {
      ++ends;
      EXPECT_TRUE(sticks(1.01 * sample.stick_low)) << index;
      EXPECT_FALSE(sticks(0.99 * sample.stick_low)) << index;
    }
    if (std::isfinite(sample.stick_high)) {
      ++ends;
      EXPECT_TRUE(sticks(0.99 * sample.stick_high)) << index;
      EXPECT_FALSE(sticks(1.01 * sample.stick_high)) << index;
    }
  }
  EXPECT_GT(4 * ends, scenes);
}

TEST(SpaceGrip, PushesInSpaceStickWithinTheForcesAndNotBeyond) {
  try_both_sides_of_the_forces(20);
}

TEST(SpaceGrip, FullPushesInSpaceStickWithinTheForcesAndNotBeyond) {
  try_both_sides_of_the_forces(120);
}

// The range that whole pushes give begins where the profile's greatest need is.
void compare_range_with_profile(int scenes) {
  int compared = 0;
  for (int index = 0; index < 60 && compared < scenes; ++index) {
    const RandomPush c = random_spatial_push(63, index);
    const Model model = prepare(c.scene);
    const PushContact& contact = model.contacts[0];
    if (contact.is_point || !model.push_needs_space(contact)) continue;
    GripRangeOptions options;
    options.tolerance = 1e-7;
    options.samples = 5;
    options.precision = 1e-4;
    options.least = 0.1;
    options.greatest = 1e3;
    const GripRange range = grip_range(model, c.scene.start, c.push, options);
    if (!range.found || range.low.is_open) continue;
    EXPECT_TRUE(range.in_space);
    double least = 0.0;
    for (const GripSample& sample : range.profile) {
      least = std::max(least, sample.stick_low);
    }
    ++compared;
    EXPECT_GE(range.low.force, 0.99 * least) << index;
    EXPECT_LE(range.low.force, 1.05 * least) << index;
  }
  EXPECT_GE(compared, scenes);
}

TEST(SpaceGrip, TheRangeOfAWholePushIsThatOfItsProfile) { compare_range_with_profile(1); }

TEST(SpaceGrip, FullTheRangeOfAWholePushIsThatOfItsProfile) {
  compare_range_with_profile(6);
}

TEST(SpaceGrip, AGraspThatNoForceHoldsIsHeldByNone) {
  RandomPush c = random_spatial_push(62, 0);
  for (double& friction : c.scene.gripper.friction) friction = 0.0;
  const Model model = prepare(c.scene);
  EXPECT_EQ(
      least_to_hold_in_space(model, 0, c.scene.start.X_HO, model.contacts[0].g_O, {}),
      std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace prehensile
