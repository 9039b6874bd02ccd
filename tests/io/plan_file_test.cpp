#include "io/plan_file.h"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/io/files.h"
#include "tests/io/random_scenes.h"

namespace prehensile::testing {
namespace {

void expect_same(double a, double b) {
  EXPECT_TRUE((std::isnan(a) && std::isnan(b)) || a == b) << a << " and " << b;
}

void expect_same(const Push& a, const Push& b) {
  ASSERT_EQ(a.index(), b.index());
  EXPECT_EQ(contact_of(a), contact_of(b));
  if (const auto* roll = std::get_if<Roll>(&a)) {
    EXPECT_EQ(roll->travel, std::get<Roll>(b).travel);
    EXPECT_EQ(roll->grip_force, std::get<Roll>(b).grip_force);
    return;
  }
  const LinearPush one = as_linear(a);
  const LinearPush two = as_linear(b);
  EXPECT_EQ(one.place, two.place);
  EXPECT_EQ(one.e, two.e);
  EXPECT_EQ(one.travel, two.travel);
  EXPECT_EQ(one.turn, two.turn);
  if (const auto* slide = std::get_if<Slide>(&a)) {
    EXPECT_EQ(slide->guard_angle, std::get<Slide>(b).guard_angle);
  }
  if (const auto* pivot = std::get_if<Pivot>(&a)) {
    EXPECT_EQ(pivot->guard_distance, std::get<Pivot>(b).guard_distance);
  }
}

void expect_same(const Plan& a, const Plan& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.message, b.message);
  EXPECT_EQ(a.planner, b.planner);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.stick_tests, b.stick_tests);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.goal, b.goal);
  EXPECT_EQ(a.proof.kind, b.proof.kind);
  EXPECT_EQ(a.proof.twist, b.proof.twist);
  EXPECT_EQ(a.proof.text, b.proof.text);
  if (std::isfinite(a.margin.force)) {
    EXPECT_EQ(a.margin.force, b.margin.force);
  } else {
    EXPECT_TRUE(std::isnan(b.margin.force));
  }
  EXPECT_EQ(a.margin.place, b.margin.place);
  EXPECT_EQ(a.margin.friction, b.margin.friction);
  EXPECT_EQ(a.margin.grasp, b.margin.grasp);
  EXPECT_EQ(a.margin.tilt, b.margin.tilt);
  EXPECT_EQ(a.margin.weightless, b.margin.weightless);
  EXPECT_EQ(a.promise, b.promise);
  ASSERT_EQ(a.explanation.has_value(), b.explanation.has_value());
  if (a.explanation) {
    EXPECT_EQ(a.explanation->text, b.explanation->text);
    EXPECT_EQ(a.stopped_by.count, b.stopped_by.count);
    ASSERT_EQ(a.explanation->changes.size(), b.explanation->changes.size());
    for (std::size_t i = 0; i < a.explanation->changes.size(); ++i) {
      EXPECT_EQ(a.explanation->changes[i].what, b.explanation->changes[i].what);
      EXPECT_EQ(a.explanation->changes[i].option, b.explanation->changes[i].option);
      EXPECT_EQ(a.explanation->changes[i].pusher, b.explanation->changes[i].pusher);
      expect_same(a.explanation->changes[i].cost, b.explanation->changes[i].cost);
    }
  }
  expect_same(a.cost, b.cost);
  expect_same(a.travel, b.travel);
  EXPECT_EQ(a.work, b.work);
  EXPECT_EQ(a.grip_changes, b.grip_changes);
  expect_same(a.lower_bound, b.lower_bound);
  expect_same(a.published_cost, b.published_cost);
  EXPECT_EQ(a.bound_is_trivial, b.bound_is_trivial);
  EXPECT_EQ(a.bound_at_goal, b.bound_at_goal);
  expect_same(a.seconds, b.seconds);
  ASSERT_EQ(a.pushes.size(), b.pushes.size());
  for (std::size_t i = 0; i < a.pushes.size(); ++i) {
    expect_same(a.pushes[i].push, b.pushes[i].push);
    EXPECT_EQ(a.pushes[i].start, b.pushes[i].start);
    EXPECT_EQ(a.pushes[i].end, b.pushes[i].end);
    expect_same(a.pushes[i].push_force, b.pushes[i].push_force);
    expect_same(a.pushes[i].slack, b.pushes[i].slack);
    expect_same(a.pushes[i].certificate, b.pushes[i].certificate);
  }
}

