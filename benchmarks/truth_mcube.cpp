#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Cholesky>

#include "benchmarks/truth_runs.h"

namespace prehensile::benchmarks {
namespace {

/// Angle of the push from the inward normal of the edge that its line meets first.
double angle_to_edge(const Plate& plate, const Vec2& from, const Vec2& to) {
  const Vec2 way = (to - from).normalized();
  double first = std::numeric_limits<double>::infinity();
  double angle = 90.0;
  const std::size_t n = plate.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& a = plate.outline[i];
    const Vec2 edge = plate.outline[(i + 1) % n] - a;
    const Vec2 inward = perp(edge.normalized());
    const double advance = way.dot(inward);
    if (advance < 1e-6) continue;
    const double reach = (a - from).dot(inward) / advance;
    const double along = (from + reach * way - a).dot(edge) / edge.squaredNorm();
    if (along < 0.0 || along > 1.0 || reach >= first) continue;
    first = reach;
    angle = std::acos(std::min(1.0, advance)) * 57.29577951308232;
  }
  return angle;
}

}  // namespace

McubePushes select_mcube(const TruthOptions& options) {
  constexpr double kSamePlace = 4e-3;  // positions are 9 mm apart and more
  TipPushes all = read_mcube_pushes(options.data / "mcube_push", options.points);
  McubePushes out;
  out.data.plates = std::move(all.plates);
  std::string recording;
  Vec2 place = Vec2::Zero();
  int position = -1;
  for (TipPush& push : all.pushes) {
    if (push.recording.find(options.recording) == std::string::npos) continue;
    const PlanarPose X_OW = inverse(push.X_WO_start);
    const Vec2 p_OTip = transform(X_OW, push.path.front()[0]);
    if (push.recording != recording) {
      recording = push.recording;
      out.recordings.push_back(recording);
      position = 0;
      place = p_OTip;
    } else if ((p_OTip - place).norm() > kSamePlace) {
      ++position;
      place = p_OTip;
    }
    if ((position / 2) % options.every != 0) continue;  // keeps odd and even ones
    const Plate& plate = out.data.plates[push.plate];
    out.position.push_back(position);
    out.push_angle.push_back(
        angle_to_edge(plate, p_OTip, transform(X_OW, push.path.back()[0])));
    out.data.pushes.push_back(std::move(push));
  }
  return out;
}

PlanarPose predicted_end(const Plate& plate, const TipPush& push, SupportModel model,
                         const Tips& tips, const Vec2& tip_offset, int& failures,
                         double step) {
  std::vector<TipPlaces> path = push.path;
  for (TipPlaces& places : path) places[0] += tip_offset;
  const PushedPlate end = push_plate(plate, model, tips, push.X_WO_start, path, step);
  failures += end.failures;
  return end.X_WO;
}

Vec2 tip_offset(const TipPushes& data, const std::vector<const TipPush*>& pushes) {
  std::vector<Vec3> rows;
  std::vector<double> gaps;
  const Tips tips{.count = 1, .radius = kMcubeTipRadius, .mu = kMcubeFrictionRegistered};
  for (const TipPush* push : pushes) {
    const Plate& plate = data.plates[push->plate];
    const PushedPlate end =
        push_plate(plate, SupportModel::kEllipsoid, tips, push->X_WO_start, push->path);
    const Vec2 p_OTip = transform(inverse(push->X_WO_end), push->path.back()[0]);
    const TipGap gap = tip_gap(plate, p_OTip, kMcubeTipRadius);
    if (!end.touched || !end.kept_contact || std::abs(gap.gap) > 5e-3) continue;
    const Vec2 n_W = rotated(push->X_WO_end.theta, gap.n_O);
    rows.emplace_back(1.0, n_W.x(), n_W.y());
    gaps.push_back(gap.gap);
  }
  // Iteratively reweighted least squares of the gap on (1, normal).
  Vec3 fit = Vec3::Zero();
  for (int round = 0; round < 20; ++round) {
    Eigen::Matrix3d A = 1e-9 * Eigen::Matrix3d::Identity();
    Vec3 b = Vec3::Zero();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double weight = 1.0 / std::max(5e-4, std::abs(gaps[i] - rows[i].dot(fit)));
      A += weight * rows[i] * rows[i].transpose();
      b += weight * gaps[i] * rows[i];
    }
    fit = A.ldlt().solve(b);
  }
  return fit.tail<2>();
}

std::vector<Vec2> offsets_of_other_half(const TipPushes& data) {
  std::map<std::string, std::array<std::vector<const TipPush*>, 2>> halves;
  std::map<std::string, std::size_t> seen;
  std::vector<std::size_t> half_of(data.pushes.size());
  for (std::size_t i = 0; i < data.pushes.size(); ++i) {
    const TipPush& push = data.pushes[i];
    half_of[i] = seen[push.recording]++ % 2;
    halves[push.recording][half_of[i]].push_back(&push);
  }
  std::map<std::string, std::array<Vec2, 2>> offsets;
  for (const auto& [recording, half] : halves) {
    offsets[recording] = {tip_offset(data, half[1]), tip_offset(data, half[0])};
  }
  std::vector<Vec2> result;
  result.reserve(data.pushes.size());
  for (std::size_t i = 0; i < data.pushes.size(); ++i) {
    result.push_back(offsets[data.pushes[i].recording][half_of[i]]);
  }
  return result;
}

}  // namespace prehensile::benchmarks
