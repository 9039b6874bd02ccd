#include "mechanics/row_contacts.h"

#include <gtest/gtest.h>

#include "problems/random_spatial.h"
#include "problems/random_stream.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

/// One mass of three rates (n, t, o) over one contact.
RowProblem block(double mass, double mu, const Vec3& u_free) {
  RowProblem problem;
  problem.rates = 3;
  problem.count = 1;
  problem.G[0].setZero();
  problem.G[0].leftCols<3>().setIdentity();
  problem.b[0] = u_free;
  problem.mu[0] = mu;
  problem.compliance[0] = problem.preload[0] = 0.0;
  problem.inertia.topLeftCorner<3, 3>() = mass * Eigen::Matrix3d::Identity();
  return problem;
}

/// Every point of a spatial problem as rows about the origin of H, and its jaws.
RowProblem rows_of(const SpatialProblem& q) {
  const JawFreedoms jaws = jaw_freedoms(q);
  RowProblem rows;
  rows.rates = 6 + jaws.count;
  rows.count = q.count;
  rows.inertia.topLeftCorner<6, 6>() = q.inertia;
  rows.f.head<6>() = q.w_g;
  for (int j = 0; j < jaws.count; ++j) {
    rows.f[6 + j] = jaws.effort[j];
    rows.inertia(6 + j, 6 + j) =
        q.jaw_mass * (jaws.jaw1[j] * jaws.jaw1[j] + jaws.jaw2[j] * jaws.jaw2[j]);
  }
  for (int k = 0; k < q.patch_count; ++k) {
    const ContactPatch& patch = q.patch[k];
    const auto& jaw = patch.body == ContactBody::kJaw1 ? jaws.jaw1 : jaws.jaw2;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      RowProblem::Rows& G = rows.G[i];
      G.setZero();
      int row = 0;
      for (const Vec3& axis : {patch.n, patch.t, patch.o()}) {
        G.block<1, 3>(row, 0) = axis.transpose();
        G.block<1, 3>(row++, 3) = q.p_HC(i).cross(axis).transpose();
      }
      rows.b[i].setZero();
      if (patch.body == ContactBody::kPusher) {
        rows.b[i] = -G.leftCols<6>() * q.V_HP;
      } else {
        for (int j = 0; j < jaws.count; ++j) G(0, 6 + j) = -jaw[j];
      }
      rows.mu[i] = patch.mu;
      rows.compliance[i] =
          patch.pressure == PressureLaw::kFoundation ? patch.compliance : 0.0;
      rows.preload[i] = q.preload[i];
    }
  }
  return rows;
}

/// Largest violation of Coulomb's law and the balance, term by term, in units.
double violation(const RowProblem& p, const RowSolution& s, double force, double rate,
                 double lever) {
  SpatialRates imbalance = p.f - p.inertia * s.v;
  double worst = 0.0;
  for (int i = 0; i < p.count; ++i) {
    const Vec3& r = s.r[i];
    const Vec3 u = p.G[i] * s.v + p.b[i];
    imbalance += p.G[i].transpose() * r;
    const double gap = u[0] + p.compliance[i] * (r[0] - p.preload[i]);
    const double slip = u.tail<2>().norm();
    const double friction = r.tail<2>().norm();
    worst =
        std::max({worst, -r[0] / force, -gap / rate, std::min(r[0] / force, gap / rate),
                  (friction - p.mu[i] * r[0]) / force,
                  std::min(slip / rate, (p.mu[i] * r[0] - friction) / force),
                  (slip * friction + u.tail<2>().dot(r.tail<2>())) / (force * rate)});
  }
  return std::max(worst, imbalance.head(p.rates).norm() / (force * lever));
}

TEST(RowContacts, BlockOnAFloorKeepsToClosedForms) {
  // It parts, sticks, slips: u = u_free + r / m, all along t.
  const RowSolution parts = solve_rows(block(2.0, 0.5, {0.1, 0.3, 0.0}));
  ASSERT_EQ(parts.status, InstantStatus::kMoves);
  EXPECT_NEAR(parts.r[0].norm(), 0.0, 1e-12);
  const RowSolution sticks = solve_rows(block(2.0, 0.5, {-1.0, 0.0, -0.4}));
  ASSERT_EQ(sticks.status, InstantStatus::kMoves);
  EXPECT_NEAR((sticks.r[0] - Vec3(2.0, 0.0, 0.8)).norm(), 0.0, 1e-8);
  const RowSolution slips = solve_rows(block(2.0, 0.5, {-1.0, 0.8, 0.6}));
  ASSERT_EQ(slips.status, InstantStatus::kMoves);
  EXPECT_NEAR((slips.r[0] - Vec3(2.0, -0.8, -0.6)).norm(), 0.0, 1e-8);
  EXPECT_NEAR((slips.v.head<3>() - Vec3(1.0, -0.4, -0.3)).norm(), 0.0, 1e-8);
}

