#include "planner/walk_lattice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/chain.h"
#include "planner/costs.h"
#include "planner/holding.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

/// Rows and columns that a push goes, at most.
constexpr int kStride = 3;

/// Of this many spacings pushes from the start and to the goals are, at most.
constexpr double kReach = 1.5 * kStride;

/// The worst of a box of uncertainty, as far as it is the same for every push; the check
/// of a whole walk knows the rest.
StickContact weakened(const SearchContact& contact, const Margin& margin) {
  StickContact weak = contact.stick;
  weak.mu *= std::max(0.0, 1.0 - margin.friction);
  if (weak.is_point) return weak;
  weak.a += margin.place * weak.t;
  weak.b -= margin.place * weak.t;
  return weak;
}

}  // namespace

WalkLattice::WalkLattice(const SearchModel& search, const FlatState& start,
                         const GoalPlaces& goals, int per_side, Steepness steepness)
    : search_(search),
      model_(*search.model),
      contacts_(static_cast<int>(search.contacts.size())),
      steepness_(steepness),
      grid_(PlaceGrid::over(model_.pad_face, per_side)) {
  for (const SearchContact& contact : search.contacts) {
    weak_.push_back(weakened(contact, search.margin));
  }
  add_nodes(start, goals);
  add_steps();
}

void WalkLattice::add_nodes(const FlatState& start, const GoalPlaces& goals) {
  at_grid_.assign(grid_.count(), -1);
  for (int k = 0; k < grid_.count(); ++k) {
    if (depth_inside(model_.pad_face, grid_.place(k)) < 0.0) continue;
    at_grid_[k] = static_cast<int>(nodes_.size());
    nodes_.push_back({grid_.place(k)});
    on_grid_.push_back(k);
  }
  start_ = static_cast<int>(nodes_.size());
  nodes_.push_back({start.p_OF});
  for (int i = 0; i < goals.count; ++i) nodes_.push_back({goals.places[i].p_OF});
}

void WalkLattice::add_steps() {
  for (int i = -kStride; i <= kStride; ++i) {
    for (int j = -kStride; j <= kStride; ++j) {
      if (std::gcd(i, j) != 1) continue;
      const Vec2 way = grid_.spacing * Vec2(i, j);
      steps_.push_back({i, j, way.norm(), -way.normalized()});
    }
  }
}

void WalkLattice::find_held(Node& node, Work& work) const {
  if (!node.held.empty()) return;
  for (const SearchContact& contact : search_.contacts) {
    const Vec2& g_O = model_.contacts[contact.contact].g_O;
    node.held.push_back(
        pads_hold_gravity(model_, pose_from_finger(node.p_OF, 0.0), g_O, work));
  }
}

KappaRanges WalkLattice::slopes_along(Node& node, int contact, DirectedDrag& drag) const {
  if (!node.held[contact]) return {};
  return drag.kappas(weak_[contact], node.p_OF);
}

void WalkLattice::find_slopes(Node& node, Work& work) {
  if (!node.slopes.empty()) return;
  find_held(node, work);
  node.slopes.resize(steps_.size() * contacts_);
  const PadsAtPlace pads(model_, node.p_OF);
  if (pads.are_lost()) return;
  if (pads.are_whole() && !whole_pads_) {
    whole_pads_ = pads;
    for (const Step& step : steps_) {
      whole_drags_.emplace_back(model_, *whole_pads_, step.e, steepness_);
    }
  }
  work.other += static_cast<std::int64_t>(steps_.size());
  const auto keep = [&](std::size_t s, DirectedDrag& drag) {
    for (int k = 0; k < contacts_; ++k) {
      node.slopes[s * contacts_ + k] = slopes_along(node, k, drag);
    }
  };
  if (pads.are_whole()) {
    for (std::size_t s = 0; s < steps_.size(); ++s) keep(s, whole_drags_[s]);
    return;
  }
  // The last step is the first one back, and so on.
  for (std::size_t s = 0; s < steps_.size() / 2; ++s) {
    DirectedDrag drag(model_, pads, steps_[s].e, steepness_);
    DirectedDrag back = drag.opposite();
    keep(s, drag);
    keep(steps_.size() - 1 - s, back);
  }
}

