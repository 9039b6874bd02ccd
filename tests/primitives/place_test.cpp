#include "primitives/place.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/random_pushes.h"
#include "problems/random_stream.h"

namespace prehensile {
namespace {

/// A random grasp with pads on the object, and motions to wish for.
struct Wish {
  Model model;
  WantedMotion motion;
};

Wish random_wish(std::uint64_t seed, int index, bool likely) {
  RandomStream stream(seed + 1000003u * static_cast<std::uint64_t>(index));
  for (std::uint64_t k = 0;; ++k) {
    const RandomPush random =
        random_push(seed, 100u * static_cast<std::uint64_t>(index) + k);
    Wish wish{prepare(random.scene), {}};
    const PlanarPose& X_HO = random.scene.start.X_HO;
    if (!pads_on_object(wish.model, X_HO) || !(wish.model.c > 0.0)) continue;
    const double angle = stream.in(-std::numbers::pi, std::numbers::pi);
    double turn = stream.in(-1.0, 1.0) / wish.model.c * 0.5;
    Vec2 v = rotated(angle, Vec2(1.0, 0.0));
    if (likely) {
      // Along the normal of a face, and hardly turning.
      v = rotated(X_HO.theta + stream.in(-0.3, 0.3), wish.model.contacts[0].n);
      turn *= 0.2;
    }
    wish.motion = motion_of_twist(X_HO, {v.x(), v.y(), turn});
    return wish;
  }
}

/// The forward instant, by nothing that the search has written.
PlanarInstant instant_of(const Wish& wish, const PlacedPush& placed) {
  Scene scene = wish.model.scene;
  scene.gripper.grip_force = placed.grip_force;
  const Model model = prepare(scene, wish.model.options);
  const PushContact& contact = model.contacts[placed.push.contact];
  return solve_planar(
      grasp_at(model, wish.motion.X_HO, contact.g_O),
      drive_at(contact, placed.push.place, wish.motion.X_HO, wish.motion.twist_HO()));
}

double error_of(const PlanarTwist& got, const PlanarTwist& wanted, double c) {
  return std::hypot(got[0] - wanted[0], got[1] - wanted[1], c * (got[2] - wanted[2])) /
         std::hypot(wanted[0], wanted[1], c * wanted[2]);
}

/// Counts of answers; every one is checked.
struct Count {
  int found = 0, impossible = 0, not_found = 0;
};

Count check_wishes(std::uint64_t seed, int count) {
  Count out;
  for (int i = 0; i < count; ++i) {
    const Wish wish = random_wish(seed, i, i % 2 == 0);
    const PlaceOptions options{.grip_low = i % 3 == 0 ? 5.0 : 0.0,
                               .grip_high = i % 3 == 0 ? 80.0 : 0.0,
                               .least_force = i % 5 == 0};
    const PlaceAnswer answer = find_place(wish.model, wish.motion, options);
    switch (answer.status) {
      case PlaceAnswer::Status::kFound: {
        ++out.found;
        const PlanarInstant instant = instant_of(wish, answer.best);
        EXPECT_TRUE(usable(instant.status)) << i;
        EXPECT_LE(error_of(instant.V_HO, wish.motion.twist_HO(), wish.model.c), 1e-5)
            << i;
        EXPECT_GE(answer.best.slack, -1e-6);
        break;
      }
      case PlaceAnswer::Status::kImpossible:
        ++out.impossible;
        for (const ContactVerdict& verdict : answer.verdicts) {
          EXPECT_TRUE(proves(wish.model, wish.motion, options, verdict)) << i;
        }
        break;
      default:
        ++out.not_found;
        EXPECT_FALSE(answer.reason.empty()) << i;
    }
  }
  return out;
}

/// Poses to be reached in one push: every push that is named is done, with a model made
/// afresh, and must end there.
Count check_paths(std::uint64_t seed, int count) {
  Count out;
  RandomStream stream(seed);
  for (int i = 0; i < count; ++i) {
    const Wish wish = random_wish(seed, i, i % 4 != 0);
    const double way = stream.in(0.5e-3, 5e-3);
    const PlanarTwist V = way * wish.motion.twist_HO();
    const PlanarPose from = wish.motion.X_HO;
    const PlanarPose to{from.x + V[0], from.y + V[1], from.theta + V[2]};
    const PlaceOptions options{.grip_low = i % 3 == 0 ? 5.0 : 0.0,
                               .grip_high = i % 3 == 0 ? 80.0 : 0.0};
    const PlaceAnswer answer = find_place(wish.model, motion_between(from, to), options);
    out.impossible += answer.status == PlaceAnswer::Status::kImpossible ? 1 : 0;
    out.not_found += answer.status == PlaceAnswer::Status::kNotFound ? 1 : 0;
    if (answer.status != PlaceAnswer::Status::kFound) continue;
    ++out.found;
    Scene scene = wish.model.scene;
    scene.gripper.grip_force = answer.best.grip_force;
    const Transition done = apply(prepare(scene, wish.model.options), Grasp{from, 0.0},
                                  answer.best.push, {.tolerance = 1e-8});
    EXPECT_TRUE(done.completed()) << i << ' ' << done.reason;
    const Vec2 off(done.end.X_HO.x - to.x, done.end.X_HO.y - to.y);
    EXPECT_LE(off.norm(), kPlaceDistanceTolerance) << i;
    EXPECT_LE(std::abs(done.end.X_HO.theta - to.theta), kPlaceAngleTolerance) << i;
    EXPECT_LE(done.worst_certificate, 1e-6) << i;
  }
  return out;
}

TEST(Place, PushesThatAreNamedEndWhereTheyShould) {
  EXPECT_GT(check_paths(45, 100).found, 20);
}

TEST(Place, FullThousandPathsEndWhereTheyShould) {
  const Count count = check_paths(47, 1000);
  EXPECT_GT(count.found, 200);
  std::printf("%d found, %d impossible, %d not found\n", count.found, count.impossible,
              count.not_found);
}

TEST(Place, MeetsWhatIsWantedOrProvesThatNobodyCan) {
  const Count count = check_wishes(41, 120);
  EXPECT_GT(count.found, 20);
  EXPECT_GT(count.impossible, 20);
}

TEST(Place, FullThousandWishes) {
  const Count count = check_wishes(43, 1000);
  EXPECT_GT(count.found, 200);
  RecordProperty("found", count.found);
  RecordProperty("impossible", count.impossible);
  RecordProperty("not_found", count.not_found);
}

TEST(Place, WhatAPusherDoesCanBeWished) {
  RandomStream stream(8);
  int asked = 0, found = 0;
  for (int i = 0; i < 150; ++i) {
    Wish wish = random_wish(47, i, true);
    const PushContact& contact = wish.model.contacts[0];
    const double half = 0.5 * (contact.b - contact.a).norm();
    const double place = stream.in(-0.6, 0.6) * half;
    const PlanarPose X_HO = wish.motion.X_HO;
    const PlanarInstant instant =
        solve_planar(grasp_at(wish.model, X_HO, contact.g_O),
                     drive_at(contact, place, X_HO, wish.motion.twist_HO()));
    // What slips is not in the search: only pushers that stick are.
    bool sticks = instant.status == InstantStatus::kMoves;
    for (int k = 0; k < instant.pusher_count; ++k) {
      sticks = sticks && instant.pusher[k].mode == ContactMode::kStick;
    }
    if (!sticks) continue;
    ++asked;
    wish.motion = motion_of_twist(X_HO, instant.V_HO);
    found += find_place(wish.model, wish.motion).status == PlaceAnswer::Status::kFound;
  }
  EXPECT_GT(asked, 30);
  EXPECT_EQ(found, asked);
}

TEST(Place, ImpossibleMeansThatNoPushOfTheContactDoesIt) {
  RandomStream stream(5);
  int proved = 0;
  for (int i = 0; i < 60; ++i) {
    const Wish wish = random_wish(53, i, false);
    const PlaceAnswer answer = find_place(wish.model, wish.motion);
    if (answer.status != PlaceAnswer::Status::kImpossible) continue;
    ++proved;
    const PlanarPose& X_HO = wish.motion.X_HO;
    for (int k = 0; k < 200; ++k) {
      const PushContact& contact =
          wish.model.contacts[stream.below(static_cast<int>(wish.model.contacts.size()))];
      const double half = 0.5 * (contact.b - contact.a).norm();
      PlanarTwist V = wish.motion.twist_HO();
      // The wanted motion, and others: a pusher that slips moves otherwise.
      if (k > 0) {
        V += V.head<2>().norm() * PlanarTwist(stream.in(-1.0, 1.0), stream.in(-1.0, 1.0),
                                              stream.in(-1.0, 1.0) / wish.model.c);
      }
      const PlanarInstant instant =
          solve_planar(grasp_at(wish.model, X_HO, contact.g_O),
                       drive_at(contact, stream.in(-half, half), X_HO, V));
      if (!usable(instant.status) || instant.V_HO.isZero(1e-9)) continue;
      const PlanarTwist got =
          instant.V_HO * (wish.motion.twist_HO().norm() / instant.V_HO.norm());
      EXPECT_GT(error_of(got, wish.motion.twist_HO(), wish.model.c), 1e-6) << i;
    }
  }
  EXPECT_GT(proved, 15);
}

TEST(Place, AFalseProofIsNone) {
  int tried = 0;
  for (int i = 0; i < 40; ++i) {
    const Wish wish = random_wish(59, i, false);
    for (const ContactVerdict& verdict : verdicts_of(wish.model, wish.motion, {})) {
      if (!verdict.proof.allFinite()) continue;
      ++tried;
      EXPECT_TRUE(proves(wish.model, wish.motion, {}, verdict));
      ContactVerdict turned = verdict;
      turned.proof = -verdict.proof;
      EXPECT_FALSE(proves(wish.model, wish.motion, {}, turned));
    }
  }
  EXPECT_GT(tried, 10);
}

TEST(Place, NearestMotionIsPossibleAndNearerThanItsNeighbours) {
  int found = 0, asked = 0;
  for (int i = 0; i < 25; ++i) {
    const Wish wish = random_wish(61, i, false);
    if (find_place(wish.model, wish.motion).status != PlaceAnswer::Status::kImpossible) {
      continue;
    }
    ++asked;
    const NearestMotion nearest = nearest_motion(wish.model, wish.motion);
    if (!nearest.found) continue;
    ++found;
    EXPECT_GT(nearest.angle, 0.0);
    Wish other{wish.model, nearest.motion};
    const PlanarInstant instant = instant_of(other, nearest.answer.best);
    EXPECT_LE(error_of(instant.V_HO, nearest.motion.twist_HO(), wish.model.c), 1e-5);
  }
  EXPECT_GT(asked, 5);
  EXPECT_GE(10 * found, 6 * asked);
}

TEST(Place, LeastForceIsNotAboveThatOfMostMargin) {
  int compared = 0;
  for (int i = 0; i < 40; ++i) {
    const Wish wish = random_wish(67, i, true);
    PlaceOptions options{.grip_low = 5.0, .grip_high = 60.0};
    const PlaceAnswer margin = find_place(wish.model, wish.motion, options);
    options.least_force = true;
    const PlaceAnswer force = find_place(wish.model, wish.motion, options);
    ASSERT_EQ(margin.status, force.status);
    if (margin.status != PlaceAnswer::Status::kFound) continue;
    if (margin.best.robust_slack < 0.0) continue;
    ++compared;
    EXPECT_GE(force.best.robust_slack, 0.0);
    EXPECT_LE(force.best.push_force, margin.best.push_force * (1.0 + 1e-6));
    EXPECT_GE(margin.best.robust_slack, force.best.robust_slack - 1e-6);
  }
  EXPECT_GT(compared, 3);
}

TEST(Place, BadQuestionsAreNamed) {
  const Wish wish = random_wish(71, 0, true);
  WantedMotion still = wish.motion;
  still.velocity = Vec2::Zero();
  still.turn = 0.0;
  EXPECT_EQ(find_place(wish.model, still).status, PlaceAnswer::Status::kBadInput);
  EXPECT_EQ(
      find_place(wish.model, wish.motion, {.grip_low = 5.0, .grip_high = 1.0}).status,
      PlaceAnswer::Status::kBadInput);
  WantedMotion off = wish.motion;
  off.X_HO.x += 1.0;
  EXPECT_FALSE(find_place(wish.model, off).reason.empty());
}

}  // namespace
}  // namespace prehensile
