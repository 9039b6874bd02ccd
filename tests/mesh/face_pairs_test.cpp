#include "mesh/face_pairs.h"

#include <numbers>

#include <gtest/gtest.h>

#include "mechanics/solvers.h"
#include "problems/extruded_mesh.h"
#include "scene/outline.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

std::vector<Vec2> regular(int count, double radius) {
  std::vector<Vec2> ring;
  ring.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    ring.push_back(rotated(2.0 * std::numbers::pi * i / count, {radius, 0.0}));
  }
  return ring;
}

TriangleMesh mesh_of(const std::vector<ExtrudedMesh>& parts, double unit = 0.001) {
  return mesh_from_bytes(to_binary_stl(parts), "a.stl", unit);
}

/// Turned and moved as a whole.
ExtrudedMesh moved(ExtrudedMesh mesh, const Eigen::Isometry3d& X) {
  for (Vec3& v : mesh.vertices) v = X * v;
  return mesh;
}

Eigen::Isometry3d random_pose(Random& random) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(
                   random.in(-3.0, 3.0),
                   Vec3(random.in(-1.0, 1.0), random.in(-1.0, 1.0), 1.0).normalized())
                   .toRotationMatrix();
  X.translation() = 50.0 * Vec3(random.in(-1.0, 1.0), random.in(-1.0, 1.0), 1.0);
  return X;
}

/// A box in any attitude has three pairs, with its three thicknesses, and is the box that
/// a scene would state.
TEST(FacePairs, BoxesAreBoxes) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Vec3 size(60.0, 40.0, 25.0);
    const ExtrudedMesh box = extruded(
        {{0, 0}, {size.x(), 0}, {size.x(), size.y()}, {0, size.y()}}, 0.0, size.z());
    const TriangleMesh mesh = mesh_of({moved(box, random_pose(random))});
    const std::vector<FacePair> pairs = find_face_pairs(mesh);
    ASSERT_EQ(pairs.size(), 3u);
    EXPECT_NEAR(pairs[0].thickness, 0.025, 1e-7);
    EXPECT_NEAR(pairs[1].thickness, 0.040, 1e-7);
    EXPECT_NEAR(pairs[2].thickness, 0.060, 1e-7);
    EXPECT_NEAR(pairs[0].area, 2.4e-3, 1e-7);
    const HeldBody body = body_between(mesh, pairs[0]);
    EXPECT_EQ(body.shape.outline.size(), 4u);
    EXPECT_TRUE(body.notes.empty());
    const OutlineProperties outline = properties_of(body.shape.outline);
    EXPECT_NEAR(outline.area, 2.4e-3, 1e-7);
    EXPECT_LT(body.shape.centroid.norm(), 1e-7);
    for (const Vec2& heights : body.shape.heights) {
      EXPECT_NEAR(heights.x(), -0.0125, 1e-6);
      EXPECT_NEAR(heights.y(), 0.0125, 1e-6);
    }
    EXPECT_NEAR(body.shape.spread(0, 0), 3.6e-3 / 12.0, 1e-8);
    EXPECT_NEAR(body.shape.spread(2, 2), 6.25e-4 / 12.0, 1e-8);
  }
}

/// The mechanics cannot tell a box from its mesh.
TEST(FacePairs, AMeshedBoxMovesLikeABox) {
  Scene scene;
  scene.object.shape = BoxShape{{0.06, 0.04, 0.025}};
  scene.object.mass = 0.2;
  scene.gripper.pad = DiscPad{.radius = 0.008};
  scene.gripper.friction = {0.5, 0.6};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "step",
                    .feature = PlaneFeature{0.02, 0.006},
                    .friction = 0.4,
                    .z_WP = 0.004}};
  const Model box = prepare(scene);
  const TriangleMesh mesh =
      mesh_of({extruded({{0, 0}, {60, 0}, {60, 40}, {0, 40}}, 0.0, 25.0)});
  scene.object.shape = body_between(mesh, find_face_pairs(mesh)[0]).shape;
  const Model solid = prepare(scene);
  EXPECT_NEAR(box.L, solid.L, 1e-7);
  EXPECT_LT((box.inertia_O - solid.inertia_O).norm(), 1e-6 * box.inertia_O.norm());
  SpatialTwist V_HP = in_space({0.01, 0.002, 0.0});
  V_HP[2] = 0.001;
  const auto answer = [&](const Model& model) {
    const InstantAnswer now =
        solve(question_at(model, model.contacts[0], 0.003, {0.002, 0.001, 0.1}, V_HP));
    EXPECT_TRUE(now.certified());
    return now;
  };
  const InstantAnswer one = answer(box);
  const InstantAnswer other = answer(solid);
  EXPECT_NEAR(one.push_force, other.push_force, 1e-4 * one.push_force);
  EXPECT_LT((one.V_HO - other.V_HO).norm(), 1e-4);
}

