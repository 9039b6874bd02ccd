#include "benchmarks/precision_plots.h"

#include <gtest/gtest.h>

namespace prehensile::benchmarks {
namespace {

PrecisionRun run_of(const char* solver, int instance, double time_us, bool solved = true,
                    double error = 0.1) {
  return {.set = "spatial 10",
          .solver = solver,
          .points = 4,
          .compliance = 1e-2,
          .instance = instance,
          .asked = true,
          .solved = solved,
          .residual = 1e-9,
          .force_error = error,
          .twist_error = 0.5 * error,
          .time_us = time_us};
}

TEST(PrecisionPoints, GatherRunsOfOneSolverAndDiscretisation) {
  std::vector<PrecisionRun> runs = {run_of("a", 0, 1.0), run_of("b", 0, 10.0),
                                    run_of("a", 1, 3.0, true, 0.3),
                                    run_of("a", 2, 2.0, false)};
  runs.push_back(run_of("a", 3, 100.0));
  runs.back().asked = false;  // No reference: counts nowhere.
  const std::vector<PrecisionPoint> points = points_of(runs);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].example.solver, "a");
  EXPECT_EQ(points[0].asked, 3);
  EXPECT_EQ(points[0].solved, 2);
  EXPECT_NEAR(points[0].failed(), 1.0 / 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(points[0].time_median, 2.0);
  EXPECT_DOUBLE_EQ(points[0].force_p95, 0.3);
  EXPECT_DOUBLE_EQ(points[0].force_median, 0.1);
  EXPECT_EQ(points[1].asked, 1);
}

TEST(PrecisionPlots, NameTheirSolversAndLeaveOutOtherSets) {
  std::vector<PrecisionRun> runs = {run_of("first", 0, 1.0), run_of("second", 0, 10.0)};
  runs.push_back(run_of("elsewhere", 0, 1.0));
  runs.back().set = "planar";
  for (const std::string& svg : {work_precision_svg(points_of(runs), "spatial 10"),
                                 profile_svg(runs, {.set = "spatial 10"})}) {
    EXPECT_NE(svg.find("first"), std::string::npos);
    EXPECT_NE(svg.find("second"), std::string::npos);
    EXPECT_EQ(svg.find("elsewhere"), std::string::npos);
    EXPECT_NE(svg.find("instants at 10 m/s^2"), std::string::npos);
  }
}

TEST(PrecisionPlots, ProfileCountsInstantsOnce) {
  const std::vector<PrecisionRun> runs = {run_of("a", 0, 1.0), run_of("a", 1, 1.0),
                                          run_of("b", 0, 2.0),
                                          run_of("b", 1, 5.0, false)};
  const std::string svg = profile_svg(runs, {.set = "spatial 10"});
  EXPECT_NE(svg.find("2 instants"), std::string::npos);
}

}  // namespace
}  // namespace prehensile::benchmarks
