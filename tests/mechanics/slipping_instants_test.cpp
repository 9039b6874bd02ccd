#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/random_instants.h"

namespace prehensile {
namespace {

/// Whether the object slips along the pusher or leaves it at one end.
bool slides_or_tips(const PlanarInstant& instant, double rate) {
  for (int k = 0; k < instant.pusher_count; ++k) {
    const PusherPoint& point = instant.pusher[static_cast<std::size_t>(k)];
    if (std::abs(point.slip_rate) > 1e-3 * rate || point.normal_rate > 1e-3 * rate) {
      return true;
    }
  }
  return false;
}

/// However an object slides along its pusher or tips on one end of it, the same pusher
/// makes it move in the same way by sticking, if it moves as the object does: friction
/// on the edge of its cone is friction in its cone. So plans of sticking pushes miss no
/// motion.
TEST(SlippingInstants, AreMotionsOfStickingPushesToo) {
  int slipping = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const RandomInstant question = random_instant(11, i);
    const PlanarInstant slips = solve_planar(question.grasp, question.drive);
    const double rate = 0.01;  // [m/s] of every push in this set
    if (slips.status != InstantStatus::kMoves || !slides_or_tips(slips, rate)) continue;
    PlanarDrive drive = question.drive;
    drive.V_HP = slips.V_HO;
    const PlanarInstant sticks = solve_planar(question.grasp, drive);
    ++slipping;
    ASSERT_TRUE(usable(sticks.status)) << i << ": " << name(sticks.status);
    EXPECT_LE((sticks.V_HO - slips.V_HO).head<2>().norm(), 1e-6 * rate) << i;
    EXPECT_LE(std::abs(sticks.V_HO[2] - slips.V_HO[2]), 1e-4 * rate / 0.01) << i;
    if (sticks.status == InstantStatus::kMoves) {
      EXPECT_NEAR(sticks.push_force, slips.push_force, 1e-5 * slips.push_force) << i;
    }
    EXPECT_FALSE(slides_or_tips(sticks, rate)) << i;
  }
  EXPECT_GE(slipping, 500);
}

}  // namespace
}  // namespace prehensile
