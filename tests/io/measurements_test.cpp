#include "io/measurements.h"

#include <gtest/gtest.h>

namespace prehensile {
namespace {

Model two_pushers() {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.04, 0.025}};
  scene.object.mass = 0.1;
  scene.gripper.pad = DiscPad{0.01};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "tip", .feature = PointFeature{}, .friction = 0.3},
                   {.name = "a, \"b\"",
                    .feature = LineFeature{},
                    .friction = 0.3,
                    .normal_angle = 1.5707963267948966}};
  return prepare(scene);
}

const std::string kHeader =
    "pusher,start_x_mm,start_y_mm,start_theta_deg,from_x_mm,from_y_mm,to_x_mm,to_y_mm,"
    "end_x_mm,end_y_mm,end_theta_deg";
const std::string kRow = "tip,1,2,3,-53,0,-40,1,11,2.5,4";

/// The message with which reading ends.
std::string error_of(const std::string& text) {
  try {
    parse_measurements(text, "p.csv", two_pushers());
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "no error";
}

TEST(Measurements, ReadsPushes) {
  const Measurements data =
      parse_measurements("# made by hand\n\n" + kHeader +
                             ",face,turn_deg,push_force_N,grip_force_N,note\r\n" + kRow +
                             ",-x,10,1.5,20,\"good, I think\"\r\n" +
                             "\"a, \"\"b\"\"\",0,0,0,0,-25,0,-10,0,5,0,,,,,\n",
                         "p.csv", two_pushers());
  ASSERT_EQ(data.pushes.size(), 2U);
  EXPECT_TRUE(data.readings.empty());
  const MeasuredPush& push = data.pushes[0];
  EXPECT_EQ(push.pusher, 0);
  EXPECT_GE(push.face, 0);
  EXPECT_NEAR(push.X_HO_start.y, 0.002, 1e-15);
  EXPECT_NEAR(push.X_HO_end.theta, 0.06981317007977318, 1e-12);
  EXPECT_LT((push.to - Vec2(-0.04, 0.001)).norm(), 1e-15);
  EXPECT_NEAR(push.turn, 0.17453292519943295, 1e-12);
  EXPECT_EQ(push.push_force, 1.5);
  EXPECT_EQ(push.grip_force, 20.0);
  EXPECT_EQ(data.pushes[1].pusher, 1);
  EXPECT_EQ(data.pushes[1].face, -1);
  EXPECT_FALSE(data.pushes[1].push_force.has_value());
}

/// Spreadsheets save a byte order mark first, which nobody sees.
TEST(Measurements, ReadsOverAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(error_of(mark + kHeader + '\n' + kRow + '\n'), "no error");
  EXPECT_EQ(error_of(mark + "# made by hand\n" + kHeader + '\n' + kRow + '\n'),
            "no error");
  EXPECT_NE(error_of(mark + mark + kHeader + '\n' + kRow + '\n'), "no error");
}

TEST(Measurements, ReadsSlipForces) {
  const Measurements data =
      parse_measurements("grip_force_N,slip_force_N,slip_torque_Nm\n5,4.6,\n10,,0.06\n",
                         "s.csv", two_pushers());
  ASSERT_EQ(data.readings.size(), 2U);
  EXPECT_EQ(data.readings[0].slip_force, 4.6);
  EXPECT_FALSE(data.readings[0].slip_torque.has_value());
  EXPECT_EQ(data.readings[1].slip_torque, 0.06);
}

TEST(Measurements, ComesBackAsWritten) {
  const Model model = two_pushers();
  std::vector<MeasuredPush> pushes =
      parse_measurements(kHeader + ",turn_deg,push_force_N,grip_force_N\n" + kRow +
                             ",10,1.5,20\n\"a, \"\"b\"\"\",0,0,0,0,-25,0,-10,0,5,0,,,\n",
                         "p.csv", model)
          .pushes;
  const std::string text = pushes_to_csv(pushes, model, 6);
  const std::vector<MeasuredPush> again = parse_measurements(text, "p.csv", model).pushes;
  EXPECT_EQ(pushes_to_csv(again, model, 6), text);
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again[1].pusher, 1);
  EXPECT_EQ(again[0].push_force, pushes[0].push_force);
  EXPECT_FALSE(again[1].grip_force.has_value());
}

