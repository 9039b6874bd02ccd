#include "planner/pads/local_law.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/pads/run_law.h"
#include "planner/pads/weak_contact.h"

namespace prehensile {
namespace {

/// Boxes, and cells of round pads: the more, the less the law allows beyond what sticks.
constexpr int kEllipsoidBoxes = 1024;
constexpr int kRingCellsOfLaw = 1024;

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

double middle_sine(const FrictionBox& box) { return box.sine_low + box.sine_high; }

bool has_planar_pushes(const Model& model) {
  return model.F > 0.0 && model.c > 0.0 &&
         std::ranges::none_of(model.contacts, [&](const PushContact& contact) {
           return model.needs_space(contact);
         });
}

std::vector<FrictionBox> boxes_of(PadSection section) {
  std::vector<FrictionBox>& boxes = section.boxes;
  double slowest = std::numeric_limits<double>::infinity();
  for (const FrictionBox& box : boxes) slowest = std::min(slowest, box.cosine_low);
  const std::size_t known = boxes.size();
  for (std::size_t i = 0; i < known; ++i) {
    if (slowest > 0.0 && boxes[i].cosine_low == slowest) {
      boxes.push_back(beyond(boxes[i]));
    }
  }
  std::ranges::stable_sort(boxes, {}, &middle_sine);
  return boxes;
}

std::vector<FrictionBox> boxes_of(const Model& model) {
  if (!has_planar_pushes(model)) return {};
  if (model.has_soft_points()) return ellipsoid_boxes();
  return boxes_of(pad_section(model, kRingCellsOfLaw));
}

/// Leaves in the second half, as many as a power of two: the last box repeated.
std::vector<FrictionBox> tree_over(const std::vector<FrictionBox>& boxes) {
  if (boxes.empty()) return {};
  const std::size_t leaves = std::bit_ceil(boxes.size());
  std::vector<FrictionBox> tree(2 * leaves, boxes.back());
  std::ranges::copy(boxes, tree.begin() + static_cast<std::ptrdiff_t>(leaves));
  for (std::size_t i = leaves - 1; i > 0; --i) {
    tree[i] = joined(tree[2 * i], tree[2 * i + 1]);
  }
  return tree;
}

/// The greatest of factor x value over an interval.
double most(double factor, double low, double high) {
  return factor > 0.0 ? factor * high : factor * low;
}

/// along x friction along the motion + moment x moment of the pads + reach x friction
/// across + constant >= 0, the factors being the greatest over places and directions; and
/// `along_low` the least, for pads that are not alike on both sides of their middle,
/// which may pull along the motion where they turn fast.
struct Row {
  double along = 0.0, moment = 0.0, reach = 0.0, constant = 0.0, along_low = 0.0;

