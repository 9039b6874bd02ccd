/// What a scene does not have gets no row, no column, no state dimension: ten scenes.
#include "mechanics/size_of_problem.h"

#include <functional>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

Pusher line_pusher(double friction) {
  Pusher pusher;
  pusher.name = "wall";
  pusher.feature = LineFeature{};
  pusher.friction = friction;
  return pusher;
}

Scene base_scene() {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.06, 0.03}};
  scene.object.mass = 0.2;
  scene.gripper.pad = DiscPad{0.009};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {line_pusher(0.4)};
  return scene;
}

struct SizeCase {
  const char* what;
  std::function<void(Scene&)> change;
  int points_per_pad;
  int finger_points;
  int pusher_points;
  int generators;
  int reference_unknowns;
  int contacts;
  int state_dimensions;
};

TEST(SizeOfProblem, TenScenes) {
  const auto nothing = [](Scene&) {};
  const std::vector<SizeCase> cases = {
      {"disc pads, line pusher", nothing, 16, 16, 2, 132, 155, 1, 3},
      {"fewer points", nothing, 4, 4, 2, 36, 47, 1, 3},
      {"point pusher", [](Scene& s) { s.pushers[0].feature = PointFeature{}; }, 16, 16, 1,
       130, 151, 1, 3},
      {"frictionless pusher", [](Scene& s) { s.pushers[0].friction = 0.0; }, 16, 16, 2,
       128, 149, 1, 3},
      {"point pads", [](Scene& s) { s.gripper.pad = PointPad{}; }, 16, 1, 2, 12, 20, 1,
       3},
      {"line pads",
       [](Scene& s) {
         s.gripper.pad = LinePad{0.02, 0.0};
       },
       8, 8, 2, 68, 83, 1, 3},
      {"no grip", [](Scene& s) { s.gripper.grip_force = 0.0; }, 16, 0, 2, 4, 11, 1, 3},
      {"no pusher", [](Scene& s) { s.pushers.clear(); }, 16, 16, 0, 0, 0, 0, 3},
      {"three faces",
       [](Scene& s) {
         s.pushers[0].faces = {"-x", "-y", "+y"};
       },
       16, 16, 2, 132, 155, 3, 3},
      {"bar that can roll",
       [](Scene& s) {
         s.object.shape = CylinderShape{0.02, 0.1, Axis::kX};
       },
       16, 16, 2, 132, 155, 1, 4},
  };
  for (const SizeCase& c : cases) {
    Scene scene = base_scene();
    c.change(scene);
    const Model model = prepare(scene, {.points_per_pad = c.points_per_pad});
    EXPECT_EQ(static_cast<int>(model.contacts.size()), c.contacts) << c.what;
    EXPECT_EQ(model.state_dimensions(), c.state_dimensions) << c.what;
    EXPECT_EQ(model.cross_section.has_value(), c.state_dimensions == 4) << c.what;
    if (model.contacts.empty()) continue;
    const ProblemSize size = size_of_problem(model, 0);
    EXPECT_EQ(size.unknowns, 3) << c.what;
    EXPECT_EQ(size.finger_points, c.finger_points) << c.what;
    EXPECT_EQ(size.pusher_points, c.pusher_points) << c.what;
    EXPECT_EQ(size.generators, c.generators) << c.what;
    EXPECT_EQ(size.reference_unknowns, c.reference_unknowns) << c.what;
  }
}

TEST(SizeOfProblem, JawsAddTheFreedomsTheyHave) {
  const std::pair<JawMode, int> cases[] = {{JawMode::kCoupled, 7},
                                           {JawMode::kFixedJaw1, 7},
                                           {JawMode::kFixedJaw2, 7},
                                           {JawMode::kIndependent, 8},
                                           {JawMode::kLocked, 6}};
  for (const auto& [mode, unknowns] : cases) {
    Scene scene = base_scene();
    scene.gripper.jaw_mode = mode;
    const ProblemSize size = size_of_problem(prepare(scene), 0);
    EXPECT_EQ(size.spatial_unknowns, unknowns);
    EXPECT_EQ(size.spatial_points, 2 * size.finger_points + size.pusher_points);
  }
}

TEST(SizeOfProblem, NoGravityGivesNoWrench) {
  Scene scene = base_scene();
  scene.g_W = Vec2::Zero();
  const Model model = prepare(scene);
  EXPECT_TRUE(grasp_at(model, {}, model.contacts[0].g_O).w_g.isZero(0.0));
}

}  // namespace
}  // namespace prehensile
