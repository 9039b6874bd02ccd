#include "io/scene_file.h"

#include <set>

#include <gtest/gtest.h>

#include "io/document.h"
#include "io/fields.h"
#include "mechanics/model.h"
#include "tests/io/files.h"
#include "tests/io/random_scenes.h"

namespace prehensile::testing {
namespace {

const char* const kShortest =
    "version: 1\n"
    "object: {box: {size: [0.1, 0.06, 0.03]}, mass: 0.2}\n"
    "gripper: {pad: {disc: {radius: 0.009}}, friction: 0.5, grip_force: 20}\n";

TEST(SceneFile, AHandfulOfLinesSufficesAndTheRestHasDefaults) {
  const Scene scene = parse_scene(kShortest, "shortest").scene;
  EXPECT_EQ(std::get<BoxShape>(scene.object.shape).size, Vec3(0.1, 0.06, 0.03));
  EXPECT_EQ(scene.object.mass, 0.2);
  EXPECT_FALSE(scene.object.p_OCom);
  EXPECT_FALSE(scene.object.inertia);
  EXPECT_EQ(std::get<DiscPad>(scene.gripper.pad).radius, 0.009);
  EXPECT_EQ(scene.gripper.friction, (std::array<double, 2>{0.5, 0.5}));
  EXPECT_EQ(scene.gripper.jaw_mode, JawMode::kCoupled);
  EXPECT_TRUE(scene.pushers.empty());
  EXPECT_EQ(scene.g_W, Vec2(0.0, -9.81));
  EXPECT_EQ(scene.overhang, Overhang::kClip);
  EXPECT_EQ(scene.start, Grasp{});
  EXPECT_FALSE(scene.goal);
}

TEST(SceneFile, EveryFieldIsRead) {
  const Scene scene = parse_scene(
                          "version: 1\n"
                          "name: all\n"
                          "origin: here\n"
                          "object:\n"
                          "  cylinder: {radius: .02, length: +0.1, axis: x}\n"
                          "  mass: 1e-1\n"
                          "  centre_of_mass: [0.01, 0]\n"
                          "  inertia: 1e-4\n"
                          "gripper:\n"
                          "  name: g\n"
                          "  pad: {rectangle: {size: [0.01, 0.02]}}\n"
                          "  friction: [0.5, 0.6]\n"
                          "  grip_force: 20\n"
                          "  jaw_mode: fixed_jaw_2\n"
                          "  tool: {position: [1, 2, 3], quaternion_xyzw: [1, 0, 0, 0]}\n"
                          "pushers:\n"
                          "  - name: a\n"
                          "    line: {length: 0.05}\n"
                          "    friction: 0.7\n"
                          "    position: [1, 2]\n"
                          "    normal_deg: 90\n"
                          "    faces: [\"-y\", edge1]\n"
                          "  - {name: b, point: {}, friction: 0}\n"
                          "gravity: [0, 0]\n"
                          "overhang: ignore\n"
                          "start: {x: 0.01, y: 0.002, theta_deg: 180, roll: 0.5}\n"
                          "goal:\n"
                          "  y: 0.01\n"
                          "  theta: 1\n"
                          "  roll_deg: 90\n"
                          "  tolerance: {position: 2e-3, angle_deg: 9}\n"
                          "  characteristic_length: 0.05\n"
                          "  test: weighted_sum\n",
                          "all")
                          .scene;
  const auto& can = std::get<CylinderShape>(scene.object.shape);
  EXPECT_EQ(can.radius, 0.02);
  EXPECT_EQ(can.length, 0.1);
  EXPECT_EQ(can.axis, Axis::kX);
  EXPECT_EQ(*scene.object.p_OCom, Vec2(0.01, 0.0));
  EXPECT_EQ(*scene.object.inertia, 1e-4);
  EXPECT_EQ(std::get<RectanglePad>(scene.gripper.pad).size, Vec2(0.01, 0.02));
  EXPECT_EQ(scene.gripper.friction, (std::array<double, 2>{0.5, 0.6}));
  EXPECT_EQ(scene.gripper.jaw_mode, JawMode::kFixedJaw2);
  EXPECT_EQ(scene.gripper.tool.p_HT, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(scene.gripper.tool.q_HT[0], 1.0);
  ASSERT_EQ(scene.pushers.size(), 2u);
  EXPECT_EQ(*std::get<LineFeature>(scene.pushers[0].feature).length, 0.05);
  EXPECT_EQ(scene.pushers[0].normal_angle, std::numbers::pi / 2.0);
  EXPECT_EQ(scene.pushers[0].faces, (std::vector<std::string>{"-y", "edge1"}));
  EXPECT_TRUE(std::holds_alternative<PointFeature>(scene.pushers[1].feature));
  EXPECT_EQ(scene.g_W, Vec2(0.0, 0.0));
  EXPECT_EQ(scene.overhang, Overhang::kIgnore);
  EXPECT_EQ(scene.start.X_HO, (PlanarPose{0.01, 0.002, std::numbers::pi}));
  EXPECT_EQ(scene.start.psi, 0.5);
  ASSERT_TRUE(scene.goal);
  EXPECT_FALSE(scene.goal->x);
  EXPECT_EQ(*scene.goal->theta, 1.0);
  EXPECT_EQ(*scene.goal->psi, std::numbers::pi / 2.0);
  EXPECT_EQ(scene.goal->position_tolerance, 2e-3);
  EXPECT_EQ(scene.goal->angle_tolerance, std::numbers::pi / 20.0);
  EXPECT_EQ(scene.goal->test, GoalTest::kWeightedSum);
}

// The axis of a prism is written only where it lies, so that files and digests of
// standing ones are what they always were.
TEST(SceneFile, AxisOfAPrism) {
  const std::string lying =
      "version: 1\n"
      "object:\n"
      "  prism: {outline: [[-0.01, -0.01], [0.01, -0.01], [0.01, 0.01], [-0.01, 0.01]],\n"
      "          thickness: 0.1, axis: y}\n"
      "  mass: 0.2\n"
      "gripper: {pad: {disc: {radius: 0.009}}, friction: 0.5, grip_force: 20}\n";
  for (const Axis axis : {Axis::kX, Axis::kY, Axis::kZ}) {
    Scene scene = parse_scene(lying, "lying").scene;
    auto& prism = std::get<PrismShape>(scene.object.shape);
    EXPECT_EQ(prism.axis, Axis::kY);
    prism.axis = axis;
    const std::string text = scene_to_yaml(scene);
    EXPECT_EQ(text.find("axis") == std::string::npos, axis == Axis::kZ) << text;
    const Scene again = parse_scene(text, "again").scene;
    EXPECT_EQ(std::get<PrismShape>(again.object.shape).axis, axis);
    EXPECT_EQ(scene_to_yaml(again), text);
  }
}

TEST(SceneFile, RandomScenesReturnUnchanged) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Scene scene = random_scene(random);
    ASSERT_TRUE(check(scene).empty()) << i << check(scene)[0].field;
    const std::string text = scene_to_yaml(scene);
    const SceneFile file = parse_scene(text, "random");
    EXPECT_EQ(scene_to_yaml(file.scene), text);
    EXPECT_EQ(file.scene.start, scene.start);
    EXPECT_EQ(file.scene.name, scene.name);
    EXPECT_EQ(file.scene.origin, scene.origin);
    EXPECT_EQ(file.scene.gripper.tool.q_HT, scene.gripper.tool.q_HT);
    EXPECT_EQ(file.scene.g_W, scene.g_W);
    EXPECT_EQ(file.scene.goal.has_value(), scene.goal.has_value());
    if (scene.goal) {
      EXPECT_EQ(file.scene.goal->theta, scene.goal->theta);
    }
    EXPECT_EQ(file.scene.uncertainty, scene.uncertainty);
    EXPECT_EQ(file.scene.cost, scene.cost);
    for (std::size_t k = 0; k < scene.pushers.size(); ++k) {
      EXPECT_EQ(file.scene.pushers[k].normal_angle, scene.pushers[k].normal_angle);
      EXPECT_EQ(file.scene.pushers[k].name, scene.pushers[k].name);
    }
  }
}

TEST(SceneFile, UncertaintyIsWrittenOnlyIfStated) {
  Scene scene = parse_scene(kShortest, "shortest").scene;
  EXPECT_EQ(scene_to_yaml(scene).find("uncertainty"), std::string::npos);
  scene.uncertainty = Uncertainty{.friction = 0.2};
  EXPECT_NE(scene_to_yaml(scene).find("uncertainty"), std::string::npos);
  scene.uncertainty->mass = 0.95;
  ASSERT_EQ(check(scene).size(), 1u);
  EXPECT_EQ(check(scene)[0].field, "uncertainty.mass");
  EXPECT_THROW(parse_scene(kShortest, "shortest", {"uncertainty={friction: -0.1}"}),
               BadInput);
  EXPECT_THROW(parse_scene(kShortest, "shortest", {"uncertainty={fricton: 0.1}"}),
               BadInput);
}

TEST(SceneFile, PricesAreWrittenOnlyIfStated) {
  Scene scene = parse_scene(kShortest, "shortest").scene;
  EXPECT_EQ(scene_to_yaml(scene).find("cost"), std::string::npos);
  scene = parse_scene(kShortest, "shortest", {"cost={work: 2}"}).scene;
  EXPECT_EQ(scene.cost, CostWeights{.work = 2.0});
  scene.cost->travel = kNan;
  ASSERT_EQ(check(scene).size(), 1u);
  EXPECT_EQ(check(scene)[0].field, "cost.travel");
  for (const char* wrong : {"cost={travel: 0}", "cost={work: -1}",
                            "cost={grip_change: x}", "cost={placement: 1}", "cost=1"}) {
    EXPECT_THROW(parse_scene(kShortest, "shortest", {wrong}), BadInput) << wrong;
  }
}

TEST(SceneFile, WholeDegreesReturnAsWholeDegrees) {
  for (int degrees = -720; degrees <= 720; ++degrees) {
    Scene scene = parse_scene(kShortest, "shortest").scene;
    scene.start.X_HO.theta = degrees * internal::kRadPerDeg;
    const std::string line = "theta_deg: " + std::to_string(degrees) + '\n';
    EXPECT_NE(scene_to_yaml(scene).find(line), std::string::npos) << degrees;
  }
}

/// Paths of all single values of a document.
void collect_paths(const internal::Value& value, const std::string& path,
                   std::vector<std::string>& paths) {
  using Kind = internal::Value::Kind;
  if (value.kind == Kind::kPlain || value.kind == Kind::kText) paths.push_back(path);
  for (const internal::Entry& entry : value.entries) {
    collect_paths(entry.value, internal::join(path, entry.key), paths);
  }
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    collect_paths(value.items[i], internal::join(path, std::to_string(i)), paths);
  }
}

