/// What happens inside of long steps: limits that are crossed and kept again before the
/// end, and pushes of many events.
#include <gtest/gtest.h>

#include "primitives/push_run.h"
#include "scene/outline.h"
#include "tests/primitives/push_checks.h"
#include "tests/support/no_heap.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::distance;
using testing::has_event;
using testing::NoHeapScope;
using testing::Random;

constexpr double kHalfLength = 0.05;  // [m] of the plate
constexpr double kHalfWidth = 0.03;

/// A plate whose upper side has these corners besides its own, from right to left.
Scene plate(const std::vector<Vec2>& cuts, const PusherFeature& feature) {
  PrismShape shape;
  shape.outline = {
      {-kHalfLength, -kHalfWidth}, {kHalfLength, -kHalfWidth}, {kHalfLength, kHalfWidth}};
  shape.outline.insert(shape.outline.end(), cuts.begin(), cuts.end());
  shape.outline.push_back({-kHalfLength, kHalfWidth});
  shape.thickness = 0.025;
  Scene scene;
  scene.object.shape = shape;
  scene.object.mass = 0.1;
  scene.object.p_OCom = Vec2::Zero();  // cuts change what may be touched, and no motion
  scene.gripper.pad = DiscPad{0.004};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 40.0;
  scene.overhang = Overhang::kIgnore;
  Pusher pusher;
  pusher.name = "pusher";
  pusher.feature = feature;
  pusher.friction = 0.5;
  scene.pushers = {pusher};
  return scene;
}

/// One to three notches, narrow or wide, with upright or slanting sides.
std::vector<Vec2> random_cuts(Random& random) {
  std::vector<Vec2> cuts;
  const int count = 1 + random.below(3);
  for (int i = count - 1; i >= 0; --i) {
    const double room = 0.08 / count;
    const double x = -0.04 + (i + random.in(0.3, 0.7)) * room;
    const double half = std::exp(random.in(std::log(1e-4), std::log(0.25 * room)));
    const double bottom = kHalfWidth - random.in(0.005, 0.055);
    const double half_bottom = random.chance(0.5) ? half : 0.1 * half;
    cuts.insert(cuts.end(), {Vec2(x + half, kHalfWidth), Vec2(x + half_bottom, bottom),
                             Vec2(x - half_bottom, bottom), Vec2(x - half, kHalfWidth)});
  }
  return cuts;
}

struct Drawn {
  Scene notched, whole;
  LinearPush push;
};

Drawn random_notched(Random& random, const PusherFeature& feature) {
  const std::vector<Vec2> cuts = random_cuts(random);
  Drawn drawn{plate(cuts, feature), plate({}, feature), {}};
  const double aside = std::holds_alternative<PointFeature>(feature) ? 0.4 : 0.3;
  drawn.push.place = random.in(-0.01, 0.01);
  drawn.push.e = rotated(random.in(-aside, aside), {1.0, 0.0});
  drawn.push.travel = random.in(0.005, 0.06);
  if (random.chance(0.5)) drawn.push.turn = random.in(-0.3, 0.3);
  if (random.chance(0.3)) drawn.push.bend = random.in(-1.0, 1.0);
  const auto& outline = std::get<PrismShape>(drawn.notched.object.shape).outline;
  Vec2 p_OF;
  do {
    p_OF = {random.in(-0.03, 0.045), random.in(-0.025, 0.025)};
  } while (depth_inside(outline, p_OF) < 1e-5);
  drawn.notched.start.X_HO = drawn.whole.start.X_HO =
      pose_from_finger(p_OF, random.in(-3.0, 3.0));
  return drawn;
}

