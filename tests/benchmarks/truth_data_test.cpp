#include "benchmarks/truth_data.h"

#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/folder.h"

namespace prehensile::benchmarks {
namespace {

/// Files made here in the layout of the public sets.
class TruthData : public ::testing::Test {
 protected:
  void write(const char* name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  /// The message of the error that reading ends with.
  template <class Read>
  static std::string error_of(const Read& read) {
    try {
      read();
    } catch (const std::exception& error) {
      return error.what();
    }
    return "no error";
  }

  const testing::Folder folder_;
};

constexpr const char* kPinHeader = "set,push,x0_m,y0_m,th0_rad,x1_m,y1_m,th1_rad,fx_N\n";

TEST_F(TruthData, ReadsPinPushes) {
  write("paths.json", R"({"board_30_90_30/0": [[0.1, 0.2], [0.3, 0.4], [0.5, 0.6]]})");
  write("trials.csv", std::string(kPinHeader) + "board_30_90_30,0,1,2,3,4,5,6,7\n");
  const TipPushes data = read_pin_pushes(folder_.path());
  ASSERT_EQ(data.pushes.size(), 1U);
  EXPECT_EQ(data.pushes[0].X_WO_end, (PlanarPose{4.0, 5.0, 6.0}));
  ASSERT_EQ(data.pushes[0].path.size(), 3U);
  EXPECT_EQ(data.pushes[0].path[1][0], Vec2(0.3, 0.4));
  EXPECT_EQ(data.plates[0].support.size(), 3U);
  EXPECT_NEAR(data.plates[0].centre().norm(), 0.0, 1e-15);
}

TEST_F(TruthData, NamesWhatIsWrong) {
  write("paths.json", R"({"board_30_90_30/0": [[0.1, 0.2]]})");
  write("trials.csv", std::string(kPinHeader) + "board_30_90_30,0,1,x,3,4,5,6,7\n");
  const auto read = [&] { read_pin_pushes(folder_.path()); };
  EXPECT_NE(error_of(read).find("trials.csv"), std::string::npos) << error_of(read);
  write("trials.csv", std::string(kPinHeader) + "board_1_2_3,0,1,2,3,4,5,6,7\n");
  EXPECT_NE(error_of(read).find("board_1_2_3"), std::string::npos) << error_of(read);
  write("trials.csv", "set,push\n");
  EXPECT_NE(error_of(read).find("x0_m"), std::string::npos) << error_of(read);
  write("paths.json", "{");
  EXPECT_NE(error_of(read).find("paths.json"), std::string::npos) << error_of(read);
}

TEST_F(TruthData, ReadsLinePushes) {
  write("trials.csv",
        "run,push,kind,px_m,py_m,nx,ny,cor_x_m,cor_y_m,angle_deg_or_mm,cmd_dx_m,cmd_dy_m,"
        "cmd_dth_rad,meas_dx_m,meas_dy_m,meas_dth_rad\n"
        "a,0,trans,-0.05,0,1,0,0.6,0.8,30,0.018,0.024,0,0,0,0\n"
        "a,1,rot,-0.05,0,1,0,0,0.5,10,0.08,0.01,0.17,0,0,0\n");
  const LinePushes data = read_line_pushes(folder_.path());
  ASSERT_EQ(data.pushes.size(), 2U);
  EXPECT_NEAR(data.pushes[0].V_OP[1], 0.024, 1e-15);
  const LinePush& turning = data.pushes[1];
  EXPECT_NEAR(turning.turn, std::numbers::pi / 18.0, 1e-12);
  EXPECT_LT(point_velocity(turning.V_OP, {0.0, 0.5}).norm(), 1e-12);
  EXPECT_NEAR((turning.fingers[1] - turning.fingers[0]).norm(), 0.05, 1e-12);
}

TEST_F(TruthData, ReadsMcubePushes) {
  write(
      "shapes.json",
      R"({"rect": {"vertices_m": [[0.04,0.04],[-0.04,0.04],[-0.04,-0.04],[0.04,-0.04]]}})");
  write("pushes.csv",
        "surface,shape,vel_mm_s,push,x0,y0,th0,x1,y1,th1,tx0,ty0,tx1,ty1,fitell_x1,"
        "fitell_y1,fitell_th1,fitp4_x1,fitp4_y1,fitp4_th1\n"
        "abs,rect,10,0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16\n");
  const TipPushes data = read_mcube_pushes(folder_.path(), 16);
  ASSERT_EQ(data.pushes.size(), 1U);
  EXPECT_EQ(data.pushes[0].path[1][0], Vec2(9.0, 10.0));
  EXPECT_EQ(data.pushes[0].published[1], (PlanarPose{14.0, 15.0, 16.0}));
  EXPECT_EQ(data.plates[0].support.size(), 16U);
}

}  // namespace
}  // namespace prehensile::benchmarks