/// Another sound value near this one.
std::string other_value(const internal::Value& value) {
  double number = 0.0;
  if (value.kind == internal::Value::Kind::kText) {
    return internal::to_yaml(internal::Value::quoted(value.text + "x"));
  }
  if (!internal::to_number(value.text, number)) return "";
  return internal::number_text(number == 0.0 ? 1e-6 : number * (1.0 - 1e-6));
}

TEST(SceneFile, TheDigestNoticesEveryField) {
  Random random(2);
  int changed = 0;
  for (int i = 0; i < 20; ++i) {
    const SceneFile file = parse_scene(scene_to_yaml(random_scene(random)), "random");
    internal::Faults faults("random");
    const std::string yaml = scene_to_yaml(file.scene);
    const internal::Value root = internal::parse_yaml(yaml, faults);
    std::vector<std::string> paths;
    collect_paths(root, "", paths);
    std::set<std::string> digests = {file.digest};
    for (const std::string& path : paths) {
      const std::string value = other_value(internal::deepest(root, path));
      const bool cannot_roll =
          path.find("roll") != std::string::npos && !can_roll(file.scene.object);
      if (value.empty() || path == "version" || cannot_roll) continue;
      const std::string digest =
          parse_scene(yaml, "changed", {path + '=' + value}).digest;
      EXPECT_TRUE(digests.insert(digest).second) << path << '=' << value;
      ++changed;
    }
  }
  EXPECT_GT(changed, 400);
}

