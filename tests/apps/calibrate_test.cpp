/// `calibrate` as its users meet it, on the worked example in problems/calibration.
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

using nlohmann::json;

const std::string kScene = "problems/calibration/tip.yaml ";
const std::string kPushes = "problems/calibration/tip_pushes.csv ";
const std::string kSlip = "problems/calibration/tip_slip.csv ";
const std::string kQuick = " --samples 10 --folds 2 ";

json answer_of(const std::string& arguments, int exit_code = 0) {
  const Outcome out = run_program(arguments + " --json");
  EXPECT_EQ(out.exit_code, exit_code) << arguments << out.err << out.out;
  return json::parse(out.out);
}

const json& parameter(const json& answer, const std::string& name) {
  for (const json& parameter : answer.at("parameters")) {
    if (parameter.at("name") == name) return parameter;
  }
  throw std::runtime_error("no parameter " + name);
}

/// The first lines of the example's pushes.
std::string first_pushes(int count) {
  std::istringstream in(
      read_text(PREHENSILE_SOURCE_DIR "/problems/calibration/tip_pushes.csv"));
  std::string line, out;
  for (int i = 0; i <= count && std::getline(in, line); ++i) out += line + '\n';
  return out;
}

/// The numbers with which examples/04_measurements.cpp made them.
TEST(Calibrate, FindsWhatMadeTheExample) {
  const Folder folder;
  const std::string scene = folder.path("after.yaml").string();
  const std::string plot = folder.path("fit.svg").string();
  const json answer = answer_of("calibrate " + kScene + kPushes + kQuick + "-o " + scene +
                                " --plot " + plot);
  const auto holds = [&](const char* name, double truth, double slack) {
    const json& found = parameter(answer, name);
    EXPECT_TRUE(found.at("told").get<bool>()) << name;
    EXPECT_NEAR(found.at("value").get<double>(), truth, slack) << name;
    EXPECT_LT(found.at("low").get<double>(), found.at("value").get<double>());
    EXPECT_GT(found.at("high").get<double>(), found.at("value").get<double>());
  };
  holds("friction of tip", 0.22, 0.01);
  holds("finger friction", 0.45, 0.02);
  holds("edge load p", 0.8, 0.15);
  holds("registration x", 0.6e-3, 1.5e-4);
  holds("registration y", -0.4e-3, 1.5e-4);
  for (const char* part : {"along", "across", "angle", "force"}) {
    const json& error = answer.at("mean_absolute_error").at(part);
    EXPECT_LT(error.at("held_out").get<double>(), error.at("before").get<double>());
  }
  EXPECT_NE(answer.at("worth").get<std::string>().find("40 pushes: a real calibration"),
            std::string::npos);
  // Numbers 8 and 27 went wrong.
  EXPECT_NE(answer.at("warnings").dump().find("number 8, 27 of the data"),
            std::string::npos)
      << answer.at("warnings").dump();
  EXPECT_TRUE(read_text(plot).starts_with("<?xml"));

  // The scene that was written holds the numbers, and `query spread` uses them.
  EXPECT_EQ(run_program("inspect " + scene).exit_code, 0);
  const json spread =
      answer_of("query spread " + scene + " --face=-x --travel-mm 10 --samples 50");
  EXPECT_NE(spread.at("factor").at("source").get<std::string>().find("on 40 pushes"),
            std::string::npos);
  EXPECT_EQ(spread.at("factor").at("normal"), answer.at("factors").at("90").at(0));
  EXPECT_NE(spread.at("boxes").get<std::string>().find("calibration"), std::string::npos);
  const double width = spread.at("spread_from_friction_and_pressure")
                           .at("box")
                           .at("friction")
                           .at("half_width");
  EXPECT_EQ(width, answer.at("left_uncertain").at("friction").at("half_width"));
  // A second calibration begins where the first ended.
  const std::string few = folder.path("few.csv").string();
  write_text(few, first_pushes(12));
  const json again =
      json::parse(run_program("calibrate " + scene + ' ' + few + kQuick + "--json").out);
  for (const char* name : {"friction of tip", "registration x"}) {
    EXPECT_EQ(parameter(again, name).at("before"), parameter(answer, name).at("value"));
  }
}

