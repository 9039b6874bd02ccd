#include "planner/obstacles/separation.h"

#include <gtest/gtest.h>

#include "planner/obstacles/collision_bodies.h"
#include "planner/obstacles/obstacle_bodies.h"
#include "tests/planner/planner_cases.h"
#include "tests/planner/random_bodies.h"

namespace prehensile {
namespace {

using testing::any_body;
using testing::Random;

double separation_of(const ConvexBody& a, const ConvexBody& b) {
  return separation({&a, pose_of(a)}, {&b, pose_of(b)});
}

ConvexBody at(const BodyShape& shape, const Vec3& position, double turn = 0.0) {
  return {.name = "body", .shape = shape, .position = position, .turn = turn};
}

TEST(Separation, ClosedForms) {
  const SphereShape ball{0.1};
  EXPECT_NEAR(separation_of(at(ball, {0, 0, 0}), at(SphereShape{0.2}, {0.3, 0.4, 0})),
              0.2, 1e-8);
  const BoxShape cube{{0.2, 0.2, 0.2}};
  EXPECT_NEAR(separation_of(at(cube, {0, 0, 0}), at(cube, {0.5, 0.05, -0.03})), 0.3,
              1e-8);
  EXPECT_NEAR(separation_of(at(cube, {0, 0, 0}), at(cube, {0.3, 0.4, 0.5})),
              std::sqrt(0.01 + 0.04 + 0.09), 1e-8);
  // An edge towards a face.
  EXPECT_NEAR(
      separation_of(at(cube, {0, 0, 0}), at(cube, {0.4, 0, 0}, std::numbers::pi / 4.0)),
      0.3 - 0.1 * std::numbers::sqrt2, 1e-8);
  EXPECT_NEAR(separation_of(at(CapsuleShape{0.05, 0.4, Axis::kX}, {0, 0, 0}),
                            at(CapsuleShape{0.05, 0.4, Axis::kY}, {0, 0, 0.3})),
              0.2, 1e-8);
  EXPECT_NEAR(separation_of(at(CylinderShape{0.1, 0.2, Axis::kZ}, {0, 0, 0}),
                            at(ball, {0.3, 0, 0.4})),
              std::sqrt(0.04 + 0.09) - 0.1, 1e-8);
  const HalfSpaceShape table{Vec3(0.0, 0.6, 0.8)};
  EXPECT_NEAR(separation_of(at(cube, {0, 0, 0}), at(table, {0, -0.6, -0.8})),
              1.0 - 0.1 * (0.6 + 0.8), 1e-12);
  EXPECT_LT(separation_of(at(cube, {0, 0, 0}), at(cube, {0.15, 0.1, 0.05})), 0.0);
  EXPECT_LE(separation_of(at(cube, {0, 0, 0}), at(cube, {0, 0, 0})), 0.0);
}

/// Points of both bodies are never nearer than the separation says, and where two of them
/// are at about that distance it cannot be more.
TEST(Separation, IsALowerBoundOfTheDistanceOfPoints) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const ConvexBody a = any_body(random);
    const ConvexBody b = any_body(random);
    const double gap = separation_of(a, b);
    for (int k = 0; k < 100; ++k) {
      const Vec3 d(random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-1.0, 1.0));
      const Vec3 e(random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-1.0, 1.0));
      const Vec3 between = support({&a, pose_of(a)}, d) - support({&b, pose_of(b)}, e);
      EXPECT_LE(gap, between.norm() + 1e-12) << i;
    }
  }
}

/// Two independent ways to the same distance.
TEST(Separation, AgreesWithTheLibrary) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  Random random(6);
  int apart = 0;
  int coarser = 0;
  for (int i = 0; i < 500; ++i) {
    Scene scene = testing::walled_square();
    const ConvexBody hand = any_body(random);
    const ConvexBody fixture = any_body(random);
    scene.obstacles = Obstacles{.fixture = {fixture}, .hand = {hand}};
    const Model model = prepare(scene);
    const PlanarPose X_WH{random.in(-0.2, 0.2), random.in(-0.2, 0.2),
                          random.in(-3.0, 3.0)};
    const double found = CollisionBodies(model).hand_distance(X_WH, 1.0);
    const double gap = separation({&hand, in_space(X_WH, 0.0) * pose_of(hand)},
                                  {&fixture, pose_of(fixture)});
    if (gap > 1e-4) ++apart;
    EXPECT_NEAR(found, std::max(0.0, gap), 1e-5) << i;
    const double coarse = random.log_in(1e-3, 0.3);
    const double about = CollisionBodies(model).hand_distance(X_WH, 1.0, 0.0, coarse);
    EXPECT_LE(about, found + 1e-5) << i;
    EXPECT_GE(about, std::min(found, coarse) - 1e-5) << i;
    coarser += about < found - 1e-3 ? 1 : 0;
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(coarser, 20);
}

TEST(Separation, TheObjectIsMadeUpOfItsPieces) {
  const Model model = prepare(published_tee(0));
  const std::vector<ConvexBody> pieces = object_bodies(model);
  Random random(7);
  for (int i = 0; i < 500; ++i) {
    const Vec2 p = random.in_box(0.06, 0.06);
    const double depth = depth_inside(model.outline, p);
    if (std::abs(depth) < 1e-6) continue;
    const ConvexBody point = at(SphereShape{1e-6}, {p.x(), p.y(), 0.01});
    double least = 1.0;
    for (const ConvexBody& piece : pieces) {
      least = std::min(least, separation_of(piece, point));
    }
    if (depth > 0.0) {
      EXPECT_LE(least, 0.0) << p.transpose();
    } else {
      EXPECT_NEAR(least, -depth - 1e-6, 1e-7) << p.transpose();
    }
  }
}

}  // namespace
}  // namespace prehensile
