#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "benchmarks/truth_runs.h"
#include "benchmarks/truth_scores.h"
#include "primitives/spread_interval.h"
#include "primitives/uncertainty.h"

namespace prehensile::benchmarks {
namespace {

constexpr int kParts = 3;  // normal, tangential, angle
constexpr std::array<double, 2> kLevels = {0.5, 0.9};

/// The box of `query spread` where nobody says otherwise, as far as a plate on a board
/// has its unknowns.
constexpr double kFrictionShare = 0.25;
constexpr double kTorqueShare = 0.25;
/// [m] of a tip as it is given, and of one whose place was estimated.
constexpr double kRawPlace = 1e-3;
constexpr double kRegisteredPlace = 3e-4;
constexpr double kPressureCentre = 3e-3;  // [m] 8 % of the torque radius
constexpr double kAngle = 5.236e-3;       // [rad] of the plate
constexpr double kFloorShare = 0.07;
/// What the data's own cameras scatter: part of the floor here, not of the product's.
constexpr double kMeasured = 3e-4;       // [m]
constexpr double kMeasuredAngle = 5e-3;  // [rad]

/// Of one push: what each level's box says of each part, and what happened.
struct Row {
  std::string shape;
  std::array<double, kParts> off{};  // of the measured end from the nominal one
  std::array<double, kParts> floor{};
  std::array<std::array<SpreadQuantiles, kParts>, kLevels.size()> spread;
};

Vec2 first_normal(const Plate& plate, const TipPush& push) {
  const Vec2 from = push.path.front()[0];
  const Vec2 to = push.path.back()[0];
  const PlanarPose X_OW = inverse(push.X_WO_start);
  constexpr int kPieces = 200;
  for (int i = 0; i <= kPieces; ++i) {
    const Vec2 tip = from + (to - from) * i / kPieces;
    const TipGap gap = tip_gap(plate, transform(X_OW, tip), kMcubeTipRadius);
    if (gap.gap <= 0.0) return rotated(push.X_WO_start.theta, gap.n_O);
  }
  return (to - from).normalized();
}

std::array<double, kParts> parts_of(const PlanarPose& end, const PlanarPose& nominal,
                                    const Vec2& n) {
  const Vec2 off = translation(end) - translation(nominal);
  return {off.dot(n), off.dot(perp(n)), wrapped(end.theta - nominal.theta)};
}

/// `offset` [m] of the tip, uncertain by `place`.
Row row_of(const TipPushes& data, const TipPush& push, const Vec2& offset, double place,
           int index, int samples) {
  const Plate& plate = data.plates[push.plate];
  Row row;
  row.shape = push.recording.substr(push.recording.rfind(' ') + 1);
  Tips tips{.count = 1, .radius = kMcubeTipRadius, .mu = kMcubeFrictionRegistered};
  int failures = 0;
  const auto end_of = [&](const Plate& other, const TipPush& same, const Vec2& off) {
    return predicted_end(other, same, SupportModel::kEllipsoid, tips, offset + off,
                         failures, 5e-4);
  };
  const PlanarPose nominal = end_of(plate, push, Vec2::Zero());
  const Vec2 n = first_normal(plate, push);
  row.off = parts_of(push.X_WO_end, nominal, n);
  const double moved =
      (translation(nominal) - translation(push.X_WO_start)).norm() * kFloorShare;
  const double turned = (nominal.theta - push.X_WO_start.theta) * kFloorShare;
  row.floor = {std::hypot(moved, kMeasured), std::hypot(moved, kMeasured),
               std::hypot(turned, kMeasuredAngle)};
  std::array<std::vector<double>, kParts> sorted;
  for (int k = 0; k < samples; ++k) {
    const BoxPoint u = random_point(static_cast<std::uint64_t>(index) + 1,
                                    static_cast<std::uint64_t>(k));
    tips.mu = kMcubeFrictionRegistered * (1.0 + kFrictionShare * u[0]);
    Plate other = plate;
    const Vec2 centre = plate.centre();
    for (Vec2& p : other.support) {
      p = centre + (1.0 + kTorqueShare * u[1]) * (p - centre) +
          kPressureCentre * Vec2(u[2], u[3]);
    }
    TipPush turned_push = push;
    turned_push.X_WO_start.theta += kAngle * u[4];
    PlanarPose end = end_of(other, turned_push, place * Vec2(u[5], u[6]));
    end.theta -= kAngle * u[4];
    const std::array<double, kParts> off = parts_of(end, nominal, n);
    for (int part = 0; part < kParts; ++part) sorted[part].push_back(off[part]);
  }
  for (auto& values : sorted) std::sort(values.begin(), values.end());
  for (std::size_t level = 0; level < kLevels.size(); ++level) {
    for (int part = 0; part < kParts; ++part) {
      row.spread[level][part] = spread_quantiles(sorted[part], kLevels[level]);
    }
  }
  return row;
}

using Factors = std::array<double, kParts>;
using Coverage = std::array<double, kParts>;

template <typename Choose>
Factors factors_of(const std::vector<Row>& rows, std::size_t level,
                   const Choose& chosen) {
  Factors out{};
  for (int part = 0; part < kParts; ++part) {
    std::map<std::string, std::vector<double>> of_shape;
    for (const Row& row : rows) {
      if (!chosen(row.shape)) continue;
      of_shape[row.shape].push_back(
          factor_needed(row.spread[level][part], row.floor[part], row.off[part]));
    }
    std::vector<std::vector<double>> needed;
    needed.reserve(of_shape.size());
    for (auto& [shape, factors] : of_shape) needed.push_back(std::move(factors));
    out[part] = conformal_factor_of_groups(needed, kLevels[level]);
  }
  return out;
}

template <typename Choose>
Coverage coverage_of(const std::vector<Row>& rows, std::size_t level,
                     const Factors& factors, bool with_floor, const Choose& chosen,
                     std::array<double, kParts>* widths = nullptr) {
  Coverage out{};
  int count = 0;
  if (widths) widths->fill(0.0);
  for (const Row& row : rows) {
    if (!chosen(row.shape)) continue;
    ++count;
    for (int part = 0; part < kParts; ++part) {
      const SpreadInterval stated = stated_interval(
          row.spread[level][part], with_floor ? row.floor[part] : 0.0, factors[part]);
      out[part] += stated.low <= row.off[part] && row.off[part] <= stated.high;
      if (widths) (*widths)[part] += stated.high - stated.low;
    }
  }
  for (int part = 0; part < kParts; ++part) {
    out[part] /= std::max(1, count);
    if (widths) (*widths)[part] /= std::max(1, count);
  }
  return out;
}

bool any(const std::string&) { return true; }

void print_bare(const std::vector<Row>& rows, std::size_t level) {
  for (const bool with_floor : {false, true}) {
    const Coverage bare = coverage_of(rows, level, {1.0, 1.0, 1.0}, with_floor, any);
    std::printf("%-42s %3.0f %%   %.3f %.3f %.3f\n",
                with_floor ? "box and floor" : "bare box", 100.0 * kLevels[level],
                bare[0], bare[1], bare[2]);
  }
}

/// One way round: factors of the shapes in `learnt`, coverage on the others.
void print_split(const std::vector<Row>& rows, std::size_t level,
                 const std::vector<std::string>& learnt) {
  const auto is_learnt = [&](const std::string& shape) {
    return std::find(learnt.begin(), learnt.end(), shape) != learnt.end();
  };
  const auto is_new = [&](const std::string& shape) { return !is_learnt(shape); };
  const Factors factors = factors_of(rows, level, is_learnt);
  std::array<double, kParts> widths{};
  const Coverage covered = coverage_of(rows, level, factors, true, is_new, &widths);
  std::string names = "learnt on";
  for (const std::string& shape : learnt) names += ' ' + shape;
  std::printf("%-42s %3.0f %%   %.3f %.3f %.3f   %.2f %.2f %.2f   %.1f %.1f %.1f\n",
              names.c_str(), 100.0 * kLevels[level], covered[0], covered[1], covered[2],
              factors[0], factors[1], factors[2], 1e3 * widths[0], 1e3 * widths[1],
              kDegPerRad * widths[2]);
}

/// Every way of learning on half of the shapes.
void print_all_splits(const std::vector<Row>& rows, std::size_t level,
                      const std::vector<std::string>& shapes) {
  const unsigned count = static_cast<unsigned>(shapes.size());
  Coverage least{1.0, 1.0, 1.0};
  Coverage most{};
  int splits = 0;
  for (unsigned mask = 0; mask < (1U << count); ++mask) {
    if (static_cast<unsigned>(__builtin_popcount(mask)) != count / 2) continue;
    const auto is_learnt = [&](const std::string& shape) {
      const auto at = std::find(shapes.begin(), shapes.end(), shape) - shapes.begin();
      return ((mask >> at) & 1U) != 0;
    };
    const Factors factors = factors_of(rows, level, is_learnt);
    const Coverage covered =
        coverage_of(rows, level, factors, true,
                    [&](const std::string& shape) { return !is_learnt(shape); });
    for (int part = 0; part < kParts; ++part) {
      least[part] = std::min(least[part], covered[part]);
      most[part] = std::max(most[part], covered[part]);
    }
    ++splits;
  }
  std::printf("%-42s %3.0f %%   %.3f..%.3f %.3f..%.3f %.3f..%.3f\n",
              ("all " + std::to_string(splits) + " halves of the shapes").c_str(),
              100.0 * kLevels[level], least[0], most[0], least[1], most[1], least[2],
              most[2]);
}

void print_per_shape(const std::vector<Row>& rows,
                     const std::vector<std::string>& shapes) {
  std::printf("90 %% intervals, factors learnt on all other shapes:\n");
  for (const std::string& shape : shapes) {
    const Factors factors =
        factors_of(rows, 1, [&](const std::string& other) { return other != shape; });
    const Coverage covered = coverage_of(
        rows, 1, factors, true, [&](const std::string& other) { return other == shape; });
    std::printf("%-42s         %.3f %.3f %.3f\n", shape.c_str(), covered[0], covered[1],
                covered[2]);
  }
}

void run_tips(const TruthOptions& options, const McubePushes& mcube, bool registered,
              std::FILE* csv) {
  const TipPushes& data = mcube.data;
  std::vector<Vec2> offsets(data.pushes.size(), Vec2::Zero());
  if (registered) offsets = offsets_of_other_half(data);
  const double place = registered ? kRegisteredPlace : kRawPlace;
  const char* tips = registered ? "registered" : "raw";
  std::vector<Row> rows;
  std::vector<std::string> shapes;
  for (std::size_t i = 0; i < data.pushes.size(); ++i) {
    rows.push_back(row_of(data, data.pushes[i], offsets[i], place, static_cast<int>(i),
                          options.samples));
    const std::string& shape = rows.back().shape;
    if (std::find(shapes.begin(), shapes.end(), shape) == shapes.end()) {
      shapes.push_back(shape);
    }
    if (!csv) continue;
    std::fprintf(csv, "mcube_push intervals,%s,%zu,ellipsoid %s,%.6f,%.6f\n",
                 data.pushes[i].recording.c_str(), i, tips,
                 1e3 * std::hypot(rows.back().off[0], rows.back().off[1]),
                 kDegPerRad * std::abs(rows.back().off[2]));
  }
  std::sort(shapes.begin(), shapes.end());
  std::printf(
      "\nmcube_push, %s tips: share of %zu measured ends inside stated intervals\n"
      "(normal, tangential, angle; mean widths in mm, mm, deg)\n"
      "%-40s  level   covered             factors          widths\n",
      tips, rows.size(), "");
  for (std::size_t level = 0; level < kLevels.size(); ++level) {
    print_bare(rows, level);
    print_split(rows, level, {"rect1", "ellip1", "hex"});
    print_split(rows, level, {"rect3", "ellip3", "tri2"});
    print_all_splits(rows, level, shapes);
    const Factors all = factors_of(rows, level, any);
    std::printf("%-42s %3.0f %%                       %.2f %.2f %.2f\n",
                "factors of all shapes", 100.0 * kLevels[level], all[0], all[1], all[2]);
  }
  print_per_shape(rows, shapes);
  std::printf(
      "box: friction %.2f +-%.0f %%, torque radius +-%.0f %%, tip +-%.1f mm, pressure "
      "centre +-%.0f mm, angle +-0.3 deg, %d samples;\n"
      "floor: %.0f %% of the motion and the data's own scatter, 0.3 mm and 0.3 deg\n",
      kMcubeFrictionRegistered, 100.0 * kFrictionShare, 100.0 * kTorqueShare, 1e3 * place,
      1e3 * kPressureCentre, options.samples, 100.0 * kFloorShare);
}

}  // namespace

void run_mcube_intervals(const TruthOptions& options, std::FILE* csv) {
  const McubePushes mcube = select_mcube(options);
  for (const bool registered : {false, true}) run_tips(options, mcube, registered, csv);
}

}  // namespace prehensile::benchmarks
