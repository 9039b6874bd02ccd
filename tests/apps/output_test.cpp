/// What the program prints, where numbers end: full devices, and numbers that are none.
#include <gtest/gtest.h>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

const std::string kScene = "problems/published/square_03.yaml";

/// However early the writing fails, and whoever writes.
TEST(Output, AnOutputThatCannotBeWrittenIsAFault) {
  for (const char* arguments :
       {"--version", "--help", "plan --help", "inspect problems/paper/slide.yaml"}) {
    const Outcome outcome = run_program(std::string(arguments) + " >/dev/full");
    EXPECT_EQ(outcome.exit_code, 3) << arguments;
    EXPECT_NE(outcome.err.find("cannot write"), std::string::npos) << arguments;
  }
}

/// Nothing to do costs nothing, and nobody could do it for less.
TEST(Output, NothingToDoHasNoGap) {
  const Folder folder;
  const Outcome outcome =
      run_program("plan " + kScene +
                  " --set goal.x=-0.024681931 --set goal.y=-0.002307982 "
                  "--set goal.theta=0.0654 --set start.x=-0.024681931 --set "
                  "start.y=-0.002307982 --set start.theta=0.0654 -o " +
                  folder.path("plan.json").string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("nothing to do"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("gap 0.0 %"), std::string::npos) << outcome.out;
}

/// Where no forces are found, there is no residual of them.
TEST(Output, WhatFallsHasNoResidual) {
  const Outcome outcome = run_program(
      "query instant problems/published/square_03.yaml --set "
      "'gravity=[0,180]'");
  EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("solver exact: 0 iterations\n"), std::string::npos);
}

}  // namespace
}  // namespace prehensile::testing
