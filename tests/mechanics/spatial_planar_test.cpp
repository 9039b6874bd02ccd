// In the mid-plane between equal pads the spatial problem is the planar one.
#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "mechanics/spatial_instant.h"
#include "problems/random_spatial.h"
#include "tests/mechanics/spatial_cases.h"

namespace prehensile {
namespace {

using testing::told;

struct Differences {
  std::vector<double> force, twist;
  int both = 0;
  int other_status = 0;

  double share(const std::vector<double>& sorted, double q) const {
    return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
  }
};

Differences compare(const SpatialRange& drawn, int total) {
  SpatialRange range = drawn;
  range.out_of_plane = 0.0;
  Differences differences;
  for (int i = 0; i < total; ++i) {
    range.points_per_pad = std::array{1, 2, 4, 8, 16, 32}[i % 6];
    range.pusher_points = 1 + i % 2;
    const SpatialProblem problem = random_spatial(41, i, range);
    const PlanarEquivalent flat = planar_equivalent(problem);
    const SpatialInstant spatial = solve_spatial(problem);
    const PlanarInstant planar = solve_planar(flat.grasp, flat.drive);
    const SpatialCertificate certificate = certify(problem, spatial);
    EXPECT_TRUE(certificate.holds())
        << i << " " << name(spatial.status) << ": " << told(certificate);
    if (planar.status != spatial.status) ++differences.other_status;
    if (planar.status != InstantStatus::kMoves ||
        spatial.status != InstantStatus::kMoves) {
      continue;
    }
    ++differences.both;
    const double capacity = flat.grasp.capacity();
    differences.force.push_back(std::abs(spatial.push_force - planar.push_force) /
                                capacity);
    const PlanarTwist V(spatial.V_HO[0], spatial.V_HO[1], spatial.V_HO[5]);
    const double length = 0.01;
    const PlanarTwist off = (V - planar.V_HO).cwiseProduct(Vec3(1.0, 1.0, length));
    differences.twist.push_back(off.norm() / problem.V_HP.head<3>().norm());
  }
  std::sort(differences.force.begin(), differences.force.end());
  std::sort(differences.twist.begin(), differences.twist.end());
  return differences;
}

void expect_equal(const Differences& d, int total) {
  std::cout << "both move: " << d.both << " of " << total
            << ", other status: " << d.other_status << ", force median "
            << d.share(d.force, 0.5) << " 95 % " << d.share(d.force, 0.95) << " most "
            << d.force.back() << ", twist median " << d.share(d.twist, 0.5) << " 95 % "
            << d.share(d.twist, 0.95) << " most " << d.twist.back() << "\n";
  EXPECT_GT(d.both, total / 2);
  EXPECT_LE(d.other_status, total / 500);
  EXPECT_LE(d.share(d.force, 0.5), 1e-6);
  EXPECT_LE(d.share(d.force, 0.95), 1e-6);
  EXPECT_LE(d.share(d.twist, 0.5), 1e-6);
  EXPECT_LE(d.share(d.twist, 0.95), 1e-6);
}

TEST(SpatialPlanar, FoundationPadsInTheMidPlane) {
  expect_equal(compare({.compliance = 1e-3}, 1500), 1500);
}

TEST(SpatialPlanar, GivenLoadsInTheMidPlane) {
  expect_equal(compare({.pressure = PressureLaw::kGiven}, 1500), 1500);
}

TEST(SpatialPlanar, AccelerationsInTheMidPlane) {
  expect_equal(compare({.acceleration = 10.0}, 1000), 1000);
}

}  // namespace
}  // namespace prehensile
