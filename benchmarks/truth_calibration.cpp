#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/truth_runs.h"
#include "benchmarks/truth_scores.h"
#include "primitives/calibration.h"
#include "primitives/uncertainty.h"

namespace prehensile::benchmarks {
namespace {

constexpr double kFitStep = 5e-4;  ///< [m] of the simulated pushes while fitting

/// What is fitted to a recording.
struct McubeFit {
  Vec2 offset = Vec2::Zero();  ///< [m] of the tip, from kinematics
  double friction = 0.0;
  double edge_load = 0.0;
  std::array<double, 2> friction_range{}, edge_load_range{};
};

/// Measured minus predicted along the push, across it, and in angle. `step` [m] of the
/// simulated pushes; `registers`: the place of the tip is fitted too, about `offset`.
FitProblem problem_of(const McubePushes& mcube, const std::vector<int>& rows,
                      const Vec2& offset, double step, bool registers) {
  FitProblem problem;
  problem.parameters = {{.name = "friction",
                         .start = kMcubeFrictionRegistered,
                         .low = 0.02,
                         .high = 0.8,
                         .step = 0.02,
                         .known = 0.05},
                        {.name = "edge load",
                         .start = 0.0,
                         .low = -1.0,
                         .high = 3.0,
                         .step = 0.1,
                         .known = 1.0,
                         .tries = {-0.6, 0.6, 1.5}}};
  if (registers) {
    for (const char* name : {"tip x", "tip y"}) {
      problem.parameters.push_back({.name = name,
                                    .start = 0.0,
                                    .low = -5e-3,
                                    .high = 5e-3,
                                    .step = 2e-4,
                                    .known = 1.5e-3});
    }
  }
  problem.rows = static_cast<int>(rows.size());
  problem.resolution = {1e-4, 1e-4, 2e-3};
  problem.residuals = [&mcube, &rows, offset, step, registers](const Eigen::VectorXd& at,
                                                               std::span<const int> which,
                                                               Eigen::MatrixXd& out) {
    const TipPush& first = mcube.data.pushes[rows[0]];
    const Plate plate = loaded_plate(mcube.data.plates[first.plate], at[1]);
    const Tips tips{.count = 1, .radius = kMcubeTipRadius, .mu = at[0]};
    const Vec2 off_tip = registers ? Vec2(offset + at.tail<2>()) : offset;
    for (std::size_t i = 0; i < which.size(); ++i) {
      const TipPush& push = mcube.data.pushes[rows[which[i]]];
      int failures = 0;
      const PlanarPose end = predicted_end(plate, push, SupportModel::kPoints, tips,
                                           off_tip, failures, step);
      const Vec2 along = (push.path.back()[0] - push.path.front()[0]).normalized();
      const Vec2 off = translation(push.X_WO_end) - translation(end);
      out.col(static_cast<Eigen::Index>(i)) << off.dot(along), off.dot(perp(along)),
          wrapped(push.X_WO_end.theta - end.theta);
    }
  };
  return problem;
}

McubeFit fit_recording(const McubePushes& mcube, const std::vector<int>& rows) {
  McubeFit out;
  std::vector<const TipPush*> pushes;
  std::vector<int> all;
  for (const int row : rows) {
    all.push_back(static_cast<int>(pushes.size()));
    pushes.push_back(&mcube.data.pushes[row]);
  }
  out.offset = tip_offset(mcube.data, pushes);
  const FitProblem problem = problem_of(mcube, rows, out.offset, kFitStep, false);
  const Fit best = fit(problem, all, start_of(problem), {});
  const FitCovariance spread = covariance(problem, all, best, {});
  out.friction = best.at[0];
  out.edge_load = best.at[1];
  const double t = student_quantile(0.95, std::max(3, problem.rows - 2));
  const double d_friction = t * std::sqrt(spread.by_scatter(0, 0));
  const double d_load = t * std::sqrt(spread.by_scatter(1, 1));
  const auto within = [&](int j, double value) {
    const FitParameter& p = problem.parameters[static_cast<std::size_t>(j)];
    return std::clamp(value, p.low, p.high);
  };
  out.friction_range = {within(0, out.friction - d_friction),
                        within(0, out.friction + d_friction)};
  out.edge_load_range = {within(1, out.edge_load - d_load),
                         within(1, out.edge_load + d_load)};
  return out;
}

std::string angle_name(double angle) {
  if (angle >= 90.0) return "tip's line meets no edge";
  const int rounded = 20 * static_cast<int>(std::lround(angle / 20.0));
  std::string number = std::to_string(rounded);
  if (number.size() == 1) number.insert(0, 1, ' ');
  return "push angle " + number + " deg";
}

/// Fits on the positions of one parity, scores the others.
void run_half(const McubePushes& mcube, int fitted_parity, Scores& scores,
              int& failures) {
  std::printf("%-16s %6s %6s %18s %20s %12s %14s\n", "recording", "fitted", "tested",
              "friction (90 %)", "edge load (90 %)", "k of torque", "tip off mm");
  for (const std::string& recording : mcube.recordings) {
    std::vector<int> fitted, tested;
    for (int i = 0; i < static_cast<int>(mcube.data.pushes.size()); ++i) {
      if (mcube.data.pushes[i].recording != recording) continue;
      (mcube.position[i] % 2 == fitted_parity ? fitted : tested).push_back(i);
    }
    if (fitted.size() < 6 || tested.empty()) {
      std::printf("%-16s %6zu %6zu: too few\n", recording.c_str(), fitted.size(),
                  tested.size());
      continue;
    }
    const McubeFit best = fit_recording(mcube, fitted);
    const Plate& uniform = mcube.data.plates[mcube.data.pushes[fitted[0]].plate];
    const Plate plate = loaded_plate(uniform, best.edge_load);
    std::printf(
        "%-16s %6zu %6zu %6.3f %.3f..%.3f %8.2f %5.2f..%5.2f %12.2f %6.2f %6.2f\n",
        recording.c_str(), fitted.size(), tested.size(), best.friction,
        best.friction_range[0], best.friction_range[1], best.edge_load,
        best.edge_load_range[0], best.edge_load_range[1],
        plate.torque_radius() / uniform.torque_radius(), 1e3 * best.offset.x(),
        1e3 * best.offset.y());
    const Tips raw{.count = 1, .radius = kMcubeTipRadius, .mu = kMcubeFriction};
    const Tips tips{.count = 1, .radius = kMcubeTipRadius, .mu = best.friction};
    for (const int i : tested) {
      const TipPush& push = mcube.data.pushes[i];
      const auto add = [&](const char* model, const PlanarPose& end) {
        scores.add(model, recording, angle_name(mcube.push_angle[i]), i, end,
                   push.X_WO_end);
      };
      add("points calibrated",
          predicted_end(plate, push, SupportModel::kPoints, tips, best.offset, failures));
      add("points raw", predicted_end(uniform, push, SupportModel::kPoints, raw,
                                      Vec2::Zero(), failures));
      add("published ellipsoid fit", push.published[0]);
      add("published quartic fit", push.published[1]);
    }
  }
}

/// Errors on one of four pushes of the odd positions, with what `count` pushes of the
/// even ones told; those are drawn at random, in the order of random_point.
struct FewErrors {
  Errors before, after, quartic;
  int told = 0;
};

void add_few(const McubePushes& mcube, const std::string& recording, std::size_t count,
             FewErrors& errors) {
  constexpr double kCoarseStep = 1e-3;
  std::vector<std::pair<double, int>> drawn;
  std::vector<int> tested;
  for (int i = 0; i < static_cast<int>(mcube.data.pushes.size()); ++i) {
    if (mcube.data.pushes[i].recording != recording) continue;
    if (mcube.position[i] % 2 == 0) {
      drawn.emplace_back(random_point(1, static_cast<std::uint64_t>(i))[0], i);
    } else if (i % 4 == 0) {
      tested.push_back(i);
    }
  }
  if (drawn.size() < count) return;
  std::sort(drawn.begin(), drawn.end());
  std::vector<int> rows;
  rows.reserve(count);
  for (std::size_t i = 0; i < count; ++i) rows.push_back(drawn[i].second);
  const FitProblem problem = problem_of(mcube, rows, Vec2::Zero(), kCoarseStep, true);
  const Calibration found = calibrate(problem, {.folds = 2});
  errors.told += found.told();
  const Eigen::VectorXd& at = found.fit.at;
  const Plate& uniform = mcube.data.plates[mcube.data.pushes[rows[0]].plate];
  const Plate plate = loaded_plate(uniform, at[1]);
  Tips tips{.count = 1, .radius = kMcubeTipRadius, .mu = kMcubeFrictionRegistered};
  int failures = 0;
  for (const int i : tested) {
    const TipPush& push = mcube.data.pushes[i];
    tips.mu = kMcubeFrictionRegistered;
    errors.before.add(
        predicted_end(uniform, push, SupportModel::kPoints, tips, Vec2::Zero(), failures),
        push.X_WO_end);
    tips.mu = at[0];
    errors.after.add(
        predicted_end(plate, push, SupportModel::kPoints, tips, at.tail<2>(), failures),
        push.X_WO_end);
    errors.quartic.add(push.published[1], push.X_WO_end);
  }
}

}  // namespace

void run_mcube_calibrated(const TruthOptions& options, std::FILE* csv) {
  const McubePushes mcube = select_mcube(options);
  for (const int parity : {0, 1}) {
    const char* fitted = parity == 0 ? "even" : "odd";
    const char* tested = parity == 0 ? "odd" : "even";
    std::printf("\nmcube_push: fitted on the %s contact positions of each recording\n",
                fitted);
    int failures = 0;
    Scores scores(
        std::string("mcube_push calibrated, tested on the ") + tested + " positions",
        csv);
    run_half(mcube, parity, scores, failures);
    scores.print();
    std::printf(
        "raw: friction %.2f, uniform pressure, nothing fitted; published: fitted by "
        "their authors to these recordings; %d steps unsolved\n",
        kMcubeFriction, failures);
  }
}

void run_mcube_few(const TruthOptions& options, std::FILE* csv) {
  const McubePushes mcube = select_mcube(options);
  std::printf(
      "\nmcube_push: friction, edge load and place of the tip from few pushes of each "
      "recording,\ntested on others; mean mm / deg\n%6s %8s %16s %16s %16s %18s\n",
      "pushes", "tested", "before", "calibrated", "quartic", "told, of 4 each");
  for (const std::size_t count : {6U, 10U, 20U, 50U}) {
    FewErrors errors;
    for (const std::string& recording : mcube.recordings) {
      add_few(mcube, recording, count, errors);
    }
    const auto show = [](const Errors& of) {
      std::printf("   %5.2f / %5.2f", mean(of.distance_mm), mean(of.angle_deg));
    };
    if (errors.after.distance_mm.empty()) continue;
    std::printf("%6zu %8zu", count, errors.after.distance_mm.size());
    for (const Errors* of : {&errors.before, &errors.after, &errors.quartic}) show(*of);
    std::printf(" %12.1f\n", static_cast<double>(errors.told) /
                                 static_cast<double>(mcube.recordings.size()));
    if (csv) {
      std::fprintf(csv, "mcube_push few,all,%zu,points calibrated,%.6f,%.6f\n", count,
                   mean(errors.after.distance_mm), mean(errors.after.angle_deg));
    }
  }
  std::printf("before: friction %.2f, uniform pressure, raw tips\n",
              kMcubeFrictionRegistered);
}

}  // namespace prehensile::benchmarks
