/// What a status claims over the ellipsoid: right answers of every kind pass, whatever is
/// forged from them does not.

#include <gtest/gtest.h>

#include "mechanics/limit_surface.h"
#include "tests/mechanics/forged_instants.h"

namespace prehensile {
namespace {

using testing::Forgery;

TEST(LimitSurfaceResidual, RejectsForgeriesOfEveryKindOfAnswer) {
  testing::ForgedCounts forged;
  for (int i = 0; i < 6000; ++i) {
    const RandomInstant q = testing::instant_of_any_drive(62, i, 1);
    const LimitSurface surface{q.grasp.capacity(), 0.006};
    const PlanarWrench& w_g = q.grasp.w_g;
    const PlanarInstant right = solve_limit_surface(surface, w_g, q.drive);
    ASSERT_LE(limit_surface_residual(surface, w_g, q.drive, right), 1e-9)
        << i << " " << name(right.status);
    const double rate = point_velocity(q.drive.V_HP, q.drive.p_HC[0]).norm();
    for (const Forgery& forgery :
         testing::forgeries(right, w_g, {surface.F, surface.c, rate})) {
      const double residual =
          limit_surface_residual(surface, w_g, q.drive, forgery.answer);
      EXPECT_FALSE(residual <= 1e-6)
          << i << ", " << name(right.status) << ": " << forgery.what;
      ++forged[right.status];
    }
  }
  testing::expect_every_status(forged);
}

/// The residual judges another motion by the laws alone: a right one passes without any
/// other evidence, one that is a little off does not.
TEST(LimitSurfaceResidual, AcceptsAnotherMotionThatObeysTheLaws) {
  int others = 0;
  for (int i = 0; i < 100000; ++i) {
    const RandomInstant q = random_instant(63, i, {.points_per_pad = 1});
    const LimitSurface surface{q.grasp.capacity(), 0.006};
    const PlanarWrench& w_g = q.grasp.w_g;
    PlanarInstant answer = solve_limit_surface(surface, w_g, q.drive);
    if (answer.status != InstantStatus::kAmbiguous || !answer.other.allFinite()) continue;
    ++others;
    answer.evidence.setConstant(kNan);
    EXPECT_LE(limit_surface_residual(surface, w_g, q.drive, answer), 1e-9) << i;
    answer.other += 0.1 * (answer.other - answer.V_HO);
    EXPECT_GT(limit_surface_residual(surface, w_g, q.drive, answer), 1e-6) << i;
  }
  EXPECT_GT(others, 20);
}

}  // namespace
}  // namespace prehensile
