#include "mechanics/model.h"

#include <gtest/gtest.h>

#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

Scene square_scene() {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  scene.object.mass = 0.5;
  scene.gripper.pad = DiscPad{0.009};
  scene.gripper.friction = {0.9, 0.7};
  scene.gripper.grip_force = 25.0;
  scene.overhang = Overhang::kIgnore;
  for (const double angle_deg : {0.0, 90.0, -90.0}) {
    Pusher wall;
    wall.name = "wall" + std::to_string(scene.pushers.size());
    wall.feature = LineFeature{};
    wall.friction = 0.9;
    wall.normal_angle = angle_deg * 3.14159265358979323846 / 180.0;
    scene.pushers.push_back(wall);
  }
  return scene;
}

TEST(Model, ConstantsOfTheGrasp) {
  const Model model = prepare(square_scene());
  EXPECT_NEAR(model.F, 1.6 * 25.0, 1e-12);
  EXPECT_NEAR(model.c, 0.006, 1e-15);
  EXPECT_EQ(model.L, 0.1);
  EXPECT_EQ(model.state_dimensions(), 3);
  EXPECT_FALSE(model.cross_section);
}

TEST(Model, WallsTouchTheFaceOppositeToTheirNormal) {
  const Model model = prepare(square_scene());
  ASSERT_EQ(model.contacts.size(), 3u);
  EXPECT_EQ(model.faces[model.contacts[0].face].name, "-x");
  EXPECT_EQ(model.faces[model.contacts[1].face].name, "-y");
  EXPECT_EQ(model.faces[model.contacts[2].face].name, "+y");
  for (const PushContact& contact : model.contacts) {
    EXPECT_NEAR((contact.g_O - Vec2(0.0, -9.81)).norm(), 0.0, 1e-12);
  }
}

TEST(Model, GravityTurnsWithTheFaceThatTouches) {
  Scene scene = square_scene();
  scene.pushers[0].faces = {"-x", "+y"};
  const Model model = prepare(scene);
  const int contact = find_contact(model, "wall0", "+y");
  ASSERT_GE(contact, 0);
  EXPECT_NEAR((model.contacts[contact].g_O - Vec2(-9.81, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(find_contact(model, "wall0", "+x"), -1);
}

TEST(Model, OtherGripsAreFurtherContacts) {
  Scene scene = square_scene();
  scene.gripper.grip_range = Vec2(10.0, 40.0);
  const Model model = prepare(scene);
  ASSERT_EQ(model.contacts.size(), 12u);
  for (const double force : {10.0, 20.0, 25.0, 40.0}) {
    const int contact = find_contact(model, "wall1", "-y", force / 25.0);
    ASSERT_GE(contact, 0) << force;
    const PushContact& found = model.contacts[contact];
    EXPECT_NEAR(found.g_O.norm(), 9.81 * 25.0 / force, 1e-12);
  }
  EXPECT_EQ(find_contact(model, "wall1", "-y", 30.0 / 25.0), -1);
  EXPECT_EQ(prepare(scene, {.other_grips = false}).contacts.size(), 3u);
  scene.g_W.setZero();  // they would move alike
  EXPECT_EQ(prepare(scene).contacts.size(), 3u);
  scene.g_W = {0.0, -9.81};
  scene.gripper.grip_force = 1e-300;
  EXPECT_EQ(prepare(scene).contacts.size(), 3u);
  scene.gripper.grip_force = 0.0;
  EXPECT_EQ(prepare(scene).contacts.size(), 3u);
}

TEST(Model, ShortLinesCoverPartOfTheFace) {
  Scene scene = square_scene();
  scene.pushers[0].feature = LineFeature{0.04};
  const Model model = prepare(scene);
  const PushContact::Segment middle = model.contacts[0].segment(0.01);
  EXPECT_NEAR((middle.b - middle.a).norm(), 0.04, 1e-15);
  const PushContact::Segment end = model.contacts[0].segment(0.05);
  EXPECT_NEAR((end.b - end.a).norm(), 0.02, 1e-15);
}

TEST(Model, GravityActsAtTheCentreOfMass) {
  Scene scene = square_scene();
  scene.object.p_OCom = Vec2(0.02, 0.0);
  const Model model = prepare(scene);
  const PlanarGrasp grasp = grasp_at(model, {}, {0.0, -9.81});
  EXPECT_NEAR((grasp.w_g - PlanarWrench(0.0, -4.905, -0.02 * 4.905)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(grasp.capacity(), model.F, 1e-12);
}

TEST(Model, InertiaAboutTheFingerAxis) {
  const Model model = prepare(square_scene());
  const PlanarPose X_HO{0.01, 0.02, 0.3};
  PlanarGrasp grasp = grasp_at(model, X_HO, Vec2::Zero());
  add_inertia(model, X_HO, grasp);
  const PlanarTwist V(0.3, -0.2, 4.0);
  const Vec2 v_com = point_velocity(V, transform(X_HO, model.p_OCom));
  const double twice_energy =
      model.mass * v_com.squaredNorm() + model.inertia_O(2, 2) * V[2] * V[2];
  EXPECT_NEAR(V.dot(grasp.inertia * V), twice_energy, 1e-12);
}

TEST(Model, GraspAndDriveUseNoHeap) {
  const Model model = prepare(square_scene());
  const testing::NoHeapScope scope;
  const PlanarGrasp grasp = grasp_at(model, {0.01, 0.0, 0.1}, {0.0, -9.81});
  const PlanarDrive drive = drive_at(model.contacts[0], 0.0, {}, {0.01, 0.0, 0.0});
  const long allocations = scope.allocations();
  EXPECT_EQ(allocations, testing::heap_is_counted() ? 0 : -1);
  EXPECT_EQ(grasp.count, 16);
  EXPECT_EQ(drive.count, 2);
}

TEST(Model, WithoutFrictionOrGripNothingHolds) {
  Scene scene = square_scene();
  scene.gripper.grip_force = 0.0;
  EXPECT_EQ(grasp_at(prepare(scene), {}, Vec2::Zero()).count, 0);
}

TEST(Model, WhatIsLeftOutIsExplained) {
  Scene scene = square_scene();
  scene.g_W = Vec2::Zero();
  std::string text;
  for (const Decision& decision : prepare(scene).decisions) {
    EXPECT_FALSE(decision.why.empty());
    text += decision.what + "; ";
  }
  EXPECT_NE(text.find("gravity wrench"), std::string::npos);
  EXPECT_NE(text.find("clipping"), std::string::npos);
}

TEST(Model, RoundObjectsGetACrossSection) {
  Scene scene = square_scene();
  scene.object.shape = CylinderShape{0.03, 0.1, Axis::kX};
  const Model model = prepare(scene);
  ASSERT_TRUE(model.cross_section);
  EXPECT_EQ(model.cross_section->radius, 0.03);
  EXPECT_EQ(model.state_dimensions(), 4);
}

TEST(Model, BadScenesAreRefusedWithAllFaults) {
  Scene scene = square_scene();
  scene.object.mass = 0.0;
  scene.gripper.grip_force = -1.0;
  try {
    prepare(scene);
    FAIL() << "accepted";
  } catch (const BadScene& bad) {
    EXPECT_EQ(bad.faults().size(), 2u);
  }
}

}  // namespace
}  // namespace prehensile
