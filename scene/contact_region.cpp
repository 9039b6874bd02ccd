#include "scene/contact_region.h"

#include <algorithm>

#include "scene/near_outline.h"
#include "scene/outline.h"
#include "scene/pad_quadrature.h"

namespace prehensile {
namespace {

/// Cells along a side of the pad where it may be clipped.
constexpr int kCellsPerSide = 8;

double mean_distance_to_axis(const ContactPoints& points) {
  double sum = 0.0;
  for (int j = 0; j < points.count; ++j) {
    sum += points.weight[j] * std::hypot(points.x[j], points.y[j]);
  }
  return sum;
}

/// Part [low, high] of the line p + s d (d a unit vector) under the pad; empty if low >=
/// high.
struct Chord {
  double low, high;
};

Chord chord_of_disc(double radius, const Vec2& p, const Vec2& d) {
  const double s = -p.dot(d);
  const double half_squared = radius * radius - (p + s * d).squaredNorm();
  if (half_squared <= 0.0) return {0.0, 0.0};
  const double half = std::sqrt(half_squared);
  return {s - half, s + half};
}

Chord chord_of_rectangle(const Vec2& size, const Vec2& p, const Vec2& d) {
  Chord chord{-1e9, 1e9};
  for (int i = 0; i < 2; ++i) {
    const double half = 0.5 * size[i];
    if (d[i] == 0.0) {
      if (std::abs(p[i]) > half) return {0.0, 0.0};
      continue;
    }
    const double one = (-half - p[i]) / d[i];
    const double two = (half - p[i]) / d[i];
    chord.low = std::max(chord.low, std::min(one, two));
    chord.high = std::min(chord.high, std::max(one, two));
  }
  return chord;
}

}  // namespace

ContactRegion::ContactRegion(const Scene& scene, int points)
    : pad_(in_plane_equivalent(scene.gripper.pad)),
      density_(std::make_shared<const PadDensity>(pad_, scene.gripper.pressure)),
      whole_(pad_points(pad_, scene.gripper.pressure, points)),
      outline_(pad_face_of(scene.object.shape)),
      points_(points) {
  const bool is_point = std::holds_alternative<PointPad>(scene.gripper.pad);
  round_side_ = can_roll(scene.object);
  clips_ = scene.overhang == Overhang::kClip;
  fixed_in_hand_ = !round_side_ && (!clips_ || is_point);
  isotropic_ = !round_side_ && std::holds_alternative<DiscPad>(pad_);
  pad_reach_ = pad_reach(scene.gripper.pad);
  if (round_side_) {
    const auto& cylinder = std::get<CylinderShape>(scene.object.shape);
    const Vec2 half = cylinder.axis == Axis::kX ? Vec2(0.5 * cylinder.length, 0.0)
                                                : Vec2(0.0, 0.5 * cylinder.length);
    generator_a_ = -half;
    generator_b_ = half;
    torque_radius_ =
        mean_distance_to_axis(along_generator({0.0, 0.0, scene.start.X_HO.theta}));
    return;
  }
  torque_radius_ = mean_distance_to_axis(whole_);
  const auto* point = std::get_if<PointPad>(&scene.gripper.pad);
  if (point && point->spin_radius) torque_radius_ = *point->spin_radius;
  if (clips_ && !is_point) {
    convex_ = is_convex(outline_);
    pieces_ = triangulate(outline_);
    cells_ = pad_cells(pad_, scene.gripper.pressure, kCellsPerSide);
  }
}

ContactRegion::ContactRegion(const ContactRegion&) = default;
ContactRegion::ContactRegion(ContactRegion&&) noexcept = default;
ContactRegion& ContactRegion::operator=(const ContactRegion&) = default;
ContactRegion& ContactRegion::operator=(ContactRegion&&) noexcept = default;
ContactRegion::~ContactRegion() = default;

ContactPoints ContactRegion::at(const PlanarPose& X_HO) const noexcept {
  if (round_side_) return along_generator(X_HO);
  if (!clips_ || is_whole(X_HO)) return whole_;
  return clipped_by_face(X_HO);
}

bool ContactRegion::is_whole(const PlanarPose& X_HO) const noexcept {
  return whole_margin(X_HO) >= 0.0;
}

double ContactRegion::whole_margin(const PlanarPose& X_HO) const noexcept {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (fixed_in_hand_) return kNever;
  const Vec2 p_OF = finger_in_object(X_HO);
  if (!round_side_) return depth_inside(outline_, p_OF) - pad_reach_;
  if (!clips_) return kNever;
  const Vec2 axis = (generator_b_ - generator_a_).normalized();
  const double room =
      0.5 * (generator_b_ - generator_a_).norm() - std::abs(p_OF.dot(axis));
  return room - pad_reach_;
}

ContactPoints ContactRegion::clipped_by_face(const PlanarPose& X_HO) const noexcept {
  ContactPoints points;
  const PlanarPose X_OH = inverse(X_HO);
  if (cells_.empty()) {  // a point pad: on the face or not
    if (depth_inside(outline_, translation(X_OH)) >= 0.0) return whole_;
    return points;
  }
  const CellFrame frame(X_OH);
  double within = 0.0;
  for (const PadCell& cell : cells_) within = std::max(within, cell.within);
  const NearOutline near(outline_, convex_, translation(X_OH), within);
  double total = 0.0;
  double pressed = 0.0;
  for (const PadCell& cell : cells_) {
    total += cell.measure * cell.pressure;
    const Vec2 middle = frame.in_object(cell.centroid);
    PressedCell part;
    const NearOutline::Close close = near.close_to(middle, cell.reach, cell.within);
    if (close.count == 1) {
      part = press_at_edge(cell, {close.one->a, close.one->b}, frame);
    } else if (close.count == 2 && near.sides() == NearOutline::Sides::kLeftOfAll) {
      part = press_at_corner(cell, {close.one->a, close.one->b},
                             {close.two->a, close.two->b}, frame);
    } else if (close.count > 0) {
      part = press(cell, pieces_, frame);
    } else if (close.inside) {
      part = {cell.measure, cell.centroid};
    }
    if (part.measure <= 0.0) continue;
    points.x[points.count] = part.centroid.x();
    points.y[points.count] = part.centroid.y();
    points.weight[points.count] = part.measure * cell.pressure;
    ++points.count;
    pressed += part.measure * cell.pressure;
  }
  for (int j = 0; j < points.count; ++j) points.weight[j] /= pressed;
  points.coverage = pressed / total;
  return points;
}

ContactPoints ContactRegion::along_generator(const PlanarPose& X_HO) const noexcept {
  ContactPoints points;
  const Vec2 a = transform(X_HO, generator_a_);
  const Vec2 along = transform(X_HO, generator_b_) - a;
  const double length = along.norm();
  const Vec2 d = along / length;
  const auto* disc = std::get_if<DiscPad>(&pad_);
  const auto* rectangle = std::get_if<RectanglePad>(&pad_);
  Chord chord{0.0, 0.0};
  if (disc) chord = chord_of_disc(disc->radius, a, d);
  if (rectangle) chord = chord_of_rectangle(rectangle->size, a, d);
  const double full = chord.high - chord.low;
  if (clips_) {
    chord.low = std::max(chord.low, 0.0);
    chord.high = std::min(chord.high, length);
  }
  if (!(chord.high > chord.low)) return points;
  points.count = points_;
  points.coverage = (chord.high - chord.low) / full;
  double sum = 0.0;
  for (int j = 0; j < points_; ++j) {
    const double s = chord.low + (chord.high - chord.low) * (j + 0.5) / points_;
    points.x[j] = a.x() + s * d.x();
    points.y[j] = a.y() + s * d.y();
    points.weight[j] = (*density_)({points.x[j], points.y[j]});
    sum += points.weight[j];
  }
  for (int j = 0; j < points_; ++j) points.weight[j] /= sum;
  return points;
}

}  // namespace prehensile