void WalkLattice::add_edges(const KappaRanges& slopes, int contact, int to, double length,
                            std::vector<WalkEdge>& edges) const {
  for (int i = 0; i < slopes.count; ++i) {
    const auto [lo, hi] = slopes.intervals[i];
    const double least = std::clamp(0.0, lo, hi);
    edges.push_back({to, contact, length * lo, length * hi,
                     length * std::sqrt(1.0 + least * least) / placement_length(model_)});
  }
}

void WalkLattice::add_steps_from(int index, Work& work, std::vector<WalkEdge>& edges) {
  Node& node = nodes_[index];
  find_slopes(node, work);
  const int i = grid_.column(on_grid_[index]);
  const int j = grid_.row(on_grid_[index]);
  std::vector<KappaRanges> slopes(static_cast<std::size_t>(contacts_));
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    const Step& step = steps_[s];
    if (!grid_.has(i + step.i, j + step.j)) continue;
    const int to = at_grid_[grid_.index(i + step.i, j + step.j)];
    if (to < 0 || !segment_on_object(model_, node.p_OF, place(to))) continue;
    find_slopes(nodes_[to], work);
    for (int k = 0; k < contacts_; ++k) {
      const std::size_t at = s * contacts_ + k;
      slopes[k] = common(node.slopes[at], nodes_[to].slopes[at]);
    }
    look_between(node.p_OF, place(to), step.e, slopes, work);
    for (int k = 0; k < contacts_; ++k) {
      add_edges(slopes[k], k, to, step.length, edges);
    }
  }
}

/// Keeps the slopes that stick half way as well: where the face clips the pads the ends
/// do not decide.
void WalkLattice::look_between(const Vec2& from, const Vec2& to, const Vec2& e,
                               std::vector<KappaRanges>& slopes, Work& work) const {
  const auto is_any = [](const KappaRanges& ranges) { return ranges.count > 0; };
  if (std::ranges::none_of(slopes, is_any)) return;
  const Vec2 middle = 0.5 * (from + to);
  const PadsAtPlace pads(model_, middle);
  if (pads.are_whole()) return;
  ++work.other;
  if (pads.are_lost()) {
    std::ranges::fill(slopes, KappaRanges());
    return;
  }
  DirectedDrag drag(model_, pads, e, steepness_);
  for (int k = 0; k < contacts_; ++k) {
    if (is_any(slopes[k])) slopes[k] = common(slopes[k], drag.kappas(weak_[k], middle));
  }
}

/// Between the start or a goal and any other place.
void WalkLattice::add_given(int from, int to, Work& work, std::vector<WalkEdge>& edges) {
  const Vec2 way = place(to) - place(from);
  const double length = way.norm();
  if (length < kShortestLeg || length > kReach * grid_.spacing) return;
  if (!segment_on_object(model_, place(from), place(to))) return;
  find_held(nodes_[from], work);
  find_held(nodes_[to], work);
  ++work.other;
  const Vec2 e = -way / length;
  const PadsAtPlace pads_from(model_, place(from));
  const PadsAtPlace pads_to(model_, place(to));
  DirectedDrag drag_from(model_, pads_from, e, steepness_);
  DirectedDrag drag_to(model_, pads_to, e, steepness_);
  for (int k = 0; k < contacts_; ++k) {
    add_edges(common(slopes_along(nodes_[from], k, drag_from),
                     slopes_along(nodes_[to], k, drag_to)),
              k, to, length, edges);
  }
}

std::vector<WalkEdge>& WalkLattice::edges_from(int node, Work& work) {
  auto& edges = nodes_[node].edges;
  if (edges) return *edges;
  edges.emplace();
  if (node < start_) add_steps_from(node, work, *edges);
  if (node == start_) {
    for (int to = 0; to < start_; ++to) add_given(node, to, work, *edges);
  }
  if (node <= start_) {
    for (int to = start_ + 1; to < nodes(); ++to) add_given(node, to, work, *edges);
  }
  return *edges;
}

}  // namespace prehensile
