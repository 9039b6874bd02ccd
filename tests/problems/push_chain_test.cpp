#include "problems/push_chain.h"

#include <gtest/gtest.h>

#include "primitives/transition.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

/// A plate with a notch from its upper side, pushed by points on both ends.
Scene notched_plate() {
  Scene scene;
  scene.object.shape = PrismShape{{{-0.05, -0.03},
                                   {0.05, -0.03},
                                   {0.05, 0.03},
                                   {0.002, 0.03},
                                   {0.002, -0.005},
                                   {-0.002, -0.005},
                                   {-0.002, 0.03},
                                   {-0.05, 0.03}},
                                  0.025};
  scene.object.mass = 0.1;
  scene.gripper.pad = DiscPad{0.004};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 40.0;
  scene.overhang = Overhang::kIgnore;
  for (const char* face : {"-x", "+x"}) {
    Pusher pusher;
    pusher.name = face;
    pusher.feature = PointFeature{};
    pusher.friction = 0.5;
    pusher.faces = {face};
    scene.pushers.push_back(pusher);
  }
  scene.start.X_HO = pose_from_finger({-0.02, 0.005}, 0.0);
  return scene;
}

// What the goal is made of stays 1 mm inside of the border, as each push is drawn to.
TEST(PushChain, PointsKeepTheFingersOnTheObjectAllTheWay) {
  const Model model = prepare(notched_plate());
  RandomStream random(2);
  int pushes = 0;
  for (int i = 0; i < 60; ++i) {
    RandomRegrasp problem;
    problem.scene = model.scene;
    if (!append_chain(model, {.least = 1, .most = 3}, random, problem)) continue;
    Grasp grasp = model.scene.start;
    for (const Push& push : problem.pushes) {
      std::vector<Sample> trace;
      const Transition done = apply(model, grasp, push, {.max_step = 0.01}, &trace);
      ASSERT_TRUE(done.completed()) << i << " " << done.reason;
      for (const Sample& sample : trace) {
        // Between two looks 2 mm apart, half of that at most.
        EXPECT_GT(depth_inside(model.outline, finger_in_object(sample.grasp.X_HO)), 0.0)
            << i << " " << sample.s;
      }
      grasp = done.end;
      ++pushes;
    }
  }
  EXPECT_GT(pushes, 60);
}

}  // namespace
}  // namespace prehensile
