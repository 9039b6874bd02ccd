/// `query spread` and `query contact` as their users meet them.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

using nlohmann::json;

const std::string kSpread = "query spread problems/paper/slide.yaml --travel-mm 15 ";
const std::string kContact = "query contact problems/paper/slide.yaml --travel-mm 15 ";
const std::string kPoint =
    "--set 'pushers=[{name: p, point: {}, friction: 0.4, position: [-0.05, 0], faces: "
    "[\"-x\"]}]' ";

json answer_of(const std::string& arguments, int exit_code = 0) {
  const Outcome out = run_program(arguments + " --json");
  EXPECT_EQ(out.exit_code, exit_code) << arguments << out.err;
  return json::parse(out.out);
}

double width(const json& range) {
  return range.at("high").get<double>() - range.at("low").get<double>();
}

TEST(Spread, NamesEverySourceAndAddsThemUp) {
  const json answer = answer_of(kSpread + kPoint);
  for (const char* part : {"normal", "tangential", "angle"}) {
    const double mechanics =
        width(answer.at("spread_from_friction_and_pressure").at(part));
    const double registration = width(answer.at("registration").at(part));
    const double both = width(answer.at("both").at(part));
    const double stated = width(answer.at("interval").at(part));
    EXPECT_GT(both, 0.8 * std::max(mechanics, registration)) << part;
    EXPECT_LT(both, 1.2 * (mechanics + registration)) << part;
    EXPECT_GE(stated, answer.at("factor").at(part).get<double>() * both) << part;
  }
  // 7 % of the 15 mm moved, and of what it turned.
  EXPECT_NEAR(answer.at("floor").at("normal"), 0.07 * 15e-3, 1e-5);
  EXPECT_NE(answer.at("factor").at("source").get<std::string>().find("mcube_push"),
            std::string::npos);
}

TEST(Spread, AStickingLineKnowsNoFriction) {
  const json answer = answer_of(kSpread);
  EXPECT_LT(width(answer.at("spread_from_friction_and_pressure").at("angle")), 1e-9);
  EXPECT_GT(width(answer.at("registration").at("normal")), 1e-3);
}

TEST(Spread, GrowsWithTheBox) {
  double last = 0.0;
  for (const char* share : {"0.05", "0.15", "0.3"}) {
    const json answer = answer_of(kSpread + kPoint + "--vary finger_friction=" + share);
    const double now = width(answer.at("both").at("angle"));
    EXPECT_GT(now, last);
    last = now;
  }
}

TEST(Spread, IsTheSameForAnyNumberOfJobsAndItsSeed) {
  const std::string query = kSpread + kPoint + "--samples 100 --json ";
  const std::string one = run_program(query + "--jobs 1").out;
  EXPECT_EQ(one, run_program(query + "--jobs 3").out);
  EXPECT_NE(one, run_program(query + "--jobs 1 --seed 2").out);
}

TEST(Spread, AnUnknownLevelHasNoMeasuredFactor) {
  const json answer = answer_of(kSpread + "--level 0.8");
  EXPECT_EQ(answer.at("factor").at("normal"), 1.0);
  EXPECT_NE(answer.at("factor").at("source").get<std::string>().find("none is known"),
            std::string::npos);
  const json given = answer_of(kSpread + "--level 0.8 --factors 1,2,3");
  EXPECT_EQ(given.at("factor").at("angle"), 3.0);
}

TEST(Spread, APushThatFailsIsANegativeAnswerWithAReason) {
  const json answer =
      answer_of("query spread problems/paper/slide.yaml --travel-mm 200", 1);
  EXPECT_NE(answer.at("nominal").at("status"), "completed");
  EXPECT_NE(answer.at("nominal").at("reason"), "");
}

TEST(Spread, WritesEveryPushAndAPicture) {
  const Folder folder;
  const std::string csv = folder.path("ends.csv").string();
  const std::string svg = folder.path("ends.svg").string();
  const Outcome out =
      run_program(kSpread + "--samples 50 --csv " + csv + " --plot " + svg);
  ASSERT_EQ(out.exit_code, 0) << out.err;
  const std::string table = read_text(csv);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 151);
  EXPECT_TRUE(read_text(svg).starts_with("<?xml"));
  EXPECT_EQ(run_program(kSpread + "--factors 1,2").exit_code, 2);
  EXPECT_EQ(run_program(kSpread + "--samples 0").exit_code, 2);
  EXPECT_EQ(run_program(kSpread + "--vary nonsense=1").exit_code, 2);
}

TEST(Contact, ALineFunnelsBetterThanAPoint) {
  const json answer = answer_of(kContact);
  double point = 0.0, wall = 1.0;
  for (const json& contact : answer.at("contacts")) {
    if (contact.at("pusher") == "point") point = contact.at("spread");
    if (contact.at("pusher") == "wall") wall = contact.at("spread");
  }
  EXPECT_GT(point, 1e-4);
  EXPECT_LT(wall, 1e-6);
}

TEST(Contact, RanksByShareAndSpreadAndNamesTheScenesOwn) {
  const json contacts = answer_of(kContact + "--lines-mm 5,15").at("contacts");
  double last = 0.0;
  int own = 0;
  for (const json& contact : contacts) {
    own += contact.at("scenes_own").get<bool>();
    if (contact.at("completed") != contact.at("samples")) continue;
    EXPECT_GE(contact.at("spread"), last);
    last = contact.at("spread");
  }
  EXPECT_EQ(own, 1);
  EXPECT_GE(contacts.size(), 10U);
}

TEST(Contact, IsTheSameForAnyNumberOfJobs) {
  const std::string query = kContact + "--samples 40 --json ";
  EXPECT_EQ(run_program(query + "--jobs 1").out, run_program(query + "--jobs 3").out);
}

TEST(Contact, WritesTableAndPicture) {
  const Folder folder;
  const std::string csv = folder.path("contacts.csv").string();
  const std::string svg = folder.path("contacts.svg").string();
  const Outcome out =
      run_program(kContact + "--samples 30 --csv " + csv + " --plot " + svg);
  ASSERT_EQ(out.exit_code, 0) << out.err;
  EXPECT_NE(out.out.find("the scene's own"), std::string::npos) << out.out;
  EXPECT_EQ(out.out.find("nan"), std::string::npos) << out.out;
  EXPECT_TRUE(read_text(csv).starts_with("pusher,pad,"));
  EXPECT_TRUE(read_text(svg).starts_with("<?xml"));
}

}  // namespace
}  // namespace prehensile::testing
