// Stiff and extreme data: the same instants, pushed to the edge one way at a time.
#include <numbers>

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/extreme_instants.h"
#include "tests/mechanics/instant_cases.h"

namespace prehensile {
namespace {

using testing::disc_grasp;
using testing::line_drive;
using testing::point_drive;
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

/// A pusher along one of four faces, off by `towards` [rad] to the object.
PlanarDrive along_face(int points, int face, double place, double mu, double side,
                       double towards) {
  const double inwards = 0.5 * std::numbers::pi * face;
  const Vec2 n(std::cos(inwards), std::sin(inwards));
  const double way = inwards + side * (0.5 * std::numbers::pi - towards);
  const Vec2 v(0.01 * std::cos(way), 0.01 * std::sin(way));
  const Vec2 at = -0.05 * n + place * perp(n);
  return points == 2 ? line_drive(at, 0.01, n, mu, v) : point_drive(at, n, mu, v);
}

/// The approach of a pusher along its face is rounding. A mode scaled to it is no motion:
/// second motions are found only where friction does drag the object along.
TEST(PlanarInstant, PushesAlongAFaceEndWithEvidenceWhenProbed) {
  PlanarGrasp grasp = disc_grasp(16, 0.01, 16.0);
  grasp.w_g = {0.0, -2.0, 0.0};
  int rests = 0;
  int drags = 0;
  for (const int points : {1, 2}) {
    for (int face = 0; face < 4; ++face) {
      for (int place = -6; place <= 6; ++place) {
        for (const double mu : {0.0, 0.1, 0.3, 0.8, 5.0}) {
          for (const double side : {1.0, -1.0}) {
            const PlanarDrive drive =
                along_face(points, face, 0.0047 * place, mu, side, 0.0);
            EXPECT_EQ(solve_planar(grasp, drive).status, InstantStatus::kHolds);
            const PlanarInstant probed =
                solve_planar(grasp, drive, {.probe_multiplicity = true});
            const Certificate certificate = certify(grasp, drive, probed);
            EXPECT_TRUE(certificate.holds())
                << points << " points, face " << face << ", place " << place << ", mu "
                << mu << ": " << name(probed.status) << " " << told(certificate);
            ++(probed.status == InstantStatus::kHolds ? rests : drags);
          }
        }
      }
    }
  }
  EXPECT_GT(rests, 700);
  EXPECT_GT(drags, 10);
}

/// However little the pusher approaches, an object on one point may swing off it, and
/// that is another motion.
TEST(PlanarInstant, GrazingPushesOfAPointPadEndWithEvidence) {
  const PlanarGrasp grasp = testing::grasp_of({{0.0, 0.0}}, 16.0);
  for (const int points : {1, 2}) {
    for (int face = 0; face < 4; ++face) {
      for (int place = -6; place <= 6; ++place) {
        for (const double towards : {1e-3, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12}) {
          for (const double side : {1.0, -1.0}) {
            const PlanarDrive drive =
                along_face(points, face, 0.0047 * place, 0.3, side, towards);
            const PlanarInstant answer = solve_planar(grasp, drive);
            const Certificate certificate = certify(grasp, drive, answer);
            EXPECT_TRUE(certificate.holds())
                << points << " points, face " << face << ", place " << place << ", "
                << towards << ": " << name(answer.status) << " " << told(certificate);
            const bool swings = std::abs(place) > points - 1 && std::abs(place) > 2;
            EXPECT_TRUE(!swings || answer.status == InstantStatus::kAmbiguous)
                << points << " points, face " << face << ", place " << place << ", "
                << towards << ": " << name(answer.status);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace prehensile
