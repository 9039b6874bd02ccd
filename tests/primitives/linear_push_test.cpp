/// Laws that every push obeys, over random pushes.
#include "primitives/linear_push.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "problems/random_pushes.h"
#include "tests/primitives/push_checks.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

using testing::distance;
using testing::has_event;

TEST(LinearPush, StickingPushIsTheExactRigidMotion) {
  int sticking = 0;
  for (int seed = 0; seed < 400; ++seed) {
    const RandomPush c = random_push(1, seed);
    const Model model = prepare(c.scene);
    const Transition t = apply(model, c.scene.start, c.push);
    if (!t.completed() || model.contacts[0].is_point || t.event_count > 0 ||
        t.slipped > 0.0) {
      continue;
    }
    ++sticking;
    EXPECT_LT(distance(t.end.X_HO, pusher_pose(c.push, c.scene.start.X_HO, 1.0), 0.1),
              1e-12);
    EXPECT_EQ(t.error_estimate, 0.0);
  }
  EXPECT_GT(sticking, 40);
}

// A leap over a ride with a constant wrench must not hide what a traced push, which looks
// everywhere, would find.
TEST(LinearPush, TracedAndUntracedPushesAgree) {
  for (int seed = 0; seed < 400; ++seed) {
    const RandomPush c = random_push(1, seed);
    const Model model = prepare(c.scene);
    std::vector<Sample> trace;
    const Transition traced = apply(model, c.scene.start, c.push, {}, &trace);
    const Transition untraced = apply(model, c.scene.start, c.push);
    EXPECT_EQ(traced.status, untraced.status) << seed;
    EXPECT_EQ(traced.event_count, untraced.event_count) << seed;
    EXPECT_LT(distance(traced.end.X_HO, untraced.end.X_HO, model.c), 2e-6) << seed;
    if (traced.status != TransitionStatus::kRefused && !trace.empty()) {
      EXPECT_EQ(trace.back().grasp, traced.end) << seed;
    }
  }
}

// Quasi-static and rate-independent: only ratios of forces matter.
TEST(LinearPush, ForcesScaleWithGripAndGravity) {
  for (int seed = 0; seed < 200; ++seed) {
    const RandomPush c = random_push(1, seed);
    RandomPush scaled = c;
    scaled.scene.gripper.grip_force *= 50.0;
    scaled.scene.g_W *= 50.0;
    const TransitionOptions options{.tolerance = 1e-7};
    const Transition one = apply(prepare(c.scene), c.scene.start, c.push, options);
    const Transition other = apply(prepare(scaled.scene), c.scene.start, c.push, options);
    ASSERT_EQ(one.status, other.status) << seed;
    EXPECT_LT(distance(one.end.X_HO, other.end.X_HO, 0.01), 2e-7) << seed;
    if (one.completed()) {
      EXPECT_NEAR(other.max_push_force, 50.0 * one.max_push_force,
                  1e-3 * other.max_push_force)
          << seed;
    }
  }
}

TEST(LinearPush, TighterToleranceConverges) {
  double last = 1e-3;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    double worst = 0.0;
    for (int seed = 0; seed < 60; ++seed) {
      RandomPush c = random_push(1, seed);
      c.scene.overhang = Overhang::kIgnore;
      const Model model = prepare(c.scene);
      const Transition reference =
          apply(model, c.scene.start, c.push, {.tolerance = 1e-11, .max_steps = 20000});
      const Transition t = apply(model, c.scene.start, c.push, {.tolerance = tolerance});
      if (!reference.completed()) continue;
      ASSERT_TRUE(t.completed()) << seed << " " << t.reason;
      worst = std::max(worst, distance(t.end.X_HO, reference.end.X_HO, model.c));
    }
    EXPECT_LT(worst, 2.0 * tolerance);
    EXPECT_LT(worst, 0.2 * last);
    last = worst;
  }
}

// The median, because an event where its margin only grazes zero moves more than the
// tolerance says.
TEST(LinearPush, EventLocationsConverge) {
  double last = 1e-2;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    std::vector<double> shifts;
    for (int seed = 0; seed < 120; ++seed) {
      RandomPush c = random_push(1, seed);
      c.scene.overhang = Overhang::kIgnore;
      const Model model = prepare(c.scene);
      const Transition reference =
          apply(model, c.scene.start, c.push, {.tolerance = 1e-11, .max_steps = 20000});
      const Transition t = apply(model, c.scene.start, c.push, {.tolerance = tolerance});
      if (t.event_count != reference.event_count) continue;
      for (int i = 0; i < t.event_count; ++i) {
        EXPECT_EQ(t.events[i].kind, reference.events[i].kind) << seed;
        if (reference.events[i].s == 0.0) continue;
        shifts.push_back(std::abs(t.events[i].s - reference.events[i].s));
      }
    }
    ASSERT_GT(shifts.size(), 15u);
    std::sort(shifts.begin(), shifts.end());
    EXPECT_LT(shifts[shifts.size() / 2], 0.05 * last);
    last = shifts[shifts.size() / 2];
  }
}

