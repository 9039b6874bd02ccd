#include "planner/pad_section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/ring_pads.h"

namespace prehensile {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kAngles = 24;  // over a quarter turn
constexpr int kDense = 128;  // kappas of either sign, evenly up to kDenseKappa
constexpr int kSparse = 64;  // and with a constant ratio up to kMostKappa
constexpr double kDenseKappa = 3.2;
constexpr int kDirections = 24;  // of the force of a pad point at the centre of rotation
constexpr double kMostKappa = 1e4;

/// Of pads of points.
constexpr double kSlowRatio = 0.6;
constexpr double kFastRatio = 1.6;

constexpr int kRingCells = 256;  // of round pads, for either sign of kappa

/// By which the boxes are widened, as shares of their width and of the value.
constexpr double kBetweenSamples = 0.05;
constexpr double kRelative = 2e-3;
constexpr double kDeviation = 2e-3;

constexpr double kRounding = 1e-9;  // of the friction of rings

struct Friction {
  double along, across, moment;
};

/// Sums the pads' friction; the point `pivot`, at the centre of rotation, has the force
/// `pivot_force` of its bound.
Friction friction_of(const ContactPoints& points, double c, double kappa, const Vec2& e,
                     int pivot = -1, const Vec2& pivot_force = Vec2::Zero()) {
  const double omega = kappa / c;
  Vec2 force = Vec2::Zero();
  double moment = 0.0;
  for (int j = 0; j < points.count; ++j) {
    const Vec2 r(points.x[j], points.y[j]);
    const Vec2 slip = e + omega * perp(r);
    const double speed = slip.norm();
    if (j != pivot && speed == 0.0) continue;
    const Vec2 f = points.weight[j] * (j == pivot ? pivot_force : Vec2(slip / speed));
    force += f;
    moment += cross(r, f);
  }
  return {force.dot(e), std::abs(cross(e, force)), moment / c};
}

/// Every point has a partner with its weight a quarter turn further.
bool alike_at_quarter_turns(const ContactPoints& points, double size) {
  for (int i = 0; i < points.count; ++i) {
    bool found = false;
    for (int j = 0; j < points.count && !found; ++j) {
      const double off = std::hypot(points.x[j] + points.y[i], points.y[j] - points.x[i]);
      found = off < 1e-9 * size && std::abs(points.weight[i] - points.weight[j]) < 1e-9;
    }
    if (!found) return false;
  }
  return true;
}

/// Dense where centres of rotation lie in the pads, sparse elsewhere.
double kappa_at(int i) {
  if (i <= kDense) return kDenseKappa * i / kDense;
  return kDenseKappa *
         std::pow(kMostKappa / kDenseKappa, static_cast<double>(i - kDense) / kSparse);
}

/// All motions of one kappa.
struct Row {
  double kappa;
  SectionCell box;
};

SectionCell empty_cell(double kappa) {
  const double sigma = std::hypot(1.0, kappa);
  const double sine = kappa / sigma;
  return {sigma, sigma, kInfinity, 0.0, 0.0, sine, sine, kInfinity, -kInfinity};
}

void keep(const Friction& friction, Row& row) {
  SectionCell& box = row.box;
  const double drag = friction.along * box.sigma_low;
  const double turning = friction.moment / friction.along / box.sigma_low;
  box.drag_low = std::min(box.drag_low, drag);
  box.drag_high = std::max(box.drag_high, drag);
  box.deviation = std::max(box.deviation, friction.across / friction.along);
  box.turning_low = std::min(box.turning_low, turning);
  box.turning_high = std::max(box.turning_high, turning);
}

SectionCell joined(const SectionCell& a, const SectionCell& b) {
  return {std::min(a.sigma_low, b.sigma_low),      std::max(a.sigma_high, b.sigma_high),
          std::min(a.drag_low, b.drag_low),        std::max(a.drag_high, b.drag_high),
          std::max(a.deviation, b.deviation),      std::min(a.sine_low, b.sine_low),
          std::max(a.sine_high, b.sine_high),      std::min(a.turning_low, b.turning_low),
          std::max(a.turning_high, b.turning_high)};
}

SectionCell widened(SectionCell cell) {
  const double drag =
      kBetweenSamples * (cell.drag_high - cell.drag_low) + kRelative * cell.drag_high;
  const double turning =
      kBetweenSamples * (cell.turning_high - cell.turning_low) + kRelative;
  cell.drag_low -= std::min(drag, 0.5 * cell.drag_low);
  cell.drag_high += drag;
  cell.deviation *= 1.0 + kBetweenSamples;
  if (cell.sigma_high > 1.05) cell.deviation += kDeviation;
  cell.turning_low -= turning;
  cell.turning_high += turning;
  return cell;
}

void add_pivots(const ContactPoints& points, double c, std::vector<Row>& rows) {
  for (int j = 0; j < points.count; ++j) {
    const Vec2 r(points.x[j], points.y[j]);
    const bool in_quarter = r.x() > -1e-9 * c && r.y() > -1e-9 * c;
    if (r.norm() < 1e-9 * c || !in_quarter) continue;
    for (const double sign : {1.0, -1.0}) {
      const double kappa = sign * c / r.norm();
      Row row{kappa, empty_cell(kappa)};
      const Vec2 e = -sign * perp(r).normalized();
      for (int k = 0; k < kDirections; ++k) {
        const Vec2 force = rotated(2.0 * kPi * k / kDirections, e);
        keep(friction_of(points, c, kappa, e, j, force), row);
      }
      rows.push_back(row);
    }
  }
}

std::vector<Row> rows_of(const ContactPoints& points, double c) {
  std::vector<Row> rows;
  rows.reserve(2 * static_cast<std::size_t>(kDense + kSparse + points.count) + 1);
  for (int i = -kDense - kSparse; i <= kDense + kSparse; ++i) {
    const double kappa = i < 0 ? -kappa_at(-i) : kappa_at(i);
    Row row{kappa, empty_cell(kappa)};
    for (int k = 0; k < kAngles; ++k) {
      const Vec2 e = rotated(0.5 * kPi * k / kAngles, Vec2(1.0, 0.0));
      keep(friction_of(points, c, kappa, e), row);
    }
    rows.push_back(row);
  }
  add_pivots(points, c, rows);
  std::sort(rows.begin(), rows.end(),
            [](const Row& a, const Row& b) { return a.kappa < b.kappa; });
  return rows;
}

/// Ends of a cell of round pads, or more: what is monotone between them.
struct RingEnd {
  double angle;  // [rad] atan(kappa)
  RingFriction friction;
  double drag_over_sine;  // monotone where the centre of rotation is inside all circles
};

SectionCell ring_cell(const RingEnd& slow, const RingEnd& fast, double c,
                      double least_radius) {
  SectionCell cell;
  const double cosine = std::max(0.0, std::cos(fast.angle));
  cell.sigma_low = 1.0 / std::cos(slow.angle);
  cell.sigma_high = cosine > 1e-12 ? 1.0 / cosine : kInfinity;
  const bool inside = c <= least_radius * std::tan(slow.angle);
  if (inside) {
    cell.drag_low = fast.drag_over_sine / std::sin(fast.angle);
    cell.drag_high = slow.drag_over_sine / std::sin(slow.angle);
  } else {
    cell.drag_low = fast.friction.along * cell.sigma_low;
    cell.drag_high = slow.friction.along * cell.sigma_high;
  }
  cell.sine_low = std::sin(slow.angle);
  cell.sine_high = std::sin(fast.angle);
  cell.turning_low = slow.friction.moment / (c * cell.drag_high) - kRounding;
  cell.turning_high = fast.friction.moment / (c * cell.drag_low) + kRounding;
  cell.drag_low *= 1.0 - kRounding;
  cell.drag_high *= 1.0 + kRounding;
  return cell;
}

SectionCell mirrored(SectionCell cell) {
  const SectionCell other = cell;
  cell.sine_low = -other.sine_high;
  cell.sine_high = -other.sine_low;
  cell.turning_low = -other.turning_high;
  cell.turning_high = -other.turning_low;
  return cell;
}

PadSection ring_section(const ContactPoints& points, double c) {
  PadSection section;
  double least_radius = kInfinity;
  for (int j = 0; j < points.count; ++j) {
    least_radius = std::min(least_radius, std::hypot(points.x[j], points.y[j]));
  }
  std::vector<RingEnd> ends;
  ends.reserve(kRingCells + 1);
  for (int i = 0; i <= kRingCells; ++i) {
    const double angle = 0.5 * kPi * i / kRingCells;
    const RingFriction friction = ring_friction(points, c, angle);
    ends.push_back({angle, friction, friction.drag * std::sin(angle)});
  }
  const auto ratio = [&](const RingEnd& end) {
    return end.friction.moment / (c * end.friction.drag * std::sin(end.angle));
  };
  section.slow_ratio = ratio(ends[1]);
  section.fast_ratio = ratio(ends.back());
  section.cells.reserve(2 * kRingCells);
  for (int i = 0; i < kRingCells; ++i) {
    const SectionCell cell = ring_cell(ends[i], ends[i + 1], c, least_radius);
    section.cells.push_back(cell);
    section.cells.push_back(mirrored(cell));
  }
  return section;
}

}  // namespace

PadSection pad_section(const Model& model) {
  const ContactPoints& points = model.region.whole();
  if (has_ring_pads(model)) return ring_section(points, model.c);
  PadSection section;
  const bool usable = model.region.is_fixed_in_hand() && model.F > 0.0 && model.c > 0.0;
  if (!usable || !alike_at_quarter_turns(points, model.c)) return section;
  section.slow_ratio = kSlowRatio;
  section.fast_ratio = kFastRatio;
  const std::vector<Row> rows = rows_of(points, model.c);
  section.cells.reserve(rows.size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    SectionCell cell = joined(rows[i - 1].box, rows[i].box);
    const SectionCell own = cell;
    if (i >= 2) cell = joined(cell, rows[i - 2].box);  // near a pivot a neighbour is one
    if (i + 1 < rows.size()) cell = joined(cell, rows[i + 1].box);
    cell.sigma_low = own.sigma_low;
    cell.sigma_high = own.sigma_high;
    cell.sine_low = own.sine_low;
    cell.sine_high = own.sine_high;
    section.cells.push_back(widened(cell));
  }
  return section;
}

PadSection section_of_whole_discs(const Model& model) {
  return ring_section(model.region.whole(), model.c);
}

}  // namespace prehensile