TEST(PlanFile, RandomPlansReturnUnchanged) {
  Random random(3);
  int pushes = 0;
  for (int i = 0; i < 300; ++i) {
    const SceneFile scene = parse_scene(scene_to_yaml(random_scene(random)), "random");
    const Model model = prepare(scene.scene);
    Plan plan = random_plan(random, model);
    if (random.chance(0.5)) plan.margin.grasp = random.in(0.0, 1e-2);
    if (random.chance(0.1)) plan.margin.force = std::numeric_limits<double>::infinity();
    if (random.chance(0.5)) plan.margin.tilt = random.in(0.0, 0.1);
    plan.margin.weightless = random.chance(0.5);
    plan.promise = static_cast<Promise>(random.below(4));
    plan.bound_is_trivial = random.chance(0.5);
    if (random.chance(0.5)) plan.bound_at_goal = random.in(1.0, 2.0);
    if (random.chance(0.3)) {
      plan.explanation = {"one \"paragraph\"",
                          {{"more grip", "--set gripper.grip_force=9", "", 1.5},
                           {"a wall", "", "{name: wall}", 2.5}}};
      for (std::int64_t& count : plan.stopped_by.count) count = random.below(5);
    }
    plan.seed = random.bits();  // all 64 bits
    const std::string text = plan_to_json({scene.scene, scene.digest, plan});
    const PlanFile file = parse_plan(text, "random");
    expect_same(plan, file.plan);
    EXPECT_EQ(file.scene_digest, scene.digest);
    EXPECT_EQ(scene_to_yaml(file.scene), scene_to_yaml(scene.scene));
    EXPECT_EQ(plan_to_json(file), text);
    pushes += static_cast<int>(plan.pushes.size());
  }
  EXPECT_GT(pushes, 100);
}

TEST(PlanFile, ProofsReturnUnchanged) {
  Random random(4);
  const auto number = [&] { return random.in(-1.0, 1.0) / 3.0; };
  const auto loops = [&](int count) {
    Loops triangles;
    for (int i = 0; i < count; ++i) {
      triangles.emplace_back();
      for (int k = 0; k < 3; ++k) triangles.back().emplace_back(number(), number());
    }
    return triangles;
  };
  const auto rate = [&] {
    return TurnRate{{number(), number()}, {number(), number(), number()}};
  };
  for (int count = 0; count < 3; ++count) {
    const SceneFile scene = parse_scene(scene_to_yaml(random_scene(random)), "random");
    Plan plan;
    plan.status = PlanStatus::kInfeasible;
    plan.proof = {.kind = Proof::Kind::kTurn,
                  .region = loops(count),
                  .turn = TurnBounds{loops(2 - count), rate(), rate()},
                  .text = "no way"};
    const std::string text = plan_to_json({scene.scene, scene.digest, plan});
    const Proof read = parse_plan(text, "random").plan.proof;
    EXPECT_EQ(read.kind, plan.proof.kind);
    EXPECT_EQ(read.region, plan.proof.region);
    ASSERT_TRUE(read.turn);
    EXPECT_EQ(read.turn->beyond, plan.proof.turn->beyond);
    for (const auto side : {&TurnBounds::most, &TurnBounds::least}) {
      EXPECT_EQ(((*read.turn).*side).at_start, ((*plan.proof.turn).*side).at_start);
      EXPECT_EQ(((*read.turn).*side).bend, ((*plan.proof.turn).*side).bend);
    }
    EXPECT_EQ(plan_to_json(parse_plan(text, "random")), text);
  }
}

TEST(PlanFile, IsSelfContained) {
  Random random(4);
  Scene scene = random_scene(random);
  while (scene.pushers.empty()) scene = random_scene(random);
  const SceneFile with =
      parse_scene(scene_to_yaml(scene), "scene", {"object.mass=0.321"});
  Plan plan;
  plan.status = PlanStatus::kBudgetSpent;
  const Folder folder;
  write_atomically(folder / "plan.json", plan_to_json({with.scene, with.digest, plan}));
  const PlanFile file = read_plan(folder / "plan.json");
  EXPECT_EQ(file.scene.object.mass, 0.321);
  EXPECT_EQ(file.plan.status, PlanStatus::kBudgetSpent);
}

TEST(PlanFile, FacesMayBeNamedByTheirEdge) {
  const auto file = kSourceTree / "tests/io/broken/values/unknown_face_in_a_plan.json";
  std::string text = text_of(file);
  const std::string wrong = "\"face\": \"+x\"";
  text.replace(text.find(wrong), wrong.size(), "\"face\": \"edge3\"");
  const PlanFile plan = parse_plan(text, "plan");
  EXPECT_EQ(plan.plan.pushes.size(), 1u);
  EXPECT_NE(plan_to_json(plan).find("\"face\": \"-x\""), std::string::npos);
}

}  // namespace
}  // namespace prehensile::testing
