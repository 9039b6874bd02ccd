// Stiff and extreme data: the same instants, pushed to the edge one way at a time.
#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/extreme_instants.h"
#include "tests/mechanics/instant_cases.h"

namespace prehensile {
namespace {

using testing::told;

TEST(PlanarInstant, ExtremesEndWithEvidence) {
  for (const PlanarExtreme& extreme : planar_extremes()) {
    for (const int points : {1, 2, 4, 16, 64}) {
      for (int i = 0; i < 100; ++i) {
        const RandomInstant q = extreme_instant(extreme, 31, i, points);
        const PlanarInstant answer = solve_planar(q.grasp, q.drive);
        if (answer.status == InstantStatus::kBadInput) {
          EXPECT_TRUE(extreme.group == "denormal" || extreme.name == "grip 0 N")
              << extreme.name << ", " << points << " points, " << i;
          continue;
        }
        if (extreme.range.inertia > 0.0 &&
            answer.status == InstantStatus::kOutOfIterations) {
          continue;
        }
        const Certificate certificate = certify(q.grasp, q.drive, answer);
        EXPECT_TRUE(certificate.holds())
            << extreme.name << ", " << points << " points, " << i << ": "
            << name(answer.status) << " " << told(certificate);
        EXPECT_TRUE(!extreme.expected || extreme.expected(answer))
            << extreme.name << ", " << points << " points, " << i << ": "
            << name(answer.status);
      }
    }
  }
}

}  // namespace
}  // namespace prehensile
