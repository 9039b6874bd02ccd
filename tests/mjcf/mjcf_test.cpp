#include "mjcf/mjcf.h"

#include <cmath>
#include <numbers>
#include <tinyxml2.h>

#include <gtest/gtest.h>

#include "mjcf/mujoco_replay.h"
#include "tests/io/files.h"

namespace prehensile::mjcf {
namespace {

using testing::files_below;
using testing::kSourceTree;

Model model_of(const std::string& file, const std::vector<std::string>& overrides = {}) {
  return prepare(read_scene(kSourceTree / "problems" / file, overrides).scene);
}

PlannedPush from_start(const Model& model, const Push& push) {
  return {.push = push, .start = model.scene.start};
}

/// What a text is refused with; empty if it is not.
std::string refusal(const Model& model, const std::vector<PlannedPush>& pushes) {
  try {
    file_text(model, pushes);
  } catch (const NotCarried& error) {
    return error.what();
  }
  return {};
}

bool holds(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

std::vector<double> numbers_in(const char* text) {
  std::vector<double> values;
  for (char* at = const_cast<char*>(text); *at != '\0';) {
    values.push_back(std::strtod(at, &at));
  }
  return values;
}

TEST(Mjcf, MujocoIsThereUnlessLeftOut) {
  EXPECT_EQ(has_mujoco(), bool{PREHENSILE_WITH_MUJOCO});
}

#if PREHENSILE_WITH_MUJOCO

TEST(Mjcf, EveryShippedSceneLoads) {
  int loaded = 0;
  for (const auto& file : files_below("problems", ".yaml")) {
    const std::string name = file.stem().string();
    // Of the published family the shapes and pushers are two, whatever the goal.
    if (file.parent_path().stem() == "published" && !name.ends_with("_01")) continue;
    const Model model = prepare(read_scene(file).scene);
    EXPECT_EQ(load_error(file_text(model, {})), "") << file;
    ++loaded;
  }
  EXPECT_GE(loaded, 15);
}

TEST(Mjcf, PushesOfEveryKindLoad) {
  const Vec2 x(1.0, 0.0);
  const auto error = [](const std::string& file, const std::vector<Push>& pushes,
                        const std::vector<std::string>& overrides = {}) {
    const Model model = model_of(file, overrides);
    std::vector<PlannedPush> planned;
    planned.reserve(pushes.size());
    for (const Push& push : pushes) planned.push_back(from_start(model, push));
    return load_error(file_text(model, planned));
  };
  EXPECT_EQ(error("paper/slide.yaml",
                  {Slide{.e = x, .travel = 0.02},
                   LinearPush{.place = 0.005, .e = x, .travel = 0.01, .turn = 0.2}}),
            "");
  EXPECT_EQ(error("paper/pivot.yaml", {Pivot{.place = -0.03, .turn = 0.5}}), "");
  EXPECT_EQ(error("tilted_hand.yaml", {LinearPush{.e = x, .travel = 0.01}}), "");
  // Smooth pusher, a plane with an end, a pad off the end of the face.
  EXPECT_EQ(error("paper/slide.yaml", {Slide{.e = x, .travel = 0.01}},
                  {"pushers.0.friction=0"}),
            "");
  EXPECT_EQ(error("paper/slide.yaml", {Slide{.e = x, .travel = 0.03}},
                  {"start.x=0.03", "start.y=0.015"}),
            "");
}

#endif

/// The key frame is where the hand leads the object to, w x y z as MuJoCo has it.
TEST(Mjcf, KeyFramesSayWhereEverythingIs) {
  const Model model = model_of("published/tee_21.yaml");
  const Vec2 e = rotated(0.3, {1.0, 0.0});
  const PlannedPush planned = from_start(
      model, LinearPush{.contact = 1, .e = perp(e), .travel = 0.02, .turn = -0.1});
  const std::string text = file_text(model, {planned});
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(text.c_str()), tinyxml2::XML_SUCCESS);
  const auto* root = document.FirstChildElement("mujoco");
  const auto* key = root->FirstChildElement("keyframe")->FirstChildElement("key");
  const std::vector<double> qpos = numbers_in(key->Attribute("qpos"));
  const std::vector<double> qvel = numbers_in(key->Attribute("qvel"));
  const std::size_t slides = 2 * 16;
  ASSERT_EQ(qpos.size(), kHandJoints + slides + 7);
  ASSERT_EQ(qvel.size(), kHandJoints + slides + 6);
  // Held as the scene says.
  const PlanarPose X_WH{qpos[0], qpos[1], qpos[3]};
  EXPECT_EQ(qpos[2], 0.0);
  const std::size_t o = kHandJoints + slides;
  EXPECT_NEAR(qpos[o + 4], 0.0, 1e-12);
  EXPECT_NEAR(qpos[o + 5], 0.0, 1e-12);
  const PlanarPose X_WO{qpos[o], qpos[o + 1], 2.0 * std::atan2(qpos[o + 6], qpos[o + 3])};
  const PlanarPose X_HO = compose(inverse(X_WH), X_WO);
  EXPECT_NEAR(X_HO.x, model.scene.start.X_HO.x, 1e-9);
  EXPECT_NEAR(X_HO.y, model.scene.start.X_HO.y, 1e-9);
  EXPECT_NEAR(X_HO.theta, model.scene.start.X_HO.theta, 1e-9);
  // Flush with the floor, at y = -0.3.
  for (const Vec2& end : {model.contacts[1].a, model.contacts[1].b}) {
    EXPECT_NEAR(transform(X_WO, end).y(), -0.3, 1e-9);
  }
  // The hand goes against the push, and ends where it should.
  const auto* numeric = root->FirstChildElement("custom")->FirstChildElement("numeric");
  EXPECT_STREQ(numeric->Attribute("name"), "push_1_seconds");
  const double seconds = numeric->DoubleAttribute("data");
  const PlanarPose end = hand_at(model, planned, 1.0).X_WH;
  EXPECT_NEAR(qpos[0] + seconds * qvel[0], end.x, 1e-9);
  EXPECT_NEAR(qpos[1] + seconds * qvel[1], end.y, 1e-9);
  EXPECT_NEAR(qpos[3] + seconds * qvel[3], end.theta, 1e-9);
  EXPECT_LT(seconds * qvel[1], -0.015);
  EXPECT_NEAR(seconds * qvel[3], 0.1, 1e-9);
  EXPECT_EQ(key->DoubleAttribute("ctrl"), model.scene.gripper.grip_force);
}

/// Half way through a push along a straight line the hand that coasts is where the push
/// wants it, whatever it turns by.
TEST(Mjcf, AHandThatCoastsFollowsThePush) {
  const Model model = model_of("published/square_01.yaml");
  for (const double turn : {0.0, 0.4, -0.9}) {
    const PlannedPush planned = from_start(
        model, LinearPush{.e = rotated(0.4, {1.0, 0.0}), .travel = 0.03, .turn = turn});
    const PlanarPose from = hand_at(model, planned, 0.0).X_WH;
    const PlanarPose half = hand_at(model, planned, 0.5).X_WH;
    const PlanarPose to = hand_at(model, planned, 1.0).X_WH;
    EXPECT_NEAR(half.x, 0.5 * (from.x + to.x), 1e-12);
    EXPECT_NEAR(half.y, 0.5 * (from.y + to.y), 1e-12);
    EXPECT_NEAR(half.theta, 0.5 * (from.theta + to.theta), 1e-12);
  }
}

/// The hand goes against the support, with the grip of the roll.
TEST(Mjcf, ARollMovesTheHandAlongTheClosingDirection) {
  const Model model = model_of("paper/roll.yaml");
  const PlannedPush planned = from_start(model, Roll{.travel = 0.02, .grip_force = 1.5});
  const std::string text = file_text(model, {planned});
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(text.c_str()), tinyxml2::XML_SUCCESS);
  const auto* root = document.FirstChildElement("mujoco");
  const auto* key = root->FirstChildElement("keyframe")->FirstChildElement("key");
  const std::vector<double> qvel = numbers_in(key->Attribute("qvel"));
  const auto* numeric = root->FirstChildElement("custom")->FirstChildElement("numeric");
  const double seconds = numeric->DoubleAttribute("data");
  EXPECT_NEAR(seconds * qvel[2], -0.02, 1e-12);
  for (const int still : {0, 1, 3}) EXPECT_EQ(qvel[static_cast<std::size_t>(still)], 0.0);
  EXPECT_EQ(key->DoubleAttribute("ctrl"), 1.5);
}

TEST(Mjcf, RefusesWhatItCannotCarry) {
  const Model slide = model_of("paper/slide.yaml");
  const Vec2 x(1.0, 0.0);
  EXPECT_EQ(refusal(slide, {from_start(slide, Slide{.e = x, .travel = 0.01})}), "");
  EXPECT_TRUE(
      holds(refusal(slide,
                    {from_start(slide, LinearPush{.e = x, .travel = 0.01, .bend = 0.2})}),
            "push 1: its path bends"));
  EXPECT_TRUE(holds(refusal(slide, {from_start(slide, Slide{.contact = 7})}),
                    "push 1: contact 7"));
  const Model limp = model_of("paper/slide.yaml", {"gripper.grip_force=0"});
  EXPECT_TRUE(holds(refusal(limp, {}), "gripper.grip_force 0 N"));
  const Model prism = model_of("paper/roll_prism.yaml");
  EXPECT_EQ(refusal(prism, {}), "");
  EXPECT_TRUE(holds(refusal(prism, {from_start(prism, Roll{.travel = 0.01})}),
                    "push 1: a prism that rolls"));
  const Model tilted = model_of("tilted_hand.yaml", {"gripper.jaw_mode=fixed_jaw_1"});
  EXPECT_TRUE(holds(refusal(tilted, {}), "gripper.jaw_mode fixed_jaw_1"));
  // Across the axis of a can the line of contact leaves the middle of the pads.
  const Model can = model_of("paper/roll.yaml");
  EXPECT_EQ(refusal(can, {from_start(can, Roll{.travel = 0.01})}), "");
  const Model fixed = model_of("paper/roll.yaml", {"gripper.jaw_mode=fixed_jaw_1"});
  EXPECT_TRUE(holds(refusal(fixed, {from_start(fixed, Roll{.travel = 0.01})}),
                    "gripper.jaw_mode fixed_jaw_1"));
  const Model ledges = model_of("ycb/can_franka.yaml");
  PlannedPush once = from_start(ledges, Slide{.contact = 1, .e = x, .travel = 0.01});
  PlannedPush later = once;
  later.start.psi = 0.3;
  EXPECT_EQ(refusal(ledges, {once, once}), "");
  EXPECT_TRUE(holds(refusal(ledges, {once, later}), "push 2: the object has rolled"));
  EXPECT_TRUE(
      holds(refusal(can, {from_start(can, LinearPush{.e = {0.0, 1.0}, .travel = 0.005})}),
            "push 1: the line where the pads touch the cylinder moves"));
}

}  // namespace
}  // namespace prehensile::mjcf
