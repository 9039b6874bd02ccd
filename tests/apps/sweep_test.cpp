/// `query sweep` as its users meet it: the curves of the paper, the same answers as
/// single queries, refusals as rows.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

using nlohmann::json;

const std::string kSlide = "query sweep problems/paper/slide.yaml ";
const std::string kPivot = "query sweep problems/paper/pivot.yaml ";
const std::string kRoll = "query sweep problems/paper/roll.yaml --of roll ";

json rows_of(const std::string& arguments, int exit_code = 0) {
  const Outcome out = run_program(arguments + " --json");
  EXPECT_EQ(out.exit_code, exit_code) << arguments << out.err;
  return json::parse(out.out).at("rows");
}

TEST(Sweep, PushForceIsLinearInTheGripForce) {
  const json rows = rows_of(kSlide + "--over gripper.grip_force=10:40:4");
  ASSERT_EQ(rows.size(), 4U);
  const auto force = [&](int i) { return rows[i].at("push_force").get<double>(); };
  // Paper Fig. 6: the pads' friction is overcome, 2 x 0.5 x grip force, and little else.
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[i].at("at")[0], 10.0 * (i + 1));
    EXPECT_NEAR(force(i), 10.0 * (i + 1), 0.6);
  }
  EXPECT_NEAR(force(1) - force(0), force(3) - force(2), 0.05);
}

TEST(Sweep, PivotForceFallsWithTheDistanceFromTheFingers) {
  const json rows =
      rows_of(kPivot + "--over place_mm=34:-30:9 --speed-mm-s 0 --turn-deg-s 40");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_LT(rows[i].at("push_force"), rows[i - 1].at("push_force"));
  }
}

TEST(Sweep, RollingBeginsAtItsThreshold) {
  const json rows = rows_of(kRoll +
                            "--over gripper.grip_force=0.5:12:12 --over "
                            "pushers.0.friction=0.05:1.2:12");
  int rolling = 0, sliding = 0;
  for (const json& row : rows) {
    if (!row.at("answered").get<bool>()) continue;
    const bool above = row.at("at")[1] > row.at("threshold");
    EXPECT_NEAR(row.at("roll_share"), above ? 1.0 : 0.0, 1e-9) << row.dump();
    ++(above ? rolling : sliding);
  }
  EXPECT_GT(rolling, 20);
  EXPECT_GT(sliding, 40);
}

TEST(Sweep, RowsAreTheAnswersOfSingleQueries) {
  const json rows =
      rows_of(kPivot + "--over place_mm=-20:20:3 --over start.y=-0.003,0.002");
  for (const json& row : rows) {
    const Outcome one =
        run_program("query instant problems/paper/pivot.yaml --json --place-mm " +
                    row.at("at")[0].dump() + " --set start.y=" + row.at("at")[1].dump());
    EXPECT_EQ(json::parse(one.out).at("push_force"), row.at("push_force"));
  }
  const json pushes = rows_of(kSlide + "--of push --over travel_mm=2,15,80");
  for (const json& row : pushes) {
    const Outcome one =
        run_program("query push problems/paper/slide.yaml --json --travel-mm " +
                    row.at("at")[0].dump());
    const json push = json::parse(one.out);
    EXPECT_EQ(push.at("status"), row.at("status"));
    EXPECT_EQ(push.at("end").at("x"), row.at("x"));
    const double force = push.at("max_push_force");
    EXPECT_NEAR(row.at("max_push_force"), force, 1e-12 * force);
  }
}

TEST(Sweep, SolversAgree) {
  const std::string over = "--over gripper.grip_force=10,20 --solver ";
  const json exact = rows_of(kSlide + over + "exact");
  for (const char* solver : {"closed", "spatial"}) {
    const json other = rows_of(kSlide + over + solver);
    for (int i = 0; i < 2; ++i) {
      const double force = exact[i].at("push_force");
      EXPECT_NEAR(other[i].at("push_force"), force, 1e-3 * force) << solver;
    }
  }
}

TEST(Sweep, IsTheSameForAnyNumberOfJobs) {
  const std::string sweep = kSlide +
                            "--solver spatial --over gripper.grip_force=2:40:12 --over "
                            "pushers.0.friction=0.1:1:9 ";
  const Folder folder;
  std::string first, first_file;
  for (const char* jobs : {"1", "2", "5"}) {
    const std::string csv = folder.path("rows.csv").string();
    const Outcome out = run_program(sweep + "--json --csv " + csv + " --jobs " + jobs);
    ASSERT_EQ(out.exit_code, 0) << out.err;
    if (first.empty()) {
      first = out.out;
      first_file = read_text(csv);
    }
    EXPECT_EQ(out.out, first) << jobs;
    EXPECT_EQ(read_text(csv), first_file) << jobs;
  }
}

