#include "primitives/ride_bound.h"

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/contact_mode.h"
#include "problems/random_pushes.h"

namespace prehensile {
namespace {

struct Look {
  PlanarGrasp grasp;
  PlanarDrive drive;
  RideMargin margin;
};

/// What keeps the line of a random push sticking after the share s, by the mechanics.
Look look(const Model& model, const RandomPush& c, double s) {
  const PlanarPose& X_HO_start = c.scene.start.X_HO;
  const PlanarPose X_HO = pusher_pose(c.push, X_HO_start, s);
  Look now;
  now.grasp = grasp_at(model, X_HO, model.contacts[0].g_O);
  now.drive = drive_at(model.contacts[0], c.push.place, X_HO,
                       pusher_twist(c.push, X_HO_start, s));
  const MotionInMode motion =
      solve_planar_in_mode(now.grasp, now.drive, {ContactModeOfPush::Load::kBoth, 0});
  now.margin.normal_force = motion.normal_force;
  now.margin.friction_left =
      now.drive.mu * (motion.normal_force[0] + motion.normal_force[1]) -
      std::abs(motion.tangential_force[0] + motion.tangential_force[1]);
  return now;
}

// The bound is a promise: no margin of any ride is negative before the share it names.
TEST(RideBound, NothingHappensBeforeTheShareItNames) {
  int promised = 0;
  double named = 0.0;
  for (int index = 0; index < 600; ++index) {
    RandomPush c = random_push(8, index);
    c.scene.overhang = Overhang::kIgnore;
    if (c.push.turn == 0.0) c.push.turn = 0.3;
    if (index % 3 == 0) c.push.bend = -c.push.turn;
    const Model model = prepare(c.scene);
    if (model.contacts[0].is_point) continue;
    const Look start = look(model, c, 0.0);
    const double share = sure_to_last(start.grasp, start.drive, c.push.turn,
                                      c.push.travel * c.push.bend, start.margin, 1.0);
    if (share == 0.0) continue;
    ++promised;
    named += share;
    for (int i = 1; i <= 40; ++i) {
      const RideMargin there = look(model, c, share * i / 40.0).margin;
      EXPECT_GE(std::min(there.normal_force[0], there.normal_force[1]), 0.0) << index;
      EXPECT_GE(there.friction_left, 0.0) << index;
    }
  }
  EXPECT_GT(promised, 60);
  EXPECT_GT(named / promised, 0.1);
}

TEST(RideBound, PromisesNothingWithoutAMargin) {
  const RandomPush c = random_push(8, 1);
  const Model model = prepare(c.scene);
  const Look start = look(model, c, 0.0);
  EXPECT_EQ(sure_to_last(start.grasp, start.drive, 0.1, 0.0, {{-1.0, 1.0}, 1.0}, 1.0),
            0.0);
  EXPECT_EQ(sure_to_last(start.grasp, start.drive, 0.1, 0.0, {{1.0, 1.0}, 0.0}, 1.0),
            0.0);
}

}  // namespace
}  // namespace prehensile
