/// What a status claims: right answers of every kind pass, whatever is forged from them
/// does not.
#include "mechanics/certificate_evidence.h"

#include <gtest/gtest.h>

#include "mechanics/certificate.h"
#include "mechanics/planar_instant.h"
#include "tests/mechanics/forged_instants.h"
#include "tests/mechanics/instant_cases.h"

namespace prehensile {
namespace {

using testing::Forgery;
using testing::told;

TEST(CertificateEvidence, RejectsForgeriesOfEveryKindOfAnswer) {
  testing::ForgedCounts forged;
  for (int i = 0; i < 2400; ++i) {
    const int points = i % 3 == 0 ? 1 : i % 3 == 1 ? 4 : 16;
    const RandomInstant q = testing::instant_of_any_drive(61, i, points);
    const PlanarInstant right =
        solve_planar(q.grasp, q.drive, {.probe_multiplicity = i % 5 == 0});
    const Certificate certificate = certify(q.grasp, q.drive, right);
    ASSERT_TRUE(certificate.holds())
        << i << " " << name(right.status) << ": " << told(certificate);
    const CertificateUnits units = certificate_units(q.grasp, q.drive);
    for (const Forgery& forgery : testing::forgeries(
             right, q.grasp.w_g, {units.force, units.length, units.rate})) {
      EXPECT_FALSE(certify(q.grasp, q.drive, forgery.answer).holds())
          << i << ", " << name(right.status) << ": " << forgery.what;
      ++forged[right.status];
    }
  }
  testing::expect_every_status(forged);
}

/// Far from the origin, whether a turning pusher advances is a question of rounding,
/// which solver and certificate may answer differently.
TEST(CertificateEvidence, AcceptsMotionsThatAreRounding) {
  const PlanarGrasp grasp = testing::disc_grasp(16, 0.01, 16.0);
  int moves = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2 p(-1.0, 0.3 + 1e-4 * i);
    const double turn = 49.0;
    PlanarDrive drive = testing::point_drive(p, {1.0, 0.0}, 0.9, {0.0, 0.0});
    drive.V_HP = {turn * p.y(), 0.01 - turn * p.x(), turn};
    const PlanarInstant answer = solve_planar(grasp, drive);
    EXPECT_TRUE(certify(grasp, drive, answer).holds()) << i << name(answer.status);
    moves += answer.status == InstantStatus::kMoves ? 1 : 0;
  }
  EXPECT_GT(moves, 100);
}

}  // namespace
}  // namespace prehensile
