// The planar solver against an enumeration of all modes that shares nothing with it.
#include <iostream>

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/enumerated_instant.h"

namespace prehensile {
namespace {

constexpr double kAgrees = 1e-6;

bool is_among(const RandomInstant& q, const PlanarInstant& answer,
              const std::vector<EnumeratedMotion>& motions) {
  double rate = 0.0;
  for (int i = 0; i < q.drive.count; ++i) {
    rate = std::max(rate, point_velocity(q.drive.V_HP, q.drive.p_HC[i]).norm());
  }
  for (const EnumeratedMotion& motion : motions) {
    const PlanarTwist apart = answer.V_HO - motion.V_HO;
    const PlanarWrench between = answer.w_push - motion.w_push;
    const double size = rate + 0.01 * std::abs(answer.V_HO[2]);
    const double force = q.grasp.capacity() + answer.push_force;
    if (apart.head<2>().norm() + 0.01 * std::abs(apart[2]) <= kAgrees * size &&
        between.head<2>().norm() <= kAgrees * force) {
      return true;
    }
  }
  return false;
}

void compare(int total) {
  int asked = 0;
  int agreed = 0;
  int unique = 0;
  for (int i = 0; i < total; ++i) {
    const RandomInstant q =
        random_instant(71, i, {.points_per_pad = std::array{2, 4, 16, 64}[i % 4]});
    const PlanarInstant answer = solve_planar(q.grasp, q.drive);
    // A fall is certified by itself; the pusher may balance it all the same.
    if (answer.status == InstantStatus::kDynamic) continue;
    const std::vector<EnumeratedMotion> motions = enumerate_motions(q);
    const bool is_unique = answer.status == InstantStatus::kMoves;
    const bool agrees =
        is_among(q, answer, motions) && (!is_unique || motions.size() == 1);
    ++asked;
    agreed += agrees ? 1 : 0;
    unique += is_unique ? 1 : 0;
    if (!agrees) {
      std::cout << i << ": " << name(answer.status) << ", " << motions.size()
                << " enumerated\n";
    }
  }
  std::cout << "agree: " << agreed << " of " << asked << ", unique motions " << unique
            << "\n";
  EXPECT_GE(agreed, 0.995 * asked);
  EXPECT_GE(unique, 0.7 * total);
}

TEST(PlanarInstant, AgreesWithTheEnumerationOfAllModes) { compare(400); }

TEST(PlanarInstant, FullAgreesWithTheEnumerationOfAllModes) { compare(20000); }

}  // namespace
}  // namespace prehensile
