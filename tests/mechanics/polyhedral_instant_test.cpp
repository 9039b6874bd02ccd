/// The paper's instant on polyhedral cones: known answers pass its residual, wrong ones
/// do not, and polishing turns a blurred answer into an exact one.
#include "mechanics/polyhedral_instant.h"

#include <numbers>

#include <gtest/gtest.h>

#include "mechanics/polyhedral_polish.h"
#include "tests/mechanics/instant_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::disc_grasp;
using testing::line_drive;
using testing::Random;

/// A line pushes a disc grasp straight along a generator; no gravity.
struct StraightSlide {
  PolyhedralInstant question;
  std::vector<double> z;  // its unknowns
};

StraightSlide straight_slide(int generators) {
  StraightSlide slide;
  const PlanarGrasp grasp = disc_grasp(12, 0.01, 20.0);
  const PlanarDrive drive =
      line_drive({-0.05, 0.001}, 0.02, {1.0, 0.0}, 0.4, {0.01, 0.0});
  EXPECT_TRUE(pose_polyhedral(grasp, drive, generators, slide.question));
  const PolyhedralInstant& q = slide.question;
  const PolyhedralUnknowns index(q);
  slide.z.assign(index.count, 0.0);
  slide.z[0] = 1.0;
  double force = 0.0;
  for (int j = 0; j < index.points; ++j) {
    slide.z[index.beta(j, generators / 2)] = q.bound[j];
    slide.z[index.xi(j)] = 1.0;
    force += q.bound[j];
  }
  // The ends share the force so that its line of action passes through the centre.
  const double share = -q.p[0].y() / (q.p[1].y() - q.p[0].y());
  slide.z[index.lambda_n(0)] = (1.0 - share) * force;
  slide.z[index.lambda_n(1)] = share * force;
  return slide;
}

TEST(PolyhedralInstant, KnownAnswerSatisfiesRowsAndResidual) {
  for (const int generators : {4, 6, 8, 16, 64}) {
    const auto [question, z] = straight_slide(generators);
    const ComplementarityProblem problem = complementarity_of(question);
    const std::vector<double> s = problem.slacks(z);
    for (std::size_t row = 0; row < s.size(); ++row) {
      const int partner = problem.partner[row];
      if (partner == ComplementarityProblem::kEquality) {
        EXPECT_NEAR(s[row], 0.0, 1e-14);
      } else {
        EXPECT_NEAR(std::min(s[row], z[partner]), 0.0, 1e-14);
      }
    }
    EXPECT_LT(residual_of(question, answer_of(question, z)), 1e-13);
  }
}

TEST(PolyhedralInstant, CountsUnknownsAndRows) {
  const StraightSlide slide = straight_slide(8);
  const ComplementarityProblem problem = complementarity_of(slide.question);
  EXPECT_EQ(problem.variables, 3 + 2 + 4 + 2 + 12 * 9);
  EXPECT_EQ(problem.constant.size(), problem.partner.size());
  EXPECT_EQ(static_cast<int>(problem.constant.size()), problem.variables);

  PolyhedralInstant frictionless;
  PlanarDrive drive = line_drive({-0.05, 0.0}, 0.02, {1.0, 0.0}, 0.0, {0.01, 0.0});
  ASSERT_TRUE(pose_polyhedral(disc_grasp(12, 0.01, 20.0), drive, 8, frictionless));
  EXPECT_EQ(complementarity_of(frictionless).variables, 3 + 2 + 12 * 9);
}

TEST(PolyhedralInstant, EveryPerturbationShows) {
  const StraightSlide slide = straight_slide(8);
  const PolyhedralAnswer answer = answer_of(slide.question, slide.z);
  const double by = 1e-3;
  const auto shows = [&](auto&& perturb) {
    PolyhedralAnswer wrong = answer;
    perturb(wrong);
    return residual_of(slide.question, wrong) > 0.05 * by;
  };
  for (const double sign : {1.0, -1.0}) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(shows([&](PolyhedralAnswer& a) { a.u[k] += sign * by; })) << k;
    }
    for (std::size_t j = 0; j < answer.f.size(); ++j) {
      EXPECT_TRUE(shows([&](PolyhedralAnswer& a) { a.f[j].x() += sign * by; }));
      EXPECT_TRUE(shows([&](PolyhedralAnswer& a) { a.f[j].y() += sign * by; }));
    }
    for (int i = 0; i < 2; ++i) {
      EXPECT_TRUE(shows([&](PolyhedralAnswer& a) { a.lambda_n[i] += sign * by; }));
      EXPECT_TRUE(shows([&](PolyhedralAnswer& a) { a.lambda_t[i] += sign * by; }));
    }
  }
  EXPECT_TRUE(shows([](PolyhedralAnswer& a) { a.u[1] = std::nan(""); }));
}

