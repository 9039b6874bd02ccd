// Laws that any answer must obey, whatever the solver: seen from another frame, in a
// mirror, with the fingers renamed, in other units.
#include <algorithm>
#include <functional>
#include <iostream>

#include <gtest/gtest.h>

#include "mechanics/spatial_instant.h"
#include "problems/random_spatial.h"
#include "tests/mechanics/spatial_cases.h"

namespace prehensile {
namespace {

using testing::told;

constexpr std::array kJawModes = {JawMode::kCoupled, JawMode::kFixedJaw1,
                                  JawMode::kFixedJaw2, JawMode::kIndependent,
                                  JawMode::kLocked};

struct Change {
  SpatialProblem problem;
  std::function<SpatialTwist(const SpatialTwist&)> twist;  ///< the old one, changed
  double force = 1.0;                                      ///< scale of forces
};

/// Same status and, where there is one motion, the same motion and push.
void expect_same(const std::function<Change(const SpatialProblem&)>& change,
                 const SpatialRange& drawn, int total) {
  SpatialRange range = drawn;
  int moves = 0;
  int other_status = 0;
  int other_motion = 0;
  for (int i = 0; i < total; ++i) {
    range.points_per_pad = std::array{1, 2, 4, 8, 16}[i % 5];
    range.jaw_mode = kJawModes[i / 5 % 5];
    range.spin_radius = i % 3 == 0 ? 0.003 : 0.0;
    const SpatialProblem problem = random_spatial(53, i, range);
    const Change changed = change(problem);
    const SpatialInstant a = solve_spatial(problem);
    const SpatialInstant b = solve_spatial(changed.problem);
    const SpatialCertificate certificate = certify(changed.problem, b);
    EXPECT_TRUE(certificate.holds())
        << i << " " << name(b.status) << ": " << told(certificate);
    other_status += a.status != b.status;
    if (a.status != InstantStatus::kMoves || b.status != InstantStatus::kMoves) continue;
    ++moves;
    const double force_off = std::abs(changed.force * a.push_force - b.push_force);
    SpatialTwist off = changed.twist(a.V_HO) - b.V_HO;
    off.tail<3>() *= 0.01;
    const double rate = problem.V_HP.head<3>().norm();
    const double size = problem.grip_force + problem.w_g.head<3>().norm();
    // Two starts may lead to two motions where there are two.
    other_motion += off.norm() > 1e-5 * rate || force_off > 1e-5 * size * changed.force;
  }
  std::cout << "moves " << moves << " of " << total << ", other status " << other_status
            << ", other motion " << other_motion << "\n";
  EXPECT_GT(moves, total / 2);
  EXPECT_LE(other_status, 1 + total / 200);
  EXPECT_LE(other_motion, 1 + total / 200);
}

Change moved(const SpatialProblem& problem, const Eigen::Matrix3d& R, const Vec3& p,
             double mirror) {
  Change change{problem, {}, 1.0};
  SpatialProblem& q = change.problem;
  for (int i = 0; i < q.count; ++i) {
    const Vec3 at = R * problem.p_HC(i) + p;
    q.x[i] = at.x();
    q.y[i] = at.y();
    q.z[i] = at.z();
  }
  for (int k = 0; k < q.patch_count; ++k) {
    q.patch[k].n = R * problem.patch[k].n;
    q.patch[k].t = R * problem.patch[k].t;
  }
  change.twist = [=](const SpatialTwist& V) {
    SpatialTwist out;
    const Vec3 w = mirror * (R * V.tail<3>());
    out << R * V.head<3>() + p.cross(w), w;
    return out;
  };
  q.V_HP = change.twist(problem.V_HP);
  const Vec3 f = R * problem.w_g.head<3>();
  q.w_g << f, mirror * (R * problem.w_g.tail<3>()) + p.cross(f);
  Eigen::Matrix<double, 6, 6> back;  // old twist from the new one
  for (int i = 0; i < 6; ++i) back.col(i) = change.twist(SpatialTwist::Unit(i));
  const Eigen::Matrix<double, 6, 6> to_old = back.inverse();
  q.inertia = to_old.transpose() * problem.inertia * to_old;
  return change;
}

Change moved_away(const SpatialProblem& problem) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(1.1, Vec3(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
  return moved(problem, R, {0.3, -0.2, 0.5}, 1.0);
}

Change mirrored(const SpatialProblem& problem) {
  const Eigen::Matrix3d R = Vec3(1.0, -1.0, 1.0).asDiagonal();
  return moved(problem, R, Vec3::Zero(), -1.0);
}

Change with_fingers_swapped(const SpatialProblem& problem) {
  Change change{problem, [](const SpatialTwist& V) { return V; }, 1.0};
  SpatialProblem& q = change.problem;
  for (int k = 0; k < q.patch_count; ++k) {
    ContactBody& body = q.patch[k].body;
    if (body == ContactBody::kPusher) continue;
    body = body == ContactBody::kJaw1 ? ContactBody::kJaw2 : ContactBody::kJaw1;
  }
  if (q.jaw_mode == JawMode::kFixedJaw1) {
    q.jaw_mode = JawMode::kFixedJaw2;
  } else if (q.jaw_mode == JawMode::kFixedJaw2) {
    q.jaw_mode = JawMode::kFixedJaw1;
  }
  return change;
}

Change gripped_harder(const SpatialProblem& problem) {
  Change change{problem, [](const SpatialTwist& V) { return V; }, 7.0};
  SpatialProblem& q = change.problem;
  q.grip_force *= 7.0;
  q.w_g *= 7.0;
  for (int i = 0; i < q.count; ++i) q.preload[i] *= 7.0;
  for (int k = 0; k < q.patch_count; ++k) q.patch[k].compliance /= 7.0;
  return change;
}

Change faster(const SpatialProblem& problem) {
  Change change{problem, [](const SpatialTwist& V) { return SpatialTwist(1e3 * V); },
                1.0};
  SpatialProblem& q = change.problem;
  q.V_HP *= 1e3;
  for (int k = 0; k < q.patch_count; ++k) q.patch[k].compliance *= 1e3;
  return change;
}

/// The points of the patches, in this order of patches.
Change with_patches(const SpatialProblem& problem,
                    const std::vector<ContactPatch>& patches) {
  Change change{problem, [](const SpatialTwist& V) { return V; }, 1.0};
  SpatialProblem& q = change.problem;
  q.count = 0;
  q.patch_count = 0;
  for (const ContactPatch& patch : patches) {
    ContactPatch& copy = q.patch[q.patch_count++];
    copy = patch;
    copy.first = q.count;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      q.x[q.count] = problem.x[i];
      q.y[q.count] = problem.y[i];
      q.z[q.count] = problem.z[i];
      q.preload[q.count++] = problem.preload[i];
    }
  }
  return change;
}

Change with_pusher_first(const SpatialProblem& problem) {
  return with_patches(problem, {problem.patch[2], problem.patch[1], problem.patch[0]});
}

Change with_a_pad_in_two_parts(const SpatialProblem& problem) {
  ContactPatch first = problem.patch[0];
  ContactPatch second = first;
  first.count = (first.count + 1) / 2;
  second.first += first.count;
  second.count -= first.count;
  if (second.count == 0) return with_pusher_first(problem);
  return with_patches(problem, {first, problem.patch[1], second, problem.patch[2]});
}

TEST(SpatialInvariance, MovesWithTheFrame) { expect_same(moved_away, {}, 500); }
TEST(SpatialInvariance, AcceleratesWithTheFrame) {
  expect_same(moved_away, {.acceleration = 1.0}, 300);
}
TEST(SpatialInvariance, Mirror) { expect_same(mirrored, {}, 500); }
TEST(SpatialInvariance, FingersSwapped) { expect_same(with_fingers_swapped, {}, 500); }
TEST(SpatialInvariance, ForcesScaleWithTheGrip) { expect_same(gripped_harder, {}, 500); }
TEST(SpatialInvariance, RatesScaleWithThePusher) { expect_same(faster, {}, 500); }

TEST(SpatialInvariance, OrderOfPatches) { expect_same(with_pusher_first, {}, 300); }
TEST(SpatialInvariance, PadInTwoParts) { expect_same(with_a_pad_in_two_parts, {}, 300); }

TEST(SpatialInvariance, RefinedPadsConverge) {
  std::vector<double> coarse, fine;
  for (int i = 0; i < 400; ++i) {
    std::array<double, 3> force{};
    bool moves = true;
    for (int k = 0; k < 3; ++k) {
      const int points = std::array{4, 16, 64}[k];
      const SpatialProblem problem =
          random_spatial(59, i, {.points_per_pad = points, .pusher_points = 1 + i % 2});
      const SpatialInstant answer = solve_spatial(problem);
      moves = moves && answer.status == InstantStatus::kMoves;
      force[k] = answer.push_force / problem.grip_force;
    }
    if (!moves) continue;
    coarse.push_back(std::abs(force[0] - force[2]));
    fine.push_back(std::abs(force[1] - force[2]));
  }
  const auto median = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  const double at_4 = median(coarse);
  const double at_16 = median(fine);
  std::cout << "push force off by " << at_4 << " (k = 4), " << at_16 << " (k = 16)\n";
  EXPECT_LT(at_16, 0.5 * at_4);
  EXPECT_LT(at_16, 5e-3);
}

}  // namespace
}  // namespace prehensile
