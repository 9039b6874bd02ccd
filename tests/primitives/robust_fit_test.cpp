#include "primitives/robust_fit.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "problems/random_stream.h"

namespace prehensile {
namespace {

double normal(RandomStream& random) {
  return std::sqrt(-2.0 * std::log(random.in(1e-300, 1.0))) *
         std::cos(6.283185307179586 * random.in(0.0, 1.0));
}

std::vector<int> all_rows(int count) {
  std::vector<int> rows(static_cast<std::size_t>(count));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// y = exp(-a x) + b in one part and a x in another, with noise; a share of outliers.
FitProblem decay(double a, double b, int rows, double noise, double outliers,
                 std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<Eigen::Vector3d> data;  // x, both parts
  for (int i = 0; i < rows; ++i) {
    const double x = random.in(0.0, 3.0);
    const double scale = random.chance(outliers) ? 20.0 * noise : noise;
    data.emplace_back(x, std::exp(-a * x) + b + scale * normal(random),
                      a * x + 5.0 * scale * normal(random));
  }
  FitProblem problem;
  problem.parameters = {
      {.name = "a", .start = 1.0, .low = 0.01, .high = 10.0, .step = 1e-3, .known = 1.0},
      {.name = "b", .start = 0.0, .low = -5.0, .high = 5.0, .step = 1e-3, .known = 1.0}};
  problem.rows = rows;
  problem.resolution = {1e-9, 1e-9};
  problem.residuals = [data](const Eigen::VectorXd& at, std::span<const int> which,
                             Eigen::MatrixXd& out) {
    for (std::size_t i = 0; i < which.size(); ++i) {
      const Eigen::Vector3d& row = data[static_cast<std::size_t>(which[i])];
      const auto column = static_cast<Eigen::Index>(i);
      out(0, column) = row[1] - std::exp(-at[0] * row[0]) - at[1];
      out(1, column) = row[2] - at[0] * row[0];
    }
  };
  return problem;
}

TEST(RobustFit, FindsExactDataExactly) {
  const FitProblem problem = decay(1.7, 0.3, 30, 0.0, 0.0, 1);
  const Fit best = fit(problem, all_rows(30), start_of(problem), {});
  EXPECT_NEAR(best.at[0], 1.7, 1e-4);
  EXPECT_NEAR(best.at[1], 0.3, 1e-4);
}

TEST(RobustFit, OutliersHardlyCount) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const FitProblem problem = decay(1.7, 0.3, 60, 0.01, 0.15, seed);
    const Fit best = fit(problem, all_rows(60), start_of(problem), {});
    EXPECT_NEAR(best.at[0], 1.7, 0.05) << seed;
    EXPECT_NEAR(best.at[1], 0.3, 0.02) << seed;
    EXPECT_LT(best.scale[0], 0.05) << seed;  // the root of the mean square is 0.08
  }
}

TEST(RobustFit, HeldParametersStay) {
  const FitProblem problem = decay(1.7, 0.3, 30, 0.01, 0.0, 1);
  Eigen::VectorXd start = start_of(problem);
  start[1] = 0.1;
  const Fit best = fit(problem, all_rows(30), start, {false, true});
  EXPECT_EQ(best.at[1], 0.1);
  EXPECT_GT(best.objective, fit(problem, all_rows(30), start, {false, false}).objective);
}

TEST(RobustFit, MissingPartsDoNotCount) {
  FitProblem problem = decay(1.7, 0.3, 40, 0.01, 0.0, 3);
  const auto inner = problem.residuals;
  problem.residuals = [inner](const Eigen::VectorXd& at, std::span<const int> which,
                              Eigen::MatrixXd& out) {
    inner(at, which, out);
    for (std::size_t i = 0; i < which.size(); ++i) {
      if (which[i] % 2 == 0) out(1, static_cast<Eigen::Index>(i)) = std::nan("");
    }
  };
  const Fit best = fit(problem, all_rows(40), start_of(problem), {});
  EXPECT_NEAR(best.at[0], 1.7, 0.05);
  EXPECT_TRUE(std::isfinite(best.objective));
}

/// The rate at which 90 % intervals hold the truth, over many draws of the data. Three
/// standard deviations of so many draws are 5 %. With outliers the intervals are wider
/// than they need be, never too narrow.
TEST(RobustFit, IntervalsCoverAtTheNominalRate) {
  for (const double outliers : {0.0, 0.1}) {
    int covered_a = 0, covered_b = 0;
    const int draws = 300;
    for (int draw = 0; draw < draws; ++draw) {
      const FitProblem problem =
          decay(1.3, 0.2, 24, 0.03, outliers, static_cast<std::uint64_t>(draw) + 100);
      const std::vector<int> rows = all_rows(24);
      const Fit best = fit(problem, rows, start_of(problem), {});
      const FitCovariance spread = covariance(problem, rows, best, {});
      const FitInterval a = profile(problem, rows, best, 0, {}, spread).interval;
      const FitInterval b = profile(problem, rows, best, 1, {}, spread).interval;
      covered_a += a.low <= 1.3 && 1.3 <= a.high;
      covered_b += b.low <= 0.2 && 0.2 <= b.high;
    }
    EXPECT_GT(covered_a, (0.9 - 0.052) * draws) << outliers;
    const double most = (outliers > 0.0 ? 0.985 : 0.9 + 0.052) * draws;
    EXPECT_LT(covered_a, most) << outliers;
    EXPECT_GT(covered_b, (0.9 - 0.052) * draws) << outliers;
    EXPECT_LT(covered_b, most) << outliers;
  }
}

TEST(RobustFit, AProfileStopsAtTheBoundWhereTheDataSetNoLimit) {
  // y = min(x, theta): once theta is beyond all x it may be anything.
  FitProblem problem;
  problem.parameters = {
      {.name = "theta", .start = 2.0, .low = 0.1, .high = 5.0, .step = 0.02}};
  problem.rows = 20;
  problem.resolution = {1e-3};
  problem.residuals = [](const Eigen::VectorXd& at, std::span<const int> which,
                         Eigen::MatrixXd& out) {
    for (std::size_t i = 0; i < which.size(); ++i) {
      const double x = 0.05 * which[i];
      const double noise = which[i] % 2 ? 0.01 : -0.01;
      out(0, static_cast<Eigen::Index>(i)) = x + noise - std::min(x, at[0]);
    }
  };
  const std::vector<int> rows = all_rows(20);
  const Fit best = fit(problem, rows, start_of(problem), {});
  const FitCovariance spread = covariance(problem, rows, best, {});
  const Profile found = profile(problem, rows, best, 0, {}, spread);
  EXPECT_TRUE(found.interval.open_high);
  EXPECT_FALSE(found.interval.open_low);
  EXPECT_EQ(found.interval.high, 5.0);
  EXPECT_NEAR(found.interval.low, 0.95, 0.1);
}

TEST(RobustFit, SampledProfilesAreEvenConvexAndNowhereBelowZero) {
  const FitProblem problem = decay(1.3, 0.2, 40, 0.03, 0.0, 7);
  const std::vector<int> rows = all_rows(40);
  const Fit best = fit(problem, rows, start_of(problem), {});
  const FitCovariance spread = covariance(problem, rows, best, {});
  for (int j = 0; j < 2; ++j) {
    Profile sampled = profile(problem, rows, best, j, {}, spread);
    const FitInterval interval = sampled.interval;
    sample_profile(problem, rows, best, j, {}, sampled);
    const std::vector<ProfilePoint>& points = sampled.points;
    ASSERT_EQ(points.size(), 17u);
    EXPECT_EQ(points[8].value, best.at[j]);
    EXPECT_LT(points.front().value, interval.low);
    EXPECT_GT(points.back().value, interval.high);
    EXPECT_GT(points.front().rise, sampled.limit);
    EXPECT_GT(points.back().rise, sampled.limit);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const double before = points[i].value - points[i - 1].value;
      const double after = points[i + 1].value - points[i].value;
      if (i != 8) {
        EXPECT_NEAR(before, after, 1e-9) << j << " " << i;
      }
      const double left = (points[i].rise - points[i - 1].rise) / before;
      const double right = (points[i + 1].rise - points[i].rise) / after;
      EXPECT_LT(left, right) << j << " " << i;
    }
  }
}

