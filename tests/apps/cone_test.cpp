/// `query cone` as its users meet it.
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

using nlohmann::json;

const std::string kCone = "query cone problems/paper/slide.yaml ";

TEST(Cone, IsConfirmedByInstantsAndShrinksUnderUncertainty) {
  const Outcome out = run_program(kCone + "--json --vary friction=0.2,place_mm=1");
  ASSERT_EQ(out.exit_code, 0) << out.err;
  const json cone = json::parse(out.out);
  const json& check = cone.at("check");
  EXPECT_EQ(check.at("limit_surface_agrees").get<int>(),
            check.at("instants").get<int>() - check.at("not_unique").get<int>());
  EXPECT_GT(check.at("inside"), 50);
  EXPECT_EQ(check.at("robust_sticks"), check.at("robust_asked"));
  EXPECT_GT(check.at("robust_asked"), 20);
  const json& nominal = cone.at("directions").at("nominal").at(0);
  const json& robust = cone.at("directions").at("robust").at(0);
  EXPECT_LT(nominal[0], robust[0]);
  EXPECT_GT(nominal[1], robust[1]);
  EXPECT_EQ(cone.at("members"), 4 + 128);
}

TEST(Cone, WithoutUncertaintyIsTheNominalOne) {
  const json cone = json::parse(run_program(kCone + "--json --vary mass=0").out);
  EXPECT_EQ(cone.at("directions").at("nominal"), cone.at("directions").at("robust"));
  EXPECT_EQ(cone.at("members"), 0);
}

TEST(Cone, OfAPointIsARangeOfDirections) {
  const std::string point =
      "--set 'pushers=[{name: p, point: {}, friction: 0.2, position: [-0.05, 0], faces: "
      "[\"-x\"]}]' ";
  const json cone = json::parse(run_program(kCone + point + "--json").out);
  EXPECT_EQ(cone.at("pusher"), "point");
  EXPECT_TRUE(cone.at("slices").empty());
  EXPECT_EQ(cone.at("check").at("limit_surface_agrees").get<int>() +
                cone.at("check").at("not_unique").get<int>(),
            cone.at("check").at("instants"));
}

TEST(Cone, WritesEdgesAndPicture) {
  const Folder folder;
  const std::string csv = folder.path("edges.csv").string();
  const std::string svg = folder.path("cone.svg").string();
  ASSERT_EQ(run_program(kCone + "--csv " + csv + " --plot " + svg).exit_code, 0);
  EXPECT_NE(read_text(csv).find("robust edge,"), std::string::npos);
  EXPECT_TRUE(read_text(svg).starts_with("<?xml"));
}

/// Every sixth of the directions that are looked at by default.
TEST(Cone, FewSlicesAreSomeOfMany) {
  for (const std::string scene : {"paper/slide.yaml", "tilted_hand.yaml"}) {
    const std::string query =
        "query cone problems/" + scene + " --json --points 4 --vary mass=0 --check 0 ";
    const json many = json::parse(run_program(query + "--slices 37").out);
    const json few = json::parse(run_program(query + "--slices 7").out);
    EXPECT_EQ(many.at("directions"), few.at("directions"));
    int found = 0;
    for (const json& slice : many.at("slices")) {
      const double at = slice.at("direction").get<double>() / (std::numbers::pi / 3.0);
      if (std::abs(at - std::round(at)) > 1e-9) continue;
      ASSERT_LT(found, static_cast<int>(few.at("slices").size()));
      const json& same = few.at("slices").at(static_cast<std::size_t>(found++));
      EXPECT_NEAR(same.at("direction").get<double>(), slice.at("direction").get<double>(),
                  1e-12);
      EXPECT_EQ(same.at("nominal").size(), slice.at("nominal").size());
    }
    EXPECT_EQ(found, static_cast<int>(few.at("slices").size()));
    EXPECT_GT(found, 0);
    EXPECT_GT(many.at("slices").size(), few.at("slices").size());
  }
}

TEST(Cone, WrongUseIsBadInput) {
  for (const char* option :
       {"--slices 1", "--vary friction", "--vary friction=-1", "--vary colour=0.1",
        "--vary friction=2", "--vary place_mm=1abs", "--pusher nobody",
        "--set gripper.friction=0", "--set 'gripper.pad={point: {}}'",
        "--plot /nowhere/at/all.svg"}) {
    const Outcome out = run_program(kCone + option);
    EXPECT_EQ(out.exit_code, 2) << option << out.out;
    EXPECT_FALSE(out.err.empty()) << option;
  }
}

}  // namespace
}  // namespace prehensile::testing
