/// `query cone` as its users meet it.
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

TEST(Cone, WrongUseIsBadInput) {
  for (const char* option :
       {"--vary friction", "--vary friction=-1", "--vary colour=0.1", "--vary friction=2",
        "--vary place_mm=1abs", "--pusher nobody", "--set gripper.friction=0",
        "--set 'gripper.pad={point: {}}'", "--plot /nowhere/at/all.svg"}) {
    const Outcome out = run_program(kCone + option);
    EXPECT_EQ(out.exit_code, 2) << option << out.out;
    EXPECT_FALSE(out.err.empty()) << option;
  }
}

}  // namespace
}  // namespace prehensile::testing