/// A nut: the pads press around the hole, which a slit opens.
TEST(FacePairs, HolesAreNotPressedOn) {
  const std::vector<Vec2> outer = regular(6, 20.0);
  const double ring = properties_of(outer).area - properties_of(regular(24, 8.0)).area;
  ExtrudedMesh nut;
  {
    // Walls of both outlines, and caps between them.
    std::vector<Vec2> around;
    for (int i = 0; i < 24; ++i) {
      const double share = (i % 4) / 4.0;
      around.push_back((1.0 - share) * outer[static_cast<std::size_t>(i / 4)] +
                       share * outer[static_cast<std::size_t>((i / 4 + 1) % 6)]);
    }
    const std::vector<Vec2> hole = regular(24, 8.0);
    const int n = 24;
    for (const double z : {0.0, 10.0}) {
      for (const Vec2& v : around) nut.vertices.emplace_back(v.x(), v.y(), z);
      for (const Vec2& v : hole) nut.vertices.emplace_back(v.x(), v.y(), z);
    }
    const auto quad = [&nut](int a, int b, int c, int d) {
      nut.triangles.push_back({a, b, c});
      nut.triangles.push_back({a, c, d});
    };
    for (int i = 0; i < n; ++i) {
      const int j = (i + 1) % n;
      quad(i, j, 2 * n + j, 2 * n + i);                  // outer wall
      quad(n + j, n + i, 3 * n + i, 3 * n + j);          // wall of the hole
      quad(2 * n + i, 2 * n + j, 3 * n + j, 3 * n + i);  // top
      quad(j, i, n + i, n + j);                          // bottom
    }
  }
  const TriangleMesh mesh = mesh_of({nut});
  const std::vector<FacePair> pairs = find_face_pairs(mesh);
  ASSERT_GE(pairs.size(), 4u);
  EXPECT_NEAR(pairs[0].area, 1e-6 * ring, 2e-6);
  const HeldBody body = body_between(mesh, pairs[0]);
  EXPECT_EQ(body.shape.outline.size(), 6u);
  EXPECT_FALSE(contains(body.shape.pad_face, {0.0, 0.0}));
  EXPECT_TRUE(contains(body.shape.pad_face, {-0.012, 0.001}));
  EXPECT_TRUE(is_simple(body.shape.pad_face));
}

/// A T seen from the side: the pads hold its stem, whose faces lie behind the bar, so
/// they reach only what the bar does not cover.
TEST(FacePairs, WhatIsInFrontOfAFaceIsNotReached) {
  const ExtrudedMesh stem = extruded({{0, 0}, {60, 0}, {60, 30}, {0, 30}}, -5.0, 5.0);
  const ExtrudedMesh bar = extruded({{60, 0}, {80, 0}, {80, 30}, {60, 30}}, -15.0, 15.0);
  const TriangleMesh mesh = mesh_of({stem, bar});
  const std::vector<FacePair> pairs = find_face_pairs(mesh);
  const auto thin = std::find_if(pairs.begin(), pairs.end(), [](const FacePair& pair) {
    return std::abs(pair.thickness - 0.010) < 1e-6 && std::abs(pair.closing.z()) > 0.99;
  });
  ASSERT_NE(thin, pairs.end());
  EXPECT_NEAR(thin->area, 1.8e-3, 1e-6);
  const HeldBody body = body_between(mesh, *thin);
  double highest = 0.0;
  for (const Vec2& heights : body.shape.heights) {
    highest = std::max(highest, heights.y());
  }
  EXPECT_NEAR(highest, 0.015, 1e-6);
}

/// Nothing flat to hold: refused by an empty list, not by a guess.
TEST(FacePairs, RoundAndTaperedBodiesHaveNone) {
  ExtrudedMesh wedge = extruded({{0, 0}, {60, 0}, {60, 40}, {0, 40}}, 0.0, 25.0);
  wedge.vertices[4].z() += 6.0;  // a corner of the top
  wedge.vertices[5].z() += 3.0;
  for (std::size_t i = 0; i < 4; ++i) {
    wedge.vertices[i].head<2>() *= 0.8;
  }
  EXPECT_TRUE(find_face_pairs(mesh_of({wedge})).empty());
}

TEST(FacePairs, SilhouettesOfManyVerticesAreSimplified) {
  const TriangleMesh mesh = mesh_of({extruded(regular(720, 30.0), 0.0, 20.0)});
  const HeldBody body = body_between(mesh, find_face_pairs(mesh)[0]);
  EXPECT_LE(body.shape.outline.size(), 200u);
  EXPECT_GE(body.shape.outline.size(), 30u);
  EXPECT_NEAR(properties_of(body.shape.outline).area, std::numbers::pi * 9e-4,
              1e-3 * std::numbers::pi * 9e-4);
}

}  // namespace
}  // namespace prehensile
