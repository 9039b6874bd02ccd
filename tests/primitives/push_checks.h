/// Measures of pushes that several tests need.
#pragma once

#include <cmath>

#include <gtest/gtest.h>

#include "primitives/linear_push.h"
#include "primitives/transition.h"
#include "problems/random_pushes.h"

namespace prehensile::testing {

inline bool has_event(const Transition& transition, EventKind kind) {
  for (int i = 0; i < transition.event_count; ++i) {
    if (transition.events[i].kind == kind) return true;
  }
  return false;
}

/// Distance of two poses [m]; angles weigh c.
inline double distance(const PlanarPose& one, const PlanarPose& other, double c) {
  return Vec3(one.x - other.x, one.y - other.y, c * (one.theta - other.theta)).norm();
}

/// The same push mirrored in the x axis of the hand and of the object.
inline RandomPush mirrored(RandomPush c) {
  const auto flip = [](Vec2& v) { v.y() = -v.y(); };
  flip(c.scene.g_W);
  c.scene.pushers[0].normal_angle *= -1.0;
  c.push.place *= -1.0;
  flip(c.push.e);
  c.push.turn *= -1.0;
  c.push.bend *= -1.0;
  c.scene.start.X_HO.y *= -1.0;
  c.scene.start.X_HO.theta *= -1.0;
  return c;
}

/// The same pose mirrored in the x axes.
inline PlanarPose mirrored(const PlanarPose& pose) {
  return {pose.x, -pose.y, -pose.theta};
}

/// This share of the way of a push, and of its turn.
inline LinearPush part_of(LinearPush push, double share) {
  push.travel *= share;
  push.turn *= share;
  return push;
}

/// Whether a push of this contact may be cut: the second part starts flush, so the first
/// has to end so.
inline bool may_be_cut(const Model& model) {
  return !model.contacts[0].is_point && std::isinf(model.contacts[0].half_length);
}

/// Expects a push in two parts to end within `tolerance` [m] of where the whole one ends.
inline void expect_parts_make_whole(const Model& model, const RandomPush& c,
                                    const Transition& whole,
                                    const TransitionOptions& options, double tolerance) {
  const Transition one = apply(model, c.scene.start, part_of(c.push, 0.4), options);
  ASSERT_TRUE(one.completed()) << one.reason;
  const Transition two = apply(model, one.end, part_of(c.push, 0.6), options);
  ASSERT_TRUE(two.completed()) << two.reason;
  EXPECT_LT(distance(two.end.X_HO, whole.end.X_HO, model.c), tolerance);
}

/// Where the object is against the pusher of a push that is done.
inline PlanarPose object_at_pusher(const RandomPush& c, const Transition& done) {
  return compose(inverse(pusher_pose(c.push, c.scene.start.X_HO, 1.0)), done.end.X_HO);
}

/// Expects a pusher that is drawn straight back from a flush face to leave the object
/// where it is. Friction may drag an object along with a pusher that leaves it askew.
inline void expect_left_behind(const Model& model, const RandomPush& c,
                               const Transition& done) {
  const PushContact& contact = model.contacts[0];
  const Vec2 moved = translation(object_at_pusher(c, done));
  const LinearPush away{
      .place = c.push.place - contact.t.dot(moved), .e = -contact.n, .travel = 0.005};
  const Transition left = apply(model, done.end, away);
  EXPECT_EQ(left.status, TransitionStatus::kPusherLost) << left.reason;
  EXPECT_LT(distance(left.end.X_HO, done.end.X_HO, 0.1), 1e-15);
}

}  // namespace prehensile::testing
