#include "scene/outline.h"

#include <numbers>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

PrismShape tee() {
  return {{{-0.05, -0.05},
           {-0.02, -0.05},
           {-0.02, -0.015},
           {0.05, -0.015},
           {0.05, 0.015},
           {-0.02, 0.015},
           {-0.02, 0.05},
           {-0.05, 0.05}},
          0.03};
}

TEST(Outline, AreaCentroidAndPolarMomentOfARectangle) {
  const OutlineProperties p =
      properties_of({{1.0, 2.0}, {5.0, 2.0}, {5.0, 4.0}, {1.0, 4.0}});
  EXPECT_DOUBLE_EQ(p.area, 8.0);
  EXPECT_NEAR((p.centroid - Vec2(3.0, 3.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(p.second.trace(), 8.0 * (16.0 + 4.0) / 12.0, 1e-12);
}

TEST(Outline, RoundOutlineHasTheAreaOfItsCircle) {
  const CylinderShape disc{0.03, 0.1, Axis::kZ};
  EXPECT_NEAR(properties_of(outline_of(disc)).area, std::numbers::pi * 9e-4, 1e-15);
  EXPECT_TRUE(faces_of(disc).empty());
}

TEST(Outline, CentroidOfTheTee) {
  EXPECT_NEAR(properties_of(tee().outline).centroid.x(), -0.0735 / 5.1, 1e-12);
}

TEST(Outline, FacesHaveInwardNormalsAndEndsInOrder) {
  for (const Shape& shape : {Shape(BoxShape{{0.1, 0.06, 0.03}}), Shape(tee()),
                             Shape(CylinderShape{0.02, 0.1, Axis::kX})}) {
    const std::vector<Vec2> outline = outline_of(shape);
    for (const Face& face : faces_of(shape)) {
      EXPECT_TRUE(contains(outline, face.centre() + 1e-6 * face.n)) << face.name;
      EXPECT_FALSE(contains(outline, face.centre() - 1e-6 * face.n)) << face.name;
      EXPECT_NEAR((face.b - face.a).dot(face.t), face.length(), 1e-15);
      EXPECT_NEAR((perp(face.n) - face.t).norm(), 0.0, 1e-15);
    }
  }
}

TEST(Outline, SidesOfTheTeeAreNamedAndItsNotchIsNoHull) {
  const std::vector<Face> faces = faces_of(tee());
  EXPECT_EQ(faces[find_face(faces, "-x")].length(), 0.1);
  EXPECT_NEAR(faces[find_face(faces, "-y")].length(), 0.03, 1e-15);
  EXPECT_EQ(find_face(faces, "-y"), find_face(faces, "edge0"));
  EXPECT_FALSE(faces[2].on_hull);
  EXPECT_EQ(faces[2].name, "edge2");
  EXPECT_EQ(find_face(faces, "top"), -1);
  EXPECT_EQ(face_towards(faces, {1.0, 0.1}), find_face(faces, "-x"));
}

TEST(Outline, DepthIsTheDistanceToTheBorderWithItsSign) {
  const std::vector<Vec2> outline = tee().outline;
  EXPECT_NEAR(depth_inside(outline, {0.03, 0.0}), 0.015, 1e-15);
  EXPECT_NEAR(depth_inside(outline, {0.03, 0.02}), -0.005, 1e-15);
  EXPECT_TRUE(contains(outline, {0.05, 0.0}));
}

TEST(Outline, SimplePolygonsOnly) {
  EXPECT_TRUE(is_simple(tee().outline));
  EXPECT_FALSE(is_simple({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(is_simple({{0, 0}, {1, 0}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(is_simple({{0, 0}, {1, 0}, {0.5, 0.0}, {0, 1}}));
}

TEST(Outline, VerticesAlongOneEdgeDoNotCrossIt) {
  for (int turn = 0; turn < 100; ++turn) {
    const Vec2 along(std::cos(0.01 * turn), std::sin(0.01 * turn));
    std::vector<Vec2> outline = {perp(along)};
    for (int k = 0; k < 30; ++k) outline.push_back(0.1 * k * along);
    EXPECT_TRUE(is_simple(outline)) << turn;
  }
}

TEST(Outline, SegmentsTouchWhereTheyMeet) {
  const Vec2 a(0, 0);
  const Vec2 b(2, 0);
  EXPECT_TRUE(segments_touch(a, b, {1, -1}, {1, 1}));
  EXPECT_TRUE(segments_touch(a, b, {1, 0}, {1, 1}));
  EXPECT_TRUE(segments_touch(a, b, {1, 0}, {3, 0}));
  EXPECT_FALSE(segments_touch(a, b, {3, 0}, {4, 0}));
  EXPECT_FALSE(segments_touch(a, b, {1, 1e-9}, {1, 1}));
}

TEST(Outline, InertiaOfKnownBodies) {
  Object box{BoxShape{{0.1, 0.06, 0.03}}, 0.5, {}, {}};
  EXPECT_NEAR(moment_of_inertia(box), 0.5 * (0.01 + 0.0036) / 12.0, 1e-12);
  Object bar{CylinderShape{0.02, 0.1, Axis::kY}, 0.5, {}, {}};
  EXPECT_NEAR(moment_of_inertia(bar), 0.5 * (3 * 4e-4 + 0.01) / 12.0, 1e-12);
  Object disc{CylinderShape{0.02, 0.1, Axis::kZ}, 0.5, {}, {}};
  EXPECT_NEAR(moment_of_inertia(disc), 0.5 * 0.5 * 4e-4, 1e-12);
}

TEST(HalfThickness, IsThatOfTheShape) {
  EXPECT_EQ(half_thickness(BoxShape{{1.0, 2.0, 3.0}}), 1.5);
  EXPECT_EQ(half_thickness(CylinderShape{.radius = 0.2, .length = 0.5, .axis = Axis::kZ}),
            0.25);
  EXPECT_EQ(half_thickness(CylinderShape{.radius = 0.2, .length = 0.5, .axis = Axis::kX}),
            0.2);
  EXPECT_EQ(half_thickness(PrismShape{.outline = {}, .thickness = 0.04}), 0.02);
}

TEST(Outline, ATeeHasTwoReflexCorners) {
  const std::vector<Vec2> outline = tee().outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    EXPECT_EQ(is_reflex(outline, i), i == 2 || i == 5) << i;
  }
}

/// How high the side of an object is decides which pushers meet it.
TEST(Outline, SidesHaveHeights) {
  for (const Face& face : faces_of(BoxShape{{0.1, 0.06, 0.03}})) {
    EXPECT_EQ(face.z_low, -0.015);
    EXPECT_EQ(face.z_high, 0.015);
  }
  const std::vector<Face> can = faces_of(CylinderShape{0.02, 0.1, Axis::kX});
  for (const Face& face : can) {
    const bool is_round = std::abs(face.n.y()) > 0.5;
    EXPECT_EQ(face.z_high, is_round ? 0.0 : 0.02) << face.name;
  }
}

}  // namespace
}  // namespace prehensile
