/// Laws of finite pushes: symmetries, and what pushes make of each other.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/certificate.h"
#include "primitives/linear_push.h"
#include "problems/random_pushes.h"
#include "tests/primitives/push_checks.h"

namespace prehensile {
namespace {

using testing::distance;
using testing::expect_left_behind;
using testing::expect_parts_make_whole;
using testing::has_event;
using testing::may_be_cut;
using testing::mirrored;
using testing::object_at_pusher;
using testing::part_of;

TEST(PushLaw, MirrorImagesMoveAsMirrorImages) {
  for (int seed = 0; seed < 300; ++seed) {
    const RandomPush c = random_push(1, seed);
    const RandomPush m = mirrored(c);
    const TransitionOptions options{.tolerance = 1e-7};
    const Transition one = apply(prepare(c.scene), c.scene.start, c.push, options);
    const Transition other = apply(prepare(m.scene), m.scene.start, m.push, options);
    ASSERT_EQ(one.status, other.status) << seed;
    EXPECT_LT(distance(one.end.X_HO, mirrored(other.end.X_HO), 0.01), 2e-7) << seed;
  }
}

TEST(PushLaw, PushInTwoPartsEndsWhereTheWholePushEnds) {
  int compared = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const RandomPush c = random_push(1, seed);
    const Model model = prepare(c.scene);
    const TransitionOptions options{.tolerance = 1e-8};
    const Transition whole = apply(model, c.scene.start, c.push, options);
    if (!whole.completed() || has_event(whole, EventKind::kCorner) ||
        !may_be_cut(model)) {
      continue;
    }
    SCOPED_TRACE(seed);
    expect_parts_make_whole(model, c, whole, options, 1e-7);
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

// A point has no face to lie flush on: its push may be cut wherever gravity is absent,
// which would turn with the object.
TEST(PushLaw, PushOfAPointInTwoPartsEndsWhereTheWholePushEnds) {
  int compared = 0;
  for (int seed = 0; seed < 400; ++seed) {
    RandomPush c = random_push(4, seed);
    c.scene.g_W.setZero();
    const Model model = prepare(c.scene);
    if (!model.contacts[0].is_point) continue;
    const TransitionOptions options{.tolerance = 1e-9};
    const Transition whole = apply(model, c.scene.start, c.push, options);
    if (!whole.completed()) continue;
    const Transition one = apply(model, c.scene.start, part_of(c.push, 0.4), options);
    ASSERT_TRUE(one.completed()) << seed;
    // Where the point and the direction are, seen from the object.
    const PlanarPose X_PO =
        compose(inverse(pusher_pose(c.push, c.scene.start.X_HO, 0.4)), one.end.X_HO);
    const PushContact& contact = model.contacts[0];
    const Vec2 p_P = contact.segment(c.push.place).a;
    const Vec2 p_O = transform(inverse(X_PO), p_P);
    LinearPush second = part_of(c.push, 0.6);
    second.place = contact.t.dot(p_O - 0.5 * (contact.a + contact.b));
    second.e = rotated(-X_PO.theta, c.push.e);
    const Transition two = apply(model, one.end, second, options);
    ASSERT_TRUE(two.completed()) << seed << " " << two.reason;
    EXPECT_LT(distance(two.end.X_HO, whole.end.X_HO, model.c), 1e-7) << seed;
    ++compared;
  }
  EXPECT_GT(compared, 60);
}

// The fourth phase of a push: the pusher leaves, and the grasp that it leaves behind
// holds the object at rest.
TEST(PushLaw, RetractingThePusherLeavesAGraspThatHoldsGravity) {
  int flush = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const RandomPush c = random_push(5, seed);
    const Model model = prepare(c.scene);
    const Transition done = apply(model, c.scene.start, c.push);
    if (!done.completed()) continue;
    const PlanarPose X_PO = object_at_pusher(c, done);
    const Vec2 g_O = rotated(-X_PO.theta, model.contacts[0].g_O);
    EXPECT_GE(gravity_slack(grasp_at(model, done.end.X_HO, g_O)), 0.0) << seed;
    if (std::abs(X_PO.theta) > 0.0) continue;
    SCOPED_TRACE(seed);
    expect_left_behind(model, c, done);
    ++flush;
  }
  EXPECT_GT(flush, 60);
}

// A screw: with bend = -turn every point of the pusher moves on a circle about one point
// of the hand. A line that sticks takes the object along on it.
TEST(PushLaw, ScrewTurnsThePusherAboutOnePointOfTheHand) {
  int rides = 0;
  for (int seed = 0; seed < 300; ++seed) {
    RandomPush c = random_push(6, seed);
    if (c.push.turn == 0.0) continue;
    c.push.bend = -c.push.turn;
    const PlanarPose& X_HO = c.scene.start.X_HO;
    const PlanarTwist V = pusher_twist(c.push, X_HO, 0.0);
    const Vec2 centre = perp(Vec2(V[0], V[1])) / V[2];
    for (const double s : {0.3, 1.0}) {
      EXPECT_NEAR((pusher_twist(c.push, X_HO, s) - V).norm(), 0.0, 1e-14);
      const Vec2 there = translation(pusher_pose(c.push, X_HO, s)) - centre;
      const Vec2 turned = rotated(s * c.push.turn, translation(X_HO) - centre);
      EXPECT_NEAR((there - turned).norm(), 0.0, 1e-14);
    }
    const Model model = prepare(c.scene);
    const Transition t = apply(model, c.scene.start, c.push);
    if (!t.completed() || t.event_count > 0 || t.slipped > 0.0) continue;
    if (model.contacts[0].is_point) continue;
    EXPECT_LT(distance(t.end.X_HO, pusher_pose(c.push, X_HO, 1.0), 0.1), 1e-12);
    ++rides;
  }
  EXPECT_GT(rides, 15);
}

TEST(PushLaw, ArcsConvergeToTheirReference) {
  int slips = 0;
  for (int seed = 0; seed < 120; ++seed) {
    RandomPush c = random_push(7, seed);
    c.push.bend = seed % 2 == 0 ? -c.push.turn : 0.8;
    const Model model = prepare(c.scene);
    for (const FrictionModel friction :
         {FrictionModel::kPads, FrictionModel::kEllipsoid}) {
      const TransitionOptions fine{.tolerance = 1e-11,
                                   .max_step = 0.01,
                                   .max_steps = 100000,
                                   .friction_model = friction};
      const Transition reference = apply(model, c.scene.start, c.push, fine);
      const Transition t =
          apply(model, c.scene.start, c.push, {.friction_model = friction});
      ASSERT_EQ(t.status, reference.status) << seed << " " << t.reason;
      EXPECT_LT(distance(t.end.X_HO, reference.end.X_HO, model.c), 3e-6) << seed;
      slips += t.slipped > 1e-6 ? 1 : 0;
    }
  }
  EXPECT_GT(slips, 30);
}

}  // namespace
}  // namespace prehensile
