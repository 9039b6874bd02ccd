#include "mechanics/proximal_newton.h"

#include <iostream>

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/random_instants.h"

namespace prehensile {
namespace {

/// Two solvers that share the pads and nothing of the algorithm: Newton's method on the
/// whole instant, and the list of pusher modes.
TEST(ProximalNewton, AgreesWithTheModes) {
  int compared = 0;
  int unsolved = 0;
  for (int i = 0; i < 6000; ++i) {
    const int points = i % 3 == 0 ? 4 : i % 3 == 1 ? 8 : 16;
    const RandomInstant q = random_instant(41, i, {.points_per_pad = points});
    const PlanarInstant modes = solve_planar(q.grasp, q.drive);
    if (modes.status != InstantStatus::kMoves) continue;
    const PadFriction::Frame frame = PadFriction::frame_of(q.grasp);
    const PadFriction pads(q.grasp, frame, false);
    const ScaledPush push =
        scaled(q.grasp.w_g, q.drive, frame.centre, frame.length, frame.force);
    const NewtonAnswer newton = solve_proximal_newton(pads, push, Eigen::Matrix3d::Zero(),
                                                      PlanarTwist::Zero(), 1e-10, 1000);
    if (!newton.converged) {
      ++unsolved;
      continue;
    }
    ++compared;
    const PlanarTwist V = twist_in_hand(push, newton.u);
    EXPECT_NEAR((V - modes.V_HO).norm(), 0.0, 1e-5 * (modes.V_HO.norm() + 1e-2)) << i;
    double normal = 0.0;
    double expected = 0.0;
    for (int k = 0; k < push.count; ++k) {
      normal += frame.force * newton.normal[k];
      expected += modes.pusher[k].normal_force;
    }
    EXPECT_NEAR(normal, expected, 1e-7 * frame.force) << i;
  }
  std::cout << "Newton unsolved: " << unsolved << " of " << compared + unsolved << "\n";
  EXPECT_GT(compared, 4500);
  EXPECT_LE(unsolved, compared / 1000);
}

TEST(ProximalNewton, SaysHowFarItIsWhenItRunsOutOfSteps) {
  const RandomInstant q =
      random_instant(42, 3, {.points_per_pad = 16, .pusher_points = 1});
  const PadFriction::Frame frame = PadFriction::frame_of(q.grasp);
  const PadFriction pads(q.grasp, frame, false);
  const ScaledPush push =
      scaled(q.grasp.w_g, q.drive, frame.centre, frame.length, frame.force);
  const NewtonAnswer newton = solve_proximal_newton(pads, push, Eigen::Matrix3d::Zero(),
                                                    PlanarTwist::Zero(), 1e-10, 1);
  EXPECT_FALSE(newton.converged);
  EXPECT_GT(newton.residual, 1e-10);
}

}  // namespace
}  // namespace prehensile
