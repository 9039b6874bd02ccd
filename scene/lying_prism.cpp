#include "scene/lying_prism.h"

#include <algorithm>

#include "scene/constants.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kSame = 1e-9;  // of the size of the section

double size_of(const std::vector<Vec2>& section) {
  double size = 0.0;
  for (const Vec2& v : section) size = std::max(size, v.norm());
  return size;
}

}  // namespace

const PrismShape* lying_prism(const Shape& shape) {
  const auto* prism = std::get_if<PrismShape>(&shape);
  return prism && prism->axis != Axis::kZ ? prism : nullptr;
}

SectionExtent extent_of(const std::vector<Vec2>& section) {
  SectionExtent extent{kInfinity,  -kInfinity, kInfinity,
                       -kInfinity, kInfinity,  -kInfinity};
  for (const Vec2& v : section) {
    extent.low = std::min(extent.low, v.x());
    extent.high = std::max(extent.high, v.x());
    extent.bottom = std::min(extent.bottom, v.y());
    extent.top = std::max(extent.top, v.y());
  }
  const double tolerance = kSame * size_of(section);
  const auto flat_at = [&](double z) {
    Vec2 flat(kInfinity, -kInfinity);
    for (const Vec2& v : section) {
      if (std::abs(v.y() - z) > tolerance) continue;
      flat = {std::min(flat.x(), v.x()), std::max(flat.y(), v.x())};
    }
    return flat;
  };
  const Vec2 below = flat_at(extent.bottom);
  const Vec2 above = flat_at(extent.top);
  extent.face_low = std::max(below.x(), above.x());
  extent.face_high = std::min(below.y(), above.y());
  return extent;
}

std::vector<Vec2> lying_rectangle(const PrismShape& prism, double low, double high) {
  const double half = 0.5 * prism.thickness;
  if (prism.axis == Axis::kX)
    return {{-half, low}, {half, low}, {half, high}, {-half, high}};
  return {{low, -half}, {high, -half}, {high, half}, {low, half}};
}

Vec2 side_heights(const std::vector<Vec2>& section, bool towards_plus) {
  const SectionExtent extent = extent_of(section);
  const double side = towards_plus ? extent.high : extent.low;
  const double tolerance = kSame * size_of(section);
  Vec2 heights(extent.top, extent.bottom);
  for (const Vec2& v : section) {
    if (std::abs(v.x() - side) > tolerance) continue;
    heights = {std::min(heights.x(), v.y()), std::max(heights.y(), v.y())};
  }
  return heights;
}

std::string section_fault(const PrismShape& prism) {
  if (prism.axis == Axis::kZ) return {};
  if (!is_convex(prism.outline)) {
    return "not convex: expected the convex section of a prism that lies in the pad "
           "plane";
  }
  const SectionExtent extent = extent_of(prism.outline);
  const double tolerance = kSame * size_of(prism.outline);
  if (std::abs(extent.bottom + extent.top) > tolerance) {
    return "off the mid-plane: expected a section that reaches as far to -z as to +z";
  }
  if (extent.face_high - extent.face_low <= tolerance) {
    return "no two flat sides face the jaws: expected flat sides opposite to each other "
           "at the lowest and the highest z";
  }
  return {};
}

bool is_same_section(const std::vector<Vec2>& section, double roll) noexcept {
  const double tolerance = kSame * size_of(section);
  return std::all_of(section.begin(), section.end(), [&](const Vec2& v) {
    const Vec2 turned = rotated(roll, v);
    return std::any_of(section.begin(), section.end(),
                       [&](const Vec2& w) { return (turned - w).norm() <= tolerance; });
  });
}

double symmetry_angle(const std::vector<Vec2>& section) noexcept {
  for (std::size_t times = section.size(); times > 1; --times) {
    const double turn = 2.0 * kPi / static_cast<double>(times);
    if (is_same_section(section, turn)) return turn;
  }
  return 2.0 * kPi;
}

}  // namespace prehensile
