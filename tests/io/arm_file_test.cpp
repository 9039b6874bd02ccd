#include "io/arm_file.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "planner/planner.h"
#include "problems/published_regrasps.h"

namespace prehensile {
namespace {

struct Written {
  PlanFile plan;
  ArmMotion motion;
  std::string text;
};

Written written(ArmFormat format) {
  Scene scene = published_tee(20);
  scene.name = "a \"tee\"\nof two lines";
  scene.gripper.tool.p_HT = {0.0, 0.1, 0.0};
  const Model model = prepare(scene);
  Written out;
  out.plan = {scene, "0123456789abcdef", plan_regrasp(model)};
  const ArmLimits limits;
  out.motion = arm_motion(model, out.plan.plan, limits);
  out.text = arm_to_text(out.plan, out.motion, limits, format);
  return out;
}

/// What reading says, or an empty text.
std::string fault_of(const std::string& text) {
  try {
    parse_arm_csv(text, "arm.csv");
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return {};
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ArmFile, CsvReturnsTheMotionExactly) {
  const Written file = written(ArmFormat::kCsv);
  const ArmMotion read = parse_arm_csv(file.text, "arm.csv");
  ASSERT_EQ(read.samples.size(), file.motion.samples.size());
  EXPECT_EQ(read.seconds, file.motion.seconds);
  EXPECT_EQ(fault_of("\xEF\xBB\xBF" + file.text), "");  // as some editors save it
  for (std::size_t i = 0; i < read.samples.size(); ++i) {
    const ArmSample& a = read.samples[i];
    const ArmSample& b = file.motion.samples[i];
    EXPECT_EQ(a.t, b.t);
    EXPECT_EQ(a.phase, b.phase);
    EXPECT_EQ(a.push, b.push);
    EXPECT_EQ(a.grip_force, b.grip_force);
    EXPECT_EQ(a.guard_force, b.guard_force);
    EXPECT_EQ(a.force, b.force);
    EXPECT_EQ(a.moment, b.moment);
    EXPECT_EQ(a.X_WH.position, b.X_WH.position);
    EXPECT_EQ(a.X_WH.orientation.coeffs(), b.X_WH.orientation.coeffs());
    EXPECT_EQ(a.X_WT.position, b.X_WT.position);
    EXPECT_EQ(a.X_WT.orientation.coeffs(), b.X_WT.orientation.coeffs());
  }
}

TEST(ArmFile, EveryFormSaysFramesUnitsAndOrder) {
  for (const ArmFormat format : {ArmFormat::kCsv, ArmFormat::kTum, ArmFormat::kYaml}) {
    const std::string text = written(format).text;
    for (const char* part :
         {"quaternion_order: xyzw", "tool_in_hand_position: [0, 0.1, 0]",
          "units: \"m, s, N, N m\"", "scene_digest: \"0123456789abcdef\"", "X_WH",
          "push_1: \"wall on -x\"", "a \\\"tee\\\" of two lines"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part;
    }
  }
}

TEST(ArmFile, TumHasEightNumbersALineAndTimesThatRise) {
  const std::string text = written(ArmFormat::kTum).text;
  double last = -1.0;
  int lines = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    if (line[0] == '#') continue;
    ++lines;
    EXPECT_EQ(std::count(line.begin(), line.end(), ' '), 7);
    const double t = std::stod(line);
    EXPECT_GT(t, last);
    last = t;
  }
  EXPECT_GT(lines, 100);
}

TEST(ArmFile, FormatsByExtension) {
  EXPECT_EQ(arm_format("a/b.csv"), ArmFormat::kCsv);
  EXPECT_EQ(arm_format("b.tum"), ArmFormat::kTum);
  EXPECT_EQ(arm_format("b.yml"), ArmFormat::kYaml);
  EXPECT_EQ(arm_format("b.txt"), ArmFormat::kTum);
  EXPECT_THROW(arm_format("b.json"), BadInput);
  EXPECT_THROW(arm_format("b"), BadInput);
}

TEST(ArmFile, BadFilesAreRefusedWithTheirLine) {
  const std::string good = written(ArmFormat::kCsv).text;
  EXPECT_EQ(fault_of(good), "");
  EXPECT_NE(fault_of("").find("expected the columns"), std::string::npos);
  EXPECT_NE(fault_of(with(good, "t,phase", "time,phase")).find("expected the columns"),
            std::string::npos);
  EXPECT_NE(fault_of(with(good, ",approach,1,", ",approach,0,")).find("push: "),
            std::string::npos);
  EXPECT_NE(fault_of(with(good, ",approach,1,", ",jump,1,")).find("phase: "),
            std::string::npos);
  EXPECT_NE(
      fault_of(with(good, ",approach,1,25,", ",approach,1,nan,")).find("grip_force"),
      std::string::npos);
  EXPECT_NE(fault_of(with(good, ",approach,1,25,", ",approach,1,")).find("24 cells"),
            std::string::npos);
  EXPECT_NE(fault_of(with(good, "\n0.02,approach", "\n0.001,approach")).find("t: "),
            std::string::npos);
  const std::string wrong = fault_of(with(good, ",0,0,0,", ",0,0.5,0,"));
  EXPECT_NE(wrong.find("hand_q"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("arm.csv: line "), std::string::npos) << wrong;
}

TEST(ArmFile, SaysWhichTransitIsNotAllowed) {
  Written one = written(ArmFormat::kCsv);
  EXPECT_EQ(one.text.find("transit_to_push"), std::string::npos);
  one.motion.blocked_transits = {1};
  const std::string csv = arm_to_text(one.plan, one.motion, {}, ArmFormat::kCsv);
  EXPECT_NE(csv.find("# transit_to_push_2: "), std::string::npos);
  EXPECT_EQ(fault_of(csv), "");
  const std::string yaml = arm_to_text(one.plan, one.motion, {}, ArmFormat::kYaml);
  EXPECT_NE(yaml.find("transit_to_push_2: "), std::string::npos);
}

/// As the plan says it, in every form; where it promises less than was asked for, also
/// why.
TEST(ArmFile, SaysWhatThePlanPromises) {
  Written one = written(ArmFormat::kCsv);
  Plan& plan = one.plan.plan;
  plan.margin = {0.125, 0.25, 0.0625, 0.001, 0.002, 5e-4, 0.004, false};
  for (const Promise promise :
       {Promise::kNominal, Promise::kNominalOnly, Promise::kPartOfMargin,
        Promise::kMargin, Promise::kScene}) {
    plan.promise = promise;
    for (const bool is_lesser : {false, true}) {
      plan.message = is_lesser ? "survives 50 %" : "";
      plan.margin.weightless = is_lesser;
      for (const ArmFormat format :
           {ArmFormat::kCsv, ArmFormat::kTum, ArmFormat::kYaml}) {
        const std::string before = format == ArmFormat::kYaml ? "\n" : "\n# ";
        const std::string text = arm_to_text(one.plan, one.motion, {}, format);
        const auto has = [&](const std::string& line) {
          return text.find(before + line + "\n") != std::string::npos;
        };
        EXPECT_TRUE(has("promise: \"" + std::string(name(promise)) + "\""));
        EXPECT_TRUE(
            has("margin: {friction: 0.125, force: 0.25, torque_radius: 0.0625, "
                "place: 0.001, centre_of_mass: 0.002, grasp: 5.0e-04, tilt: 0.004" +
                std::string(is_lesser ? ", gravity: must not help}" : "}")));
        EXPECT_EQ(has("message: \"survives 50 %\""), is_lesser);
      }
    }
  }
}

}  // namespace
}  // namespace prehensile
