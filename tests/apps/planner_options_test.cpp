#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "planner/planner.h"
#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

using nlohmann::json;

const std::string kScene = "problems/published/tee_21.yaml";

TEST(PlannerOptions, EveryPlannerIsListedWithItsOptions) {
  const Outcome listed = run_program("plan --list-planners");
  EXPECT_EQ(listed.exit_code, 0);
  for (const std::string& name : planner_names()) {
    EXPECT_NE(listed.out.find(name), std::string::npos) << name;
  }
  EXPECT_NE(listed.out.find("fallback_share"), std::string::npos);
  EXPECT_NE(run_program("plan --help").out.find("--planner-option"), std::string::npos);
}

TEST(PlannerOptions, APlannerAndItsOptionsAreUsed) {
  const Folder folder;
  const std::string file = folder.path("plan.json").string();
  const Outcome planned =
      run_program("plan " + kScene +
                  " --planner motion-cone-tree --planner-option step=0.3"
                  " --planner-option goal_bias=0.4 --seed 3 -o " +
                  file);
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  EXPECT_EQ(json::parse(read_text(file)).at("planner"), "motion-cone-tree");
  EXPECT_EQ(run_program("check " + file).exit_code, 0);
}

void expect_refused(const std::string& arguments, const std::string& says) {
  const Outcome refused = run_program("plan " + kScene + " " + arguments);
  EXPECT_EQ(refused.exit_code, 2) << arguments;
  EXPECT_NE(refused.err.find(says), std::string::npos) << refused.err;
}

TEST(PlannerOptions, WhatIsUnknownOrOutOfRangeIsRefused) {
  expect_refused("--planner magic", "expected one of push, motion-cone-tree");
  expect_refused("--planner geometric::PRM", "cannot be undone");
  expect_refused("--planner-option speed=2", "has no option speed");
  expect_refused("--planner-option fallback_share=2", "from 0 to 0.9");
  expect_refused("--planner-option fallback_share=nan", "expected name=number");
  expect_refused("--planner-option fallback_share", "expected name=number");
  expect_refused("--planner-option fallback_share=0.1x", "expected name=number");
  expect_refused("--planner-option =3", "expected name=number");
  expect_refused(
      "--planner-option fallback_share=0.1 --planner-option fallback_share=0.2", "twice");
}

}  // namespace
}  // namespace prehensile::testing
