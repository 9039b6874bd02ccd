/// Bodies and meshes as they are drawn: where the scene has them, and nowhere else.
#include "viewer/surfaces.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "planner/obstacles/collision_bodies.h"
#include "planner/obstacles/obstacle_bodies.h"
#include "planner/obstacles/separation.h"
#include "tests/viewer/film_cases.h"
#include "viewer/film_state.h"

namespace prehensile::viewer {
namespace {

using testing::film_cases;
using testing::FilmCase;

/// Farthest along a direction of what is drawn.
double drawn_reach(const Surface& surface, const Vec3& direction) {
  double most = -1e9;
  for (const auto& triangle : surface.triangles) {
    for (const Vec3& p : triangle) most = std::max(most, direction.dot(p));
  }
  return most;
}

/// Whether a convex surface has the point inside, by more than `depth`.
bool holds(const Surface& surface, const Vec3& p, double depth) {
  for (const auto& [a, b, c] : surface.triangles) {
    if ((b - a).cross(c - a).normalized().dot(p - a) > -depth) return false;
  }
  return true;
}

std::vector<ConvexBody> bodies_of_every_kind() {
  std::vector<ConvexBody> bodies(9);
  bodies[0].shape = BoxShape{{0.1, 0.04, 0.02}};
  bodies[1].shape = SphereShape{0.03};
  std::size_t i = 2;
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    bodies[i++].shape = CylinderShape{.radius = 0.01, .length = 0.08, .axis = axis};
    bodies[i++].shape = CapsuleShape{.radius = 0.01, .length = 0.08, .axis = axis};
    bodies[i++].shape = PrismShape{.outline = {{0.0, 0.0}, {0.05, 0.0}, {0.0, 0.03}},
                                   .thickness = 0.02,
                                   .axis = axis};
  }
  bodies[i].shape =
      PrismShape{.outline = {{0.0, 0.0}, {0.05, 0.0}, {0.0, 0.03}}, .thickness = 0.02};
  for (ConvexBody& body : bodies) {
    body.position = {0.2, -0.1, 0.05};
    body.quaternion = {0.5, -0.5, 0.1, std::sqrt(0.49)};
    body.turn = 0.7;
  }
  return bodies;
}

/// As far as the bodies that the check of plans keeps apart, to every side.
TEST(Surfaces, ReachAsFarAsTheBodies) {
  for (const ConvexBody& body : bodies_of_every_kind()) {
    const Surface surface = surface_of(body, 1.0);
    EXPECT_GT(volume_of(surface), 0.0);
    for (int k = 0; k < 200; ++k) {
      const double z = 1.0 - (2.0 * k + 1.0) / 200.0;
      const double around = 2.399963 * k;
      const Vec3 n(std::sqrt(1.0 - z * z) * std::cos(around),
                   std::sqrt(1.0 - z * z) * std::sin(around), z);
      const double reach = n.dot(support({&body, pose_of(body)}, n));
      EXPECT_LE(drawn_reach(surface, n), reach + 1e-9) << body.shape.index();
      // Round sides are drawn by facets inside them.
      EXPECT_GE(drawn_reach(surface, n), reach - 1e-3) << body.shape.index();
    }
  }
}

TEST(Surfaces, AHalfSpaceEndsAtItsPlane) {
  ConvexBody body;
  body.shape = HalfSpaceShape{Vec3(1.0, 2.0, -2.0) / 3.0};
  body.position = {0.1, 0.0, 0.02};
  body.turn = 0.4;
  const Surface surface = surface_of(body, 0.5);
  const Vec3 n = pose_of(body).linear() * std::get<HalfSpaceShape>(body.shape).normal;
  EXPECT_NEAR(drawn_reach(surface, n), n.dot(body.position), 1e-12);
  EXPECT_GT(volume_of(surface), 0.0);
  EXPECT_TRUE(holds(surface, body.position - 1e-3 * n, 1e-4));
  EXPECT_FALSE(holds(surface, body.position + 1e-3 * n, -1e-4));
}

/// At no moment of the film is a point of the drawn hand in the drawn fixture.
TEST(Surfaces, TheHandKeepsClearOfTheFixture) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  const FilmCase& one = testing::film_case("confined/post_in_the_way.yaml");
  ASSERT_TRUE(one.plan.usable());
  const Obstacles& obstacles = *one.model.scene.obstacles;
  const double extent = extent_of(one.model);
  std::vector<Surface> fixture, hand;
  for (const ConvexBody& body : obstacles.fixture) {
    fixture.push_back(surface_of(body, extent));
  }
  for (const ConvexBody& body : obstacles.hand) hand.push_back(surface_of(body, extent));
  int pushing = 0;
  for (const FilmPhase& phase : one.film.phases) {
    if (phase.kind == ArmPhase::kTransit) continue;  // the arm finds its own way there
    ++pushing;
    for (const double share : {0.0, 0.3, 0.6, 1.0}) {
      const double t = std::lerp(phase.begin, phase.end, share);
      const PlanarPose X_WH = state_at(one.film, std::min(t, phase.end - 1e-9)).X_WH;
      const Eigen::Isometry3d X = in_space(X_WH, 0.0);
      for (const Surface& body : hand) {
        for (const auto& [a, b, c] : body.triangles) {
          for (int i = 0; i <= 10; ++i) {
            const Vec3 p = X * ((a * i + b * (10 - i)) / 10.0);
            for (const Surface& other : fixture) EXPECT_FALSE(holds(other, p, 1e-9)) << t;
          }
        }
      }
    }
  }
  EXPECT_GE(pushing, 3);
  // The test can fail: the finger axis at the post is in it.
  EXPECT_TRUE(holds(fixture[3], {-0.145, 0.015, 0.0}, 1e-4));
}

/// The triangles lie where the mechanics has the body: between the faces at the pads, and
/// inside the silhouette.
TEST(Surfaces, AMeshIsWhereTheSolidIs) {
  const FilmCase& one = testing::film_case("bracket.yaml");
  ASSERT_TRUE(one.film.surface.has_value());
  const auto& solid = std::get<SolidShape>(one.model.scene.object.shape);
  const Surface surface = surface_of(*one.film.surface);
  EXPECT_EQ(one.film.surface->off, 0.0);
  EXPECT_GT(volume_of(surface), 0.0);
  double on_jaws = 0.0;
  for (const auto& [a, b, c] : surface.triangles) {
    for (const Vec3& p : {a, b, c}) {
      EXPECT_GT(depth_inside(solid.outline, p.head<2>()), -1e-4);
    }
    const double half = 0.5 * solid.thickness;
    for (const double side : {-half, half}) {
      const bool flat = std::abs(a.z() - side) < 1e-6 && std::abs(b.z() - side) < 1e-6 &&
                        std::abs(c.z() - side) < 1e-6;
      if (flat) on_jaws += 0.5 * (b - a).cross(c - a).norm();
    }
  }
  EXPECT_GE(on_jaws, 2.0 * properties_of(solid.pad_face).area * (1.0 - 1e-3));
}

}  // namespace
}  // namespace prehensile::viewer
