#include "benchmarks/suite/problem_list.h"

#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "mechanics/model.h"
#include "tests/suite/small_suite.h"

namespace prehensile::suite {
namespace {

using testing::Folder;

namespace fs = std::filesystem;
const fs::path kRoot = PREHENSILE_SOURCE_DIR;

ProblemList problems_of(const std::string& families, const fs::path& folder = "",
                        bool quick = false) {
  return {parse_suite("version: 1\nname: s\nplanners:\n  - {planner: push}\nfamilies:\n" +
                          families,
                      "s.yaml", {"push"}, folder),
          quick};
}

template <typename Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const std::exception& fault) {
    return fault.what();
  }
  return {};
}

const std::string kAllKinds =
    "  - {name: published, published: {object: tee}}\n"
    "  - {name: ranges, among_walls: {object: tee, range: published, gravity: none}}\n"
    "  - {name: wide, among_walls: {object: square}}\n"
    "  - {name: boxes, random: {object: box}}\n"
    "  - {name: cans, random: {object: cylinder, goals: random}}\n"
    "  - {name: fixtures, fixtures: {object: box, pusher_count: [1, 6]}}\n"
    "  - {name: points, fixtures: {object: tee, pushers: points}}\n"
    "  - {name: slender, fixtures: {object: convex, pad: rectangle, pad_aspect: [0.1, "
    "0.3]}}\n"
    "  - {name: concave, fixtures: {object: concave, goals: random}}\n"
    "  - {name: tight, fixtures: {object: box, position_tolerance: 1e-4,\n"
    "      angle_tolerance_deg: 0.1}}\n"
    "  - {name: ycb, scenes: {files: [\"ycb/*.yaml\"]}}\n"
    "  - {name: ycb_pushes, scenes: {files: [\"ycb/*.yaml\"], goals: pushes, count: 5}}\n"
    "  - {name: ycb_random, scenes: {files: [\"y?b/can_*.yaml\"], goals: random, count: "
    "5}}\n";

TEST(ProblemList, ProblemsAreSoundAndTheSameEachTime) {
  const ProblemList problems = problems_of(kAllKinds, kRoot / "problems");
  ASSERT_EQ(problems.families(), 13);
  for (int family = 0; family < problems.families(); ++family) {
    std::set<std::string> different;
    const int count = std::min(6, problems.count(family));
    for (int i = 0; i < count; ++i) {
      const Scene scene = problems.scene(family, i);
      EXPECT_TRUE(check(scene).empty()) << problems.problem_name(family, i);
      const std::string text = scene_to_yaml(scene);
      EXPECT_EQ(text, scene_to_yaml(problems.scene(family, i)));
      different.insert(text);
      ASSERT_TRUE(scene.goal.has_value());
      EXPECT_FALSE(prepare(scene).contacts.empty());
      EXPECT_EQ(scene.name, problems.name(family) + '/' + std::to_string(i + 1));
    }
    EXPECT_EQ(static_cast<int>(different.size()), count) << problems.name(family);
  }
}

TEST(ProblemList, RangesAreKept) {
  const ProblemList problems = problems_of(
      "  - {name: f, fixtures: {object: box, size: [0.05, 0.06], mass: [0.1, 0.2],\n"
      "      pad: rectangle, pad_size: [0.01, 0.02], pad_aspect: [0.2, 0.4],\n"
      "      finger_friction: [0.5, 0.6], pusher_friction: [0.3, 0.4],\n"
      "      strength: [2, 3], pusher_count: [1, 6], weightless: 0.5,\n"
      "      position_tolerance: 5e-4, angle_tolerance: 0.01}}\n");
  std::set<std::size_t> counts;
  int weightless = 0;
  constexpr int kProblems = 60;
  for (int i = 0; i < kProblems; ++i) {
    const Scene scene = problems.scene(0, i);
    const Vec3 size = std::get<BoxShape>(scene.object.shape).size;
    EXPECT_TRUE(size.x() >= 0.05 && size.x() <= 0.06 && size.y() >= 0.05);
    EXPECT_TRUE(scene.object.mass >= 0.1 && scene.object.mass <= 0.2);
    const Vec2 pad = std::get<RectanglePad>(scene.gripper.pad).size;
    const double aspect = pad.minCoeff() / pad.maxCoeff();
    EXPECT_TRUE(pad.maxCoeff() >= 0.01 && pad.maxCoeff() <= 0.02);
    EXPECT_TRUE(aspect >= 0.2 && aspect <= 0.4);
    const double mu = scene.gripper.friction[0];
    EXPECT_TRUE(mu >= 0.5 && mu <= 0.6);
    const double strength =
        2.0 * mu * scene.gripper.grip_force / (9.81 * scene.object.mass);
    EXPECT_TRUE(strength >= 2.0 && strength <= 3.0) << strength;
    for (const Pusher& pusher : scene.pushers) {
      EXPECT_TRUE(pusher.friction >= 0.3 && pusher.friction <= 0.4);
    }
    counts.insert(scene.pushers.size());
    weightless += scene.g_W.norm() == 0.0 ? 1 : 0;
    EXPECT_EQ(scene.goal->position_tolerance, 5e-4);
    EXPECT_EQ(scene.goal->angle_tolerance, 0.01);
  }
  EXPECT_EQ(*counts.begin(), 1u);
  EXPECT_EQ(*counts.rbegin(), 6u);
  EXPECT_GT(weightless, 15);
  EXPECT_LT(weightless, 45);
}

#ifdef PREHENSILE_HAS_MESHES
TEST(ProblemList, MeshesAreHeldAndPushed) {
  const ProblemList problems = problems_of(
      "  - {name: m, meshes: {files: [\"meshes/*.obj\"], unit: mm, count: 3}}\n",
      kRoot / "problems");
  ASSERT_EQ(problems.count(0), 3);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(check(problems.scene(0, i)).empty());
}
#endif

TEST(ProblemList, FilesStayInTheFolder) {
  const Folder folder;
  fs::create_directory(folder / "inside");
  std::ofstream(folder / "scene.yaml") << "version: 1\n";
  fs::create_symlink(folder / "scene.yaml", folder / "inside/link.yaml");
  const auto message = message_of([&] {
    problems_of("  - {name: f, scenes: {files: [\"*.yaml\"]}}\n", folder / "inside");
  });
  EXPECT_NE(message.find("leads out of"), std::string::npos) << message;
  const auto absent = message_of([&] {
    problems_of("  - {name: f, scenes: {files: [\"*.yml\"]}}\n", folder / "inside");
  });
  EXPECT_NE(absent.find("no such file"), std::string::npos) << absent;
}

TEST(ProblemList, RangesWithoutAProblemSaySo) {
  // Fingers as strong as the weight hold nothing over the margin.
  const ProblemList problems = problems_of(
      "  - {name: f, fixtures: {object: box, strength: [1, 1.01], weightless: 0}}\n");
  EXPECT_NE(message_of([&] { problems.scene(0, 0); }), "");
}

TEST(ProblemList, QuickTakesTheFirstFew) {
  const ProblemList problems =
      problems_of(kAllKinds + "quick: 2\n", kRoot / "problems", true);
  EXPECT_EQ(problems.count(), 2 * 13);
}

}  // namespace
}  // namespace prehensile::suite
