/// The search for a push where the loads of the pads shift.
#include "primitives/space_place.h"

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/spatial_certificate.h"
#include "mechanics/spatial_model.h"
#include "primitives/space_grip.h"
#include "primitives/uncertainty.h"
#include "problems/random_pushes.h"

namespace prehensile {
namespace {

/// A push of a line in space that rides: what it does can be wished for.
struct Ride {
  RandomPush push;
  Model model;
  WantedMotion wanted;
};

std::vector<Ride> rides(std::uint64_t seed, int count) {
  std::vector<Ride> out;
  for (int index = 0; static_cast<int>(out.size()) < count; ++index) {
    RandomPush c = random_spatial_push(seed, index);
    c.push.bend = 0.0;
    const Model model = prepare(c.scene);
    const PushContact& contact = model.contacts[0];
    if (contact.is_point || !model.push_needs_space(contact)) continue;
    const Transition t = apply(model, c.scene.start, c.push);
    if (!t.completed() || t.event_count > 0 || t.slipped > 0.0) continue;
    const PlanarPose& from = c.scene.start.X_HO;
    out.push_back({c, model, motion_between(from, pusher_pose(c.push, from, 1.0))});
  }
  return out;
}

// What a push does is found again, by a push that does it and is at least as firm; and
// the first instant as well.
void find_what_pushes_do(int scenes) {
  int instants = 0;
  for (const Ride& ride : rides(71, scenes)) {
    const Model& model = ride.model;
    const PlaceAnswer answer = find_place(model, ride.wanted);
    ASSERT_EQ(answer.status, PlaceAnswer::Status::kFound) << answer.reason;
    const PlacedPush& best = answer.best;
    EXPECT_GE(best.slack,
              slack_in_space(model, ride.wanted, 0, ride.push.push.place) - 1e-3);
    // Made by nothing that the search has written.
    const Transition t = apply(model, ride.push.scene.start, best.push);
    EXPECT_TRUE(t.completed() && t.in_space);
    const PlanarPose end = pusher_pose(ride.push.push, ride.push.scene.start.X_HO, 1.0);
    EXPECT_NEAR(t.end.X_HO.x, end.x, kPlaceDistanceTolerance);
    EXPECT_NEAR(t.end.X_HO.y, end.y, kPlaceDistanceTolerance);
    EXPECT_NEAR(t.end.X_HO.theta, end.theta, kPlaceAngleTolerance);

    // Where it all but slips one end may creep: a ride still, but no instant to name.
    if (best.slack < 2e-3) continue;
    ++instants;
    WantedMotion instant = ride.wanted;
    instant.is_path = false;
    const PlaceAnswer first = find_place(model, instant);
    ASSERT_EQ(first.status, PlaceAnswer::Status::kFound) << first.reason;
    const PlanarTwist V = instant.twist_HO();
    const SpatialProblem problem =
        spatial_problem_at(model, model.contacts[0], first.best.push.place, instant.X_HO,
                           (SpatialTwist() << V[0], V[1], 0.0, 0.0, 0.0, V[2]).finished(),
                           {.follow_free_pressure = true});
    const SpatialInstant made = solve_spatial(problem);
    EXPECT_LE(certify(problem, made).worst, 1e-6);
    EXPECT_NEAR(made.push_force, first.best.push_force, 1e-5 * made.push_force);
    // Up to what the pads yield.
    const Vec3 off(made.V_HO[0] - V[0], made.V_HO[1] - V[1],
                   model.c * (made.V_HO[5] - V[2]));
    EXPECT_LE(off.norm(), 0.02 * Vec3(V[0], V[1], model.c * V[2]).norm());
  }
  EXPECT_GE(3 * instants, 2 * scenes);
}

TEST(SpacePlace, MotionsThatAPushMakesAreFound) { find_what_pushes_do(3); }

TEST(SpacePlace, FullMotionsThatAPushMakesAreFound) { find_what_pushes_do(30); }

// The answer survives members of the box: half of its ends, drawn anew.
void try_members_of_the_box(int scenes) {
  const Margin margin;
  int robust = 0;
  for (const Ride& ride : rides(72, scenes)) {
    const PlaceAnswer answer = find_place(ride.model, ride.wanted);
    ASSERT_TRUE(answer.best.found);
    EXPECT_LE(answer.best.robust_slack, answer.best.slack);
    if (answer.best.robust_slack < 0.0) continue;
    ++robust;
    UncertaintyBox box;
    box[Unknown::kFriction] = margin.friction;
    box[Unknown::kGripForce] = margin.force;
    box[Unknown::kPlace] = margin.place;
    box[Unknown::kCentreOfMassX] = box[Unknown::kCentreOfMassY] = margin.centre_of_mass;
    for (std::uint64_t i = 0; i < 8; ++i) {
      const UncertainPush member = vary(ride.push.scene, ride.push.scene.start,
                                        answer.best.push, box, random_point(5, i));
      const Transition t = apply(prepare(member.scene), member.start, member.push);
      EXPECT_TRUE(t.completed()) << t.reason;
      EXPECT_LT(t.slipped, 1e-6);
    }
  }
  EXPECT_GT(3 * robust, scenes);
}

TEST(SpacePlace, RobustSlackIsThatOfTheWorstMember) { try_members_of_the_box(2); }

TEST(SpacePlace, FullRobustSlackIsThatOfTheWorstMember) { try_members_of_the_box(12); }

// Less force than most margin, and still in the box.
void compare_least_force_with_most_margin(int scenes) {
  int looser = 0;
  for (const Ride& ride : rides(73, scenes)) {
    PlaceOptions options;
    options.grip_low = 0.2 * ride.model.scene.gripper.grip_force;
    options.grip_high = 1.5 * ride.model.scene.gripper.grip_force;
    const PlaceAnswer firm = find_place(ride.model, ride.wanted, options);
    options.least_force = true;
    const PlaceAnswer light = find_place(ride.model, ride.wanted, options);
    ASSERT_TRUE(firm.best.found && light.best.found);
    if (firm.best.robust_slack < 0.0) continue;
    EXPECT_GE(light.best.robust_slack, 0.0);
    EXPECT_LE(light.best.push_force, firm.best.push_force * (1.0 + 1e-9));
    looser += light.best.grip_force < 0.9 * firm.best.grip_force ? 1 : 0;
  }
  EXPECT_GT(4 * looser, scenes);
}

TEST(SpacePlace, LeastForceLoosensTheGrip) { compare_least_force_with_most_margin(2); }

TEST(SpacePlace, FullLeastForceLoosensTheGrip) {
  compare_least_force_with_most_margin(8);
}

// A pusher cannot pull. The pad plane proves it; in space it is said without a proof.
TEST(SpacePlace, WhatIsNotFoundIsNotCalledImpossible) {
  const Ride ride = rides(71, 1).front();
  WantedMotion away = ride.wanted;
  away.velocity = -away.velocity;
  away.turn = -away.turn;
  away.is_path = false;
  const PlaceAnswer answer = find_place(ride.model, away);
  EXPECT_EQ(answer.status, PlaceAnswer::Status::kNotFound);
  for (const ContactVerdict& verdict : answer.verdicts) {
    EXPECT_FALSE(verdict.proof.allFinite());
    EXPECT_FALSE(verdict.reason.empty());
  }
}

// Where the scene is symmetric a place of the pad plane sticks in space too, and with
// most of the margin that a search in space finds.
void compare_places_with_the_pad_plane(int scenes) {
  int compared = 0;
  for (int index = 0; index < scenes; ++index) {
    const RandomPush c = random_push(74, index);
    const Model model = prepare(c.scene);
    if (model.contacts[0].is_point) continue;
    const WantedMotion wanted = motion_of_twist(
        c.scene.start.X_HO, pusher_twist(c.push, c.scene.start.X_HO, 0.0));
    const PlaceAnswer flat = find_place(model, wanted);
    const double own = model.scene.gripper.grip_force;
    if (flat.status == PlaceAnswer::Status::kFound && flat.best.slack > 1e-3) {
      ++compared;
      EXPECT_GE(slack_in_space(model, wanted, 0, flat.best.push.place), 0.0) << index;
      EXPECT_GE(best_place_in_space(model, wanted, 0, own, own).slack, 0.0) << index;
    } else if (flat.status == PlaceAnswer::Status::kImpossible) {
      ++compared;
      EXPECT_LT(best_place_in_space(model, wanted, 0, own, own).slack, 1e-6) << index;
    }
  }
  EXPECT_GT(24 * compared, 5 * scenes);
}

TEST(SpacePlace, PlacesOfThePadPlaneStickWhereTheSceneIsSymmetric) {
  compare_places_with_the_pad_plane(30);
}

TEST(SpacePlace, FullPlacesOfThePadPlaneStickWhereTheSceneIsSymmetric) {
  compare_places_with_the_pad_plane(120);
}

// Curves run through the answer, and end where the object does not make the motion.
TEST(SpacePlace, SlackAtThePlaceFoundIsThatOfTheAnswer) {
  for (const Ride& ride : rides(71, 4)) {
    const PlacedPush best = find_place(ride.model, ride.wanted).best;
    ASSERT_TRUE(best.found);
    const Margin margin = PlaceOptions{}.margin;
    const PlaceSlack slack =
        slack_at(ride.model, ride.wanted, best.push.contact, best.push.place, margin);
    EXPECT_DOUBLE_EQ(slack.nominal, best.slack);
    // Where a member of the box does not make the motion there is no curve.
    if (best.robust_slack == kNoMotionInSpace) {
      EXPECT_TRUE(std::isnan(slack.robust));
    } else {
      EXPECT_DOUBLE_EQ(slack.robust, best.robust_slack);
      EXPECT_LE(slack.robust, slack.nominal);
    }

    WantedMotion back = ride.wanted;
    back.velocity *= -1.0;
    const PlaceSlack none =
        slack_at(ride.model, back, best.push.contact, best.push.place, margin);
    EXPECT_FALSE(none.nominal >= 0.0);
  }
}

// A point makes a wanted motion at one place only: nothing to be drawn over places.
TEST(SpacePlace, APointInSpaceHasNoSlackOverPlaces) {
  for (int index = 0;; ++index) {
    const RandomPush c = random_spatial_push(72, index);
    const Model model = prepare(c.scene);
    if (!model.contacts[0].is_point || !model.push_needs_space(model.contacts[0]))
      continue;
    const WantedMotion wanted = motion_of_twist(c.scene.start.X_HO, {0.01, 0.0, 0.0});
    const PlaceSlack slack = slack_at(model, wanted, 0, 0.0, Margin::none());
    EXPECT_TRUE(std::isnan(slack.nominal) && std::isnan(slack.robust));
    return;
  }
}

}  // namespace
}  // namespace prehensile