TEST(RowContacts, UnitsDoNotMatter) {
  for (const double force : {1e-6, 1e6}) {
    for (const double rate : {1e-6, 1e6}) {
      const Vec3 u_free(-1.0, 0.8, 0.6);
      const RowSolution slips = solve_rows(block(2.0 * force / rate, 0.5, rate * u_free));
      ASSERT_EQ(slips.status, InstantStatus::kMoves);
      EXPECT_NEAR((slips.r[0] / force - Vec3(2.0, -0.8, -0.6)).norm(), 0.0, 1e-8);
    }
  }
}

TEST(RowContacts, SayWhatTheSpatialSolverSays) {
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const SpatialProblem q =
        random_spatial(41, i, {.points_per_pad = 4, .acceleration = i % 2 ? 10.0 : 0.0});
    const SpatialInstant answer = solve_spatial(q);
    if (answer.status != InstantStatus::kMoves) continue;
    const RowProblem rows = rows_of(q);
    const RowSolution solution = solve_rows(rows);
    if (solution.status != InstantStatus::kMoves) continue;
    ++compared;
    const double rate = q.V_HP.head<3>().norm();
    EXPECT_NEAR((solution.v.head<3>() - answer.V_HO.head<3>()).norm() / rate, 0.0, 1e-5)
        << i;
    EXPECT_LE(violation(rows, solution, q.grip_force, rate, 1.0), 1e-6) << i;
  }
  EXPECT_GE(compared, 160);
}

TEST(RowContacts, RandomRowsObeyTheLaws) {
  int solved = 0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    RandomStream random(1000 + trial);
    RowProblem problem;
    problem.rates = 3 + random.below(4);
    problem.count = 1 + random.below(12);
    problem.inertia.topLeftCorner(problem.rates, problem.rates).setIdentity();
    for (int i = 0; i < problem.count; ++i) {
      problem.G[i].setZero();
      for (int row = 0; row < 3; ++row) {
        for (int k = 0; k < problem.rates; ++k) {
          problem.G[i](row, k) = random.in(-1.0, 1.0);
        }
        problem.b[i][row] = random.in(-1.0, 1.0);
      }
      // All contacts can part along the first rate, so there is an answer.
      problem.G[i](0, 0) = 2.0;
      problem.G[i](1, 0) = problem.G[i](2, 0) = 0.0;
      problem.mu[i] = random.in(0.0, 1.2);
      problem.compliance[i] = problem.preload[i] = 0.0;
    }
    const RowSolution solution = solve_rows(problem);
    ASSERT_NE(solution.status, InstantStatus::kBadInput);
    if (solution.status != InstantStatus::kMoves) continue;
    ++solved;
    EXPECT_LE(violation(problem, solution, 1.0, 1.0, 1.0), 1e-7) << trial;
  }
  EXPECT_GE(solved, 0.99 * kTrials);
}

TEST(RowContacts, RefuseWhatMakesNoSense) {
  const auto status_of = [](auto&& spoil) {
    RowProblem problem = block(1.0, 0.5, {-1.0, 0.0, 0.0});
    spoil(problem);
    return solve_rows(problem).status;
  };
  const auto bad = InstantStatus::kBadInput;
  EXPECT_EQ(status_of([](RowProblem&) {}), InstantStatus::kMoves);
  EXPECT_EQ(status_of([](RowProblem& p) { p.rates = 0; }), bad);
  EXPECT_EQ(status_of([](RowProblem& p) { p.rates = 9; }), bad);
  EXPECT_EQ(status_of([](RowProblem& p) { p.count = 0; }), bad);
  EXPECT_EQ(status_of([](RowProblem& p) { p.count = 137; }), bad);
  EXPECT_EQ(status_of([](RowProblem& p) { p.mu[0] = -0.1; }), bad);
  EXPECT_EQ(status_of([](RowProblem& p) { p.b[0][1] = kNan; }), bad);
  EXPECT_EQ(status_of([](RowProblem& p) { p.G[0](2, 1) = kNan; }), bad);
  EXPECT_EQ(status_of([](RowProblem& p) { p.inertia(1, 2) = kNan; }), bad);
  EXPECT_EQ(status_of([](RowProblem& p) { p.compliance[0] = -1.0; }), bad);
}

TEST(RowContacts, SayWhenTheyFindNothing) {
  // Two walls that both press the block towards the other: nothing balances.
  RowProblem problem = block(1.0, 0.5, {-1.0, 0.0, 0.0});
  problem.count = 2;
  problem.G[1] = -problem.G[0];
  problem.b[1] = {-1.0, 0.0, 0.0};
  problem.mu[1] = 0.5;
  problem.compliance[1] = problem.preload[1] = 0.0;
  EXPECT_EQ(solve_rows(problem).status, InstantStatus::kOutOfIterations);
}

TEST(RowContacts, TakeNoHeap) {
  const RowProblem rows = rows_of(random_spatial(41, 0, {.points_per_pad = 4}));
  const testing::NoHeapScope scope;
  solve_rows(rows);
  EXPECT_LE(scope.allocations(), 0);
}

}  // namespace
}  // namespace prehensile
