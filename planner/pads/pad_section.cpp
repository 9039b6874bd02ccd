#include "planner/pads/pad_section.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner/pads/point_section.h"
#include "planner/pads/ring_pads.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kRounding = 1e-9;  // of the friction of rings

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

FrictionBox box_of(const SectionCell& cell) {
  FrictionBox box;
  box.cosine_low = 1.0 / cell.sigma_high;
  box.cosine_high = 1.0 / cell.sigma_low;
  box.sine_low = cell.sine_low;
  box.sine_high = cell.sine_high;
  box.along_low = cell.drag_low * box.cosine_low;
  box.along_high = cell.drag_high * box.cosine_high;
  box.across = cell.deviation * box.along_high;
  const auto moment = std::minmax(
      {cell.turning_low * cell.drag_low, cell.turning_low * cell.drag_high,
       cell.turning_high * cell.drag_low, cell.turning_high * cell.drag_high});
  box.moment_low = moment.first;
  box.moment_high = moment.second;
  return box;
}

PadSection ring_section(const ContactPoints& points, double c, int cells) {
  PadSection section;
  double least_radius = kInfinity;
  for (int j = 0; j < points.count; ++j) {
    least_radius = std::min(least_radius, std::hypot(points.x[j], points.y[j]));
  }
  std::vector<RingEnd> ends;
  ends.reserve(cells + 1);
  for (int i = 0; i <= cells; ++i) {
    const double angle = 0.5 * kPi * i / cells;
    const RingFriction friction = ring_friction(points, c, angle);
    ends.push_back({angle, friction, friction.drag * std::sin(angle)});
  }
  const auto ratio = [&](const RingEnd& end) {
    return end.friction.moment / (c * end.friction.drag * std::sin(end.angle));
  };
  section.slow_ratio = ratio(ends[1]);
  section.fast_ratio = ratio(ends.back());
  section.cells.reserve(2 * cells);
  for (int i = 0; i < cells; ++i) {
    const SectionCell cell = ring_cell(ends[i], ends[i + 1], c, least_radius);
    section.cells.push_back(cell);
    section.cells.push_back(mirrored(cell));
  }
  std::ranges::transform(section.cells, std::back_inserter(section.boxes), box_of);
  return section;
}

}  // namespace

FrictionBox joined(const FrictionBox& a, const FrictionBox& b) {
  return {std::min(a.along_low, b.along_low),     std::max(a.along_high, b.along_high),
          std::max(a.across, b.across),           std::min(a.moment_low, b.moment_low),
          std::max(a.moment_high, b.moment_high), std::min(a.cosine_low, b.cosine_low),
          std::max(a.cosine_high, b.cosine_high), std::min(a.sine_low, b.sine_low),
          std::max(a.sine_high, b.sine_high)};
}

PadSection pad_section(const Model& model, int ring_cells) {
  const ContactPoints& points = model.region.whole();
  if (has_ring_pads(model)) return ring_section(points, model.c, ring_cells);
  const bool usable = model.region.is_fixed_in_hand() && model.F > 0.0 && model.c > 0.0;
  return usable ? section_of_points(points, model.c) : PadSection{};
}

PadSection section_of_whole_discs(const Model& model, int ring_cells) {
  return ring_section(model.region.whole(), model.c, ring_cells);
}

}  // namespace prehensile