TEST(PolyhedralInstant, PolishingUndoesTheBlurOfAnInteriorPoint) {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    auto [question, z] = straight_slide(4 + 4 * (trial % 4));
    const double blur = 1e-5;
    for (double& value : z) value = std::abs(value + random.in(0.0, blur));
    const double before = residual_of(question, answer_of(question, z));
    const PolyhedralAnswer sharp = polished(question, z);
    EXPECT_GT(before, 1e-7);
    EXPECT_LT(residual_of(question, sharp), 1e-13);
    EXPECT_NEAR(sharp.u[0], 1.0, 1e-13);
    EXPECT_NEAR(sharp.lambda_n[0] + sharp.lambda_n[1], 1.0, 1e-13);
  }
}

// Units take out every scale: the scaled question is the same one.
TEST(PolyhedralInstant, UnitsMakeScaledQuestionsEqual) {
  const PlanarGrasp grasp = disc_grasp(7, 0.01, 20.0);
  const PlanarDrive drive =
      line_drive({-0.05, 0.001}, 0.02, {1.0, 0.0}, 0.4, {0.01, 0.003});
  PlanarGrasp scaled = grasp;
  PlanarDrive scaled_drive = drive;
  const double length = 3.0, force = 1e4, rate = 1e-6;
  for (int j = 0; j < grasp.count; ++j) {
    scaled.x[j] *= length;
    scaled.y[j] *= length;
    scaled.bound[j] *= force;
  }
  for (Vec2& p : scaled_drive.p_HC) p *= length;
  scaled_drive.V_HP *= rate;
  PolyhedralInstant one, two;
  ASSERT_TRUE(pose_polyhedral(grasp, drive, 8, one));
  ASSERT_TRUE(pose_polyhedral(scaled, scaled_drive, 8, two));
  for (int j = 0; j < grasp.count; ++j) {
    EXPECT_LT((one.r[j] - two.r[j]).norm(), 1e-14);
    EXPECT_NEAR(one.bound[j], two.bound[j], 1e-15);
  }
  EXPECT_LT((one.V_HP - two.V_HP).norm(), 1e-14);
  EXPECT_LT((one.p[1] - two.p[1]).norm(), 1e-14);
}

TEST(PolyhedralInstant, HandAndUnitsAreInverse) {
  PlanarGrasp grasp = disc_grasp(7, 0.01, 20.0);
  for (int j = 0; j < grasp.count; ++j) grasp.x[j] += 0.03;
  PlanarDrive drive = line_drive({-0.05, 0.001}, 0.02, {1.0, 0.0}, 0.4, {0.01, 0.003});
  drive.V_HP[2] = 0.7;
  grasp.w_g = {1.0, -2.0, 0.05};
  Eigen::Matrix3d root;
  root << 0.3, 0.1, 0.0, 0.0, 0.4, 0.001, 0.0, 0.0, 0.002;
  grasp.inertia = root.transpose() * root;
  PolyhedralInstant q;
  ASSERT_TRUE(pose_polyhedral(grasp, drive, 8, q));
  EXPECT_LT((q.twist_in_hand(q.V_HP) - drive.V_HP).norm(), 1e-15);
  EXPECT_LT((q.wrench_in_hand(q.w_g) - grasp.w_g).norm(), 1e-14);
  // Newton's law reads the same on both sides.
  const PlanarTwist u(0.3, -0.2, 0.9);
  const PlanarWrench in_hand = grasp.inertia * q.twist_in_hand(u);
  EXPECT_LT((q.wrench_in_hand(q.inertia * u) - in_hand).norm(), 1e-14);
}

}  // namespace
}  // namespace prehensile