TEST(RobustFit, ASampledProfileRisesFromItsLeastWhereTheFitStoppedShort) {
  const FitProblem problem = decay(1.3, 0.2, 40, 0.03, 0.0, 7);
  const std::vector<int> rows = all_rows(40);
  const Fit best = fit(problem, rows, start_of(problem), {});
  const FitCovariance spread = covariance(problem, rows, best, {});
  Profile sampled = profile(problem, rows, best, 0, {}, spread);
  Eigen::VectorXd aside = best.at;
  aside[0] += 0.2 * sampled.interval.half_width();
  const Fit stopped = fit(problem, rows, aside, {true, false});
  sample_profile(problem, rows, stopped, 0, {}, sampled);
  double least = 1.0, at_fit = 0.0;
  for (const ProfilePoint& point : sampled.points) {
    least = std::min(least, point.rise);
    if (point.value == stopped.at[0]) at_fit = point.rise;
  }
  EXPECT_EQ(least, 0.0);
  EXPECT_GT(at_fit, 0.0);
}

TEST(RobustFit, StudentQuantilesAreThoseOfTables) {
  EXPECT_NEAR(student_quantile(0.95, 3), 2.353, 0.02);
  EXPECT_NEAR(student_quantile(0.95, 10), 1.812, 1e-3);
  EXPECT_NEAR(student_quantile(0.975, 30), 2.042, 1e-3);
  EXPECT_NEAR(student_quantile(0.95, 100000), 1.6449, 1e-3);
  EXPECT_NEAR(student_quantile(0.05, 10), -1.812, 1e-3);
}

}  // namespace
}  // namespace prehensile
