#include "scene/lying_prism.h"

#include <gtest/gtest.h>

#include "scene/outline.h"
#include "tests/support/sections.h"

namespace prehensile {
namespace {

using testing::regular_section;

// A prism with a rectangular section is a box.
TEST(LyingPrism, WithARectangleItIsABox) {
  const double a = 0.03, b = 0.02, length = 0.1;
  const std::vector<Vec2> section = {
      {-0.5 * a, -0.5 * b}, {0.5 * a, -0.5 * b}, {0.5 * a, 0.5 * b}, {-0.5 * a, 0.5 * b}};
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    const Shape prism = PrismShape{section, length, axis};
    const Shape box =
        BoxShape{axis == Axis::kX ? Vec3(length, a, b) : Vec3(a, length, b)};
    EXPECT_EQ(half_thickness(prism), half_thickness(box));
    const std::vector<Vec2> one = outline_of(prism);
    const std::vector<Vec2> other = outline_of(box);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR((one[i] - other[i]).norm(), 0.0, 1e-15);
    const std::vector<Face> faces = faces_of(prism);
    const std::vector<Face> of_box = faces_of(box);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(faces[i].name, of_box[i].name);
      EXPECT_NEAR(faces[i].z_low, of_box[i].z_low, 1e-15);
      EXPECT_NEAR(faces[i].z_high, of_box[i].z_high, 1e-15);
    }
    Object object;
    object.mass = 0.3;
    object.shape = prism;
    const Eigen::Matrix3d inertia = inertia_of(object);
    object.shape = box;
    EXPECT_NEAR((inertia - inertia_of(object)).norm(), 0.0, 1e-15);
    EXPECT_NEAR(centre_of_mass(object).norm(), 0.0, 1e-15);
  }
}

TEST(LyingPrism, PadsFindTheFlatSidesThatFaceThem) {
  const Shape octagon = PrismShape{regular_section(8, 0.02), 0.1, Axis::kX};
  const double side = 2.0 * 0.02 * std::tan(std::numbers::pi / 8.0);
  double width = 0.0;
  for (const Vec2& v : pad_face_of(octagon)) width = std::max(width, 2.0 * v.y());
  EXPECT_NEAR(width, side, 1e-12);
  const Vec2 heights = side_heights(regular_section(8, 0.02), false);
  EXPECT_NEAR(heights.y() - heights.x(), side, 1e-12);
}

TEST(LyingPrism, FaultsOfASection) {
  const auto fault = [](std::vector<Vec2> section) {
    return section_fault({std::move(section), 0.1, Axis::kX});
  };
  EXPECT_EQ(fault(regular_section(8, 0.02)), "");
  EXPECT_EQ(fault(regular_section(6, 0.02)), "");
  EXPECT_NE(fault(regular_section(3, 0.02)).find("mid-plane"), std::string::npos);
  std::vector<Vec2> notched = regular_section(8, 0.02);
  notched[2] *= 0.3;
  EXPECT_NE(fault(notched).find("convex"), std::string::npos);
  Scene scene;
  scene.object.shape = PrismShape{notched, 0.1, Axis::kX};
  scene.object.mass = 0.1;
  const std::vector<Fault> faults = check(scene);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front().field, "object.prism.outline");
}

TEST(LyingPrism, ASquareLooksTheSameAfterAQuarterTurn) {
  const double quarter = 0.5 * std::numbers::pi;
  EXPECT_TRUE(is_same_section(regular_section(4, 0.02), 3.0 * quarter));
  EXPECT_FALSE(is_same_section(regular_section(4, 0.02), 0.5 * quarter));
  const std::vector<Vec2> flat = {
      {-0.03, -0.02}, {0.03, -0.02}, {0.03, 0.02}, {-0.03, 0.02}};
  EXPECT_FALSE(is_same_section(flat, quarter));
  EXPECT_TRUE(is_same_section(flat, 2.0 * quarter));
  for (const int sides : {3, 4, 6, 12}) {
    const std::vector<Vec2> section = regular_section(sides, 0.02);
    EXPECT_NEAR(symmetry_angle(section), 4.0 * quarter / sides, 1e-12) << sides;
  }
  EXPECT_NEAR(symmetry_angle(flat), 2.0 * quarter, 1e-12);
  const std::vector<Vec2> beside = {
      {-0.03, -0.02}, {0.02, -0.02}, {0.02, 0.02}, {-0.03, 0.02}};
  EXPECT_NEAR(symmetry_angle(beside), 4.0 * quarter, 1e-12);
}

/// Plans roll a prism to where it looks as it did; other goals are refused by name.
TEST(LyingPrism, GoalsAreAttitudesThatLookAlike) {
  Scene scene;
  scene.object.shape = PrismShape{regular_section(6, 0.02), 0.1, Axis::kX};
  scene.object.mass = 0.1;
  scene.gripper.pad = RectanglePad{{0.03, 0.002}};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.goal.emplace();
  for (const double sides : {-4.0, 1.0, 7.0}) {
    scene.goal->psi = sides * std::numbers::pi / 3.0;
    EXPECT_TRUE(check(scene).empty()) << sides;
  }
  scene.goal->psi = 0.5 * std::numbers::pi;
  const std::vector<Fault> faults = check(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].field, "goal.roll_deg");
  EXPECT_NE(faults[0].what.find("multiple of 60"), std::string::npos) << faults[0].what;
}

}  // namespace
}  // namespace prehensile