// Point pushing is unstable when the pusher trails the centre of friction: no motion may
// be made up there, and forces stay within the friction cone.
TEST(LinearPush, SamplesObeyTheFrictionCone) {
  for (int seed = 0; seed < 200; ++seed) {
    const RandomPush c = random_push(1, seed);
    const Model model = prepare(c.scene);
    std::vector<Sample> trace;
    const Transition t = apply(model, c.scene.start, c.push, {}, &trace);
    const double mu = c.scene.pushers[0].friction;
    double last_s = -1.0;
    for (const Sample& sample : trace) {
      EXPECT_GE(sample.normal_force, -1e-7 * model.F);
      EXPECT_LE(std::abs(sample.tangential_force),
                mu * sample.normal_force + 1e-6 * model.F);
      EXPECT_LE(sample.tangential_force * sample.slip_rate, 1e-9);
      EXPECT_GE(sample.s, last_s);
      EXPECT_LE(sample.push_force, t.max_push_force);
      EXPECT_GE(sample.push_force, t.min_push_force);
      EXPECT_LE(sample.certificate, t.worst_certificate);
      last_s = sample.s;
    }
  }
}

TEST(LinearPush, UsesNoHeapWithoutATrace) {
  for (int seed = 0; seed < 60; ++seed) {
    const RandomPush c = random_push(1, seed);
    const Model model = prepare(c.scene);
    const Push push = c.push;
    const testing::NoHeapScope scope;
    const Transition t = apply(model, c.scene.start, push);
    const Transition fast =
        apply(model, c.scene.start, push, {.friction_model = FrictionModel::kEllipsoid});
    EXPECT_LE(scope.allocations(), 0) << name(t.status) << name(fast.status);
  }
}

// A point that trails a tiny pad over a long way: its swing dies out in a share of the
// push that no explicit method could follow with the steps that are taken here.
TEST(LinearPush, StiffSlipsAreTakenInLongSteps) {
  int stiff = 0;
  int slow = 0;
  int compared = 0;
  for (int seed = 0; seed < 60; ++seed) {
    RandomPush c = random_push(9, seed);
    c.scene.object.shape = BoxShape{{0.1, 0.1, 0.02}};
    c.scene.pushers[0].feature = PointFeature{};
    c.scene.g_W.setZero();
    c.push.travel = 0.03;
    const Model model = prepare(c.scene);
    const TransitionOptions options{.friction_model = FrictionModel::kEllipsoid};
    for (const double radius : {1e-3, 1e-4}) {
      RandomPush tiny = c;
      tiny.scene.gripper.pad = DiscPad{radius};
      const Model small = prepare(tiny.scene);
      const Transition t = apply(small, c.scene.start, c.push, options);
      if (!t.completed() || t.slipped < 1e-3) continue;
      ++stiff;
      slow += t.instants > 1500 ? 1 : 0;
      const TransitionOptions fine{.tolerance = 1e-9,
                                   .max_step = 0.01,
                                   .max_steps = 20000,
                                   .friction_model = FrictionModel::kEllipsoid};
      const Transition reference = apply(small, c.scene.start, c.push, fine);
      if (!reference.completed()) continue;
      EXPECT_LT(distance(t.end.X_HO, reference.end.X_HO, small.c), 3e-6) << seed;
      ++compared;
    }
  }
  // Two of the tiniest pads come through a swing that no step can cross.
  EXPECT_LE(slow, stiff / 10);
  EXPECT_GT(compared, 25);
  EXPECT_GT(stiff, 25);
}

TEST(LinearPush, RandomPushesAreCertifiedOrStopForAPhysicalReason) {
  std::array<int, 11> counts{};
  for (int seed = 0; seed < 2000; ++seed) {
    const RandomPush c = random_push(1, seed);
    const Transition t = apply(prepare(c.scene), c.scene.start, c.push);
    ++counts[static_cast<int>(t.status)];
    EXPECT_NE(t.status, TransitionStatus::kNotRun) << seed;
    EXPECT_NE(t.status, TransitionStatus::kUncertified) << seed << " " << t.reason;
    EXPECT_NE(t.status, TransitionStatus::kRefused) << seed << " " << t.reason;
    EXPECT_EQ(t.completed(), t.reason.empty());
    if (t.completed()) {
      EXPECT_EQ(t.done, 1.0);
    }
    if (t.done > 0.0) {
      EXPECT_LE(t.worst_certificate, 1e-6) << seed;
    }
  }
  for (int i = 0; i < 11; ++i) {
    if (counts[i] == 0) continue;
    const auto status = static_cast<TransitionStatus>(i);
    std::printf("%6d %s\n", counts[i], name(status).data());
  }
  EXPECT_GT(counts[static_cast<int>(TransitionStatus::kCompleted)], 1500);
  // Where the pusher comes to graze the object the motion grows singular.
  EXPECT_LE(counts[static_cast<int>(TransitionStatus::kIterationLimit)], 2);
}

}  // namespace
}  // namespace prehensile
