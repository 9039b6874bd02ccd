#include "mesh/few_triangles.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "problems/extruded_mesh.h"

namespace prehensile {
namespace {

/// A ball of radius 1 of 2 * 99 * 100 triangles.
TriangleMesh ball() {
  constexpr int kAround = 100;
  TriangleMesh mesh;
  const auto add_ring = [&](double z) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      const double r = std::sqrt(1.0 - z * z);
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
  };
  constexpr int kRings = 100;
  for (int k = 0; k < kRings; ++k) {
    add_ring(-std::cos(std::numbers::pi * (k + 0.5) / kRings));
  }
  for (int k = 0; k + 1 < kRings; ++k) {
    for (int i = 0; i < kAround; ++i) {
      const int a = k * kAround + i;
      const int b = k * kAround + (i + 1) % kAround;
      mesh.triangles.push_back({a, b, b + kAround});
      mesh.triangles.push_back({a, b + kAround, a + kAround});
    }
  }
  return mesh;
}

TEST(FewTriangles, KeepsAMeshThatIsSmall) {
  const TriangleMesh mesh = mesh_from_bytes(to_obj({bracket()}), "bracket.obj", 1e-3);
  Eigen::Isometry3d X_OM = Eigen::Isometry3d::Identity();
  X_OM.translate(Vec3(1.0, 2.0, 3.0));
  X_OM.rotate(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
  const ObjectSurface surface = few_triangles(mesh, X_OM);
  EXPECT_EQ(surface.triangles, mesh.triangles);
  EXPECT_EQ(surface.off, 0.0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_LT((surface.vertices[i] - X_OM * mesh.vertices[i]).norm(), 1e-12);
  }
}

TEST(FewTriangles, ThinsAMeshThatIsLarge) {
  const TriangleMesh mesh = ball();
  const ObjectSurface surface = few_triangles(mesh, Eigen::Isometry3d::Identity(), 2000);
  EXPECT_LE(surface.triangles.size(), 2000U);
  EXPECT_GE(surface.triangles.size(), 1000U);
  EXPECT_GT(surface.off, 0.0);
  EXPECT_LT(surface.off, 0.15);
  for (const Vec3& p : surface.vertices) EXPECT_NEAR(p.norm(), 1.0, 1e-12);
  // Said and true: every vertex has one of these as near as that.
  for (const Vec3& p : mesh.vertices) {
    double nearest = 1e9;
    for (const Vec3& q : surface.vertices) nearest = std::min(nearest, (p - q).norm());
    EXPECT_LE(nearest, surface.off + 1e-12);
  }
  double volume = 0.0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto at = [&](int i) { return surface.vertices[static_cast<std::size_t>(i)]; };
    volume += at(a).dot(at(b).cross(at(c))) / 6.0;
  }
  EXPECT_NEAR(volume, 4.0 / 3.0 * std::numbers::pi, 0.15);
}

}  // namespace
}  // namespace prehensile
