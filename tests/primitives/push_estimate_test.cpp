/// Honesty of the error estimate, and of the search for events, over random pushes.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "problems/random_pushes.h"
#include "tests/primitives/push_checks.h"

namespace prehensile {
namespace {

using testing::distance;

/// Errors of the reference itself [m].
constexpr double kReference = 1e-11;

TransitionOptions fine(FrictionModel friction) {
  return {.tolerance = 1e-12,
          .max_step = 0.005,
          .max_steps = 200000,
          .friction_model = friction};
}

struct Honesty {
  int sticking = 0;    // nothing to integrate: estimate and error are rounding
  int integrated = 0;  // some part slips or tips
  int under = 0;       // true error above three times the estimate
  int over = 0;        // estimate above thirty times the true error
  int unlike = 0;      // ends otherwise than the reference
  int missed = 0;      // events that the reference sees
  double worst = 0.0;  // [m]
};

Honesty honesty(FrictionModel friction, std::uint64_t seed, int first, int count) {
  Honesty sum;
  for (int index = first; index < first + count; ++index) {
    const RandomPush c = random_push(seed, index);
    const Model model = prepare(c.scene);
    const Transition reference = apply(model, c.scene.start, c.push, fine(friction));
    const Transition t =
        apply(model, c.scene.start, c.push, {.friction_model = friction});
    if (t.status != reference.status) {
      ++sum.unlike;
      continue;
    }
    sum.missed += t.event_count < reference.event_count ? 1 : 0;
    const double error = distance(t.end.X_HO, reference.end.X_HO, model.c);
    sum.worst = std::max(sum.worst, error);
    if (t.event_count == 0 && t.slipped < 1e-12 && !model.contacts[0].is_point) {
      EXPECT_LT(error, 1e-11) << index;
      EXPECT_LT(t.error_estimate, 1e-11) << index;
      ++sum.sticking;
      continue;
    }
    ++sum.integrated;
    sum.under += error > 3.0 * t.error_estimate + kReference ? 1 : 0;
    sum.over += t.error_estimate > 30.0 * error + 3.0 * kReference ? 1 : 0;
  }
  return sum;
}

void expect_honest(const Honesty& found, int count, double under, double over) {
  std::printf(
      "%d integrated: %.2f %% above 3 x estimate, %.2f %% below estimate / 30, "
      "worst %.1e m; %d sticking; %d end otherwise, %d with fewer events\n",
      found.integrated, 100.0 * found.under / found.integrated,
      100.0 * found.over / found.integrated, found.worst, found.sticking, found.unlike,
      found.missed);
  EXPECT_GT(found.integrated, count / 3);
  EXPECT_GT(found.sticking, count / 10);
  EXPECT_LE(found.under, under * found.integrated);
  EXPECT_LE(found.over, over * found.integrated);
  EXPECT_LE(found.unlike, 0.004 * count);
  EXPECT_LE(found.missed, 0.003 * count);
}

// Pads of sixteen points have kinks where the centre of rotation passes close to a point.
TEST(PushEstimate, IsHonestOverPads) {
  expect_honest(honesty(FrictionModel::kPads, 12, 0, 600), 600, 0.015, 0.10);
}

TEST(PushEstimate, IsHonestOverTheEllipsoid) {
  expect_honest(honesty(FrictionModel::kEllipsoid, 12, 0, 600), 600, 0.01, 0.10);
}

TEST(PushEstimateFull, IsHonestOverPads) {
  expect_honest(honesty(FrictionModel::kPads, 13, 0, 10000), 10000, 0.01, 0.10);
}

TEST(PushEstimateFull, IsHonestOverTheEllipsoid) {
  expect_honest(honesty(FrictionModel::kEllipsoid, 13, 0, 10000), 10000, 0.01, 0.10);
}

}  // namespace
}  // namespace prehensile
