/// `query place` as its users meet it: the push it names does what was wanted.
#include <cmath>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

using nlohmann::json;

const std::string kSlide = "query place problems/paper/slide.yaml ";
const std::string kPivot = "query place problems/paper/pivot.yaml ";

json answer_of(const std::string& arguments, int exit_code) {
  const Outcome out = run_program(arguments + " --json");
  EXPECT_EQ(out.exit_code, exit_code) << arguments << out.err;
  return json::parse(out.out);
}

/// Runs the command that an answer names.
json repeated(const json& push) {
  const std::string command = push.at("command");
  const Outcome out = run_program(command.substr(command.find(' ') + 1) + " --json");
  EXPECT_EQ(out.exit_code, 0) << command << out.err;
  return json::parse(out.out);
}

TEST(PlaceQuery, ThePushThatItNamesEndsAtTheWantedPose) {
  for (const auto& [query, x, y, theta] :
       {std::tuple{kSlide + "--to 10,0,0", 0.010, 0.0, 0.0},
        std::tuple{kSlide + "--to 5,3,10", 0.005, 0.003, 10.0},
        std::tuple{kPivot + "--to 27.87,28.69,45", 0.02787, 0.02869, 45.0}}) {
    const json answer = answer_of(query, 0);
    EXPECT_EQ(answer.at("status"), "found");
    const json end = repeated(answer.at("push")).at("end");
    EXPECT_NEAR(end.at("x"), x, 1e-6) << query;
    EXPECT_NEAR(end.at("y"), y, 1e-6) << query;
    EXPECT_NEAR(end.at("theta"), theta * 3.14159265358979 / 180.0, 1e-6) << query;
  }
}

TEST(PlaceQuery, TheInstantThatItNamesHasTheWantedTwist) {
  const json answer =
      answer_of(kPivot + "--twist 0,0,30 --grip-force 5,40 --least-force", 0);
  const json twist = repeated(answer.at("push")).at("object_twist");
  const double omega = 30.0 * 3.14159265358979 / 180.0;
  EXPECT_NEAR(twist.at(0), 0.0, 1e-7);
  EXPECT_NEAR(twist.at(1), 0.0, 1e-7);
  EXPECT_NEAR(twist.at(2), omega, 1e-6);
}

TEST(PlaceQuery, WhatIsImpossibleComesWithProofsAndTheNearestMotion) {
  const json answer = answer_of(kSlide + "--twist=-5,0,0", 1);
  EXPECT_EQ(answer.at("status"), "impossible");
  EXPECT_TRUE(answer.at("push").is_null());
  for (const json& contact : answer.at("contacts")) {
    EXPECT_TRUE(contact.at("proof_holds").get<bool>());
    EXPECT_NE(contact.at("reason"), "");
  }
  const json& nearest = answer.at("nearest");
  EXPECT_GT(nearest.at("angle"), 0.1);
  const json twist = repeated(nearest.at("push")).at("object_twist");
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(twist.at(i), nearest.at("twist").at(i), 1e-5);
  }
}

TEST(PlaceQuery, WritesTableAndPicture) {
  const Folder folder;
  const std::string csv = folder.path("margin.csv").string();
  const std::string svg = folder.path("place.svg").string();
  for (const char* wish : {"--to 10,0,0", "--twist=-5,0,0"}) {
    const Outcome out = run_program(kSlide + wish + " --csv " + csv + " --plot " + svg);
    EXPECT_LE(out.exit_code, 1) << out.err;
    EXPECT_EQ(out.out.find("nan"), std::string::npos) << out.out;
    EXPECT_TRUE(read_text(csv).starts_with("contact,place_m,"));
    EXPECT_TRUE(read_text(svg).starts_with("<?xml"));
  }
}

// In space the curve runs through what the answer states, and a point has none.
TEST(PlaceQuery, DrawsPlacesOfSpace) {
  const Folder folder;
  const std::string csv = folder.path("margin.csv").string();
  const std::string svg = folder.path("place.svg").string();
  const std::string ask =
      "query place problems/tilted_hand.yaml --json --csv " + csv + " --plot " + svg;
  const Outcome out = run_program(ask + " --to 5,0,0");
  ASSERT_EQ(out.exit_code, 0) << out.err;
  const json push = json::parse(out.out).at("push");
  std::istringstream lines(read_text(csv));
  std::string line;
  std::getline(lines, line);
  double above = -1.0;
  double most = -1.0;
  double most_robust = -1.0;
  int rows = 0;
  while (std::getline(lines, line)) {
    ++rows;
    std::istringstream fields(line.substr(line.find(',') + 1));
    double place = 0.0, slack = 0.0, robust = 0.0;
    char comma = 0;
    ASSERT_TRUE(fields >> place >> comma >> slack >> comma >> robust) << line;
    EXPECT_LE(robust, slack) << line;
    most = std::max(most, slack);
    most_robust = std::max(most_robust, robust);
    if (slack >= 0.0) above = place;
  }
  EXPECT_EQ(rows, 201);
  EXPECT_NEAR(most, push.at("slack").get<double>(), 1e-3);
  EXPECT_NEAR(most_robust, push.at("robust_slack").get<double>(), 2e-3);
  EXPECT_LT(above, 0.039);
  EXPECT_NE(read_text(svg).find("Margin against place"), std::string::npos);

  EXPECT_EQ(run_program(ask + " --twist 0,3,0").exit_code, 0);
  EXPECT_EQ(read_text(csv), "contact,place_m,slack,robust_slack\n");
  EXPECT_EQ(read_text(svg).find("Margin against place"), std::string::npos);
}

TEST(PlaceQuery, WrongUseIsBadInput) {
  for (const char* wish :
       {"", "--twist 0,0,0", "--twist 1,0,0 --to 1,0,0", "--to=-15,0,0", "--to 500,0,0",
        "--twist 1,0", "--twist 1,0,0 --pusher nobody", "--twist 1,0,0 --face +y",
        "--twist 1,0,0 --grip-force 9,3", "--twist 1,0,0 --set gripper.friction=0"}) {
    const Outcome out = run_program(kSlide + wish);
    EXPECT_EQ(out.exit_code, 2) << wish << out.out;
    EXPECT_FALSE(out.err.empty()) << wish;
  }
}

}  // namespace
}  // namespace prehensile::testing