TEST(SceneFile, TheDigestIgnoresLayoutAndUnits) {
  const std::string digest = parse_scene(kShortest, "shortest").digest;
  EXPECT_EQ(digest.size(), 16u);
  const std::string other =
      "# a comment\n"
      "gripper:\n  grip_force: 20.0\n  friction: [0.5, 0.5]\n"
      "  pad: {disc: {radius: 9e-3}}\n"
      "object:\n  mass: 0.200\n  box:\n    size: [0.1, 0.06, 0.03]\n"
      "start: {theta: 0, x: 0}\n"
      "version: 1\n";
  EXPECT_EQ(parse_scene(other, "other").digest, digest);
  EXPECT_EQ(parse_scene(kShortest, "shortest", {"start.theta_deg=0"}).digest, digest);
  EXPECT_NE(parse_scene(kShortest, "shortest", {"start.theta_deg=1"}).digest, digest);
}

TEST(Overrides, ReplaceAndAddFields) {
  const auto scene_with = [](const std::vector<std::string>& overrides) {
    return parse_scene(kShortest, "shortest", overrides).scene;
  };
  EXPECT_EQ(scene_with({"gripper.grip_force=30"}).gripper.grip_force, 30.0);
  EXPECT_EQ(scene_with({"goal.x=0.01"}).goal->x, 0.01);
  EXPECT_EQ(scene_with({"gravity=[0, 0]"}).g_W, Vec2(0.0, 0.0));
  EXPECT_EQ(scene_with({"object.box.size.2=0.05", "object.box.size.2=0.06"})
                .object.shape.index(),
            0u);
  EXPECT_EQ(scene_with({"start.theta=0.5", "start.theta_deg=180"}).start.X_HO.theta,
            std::numbers::pi);
  EXPECT_EQ(scene_with({"start.theta_deg=180", "start.theta=0.5"}).start.X_HO.theta, 0.5);
  const Scene other = scene_with(
      {"gripper.pad={point: {}}", "pushers=[{name: a, point: {}, friction: 0.1}]",
       "pushers.0.friction=0.2", "pushers.0.name=with = sign"});
  EXPECT_TRUE(std::holds_alternative<PointPad>(other.gripper.pad));
  ASSERT_EQ(other.pushers.size(), 1u);
  EXPECT_EQ(other.pushers[0].friction, 0.2);
  EXPECT_EQ(other.pushers[0].name, "with = sign");
}