  bool may_hold(const FrictionBox& box) const {
    double friction = most(along, box.along_low, box.along_high);
    if (box.along_low < 0.0) friction = std::max(friction, along_low * box.along_low);
    return friction + most(moment, box.moment_low, box.moment_high) + reach * box.across +
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

/// Edge k of the friction cone, at the worst of the tilts.
Row edge_of_cone(const LocalLaw::Demand& demand, int k, const DirectionSpan& directions) {
  const Vec2& w = demand.w[k];
  const double ahead =
      least_turned(-w.dot(directions.middle), -cross(w, directions.middle), demand.tilt);
  // By the tilt, least_turned changes a little faster than a scalar product.
  const double most = w.norm() * std::hypot(1.0, demand.tilt) * directions.half_angle;
  return {most + ahead, 0.0, w.norm(), -demand.asked[k], ahead - most};
}

/// Moment about end k of the face over F c, with the finger axis off its place across the
/// motion.
Row end_of_face(const LocalLaw::Demand& demand, int k, double c,
                std::span<const Vec2> places, const DirectionSpan& directions) {
  const double side = k == 0 ? 1.0 : -1.0;
  Row row{-INFINITY, side, 0.0, demand.help[k] / c, INFINITY};
  for (const Vec2& place : places) {
    const Vec2 lever = (place - demand.end[k]) / c;
    const double off = lever.norm() * directions.half_angle;
    const double along = -side * cross(lever, directions.middle);
    row.along = std::max(row.along, along + off);
    row.along_low = std::min(row.along_low, along - off);
    row.reach = std::max(row.reach, lever.norm());
  }
  row.along -= demand.grasp / c;
  row.along_low -= demand.grasp / c;
  return row;
}

Advance advance_of(const LocalLaw::Demand& demand, int k, double c,
                   std::span<const Vec2> places, const DirectionSpan& directions) {
  Advance advance{directions.half_angle - demand.n.dot(directions.middle), INFINITY,
                  -INFINITY};
  for (const Vec2& place : places) {
    const double turning = demand.n.dot(perp(demand.face_end[k] - place)) / c;
    advance.turning_low = std::min(advance.turning_low, turning);
    advance.turning_high = std::max(advance.turning_high, turning);
  }
  return advance;
}

/// Rows at these places and directions.
class Demands {
 public:
  Demands(const LocalLaw::Demand& demand, double c, std::span<const Vec2> places,
          const DirectionSpan& directions)
      : rows_{edge_of_cone(demand, 0, directions), edge_of_cone(demand, 1, directions),
              end_of_face(demand, 0, c, places, directions),
              end_of_face(demand, 1, c, places, directions)},
        advances_{advance_of(demand, 1, c, places, directions),
                  advance_of(demand, 0, c, places, directions)} {}

  bool may_be_met(const FrictionBox& box) const {
    return std::ranges::all_of(rows_,
                               [&](const Row& row) { return row.may_hold(box); }) &&
           std::ranges::any_of(advances_,
                               [&](const Advance& end) { return end.may_hold(box); });
  }

 private:
  std::array<Row, 4> rows_;
  std::array<Advance, 2> advances_;
};

/// Least sigma - share kappa in a box: (1 - share sin phi) / cos phi, which falls up to
/// where the sine is the share and rises from there.
double least_in(const FrictionBox& box, double share) {
  const double sine = std::clamp(share, box.sine_low, box.sine_high);
  const double squared = (1.0 - sine) * (1.0 + sine);
  return squared > 0.0 ? (1.0 - share * sine) / std::sqrt(squared) : INFINITY;
}

/// Greatest sense kappa in a box.
double most_in(const FrictionBox& box, double sense) {
  const double sine = sense > 0.0 ? box.sine_high : -box.sine_low;
  const double cosine = sine > 0.0 ? box.cosine_low : box.cosine_high;
  return cosine > 0.0 ? sine / cosine : std::copysign(INFINITY, sine);
}

/// Nodes of a tree that are still to be looked at: more than twice its depth.
template <class Entry>
class Pile {
 public:
  bool empty() const { return count_ == 0; }
  void push(const Entry& entry) { entries_[count_++] = entry; }
  Entry pop() { return entries_[--count_]; }

 private:
  std::array<Entry, 64> entries_;
  int count_ = 0;
};

bool is_leaf(const std::vector<FrictionBox>& tree, std::size_t node) {
  return 2 * node >= tree.size();
}

bool may_be_met_in(const std::vector<FrictionBox>& tree, const Demands& demands) {
  Pile<std::size_t> open;
  open.push(1);
  while (!open.empty()) {
    const std::size_t node = open.pop();
    if (!demands.may_be_met(tree[node])) continue;
    if (is_leaf(tree, node)) return true;
    open.push(2 * node);
    open.push(2 * node + 1);
  }
  return false;
}

/// The least cost of a box that the demands may be met in, from the cheaper branch on.
/// `cost(box)` is no more than that of any box within.
template <class Cost>
LeastTravel least_in_tree(const std::vector<FrictionBox>& tree, const Demands& demands,
                          const Cost& cost) {
  const auto branch_to = [&](std::size_t node) -> LeastTravel {
    return {cost(tree[node]), node};
  };
  LeastTravel least{.cost = INFINITY};
  Pile<LeastTravel> open;
  open.push(branch_to(1));
  while (!open.empty()) {
    const LeastTravel branch = open.pop();
    if (branch.cost >= least.cost || !demands.may_be_met(tree[branch.box])) continue;
    if (is_leaf(tree, branch.box)) {
      least = branch;
      continue;
    }
    const LeastTravel one = branch_to(2 * branch.box);
    const LeastTravel other = branch_to(2 * branch.box + 1);
    open.push(one.cost < other.cost ? other : one);
    open.push(one.cost < other.cost ? one : other);
  }
  return least;
}

LocalLaw::Demand demand_of(const Model& model, const PushContact& pushed,
                           const Margin& of_scene) {
  const Margin margin = margin_of_laws(model, pushed, of_scene);
  const WeakContact contact(face_contact(model, pushed), margin, Vec2::Zero());
  LocalLaw::Demand demand{.n = contact.n,
                          .w = contact.w,
                          .end = contact.end,
                          .face_end = {pushed.b, pushed.a},
                          .tilt = margin.tilt,
                          .grasp = margin.grasp};
  for (const int k : {0, 1}) {
    demand.asked[k] = contact.most_asked_of_edge(k);
    demand.help[k] = contact.least_help_at_end(k);
  }
  return demand;
}

}  // namespace

LocalLaw::LocalLaw(const Model& model, const Margin& margin)
    : LocalLaw(model, margin, boxes_of(model)) {}

LocalLaw::LocalLaw(const Model& model, const Margin& margin,
                   const std::vector<FrictionBox>& boxes)
    : c_(model.c), tree_(tree_over(boxes)) {
  if (tree_.empty()) return;
  for (const PushContact& contact : model.contacts) {
    demands_.push_back(demand_of(model, contact, margin));
  }
}

LocalLaw LocalLaw::of_whole_discs(const Model& model) {
  const Margin none = Margin::none();
  if (!has_planar_pushes(model)) return {model, none, {}};
  return {model, none, boxes_of(section_of_whole_discs(model, kRingCellsOfLaw))};
}

bool LocalLaw::is_in_cone(int contact, const DirectionSpan& directions) const noexcept {
  const LocalLaw::Demand& demand = demands_[contact];
  return edge_of_cone(demand, 0, directions).may_hold(tree_[1]) &&
         edge_of_cone(demand, 1, directions).may_hold(tree_[1]);
}

bool LocalLaw::may_move(int contact, const PlaceSpan& places,
                        const DirectionSpan& directions) const noexcept {
  const std::array ends = {places.a, places.b};
  return is_known() && is_in_cone(contact, directions) &&
         may_be_met_in(tree_, {demands_[contact], c_, ends, directions});
}

LeastTravel LocalLaw::least_travel(int contact, std::span<const Vec2> corners,
                                   const DirectionSpan& directions, double share,
                                   const LeastTravel& before) const noexcept {
  if (!is_known() || !is_in_cone(contact, directions)) return {.cost = INFINITY};
  const Demands demands(demands_[contact], c_, corners, directions);
  if (before.box > 0 && demands.may_be_met(tree_[before.box])) return before;
  return least_in_tree(tree_, demands,
                       [share](const FrictionBox& box) { return least_in(box, share); });
}

double LocalLaw::most_turn(int contact, std::span<const Vec2> corners,
                           const DirectionSpan& directions, double sense) const noexcept {
  if (!is_known() || !is_in_cone(contact, directions)) return -INFINITY;
  return -least_in_tree(tree_, {demands_[contact], c_, corners, directions},
                        [sense](const FrictionBox& box) { return -most_in(box, sense); })
              .cost;
}

}  // namespace prehensile