TEST(Measurements, NamesWhatIsWrongOnce) {
  const std::string start = kHeader + "\n";
  EXPECT_EQ(error_of(""), "p.csv:1: empty: expected a header and lines of measurements");
  EXPECT_EQ(error_of(start), "p.csv:1: no measurement: expected lines after the header");
  EXPECT_EQ(error_of(start + "tip,1,2,nan,-53,0,-40,1,11,2.5,4\n"),
            "p.csv:2: start_theta_deg: nan: expected a number from -3600 to 3600");
  EXPECT_EQ(error_of(start + "tip,1,2,3,-53,inf,-40,1,11,2.5,4\n"),
            "p.csv:2: from_y_mm: inf: expected a number from -10000 to 10000");
  EXPECT_EQ(error_of(start + kRow + "\ntip,1,2,3,-53,0,-40,,11,2.5,4\n"),
            "p.csv:3: to_y_mm: empty: expected a number from -10000 to 10000");
  EXPECT_EQ(error_of(start + "tip,1,2,3,-53,0x1p3,-40,1,11,2.5,4\n"),
            "p.csv:2: from_y_mm: 0x1p3: expected a number from -10000 to 10000");
  EXPECT_EQ(error_of(start + "wall,1,2,3,-53,0,-40,1,11,2.5,4\n"),
            "p.csv:2: pusher: wall: expected one of tip, a, \"b\"");
  EXPECT_EQ(error_of(start + "tip,1,2,3\n"),
            "p.csv:2: 4 cells: expected 11, as in the header");
  EXPECT_EQ(error_of(start + "tip,1,2,3,-53,0,-53,0,11,2.5,4\n"),
            "p.csv:2: to_x_mm: the place that the pusher comes from: expected a path");
  EXPECT_EQ(error_of(start + "\"tip,1,2,3\n"),
            "p.csv:2: a quote without its end: expected one on the same line");
  EXPECT_EQ(error_of(kHeader + ",face\n" + kRow + ",+z\n"),
            "p.csv:2: face: +z: expected a face that the pusher may touch: -x");
  EXPECT_EQ(error_of(kHeader + ",push_force_N\n" + kRow + ",-1\n"),
            "p.csv:2: push_force_N: -1: expected a number from 1e-09 to 1e+06");
  // Several faults, one message each.
  EXPECT_EQ(error_of(start + "tip,x,2,3,-53,y,-40,1,11,2.5,4\n"),
            "p.csv:2: start_x_mm: x: expected a number from -10000 to 10000\n"
            "p.csv:2: from_y_mm: y: expected a number from -10000 to 10000");
}

TEST(Measurements, RefusesHeadersThatItDoesNotKnow) {
  EXPECT_EQ(error_of("grip_force_N,slip_force_N,slip_force_N\n1,1,1\n"),
            "p.csv:1: slip_force_N: column twice: expected once");
  EXPECT_EQ(error_of("slip_force_N\n1\n"),
            "p.csv:1: grip_force_N: column missing: expected it in the header");
  EXPECT_EQ(error_of("grip_force_N,slip_force_N,to_x_mm\n1,1,1\n"),
            "p.csv:1: to_x_mm: column of pushes beside one of slip forces: expected "
            "either");
  EXPECT_EQ(error_of(kHeader.substr(7) + "\n"),
            "p.csv:1: pusher: column missing: expected it, for the scene has 2 pushers");
  EXPECT_TRUE(
      error_of("start_x\n1\n")
          .starts_with(
              "p.csv:1: start_x: unknown column: expected pusher, face, start_x_mm, "));
  EXPECT_EQ(error_of("grip_force_N,slip_force_N\n0,1\n"),
            "p.csv:2: grip_force_N: 0: expected a number from 1e-09 to 1e+06");
  EXPECT_EQ(error_of("grip_force_N,slip_force_N,slip_torque_Nm\n1,,\n"),
            "p.csv:2: no force and no torque: expected one of them at least");
}

TEST(Measurements, IsBounded) {
  EXPECT_EQ(error_of(std::string(3'000'000, 'x')),
            "p.csv: 3000000 bytes: expected at most 2000000 bytes");
  EXPECT_EQ(error_of(kHeader + "\n" + std::string(5000, '1') + "\n"),
            "p.csv:2: 5000 characters: expected at most 4096 in a line");
  std::string many = "grip_force_N,slip_force_N\n";
  for (int i = 0; i < 5001; ++i) many += "1,1\n";
  EXPECT_EQ(error_of(many), "p.csv:5002: more lines: expected at most 5000");
  std::string wide = "note";
  for (int i = 0; i < 64; ++i) wide += ",note";
  EXPECT_EQ(error_of(wide + "\n"), "p.csv:1: 65 columns: expected at most 64");
  EXPECT_NE(error_of(std::string("a\0b\n", 4)).find("p.csv"), std::string::npos);
  // Every bad line is counted, not every one told.
  std::string bad = "grip_force_N,slip_force_N\n";
  for (int i = 0; i < 4000; ++i) bad += "nan,nan\n";
  EXPECT_LT(error_of(bad).size(), 4000U);
}

}  // namespace
}  // namespace prehensile
