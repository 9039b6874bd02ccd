/// --mjcf of `view` and `query push`, and `check --mujoco`.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

bool holds(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

TEST(Mjcf, IsWrittenOfScenesAndPushes) {
  const Folder folder;
  const std::string file = folder.path("push.xml").string();
  const Outcome push = run_program(
      "query push problems/paper/slide.yaml --kind slide --travel-mm 5 --json --mjcf " +
      file);
  EXPECT_EQ(push.exit_code, 0) << push.err;
  EXPECT_TRUE(holds(read_text(file), "name=\"push_1\""));
  const Outcome scene = run_program("view problems/paper/roll.yaml --mjcf " + file);
  EXPECT_EQ(scene.exit_code, 0) << scene.err;
  EXPECT_TRUE(holds(scene.out, "MJCF: " + file));
  EXPECT_TRUE(holds(read_text(file), "name=\"start\""));
}

TEST(Mjcf, ARefusalLeavesNothing) {
  const Folder folder;
  const std::string file = folder.path("push.xml").string();
  const Outcome refused =
      run_program("query push problems/paper/slide.yaml --bend-deg 10 --mjcf " + file);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(holds(refused.err, "--mjcf " + file + ": push 1: its path bends"))
      << refused.err;
  EXPECT_TRUE(folder.empty());
}

/// Jaws of which one stands still roll a can, but not in MuJoCo.
TEST(CheckMujoco, RefusesWhatItCannotCarry) {
  const Folder folder;
  const std::string plan = folder.path("plan.json").string();
  const std::string file = folder.path("plan.xml").string();
  ASSERT_EQ(
      run_program("plan problems/paper/roll.yaml --set gripper.jaw_mode=fixed_jaw_1 "
                  "--no-advice -o " +
                  plan)
          .exit_code,
      0);
  const std::string why = "gripper.jaw_mode fixed_jaw_1: expected coupled or locked";
  const Outcome written = run_program("view " + plan + " --mjcf " + file);
  EXPECT_EQ(written.exit_code, 2);
  EXPECT_TRUE(holds(written.err, "--mjcf " + file + ": " + why)) << written.err;
  EXPECT_FALSE(std::filesystem::exists(file));
  const Outcome seen = run_program("check " + plan + " --mujoco");
  EXPECT_EQ(seen.exit_code, 2);
  EXPECT_EQ(seen.out, "");
  EXPECT_TRUE(holds(
      seen.err, PREHENSILE_WITH_MUJOCO ? "--mujoco: " + why : "this build has no MuJoCo"))
      << seen.err;
}

/// A speed at which the simulation would never end, and none that would take no step.
TEST(CheckMujoco, RefusesASpeedThatTakesForEver) {
  const Folder folder;
  const std::string plan = folder.path("plan.json").string();
  const std::string goal =
      "plan problems/paper/slide.yaml --set goal.x=-0.011 --no-advice -o ";
  ASSERT_EQ(run_program(goal + plan).exit_code, 0);
  for (const char* speed : {"1e-300", "1e-9", "1e-5"}) {
    const Outcome seen =
        run_program("check " + plan + " --mujoco --mujoco-speed-mm-s " + speed);
    EXPECT_EQ(seen.exit_code, 2);
    EXPECT_EQ(seen.out, "");
    EXPECT_TRUE(holds(seen.err, PREHENSILE_WITH_MUJOCO ? "expected at most 100000 s"
                                                       : "this build has no MuJoCo"))
        << seen.err;
  }
}

TEST(CheckMujoco, GivesASecondOpinion) {
  const Folder folder;
  const std::string plan = folder.path("plan.json").string();
  const std::string goal =
      "plan problems/paper/slide.yaml --set goal.x=-0.011 --no-advice -o ";
  ASSERT_EQ(run_program(goal + plan).exit_code, 0);
  const Outcome seen =
      run_program("check " + plan + " --mujoco --mujoco-speed-mm-s 10 --json");
  if (!PREHENSILE_WITH_MUJOCO) {
    EXPECT_EQ(seen.exit_code, 2);
    EXPECT_TRUE(holds(seen.err, "this build has no MuJoCo")) << seen.err;
    return;
  }
  ASSERT_EQ(seen.exit_code, 0) << seen.out << seen.err;
  const auto opinion = nlohmann::json::parse(seen.out).at("mujoco");
  EXPECT_TRUE(opinion.at("agrees").get<bool>());
  const auto& push = opinion.at("pushes").at(0);
  EXPECT_LT(push.at("position_error").get<double>(), 1e-4);
  EXPECT_LT(std::abs(push.at("force_error").get<double>()), 0.05);
  EXPECT_EQ(run_program("check " + plan + " --mujoco-speed-mm-s 10").exit_code, 2);
}

}  // namespace
}  // namespace prehensile::testing