TEST(Calibrate, FivePushesAreNotACalibration) {
  const Folder folder;
  const std::string csv = folder.path("few.csv").string();
  write_text(csv, first_pushes(8));
  const Outcome out = run_program("calibrate " + kScene + csv + kQuick);
  EXPECT_NE(out.out.find("8 pushes: not a calibration (20 are a real one, 5 are not)"),
            std::string::npos)
      << out.out;
  write_text(csv, first_pushes(5));
  const Outcome fewer = run_program("calibrate " + kScene + csv);
  EXPECT_EQ(fewer.exit_code, 2);
  EXPECT_EQ(fewer.err, csv +
                           ": 5 measurements: expected at least 7 for the 5 parameters "
                           "that they are to tell\n");
}

TEST(Calibrate, IsTheSameForAnyNumberOfJobs) {
  const Folder folder;
  const std::string csv = folder.path("few.csv").string();
  write_text(csv, first_pushes(10));
  const std::string query =
      "calibrate " + kScene + csv + kQuick + " --pressure none --json ";
  EXPECT_EQ(run_program(query + "--jobs 1").out, run_program(query + "--jobs 3").out);
}

TEST(Calibrate, TakesSlipForces) {
  const Folder folder;
  const std::string scene = folder.path("after.yaml").string();
  const std::string plot = folder.path("slip.svg").string();
  const json answer =
      answer_of("calibrate " + kScene + kSlip + "-o " + scene + " --plot " + plot);
  EXPECT_NEAR(parameter(answer, "finger friction").at("value"), 0.45, 0.01);
  EXPECT_NEAR(parameter(answer, "torque radius factor k").at("value"), 1.1, 0.04);
  EXPECT_NEAR(parameter(answer, "bias of the force").at("value"), 0.6, 0.2);
  EXPECT_TRUE(read_text(plot).starts_with("<?xml"));
  EXPECT_NE(read_text(scene).find("calibration:"), std::string::npos);
}

TEST(Calibrate, WritesNothingWhereNothingWasLearnt) {
  const Folder folder;
  const std::string csv = folder.path("still.csv").string();
  const std::string scene = folder.path("after.yaml").string();
  // Readings without rhyme or reason, but of the force that the scene expects.
  std::string text = "grip_force_N,slip_force_N\n";
  for (int i = 0; i < 12; ++i) text += i % 2 ? "10,30\n" : "10,3.3333\n";
  write_text(csv, text);
  const json answer = answer_of("calibrate " + kScene + csv + " -o " + scene, 1);
  EXPECT_FALSE(answer.at("usable").get<bool>());
  EXPECT_TRUE(answer.at("scene").is_null());
  EXPECT_FALSE(std::filesystem::exists(scene));
  EXPECT_NE(answer.at("warnings").dump().find("cannot tell"), std::string::npos);
}

TEST(Calibrate, RefusesBadInput) {
  const Folder folder;
  const std::string csv = folder.path("bad.csv").string();
  write_text(csv, "grip_force_N,slip_force_N\n10,nan\n");
  const Outcome out = run_program("calibrate " + kScene + csv);
  EXPECT_EQ(out.exit_code, 2);
  EXPECT_EQ(out.err, csv +
                         ":2: slip_force_N: nan: expected a number from 1e-09 to "
                         "1e+06\n");
  EXPECT_EQ(run_program("calibrate " + kScene + "no_such.csv").exit_code, 2);
  EXPECT_EQ(run_program("calibrate " + kScene + kPushes + "--pressure soft").exit_code,
            2);
  EXPECT_EQ(run_program("calibrate " + kScene + kPushes + "--folds 1").exit_code, 2);
}

}  // namespace
}  // namespace prehensile::testing