TEST(Sweep, RefusalsAreRowsWithAReason) {
  const json rows = rows_of(kSlide + "--over gripper.grip_force=-5,0,0.5,20");
  EXPECT_EQ(rows[0].at("status"), "bad input");
  EXPECT_NE(rows[0].at("reason").get<std::string>().find("-5"), std::string::npos);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(rows[i].at("answered").get<bool>());
    EXPECT_NE(rows[i].at("reason"), "") << rows[i].dump();
  }
  EXPECT_TRUE(rows[3].at("answered").get<bool>());
  rows_of(kSlide + "--over gripper.grip_force=0.1,0.2", 1);
}

TEST(Sweep, WritesTablesAndPictures) {
  const Folder folder;
  const std::string csv = folder.path("rows.csv").string();
  const std::string svg = folder.path("map.svg").string();
  const Outcome out = run_program(
      kRoll +
      "--over gripper.grip_force=1:10:4:log --over pushers.0.friction=0.1:1:9 "
      "--show roll_share --csv " +
      csv + " --plot " + svg);
  ASSERT_EQ(out.exit_code, 0) << out.err;
  EXPECT_NE(out.out.find("36 rows"), std::string::npos) << out.out;
  const std::string table = read_text(csv);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 37);
  EXPECT_TRUE(table.starts_with("gripper.grip_force,pushers.0.friction,answered,"));
  const std::string picture = read_text(svg);
  EXPECT_TRUE(picture.starts_with("<?xml"));
  EXPECT_NE(picture.find("share of rolling"), std::string::npos);
  EXPECT_EQ(picture.find("nan"), std::string::npos);
}

/// A curve that stops at once is seen all the same: its crosses have its colour.
TEST(Sweep, CrossesShowWhereEachCurveStopped) {
  const Folder folder;
  const std::string svg = folder.path("stops.svg").string();
  const Outcome out = run_program(
      "query sweep problems/paper/roll_prism.yaml --of push --kind roll --over "
      "travel_mm=1:5:5 --over start.y=-0.005,-0.011 --show psi --plot " +
      svg);
  ASSERT_EQ(out.exit_code, 0) << out.err;
  const std::string picture = read_text(svg);
  EXPECT_NE(picture.find(">stopped or not unique</text>"), std::string::npos);
  EXPECT_NE(picture.find(", 5 stopped or without a unique answer<"), std::string::npos);
  EXPECT_NE(out.out.find("in brackets: stopped, or "), std::string::npos) << out.out;
  // Of the first curve nothing but five crosses, in the first colour.
  const std::size_t cross = picture.find("stroke=\"#0072b2\" stroke-width=\"1.50\"");
  ASSERT_NE(cross, std::string::npos);
  const std::size_t path = picture.rfind("<path", cross);
  const std::string marks = picture.substr(path, cross - path);
  EXPECT_EQ(std::count(marks.begin(), marks.end(), 'M'), 10);
}

TEST(Sweep, WordsMayBeSwept) {
  const json rows = rows_of(
      "query sweep problems/paper/roll.yaml --of roll --over "
      "gripper.jaw_mode=coupled,fixed_jaw_1,fixed_jaw_2,locked");
  EXPECT_EQ(rows[1].at("at")[0], "fixed_jaw_1");
  EXPECT_EQ(rows.size(), 4U);
}

TEST(Sweep, WrongUseIsBadInput) {
  for (const char* over :
       {"gripper.grip=1:2:3", "gripper.grip_force", "gripper.grip_force=1:2",
        "gripper.grip_force=1:2:1", "gripper.grip_force=0:2:5:log", "place_mm=a,b",
        "gripper.grip_force=1:2:5:lin", "gripper.grip_force=1,,2", "=1:2:3",
        "gripper.grip_force=1:2:2000000", "gripper.grip_force=nan:2:5"}) {
    const Outcome out = run_program(kSlide + "--over " + over);
    EXPECT_EQ(out.exit_code, 2) << over << out.out;
    EXPECT_FALSE(out.err.empty()) << over;
    EXPECT_TRUE(out.out.empty()) << over;
  }
  EXPECT_EQ(run_program(kSlide).exit_code, 2);
  EXPECT_EQ(run_program(kSlide + "--over place_mm=1,2 --show nothing").exit_code, 2);
  EXPECT_EQ(run_program(kSlide + "--over place_mm=1,2 --plot /nowhere/a.svg").exit_code,
            2);
}

}  // namespace
}  // namespace prehensile::testing