TEST(Problems, EveryShippedSceneLoadsAndSaysWhereItComesFrom) {
  const auto files = files_below("problems", ".yaml");
  EXPECT_GE(files.size(), 110u);
  for (const auto& file : files) {
    const SceneFile scene = read_scene(file);
    EXPECT_FALSE(scene.scene.origin.empty()) << file;
    EXPECT_TRUE(scene.scene.goal) << file;
    EXPECT_FALSE(prepare(scene.scene).contacts.empty()) << file;
  }
}

TEST(Problems, PublishedGraspsAreThoseOfThePublishedConstants) {
  for (const auto& file : files_below("problems/published", ".yaml")) {
    const Model model = prepare(read_scene(file).scene);
    EXPECT_NEAR(model.F, 45.0, 1e-12);
    EXPECT_NEAR(model.c, 0.006, 1e-12);
    EXPECT_EQ(model.contacts.size(), 3u);
    for (const PushContact& contact : model.contacts) {
      EXPECT_NEAR((contact.g_O - Vec2(0.0, -9.81)).norm(), 0.0, 1e-12);
    }
    const Goal& goal = *model.scene.goal;
    EXPECT_TRUE(pads_on_object(model, {*goal.x, *goal.y, *goal.theta})) << file;
  }
}

}  // namespace
}  // namespace prehensile::testing
