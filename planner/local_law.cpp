#include "planner/local_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/pad_section.h"

namespace prehensile {
namespace {

constexpr int kEllipsoidBoxes = 256;

/// Over F, F c and |v|: by so much an inequality may fail and still count as met.
constexpr double kRounding = 1e-8;

/// Of the friction beyond the last box of a section, in shares of that of the last.
constexpr double kBeyond = 0.01;

std::vector<FrictionBox> ellipsoid_boxes() {
  std::vector<FrictionBox> boxes;
  for (int i = 0; i < kEllipsoidBoxes; ++i) {
    const auto angle = [](int k) {
      return std::numbers::pi * (static_cast<double>(k) / kEllipsoidBoxes - 0.5);
    };
    const auto [cosine_low, cosine_high] =
        std::minmax({std::cos(angle(i)), std::cos(angle(i + 1))});
    const double sine_low = std::sin(angle(i));
    const double sine_high = std::sin(angle(i + 1));
    boxes.push_back({cosine_low, cosine_high, 0.0, sine_low, sine_high, cosine_low,
                     cosine_high, sine_low, sine_high});
  }
  return boxes;
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

/// Turning on the spot, faster than in the box.
FrictionBox beyond(const FrictionBox& last) {
  FrictionBox box = last;
  box.cosine_low = box.along_low = 0.0;
  box.across = std::max(box.across, box.along_high);
  box.moment_low -= kBeyond * std::abs(last.moment_low);
  box.moment_high += kBeyond * std::abs(last.moment_high);
  (last.sine_low < 0.0 ? box.sine_low : box.sine_high) = last.sine_low < 0.0 ? -1.0 : 1.0;
  return box;
}

std::vector<FrictionBox> boxes_of(const Model& model) {
  for (const PushContact& contact : model.contacts) {
    if (model.needs_space(contact)) return {};
  }
  if (!(model.F > 0.0 && model.c > 0.0)) return {};
  if (model.has_soft_points()) return ellipsoid_boxes();
  const PadSection section = pad_section(model);
  std::vector<FrictionBox> boxes;
  for (const SectionCell& cell : section.cells) boxes.push_back(box_of(cell));
  for (const double sign : {1.0, -1.0}) {
    const SectionCell* last = nullptr;
    for (const SectionCell& cell : section.cells) {
      if (sign * (cell.sine_low + cell.sine_high) < 0.0) continue;
      if (!last || cell.sigma_high > last->sigma_high) last = &cell;
    }
    if (last && std::isfinite(last->sigma_high)) boxes.push_back(beyond(box_of(*last)));
  }
  return boxes;
}

/// The greatest of factor x value over an interval.
double most(double factor, double low, double high) {
  return factor > 0.0 ? factor * high : factor * low;
}

/// along x friction along the motion + moment x moment of the pads + reach x friction
/// across + constant >= 0, the factors being the greatest over places and directions.
struct Row {
  double along = 0.0, moment = 0.0, reach = 0.0, constant = 0.0;

  bool may_hold(const FrictionBox& box) const {
    return most(along, box.along_low, box.along_high) +
               most(moment, box.moment_low, box.moment_high) + reach * box.across +
               constant >=
           -kRounding;
  }
};

/// Rate at which the pusher advances at an end of the face: normal part of the motion
/// and of the turning, at one of the places.
struct Advance {
  double along = 0.0;
  double turning_low = 0.0, turning_high = 0.0;

  bool may_hold(const FrictionBox& box) const {
    const double turning = std::max(most(turning_low, box.sine_low, box.sine_high),
                                    most(turning_high, box.sine_low, box.sine_high));
    return most(along, box.cosine_low, box.cosine_high) + turning >= -kRounding;
  }
};

Row edge_of_cone(const PushContact& contact, const Vec2& gamma, double side,
                 const DirectionSpan& directions) {
  const Vec2 w = contact.mu * contact.n + side * contact.t;
  return {w.norm() * directions.half_angle - w.dot(directions.middle), 0.0, w.norm(),
          -w.dot(gamma)};
}

/// Moment about an end of the face over F c: side +1 about b, -1 about a.
Row end_of_face(const Model& model, const Vec2& end, const Vec2& gamma, double side,
                const PlaceSpan& places, const DirectionSpan& directions) {
  Row row{-INFINITY, side, 0.0, -side * cross(model.p_OCom - end, gamma) / model.c};
  for (const Vec2& place : {places.a, places.b}) {
    const Vec2 lever = (place - end) / model.c;
    row.along = std::max(row.along, lever.norm() * directions.half_angle -
                                        side * cross(lever, directions.middle));
    row.reach = std::max(row.reach, lever.norm());
  }
  return row;
}

Advance advance_of(const PushContact& contact, const Vec2& end, double c,
                   const PlaceSpan& places, const DirectionSpan& directions) {
  const auto turning = [&](const Vec2& place) {
    return contact.n.dot(perp(end - place)) / c;
  };
  const auto [low, high] = std::minmax({turning(places.a), turning(places.b)});
  return {directions.half_angle - contact.n.dot(directions.middle), low, high};
}

}  // namespace

LocalLaw::LocalLaw(const Model& model) : model_(model), boxes_(boxes_of(model)) {}

bool LocalLaw::may_move(int contact, const PlaceSpan& places,
                        const DirectionSpan& directions) const noexcept {
  const PushContact& pushed = model_.contacts[contact];
  const Vec2 gamma = model_.mass / model_.F * pushed.g_O;
  const std::array rows = {
      edge_of_cone(pushed, gamma, 1.0, directions),
      edge_of_cone(pushed, gamma, -1.0, directions),
      end_of_face(model_, pushed.b, gamma, 1.0, places, directions),
      end_of_face(model_, pushed.a, gamma, -1.0, places, directions)};
  const std::array advances = {
      advance_of(pushed, pushed.a, model_.c, places, directions),
      advance_of(pushed, pushed.b, model_.c, places, directions)};
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const FrictionBox& box) {
    return std::all_of(rows.begin(), rows.end(),
                       [&](const Row& row) { return row.may_hold(box); }) &&
           std::any_of(advances.begin(), advances.end(),
                       [&](const Advance& end) { return end.may_hold(box); });
  });
}

}  // namespace prehensile
