#include "primitives/calibration.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "problems/random_stream.h"

namespace prehensile {
namespace {

/// y = model(parameters, x), one part, with noise.
template <typename Model>
FitProblem problem_of(const Model& model, const Eigen::VectorXd& truth, int rows,
                      double noise, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<std::pair<double, double>> data;
  for (int i = 0; i < rows; ++i) {
    const double x = random.in(0.0, 1.0);
    data.emplace_back(x, model(truth, x) + noise * random.in(-1.7, 1.7));
  }
  FitProblem problem;
  for (Eigen::Index j = 0; j < truth.size(); ++j) {
    std::string name = "p";
    problem.parameters.push_back({.name = name += std::to_string(j),
                                  .start = 0.5,
                                  .low = -5.0,
                                  .high = 5.0,
                                  .step = 1e-3,
                                  .known = 0.5});
  }
  problem.rows = rows;
  problem.resolution = {1e-6};
  problem.residuals = [data, model](const Eigen::VectorXd& at, std::span<const int> which,
                                    Eigen::MatrixXd& out) {
    for (std::size_t i = 0; i < which.size(); ++i) {
      const auto& [x, y] = data[static_cast<std::size_t>(which[i])];
      out(0, static_cast<Eigen::Index>(i)) = y - model(at, x);
    }
  };
  return problem;
}

TEST(Calibration, TellsWhatTheDataTell) {
  const auto line = [](const Eigen::VectorXd& p, double x) { return p[0] + p[1] * x; };
  const FitProblem problem = problem_of(line, Eigen::Vector2d(0.2, 1.4), 40, 0.02, 1);
  const Calibration found = calibrate(problem);
  EXPECT_EQ(found.told(), 2);
  EXPECT_NEAR(found.parameters[1].value, 1.4, 0.05);
  EXPECT_LE(found.parameters[1].profile.interval.low, found.parameters[1].value);
  EXPECT_LT(found.held_out.cwiseAbs().mean(), 0.2 * found.before.cwiseAbs().mean());
}

/// Ripples, as the steps of a model leave them, stop fits beside the best place: where a
/// profile finds a better one, the fit goes there.
TEST(Calibration, NoProfileFallsFarBelowTheFit) {
  const auto rippled = [](const Eigen::VectorXd& p, double x) {
    const double y = p[0] + p[1] * x;
    return y + 2e-3 * std::sin(1000.0 * y);
  };
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const FitProblem problem =
        problem_of(rippled, Eigen::Vector2d(0.2, 1.4), 40, 0.02, seed);
    const Calibration found = calibrate(problem);
    for (const CalibratedParameter& parameter : found.parameters) {
      if (!parameter.told) continue;
      ++told;
      for (const ProfilePoint& point : parameter.profile.points) {
        if (point.value != parameter.value) continue;
        EXPECT_LE(point.rise, 0.1) << "seed " << seed;
      }
    }
  }
  EXPECT_EQ(told, 40);
}

TEST(Calibration, AParameterWithoutInfluenceIsNotTold) {
  const auto line = [](const Eigen::VectorXd& p, double x) { return p[0] + x; };
  const FitProblem problem = problem_of(line, Eigen::Vector2d(0.2, 3.0), 40, 0.02, 1);
  const Calibration found = calibrate(problem);
  EXPECT_TRUE(found.parameters[0].told);
  EXPECT_FALSE(found.parameters[1].told);
  EXPECT_EQ(found.parameters[1].value, 0.5);
  EXPECT_TRUE(found.parameters[1].profile.interval.open_low);
  EXPECT_TRUE(found.parameters[1].profile.interval.open_high);
}

TEST(Calibration, ExchangeableParametersAreNamed) {
  const auto sum = [](const Eigen::VectorXd& p, double x) {
    return p[0] + p[1] + p[2] * x;
  };
  const FitProblem problem = problem_of(sum, Eigen::Vector3d(0.3, 0.9, 1.2), 40, 0.02, 1);
  const Calibration found = calibrate(problem);
  EXPECT_EQ(found.told(), 2);
  EXPECT_TRUE(found.parameters[2].told);
  const int untold = found.parameters[0].told ? 1 : 0;
  EXPECT_EQ(found.parameters[static_cast<std::size_t>(untold)].confused_with, 1 - untold);
  EXPECT_LT(found.parameters[static_cast<std::size_t>(untold)].correlation, -0.95);
  EXPECT_NEAR(found.parameters[0].value + found.parameters[1].value, 1.2, 0.05);
}

TEST(Calibration, OneSidedKnowledgeMovesTheValueNoFartherThanItMust) {
  const auto bent = [](const Eigen::VectorXd& p, double x) {
    return std::min(x, p[0]) + p[1];
  };
  // p0 beyond every x: nothing but "at least about 1".
  const FitProblem problem = problem_of(bent, Eigen::Vector2d(2.0, 0.4), 60, 0.01, 1);
  const Calibration found = calibrate(problem);
  EXPECT_FALSE(found.parameters[0].told);
  EXPECT_TRUE(found.parameters[0].profile.interval.open_high);
  EXPECT_NEAR(found.parameters[0].value, 1.0, 0.1);  // the start is 0.5
  EXPECT_NEAR(found.parameters[1].value, 0.4, 0.01);
}

/// A row is predicted by a fit that has not seen it: spoiling its measurement moves its
/// held-out residual by exactly the spoil.
TEST(Calibration, HeldOutRowsAreNotSeen) {
  const auto line = [](const Eigen::VectorXd& p, double x) { return p[0] + p[1] * x; };
  const FitProblem problem = problem_of(line, Eigen::Vector2d(0.2, 1.4), 25, 0.02, 1);
  const Calibration clean = calibrate(problem);
  for (const int spoilt : {0, 7, 24}) {
    FitProblem other = problem;
    other.residuals = [&problem, spoilt](const Eigen::VectorXd& at,
                                         std::span<const int> which,
                                         Eigen::MatrixXd& out) {
      problem.residuals(at, which, out);
      for (std::size_t i = 0; i < which.size(); ++i) {
        if (which[i] == spoilt) out(0, static_cast<Eigen::Index>(i)) += 0.5;
      }
    };
    const Calibration found = calibrate(other);
    EXPECT_NEAR(found.held_out(0, spoilt), clean.held_out(0, spoilt) + 0.5, 1e-12);
    const auto mine =
        static_cast<std::size_t>(clean.fold[static_cast<std::size_t>(spoilt)]);
    const std::size_t another = (mine + 1) % clean.fold_at.size();
    EXPECT_EQ(found.fold_at[mine], clean.fold_at[mine]);
    EXPECT_NE(found.fold_at[another], clean.fold_at[another]);
  }
}

TEST(Calibration, FoldsDependOnTheSeedOnly) {
  const auto line = [](const Eigen::VectorXd& p, double x) { return p[0] + p[1] * x; };
  const FitProblem problem = problem_of(line, Eigen::Vector2d(0.2, 1.4), 23, 0.02, 1);
  const Calibration one = calibrate(problem, {.seed = 4});
  EXPECT_EQ(one.fold, calibrate(problem, {.seed = 4}).fold);
  EXPECT_NE(one.fold, calibrate(problem, {.seed = 5}).fold);
  std::array<int, 5> sizes{};
  for (const int fold : one.fold) ++sizes[static_cast<std::size_t>(fold)];
  EXPECT_LE(*std::max_element(sizes.begin(), sizes.end()), 5);
  EXPECT_GE(*std::min_element(sizes.begin(), sizes.end()), 4);
}

}  // namespace
}  // namespace prehensile