/// The law: the finger axis meets the border where the same push of the plate without
/// cuts, looked at closely, brings it there; and without such a place nothing changes.
void expect_border_is_seen(const PusherFeature& feature, bool ellipsoid) {
  constexpr double kNear = 2e-5;  // [m]
  Random random(7);
  int met = 0;
  int kept = 0;
  for (int i = 0; i < 300; ++i) {
    const Drawn drawn = random_notched(random, feature);
    const Model notched = prepare(drawn.notched);
    const Model whole = prepare(drawn.whole);
    const Grasp& start = drawn.whole.start;
    TransitionOptions options;
    if (ellipsoid) options.friction_model = FrictionModel::kEllipsoid;
    TransitionOptions close = options;
    close.max_step = 1e-3;
    std::vector<Sample> trace;
    apply(whole, start, drawn.push, close, &trace);
    const Transition plain = apply(whole, start, drawn.push, options);
    Transition t;
    {
      const NoHeapScope no_heap;
      t = apply(notched, start, drawn.push, options);
    }
    const auto& outline = notched.outline;
    double least = 1.0;
    double outside_at = 2.0;
    for (const Sample& sample : trace) {
      const double depth = depth_inside(outline, finger_in_object(sample.grasp.X_HO));
      least = std::min(least, depth);
      if (depth < -kNear) outside_at = std::min(outside_at, sample.s);
    }
    if (outside_at < 2.0) {
      ++met;
      EXPECT_EQ(t.status, TransitionStatus::kPadLost) << i << " " << t.reason;
      EXPECT_LE(t.done, outside_at + 1e-4) << i;
      EXPECT_NEAR(depth_inside(outline, finger_in_object(t.end.X_HO)), 0.0, 2e-6) << i;
    } else if (least > kNear) {
      ++kept;
      EXPECT_EQ(t.status, plain.status) << i << " " << t.reason;
      EXPECT_EQ(t.done, plain.done) << i;
      if (!std::holds_alternative<PointFeature>(feature)) continue;
      EXPECT_EQ(t.end.X_HO.x, plain.end.X_HO.x) << i;
      EXPECT_EQ(t.end.X_HO.y, plain.end.X_HO.y) << i;
      EXPECT_EQ(t.end.X_HO.theta, plain.end.X_HO.theta) << i;
      EXPECT_EQ(t.error_estimate, plain.error_estimate) << i;
      EXPECT_EQ(t.instants, plain.instants) << i;
    }
  }
  EXPECT_GT(met, 40);
  EXPECT_GT(kept, 40);
}

TEST(PushEvents, APointSeesEveryNotch) { expect_border_is_seen(PointFeature{}, false); }

TEST(PushEvents, APointSeesEveryNotchOverTheEllipsoid) {
  expect_border_is_seen(PointFeature{}, true);
}

TEST(PushEvents, RidesSeeEveryNotch) { expect_border_is_seen(LineFeature{}, false); }

TEST(PushEvents, ShortLinesSeeEveryNotch) {
  expect_border_is_seen(LineFeature{0.03}, false);
}

// A direction that turns back makes the object stray and return within a step.
TEST(PushEvents, AGuardIsSeenWhereTheObjectReturns) {
  Random random(3);
  int met = 0;
  int returned = 0;
  for (int i = 0; i < 400; ++i) {
    const Scene scene = plate({}, PointFeature{});
    const Model model = prepare(scene);
    LinearPush push;
    push.place = random.in(-0.01, 0.01);
    push.bend = random.in(-2.5, 2.5);
    push.e = rotated(-0.5 * push.bend + random.in(-0.2, 0.2), {1.0, 0.0});
    push.turn = random.in(-0.2, 0.2);
    push.travel = random.in(0.005, 0.03);
    const Grasp start{
        pose_from_finger({random.in(-0.02, 0.03), random.in(-0.02, 0.02)}, 0.0), 0.0};
    std::vector<Sample> trace;
    follow(model, start, push, {}, {.max_step = 1e-3}, &trace);
    const auto turned = [&](const Sample& s) {
      return std::abs(s.grasp.X_HO.theta - start.X_HO.theta);
    };
    double most = 0.0;
    double end = 0.0;
    for (const Sample& sample : trace) {
      end = turned(sample);
      most = std::max(most, end);
    }
    if (!(most > end + 2e-3)) continue;
    ++returned;
    const Guard guard{.angle = std::max(end, 0.25 * most) + 0.5 * (most - end)};
    if (guard.angle > most - 1e-3) continue;
    const Transition t = follow(model, start, push, guard, {}, nullptr);
    ++met;
    EXPECT_EQ(t.status, TransitionStatus::kLeftGuard) << i << " " << t.reason;
    EXPECT_NEAR(std::abs(t.end.X_HO.theta - start.X_HO.theta), guard.angle, 1e-6) << i;
  }
  EXPECT_GT(returned, 40);
  EXPECT_GT(met, 20);
}

