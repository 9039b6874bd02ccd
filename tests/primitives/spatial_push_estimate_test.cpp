/// Convergence and honesty of the error estimate of pushes in space.
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include <gtest/gtest.h>

#include "problems/random_pushes.h"
#include "tests/primitives/push_checks.h"

namespace prehensile {
namespace {

using testing::distance;

/// Errors of the reference itself [m].
constexpr double kReference = 3e-9;

constexpr TransitionOptions kFine{
    .tolerance = 1e-8, .max_step = 0.02, .max_steps = 20000};

struct Honesty {
  int sticking = 0;
  int integrated = 0;
  int under = 0;   // true error above three times the estimate
  int over = 0;    // estimate above thirty times the true error
  int unlike = 0;  // ends otherwise than the reference
  int missed = 0;  // events that the reference sees
  std::vector<double> error, instants, time_us;
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

Honesty honesty(std::uint64_t seed, int first, int count) {
  Honesty sum;
  for (int index = first; index < first + count; ++index) {
    const RandomPush c = random_spatial_push(seed, index);
    const Model model = prepare(c.scene);
    const std::clock_t start = std::clock();
    const Transition t = apply(model, c.scene.start, c.push);
    const double time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_NE(t.status, TransitionStatus::kUncertified) << index;
    const Transition reference = apply(model, c.scene.start, c.push, kFine);
    if (t.status != reference.status) {
      ++sum.unlike;
      continue;
    }
    sum.missed += t.event_count < reference.event_count ? 1 : 0;
    if (t.done == 0.0) continue;
    const double error = distance(t.end.X_HO, reference.end.X_HO, model.c);
    if (t.event_count == 0 && t.slipped == 0.0 && !model.contacts[0].is_point) {
      ++sum.sticking;
      continue;
    }
    ++sum.integrated;
    sum.error.push_back(error);
    sum.instants.push_back(t.instants);
    sum.time_us.push_back(1e6 * time);
    sum.under += error > 3.0 * t.error_estimate + kReference ? 1 : 0;
    sum.over += t.error_estimate > 30.0 * error + 3.0 * kReference ? 1 : 0;
  }
  std::printf(
      "%d integrated: %.2f %% above 3 x estimate, %.2f %% below estimate / 30; error "
      "median %.1e, 95 %% %.1e m, worst %.1e m; instants %.0f, 95 %% %.0f; %.0f us, "
      "95 %% %.0f us; %d sticking; %d end otherwise, %d with fewer events\n",
      sum.integrated, 100.0 * sum.under / sum.integrated,
      100.0 * sum.over / sum.integrated, quantile(sum.error, 0.5),
      quantile(sum.error, 0.95), quantile(sum.error, 1.0), quantile(sum.instants, 0.5),
      quantile(sum.instants, 0.95), quantile(sum.time_us, 0.5),
      quantile(sum.time_us, 0.95), sum.sticking, sum.unlike, sum.missed);
  return sum;
}

void expect_honest(const Honesty& found, int count) {
  EXPECT_GT(found.integrated, count / 3);
  EXPECT_GT(found.sticking, count / 20);
  EXPECT_LE(found.under, std::max(1.0, 0.01 * found.integrated));
  EXPECT_LE(found.over, std::max(4.0, 0.10 * found.integrated));
  EXPECT_LE(found.unlike, 1 + 0.01 * count);
  EXPECT_LE(found.missed, 1 + 0.01 * count);
  EXPECT_LT(quantile(found.error, 0.5), 1e-6);
}

TEST(SpatialPushEstimate, IsHonest) { expect_honest(honesty(31, 0, 40), 40); }

class SpatialPushEstimateFull : public ::testing::TestWithParam<int> {};

TEST_P(SpatialPushEstimateFull, IsHonest) {
  expect_honest(honesty(32, 500 * GetParam(), 500), 500);
}
INSTANTIATE_TEST_SUITE_P(Quarters, SpatialPushEstimateFull, ::testing::Range(0, 4));

// Pushes that meet two motions next to each other (36, 134, 199, 1726), tilt where the
// motion followed ends (1605), or end where the pads just hold the object (1597, 1641,
// 1657): the end is that of the reference, within the estimate.
TEST(SpatialPushEstimate, FollowsOneMotionToItsEnd) {
  for (const int index : {36, 134, 199, 1597, 1605, 1641, 1657, 1726}) {
    const RandomPush c = random_spatial_push(32, index);
    const Model model = prepare(c.scene);
    const Transition t = apply(model, c.scene.start, c.push);
    const Transition reference = apply(model, c.scene.start, c.push, kFine);
    EXPECT_EQ(t.status, reference.status) << index;
    EXPECT_EQ(t.event_count, reference.event_count) << index;
    EXPECT_LE(distance(t.end.X_HO, reference.end.X_HO, model.c),
              3.0 * t.error_estimate + kReference)
        << index;
  }
}

// Pushes of 40 mm on boxes large enough for them.
TEST(SpatialPushTimeFull, FortyMillimetres) {
  constexpr int kPushes = 300;
  std::printf("points  completed  instants med/p95  us med/p95; rides: the same\n");
  for (const int points : {4, 8, 16}) {
    std::array<std::vector<double>, 2> instants, times;
    int completed = 0;
    for (int index = 0; index < kPushes; ++index) {
      RandomPush c = random_spatial_push(41, index);
      auto& box = std::get<BoxShape>(c.scene.object.shape);
      box.size.x() = box.size.y() = 0.16;
      c.push.travel = 0.04;
      const Model model = prepare(c.scene, {.points_per_pad = points});
      const std::clock_t start = std::clock();
      const Transition t = apply(model, c.scene.start, c.push);
      const double time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      if (!t.completed()) continue;
      ++completed;
      const bool rides =
          t.event_count == 0 && t.slipped == 0.0 && !model.contacts[0].is_point;
      instants[rides ? 1 : 0].push_back(t.instants);
      times[rides ? 1 : 0].push_back(1e6 * time);
    }
    EXPECT_GT(completed, kPushes / 2);
    std::printf("%6d  %9d", points, completed);
    for (const int kind : {0, 1}) {
      ASSERT_FALSE(instants[kind].empty());
      std::printf("  %.0f/%.0f  %.0f/%.0f", quantile(instants[kind], 0.5),
                  quantile(instants[kind], 0.95), quantile(times[kind], 0.5),
                  quantile(times[kind], 0.95));
    }
    std::printf("\n");
    EXPECT_LT(quantile(instants[0], 0.5), 100.0);
  }
}

// Steps of half the length, and of half that: the end of the push settles at a pace that
// the tolerance sets.
TEST(SpatialPushEstimate, FinerStepsConverge) {
  std::array<std::vector<double>, 3> errors;
  for (int seed = 0; seed < 14; ++seed) {
    const RandomPush c = random_spatial_push(33, seed);
    const Model model = prepare(c.scene);
    const Transition reference =
        apply(model, c.scene.start, c.push, {.tolerance = 1e-8, .max_step = 0.02});
    if (!reference.completed() || reference.slipped == 0.0) continue;
    double tolerance = 1e-4;
    double max_step = 0.1;
    for (std::vector<double>& of : errors) {
      const Transition t = apply(model, c.scene.start, c.push,
                                 {.tolerance = tolerance, .max_step = max_step});
      if (!t.completed()) break;
      of.push_back(distance(t.end.X_HO, reference.end.X_HO, model.c));
      tolerance *= 0.1;
      max_step *= 0.5;
    }
  }
  ASSERT_GT(errors[2].size(), 3U);
  EXPECT_LT(quantile(errors[0], 0.9), 1e-4);
  EXPECT_LT(quantile(errors[1], 0.9), 1e-5);
  EXPECT_LT(quantile(errors[2], 0.9), 1e-6);
}

}  // namespace
}  // namespace prehensile