/// A push that turns many times, with most kinds of pads and pushers.
RandomPush winding_push(std::uint64_t index) {
  RandomPush c = random_push(31, index);
  Random random(index);
  const double sign = random.chance(0.5) ? 1.0 : -1.0;
  c.push.turn = sign * random.in(15.0, 60.0);
  return c;
}

// References are steps ten times shorter. Events are as many, but for a mode too short to
// be looked at, and no status is about the number of them.
TEST(PushEvents, WindingPushesGoOnToTheirEnd) {
  int many = 0;
  int compared = 0;
  int missed = 0;
  int too_small = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const RandomPush c = winding_push(i);
    const Model model = prepare(c.scene);
    const Transition fine =
        apply(model, c.scene.start, c.push,
              {.tolerance = 1e-10, .max_step = 0.005, .max_steps = 100000});
    Transition t;
    {
      const NoHeapScope no_heap;
      t = apply(model, c.scene.start, c.push);
    }
    EXPECT_EQ(t.status, fine.status) << i << " " << t.reason << ", " << fine.reason;
    if (!t.completed()) continue;
    const int events = t.event_count + t.more_events;
    if (events != fine.event_count + fine.more_events) ++missed;
    if (events > 16) ++many;
    ++compared;
    const double error = distance(t.end.X_HO, fine.end.X_HO, model.c);
    EXPECT_LT(error, 1e-5) << i;
    if (error > 5.0 * t.error_estimate + 1e-9) ++too_small;
  }
  EXPECT_GT(compared, 60);
  EXPECT_GT(many, 10);
  EXPECT_LE(missed, 2);
  EXPECT_LT(too_small, 0.05 * compared);
}

/// The end of a push by a point, cut into short ones that begin where the last one ended.
PlanarPose end_in_parts(const Model& model, Grasp grasp, const LinearPush& push,
                        int parts) {
  const PushContact& contact = model.contacts[push.contact];
  const Vec2 centre = 0.5 * (contact.a + contact.b);
  LinearPush part = push;
  part.travel /= parts;
  part.turn /= parts;
  part.bend /= parts;
  for (int i = 0; i < parts; ++i) {
    const Transition t = apply(model, grasp, part, {.tolerance = 1e-9});
    EXPECT_TRUE(t.completed()) << i << " " << t.reason;
    EXPECT_EQ(t.more_events, 0);
    // The pusher as the object now has it.
    const PlanarPose X_OP =
        compose(inverse(t.end.X_HO), pusher_pose(part, grasp.X_HO, 1.0));
    part.place = contact.t.dot(transform(X_OP, centre + part.place * contact.t) - centre);
    part.e = rotated(X_OP.theta + part.bend, part.e).normalized();
    grasp = t.end;
  }
  return grasp.X_HO;
}

TEST(PushEvents, ALongPushOfManyEventsIsItsParts) {
  int many = 0;
  for (std::uint64_t i = 0; i < 600; ++i) {
    RandomPush c = winding_push(i);
    c.scene.pushers[0].feature = PointFeature{};
    c.scene.g_W.setZero();  // every push would turn it to the face that it begins at
    const Model model = prepare(c.scene);
    const Transition t = apply(model, c.scene.start, c.push);
    if (!t.completed() || t.event_count + t.more_events <= 16) continue;
    ++many;
    EXPECT_EQ(t.event_count, Transition::kMaxEvents - 1);
    const PlanarPose end = end_in_parts(model, c.scene.start, c.push, 200);
    EXPECT_LT(distance(t.end.X_HO, end, model.c), 1e-5) << i;
  }
  EXPECT_GT(many, 3);
}

}  // namespace
}  // namespace prehensile
