#include "planner/walks/walk_lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "planner/costs.h"
#include "planner/steering/chain.h"
#include "planner/steering/holding.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

/// Pads half way between nodes that are kept, at most: some 3 KB each. Five or six steps
/// that differ meet half way at each of these places.
constexpr std::size_t kMostBetween = 500;

/// Pushes by points turn the object a little otherwise than straight ways say: nodes are
/// so far inside the face [m].
constexpr double kBesidePoints = 2e-4;

/// Of this many spacings pushes from the start and to the goals are, at most.
constexpr double kReach = 4.5;

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

/// Of coordinates in rows, with `per_side` nodes over the longer side of the object, or
/// in a row.
PlaceGrid grid_over(const std::vector<Vec2>& face, const Rows& rows, int per_side) {
  std::vector<Vec2> coordinates;
  Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 most = -least;
  for (const Vec2& vertex : face) {
    coordinates.push_back(rows.coordinates(vertex));
    least = least.cwiseMin(coordinates.back());
    most = most.cwiseMax(coordinates.back());
  }
  const Vec2 size = most - least;
  const double stretched = rows.closer > 1.0 ? size.maxCoeff() / size.x() : 1.0;
  return PlaceGrid::over(coordinates,
                         static_cast<int>(std::lround(per_side * stretched)));
}

}  // namespace

WalkLattice::WalkLattice(const SearchModel& search, const FlatState& start,
                         const GoalPlaces& goals, const Fineness& fineness,
                         Steepness steepness, const Rows& rows)
    : search_(search),
      model_(*search.model),
      contacts_(static_cast<int>(search.contacts.size())),
      steepness_(steepness),
      rows_(rows),
      grid_(grid_over(model_.pad_face, rows, fineness.per_side)) {
  for (const SearchContact& contact : search.contacts) {
    weak_.push_back(weakened(contact, search.margin));
  }
  add_nodes();
  add_steps(fineness.stride);
  set_ends(start, goals);
}

void WalkLattice::add_nodes() {
  const bool points = std::ranges::any_of(
      model_.contacts, [](const PushContact& contact) { return contact.is_point; });
  const double depth = points ? kBesidePoints : 0.0;
  at_grid_.assign(grid_.count(), -1);
  for (int k = 0; k < grid_.count(); ++k) {
    if (depth_inside(model_.pad_face, place_on_grid(k)) < depth) continue;
    at_grid_[k] = static_cast<int>(nodes_.size());
    nodes_.push_back({place_on_grid(k)});
    on_grid_.push_back(k);
  }
  start_ = static_cast<int>(nodes_.size());
}

void WalkLattice::set_ends(const FlatState& start, const GoalPlaces& goals) {
  for (; !narrowed_.empty(); narrowed_.pop_back()) {
    const Narrowed& last = narrowed_.back();
    WalkEdge& edge = nodes_[last.node].edges[last.edge];
    edge.lo = last.lo;
    edge.hi = last.hi;
  }
  nodes_.resize(static_cast<std::size_t>(start_));
  for (Node& node : nodes_) {
    node.edges.resize(node.steps);
    node.knows_goals = false;
  }
  pads_of_ends_.clear();
  pads_of_ends_.resize(1 + static_cast<std::size_t>(goals.count));
  nodes_.push_back({start.p_OF});
  for (int i = 0; i < goals.count; ++i) nodes_.push_back({goals.places[i].p_OF});
}

void WalkLattice::narrow(int node, int edge, double lo, double hi) {
  WalkEdge& narrower = nodes_[node].edges[edge];
  narrowed_.push_back({node, edge, narrower.lo, narrower.hi});
  narrower.lo = lo;
  narrower.hi = hi;
}

void WalkLattice::add_steps(int stride) {
  for (int i = -stride; i <= stride; ++i) {
    for (int j = -stride; j <= stride; ++j) {
      if (std::gcd(i, j) != 1) continue;
      const Vec2 way = rows_.place(grid_.spacing * Vec2(i, j));
      steps_.push_back({i, j, way.norm(), -way.normalized()});
    }
  }
}

void WalkLattice::find_held(Node& node, Work& work) const {
  if (!node.held.empty()) return;
  const bool given = &node - nodes_.data() >= start_;
  const Margin margin = given ? Margin::none() : search_.margin_from(node.p_OF);
  const PlanarPose X_HO = pose_from_finger(node.p_OF, 0.0);
  for (const SearchContact& contact : search_.contacts) {
    const Vec2& g_O = model_.contacts[contact.contact].g_O;
    node.held.push_back(pads_hold_gravity(model_, X_HO, g_O, margin, work));
  }
}

WalkLattice::KeptRanges::KeptRanges(const KappaRanges& ranges) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < static_cast<std::size_t>(ranges.count); ++i) {
    const auto [lo, hi] = ranges.intervals[i];
    lo_[i] = static_cast<float>(lo);
    hi_[i] = static_cast<float>(hi);
    if (lo_[i] < lo) lo_[i] = std::nextafter(lo_[i], kFar);
    if (hi_[i] > hi) hi_[i] = std::nextafter(hi_[i], -kFar);
  }
}

KappaRanges WalkLattice::KeptRanges::ranges() const {
  KappaRanges ranges;
  for (std::size_t i = 0; i < lo_.size(); ++i) {
    if (lo_[i] <= hi_[i]) ranges.intervals[ranges.count++] = {lo_[i], hi_[i]};
  }
  return ranges;
}

KappaRanges WalkLattice::slopes_along(const Node& node, int contact,
                                      DirectedDrag& drag) const {
  if (!node.held[contact]) return {};
  return drag.kappas(weak_[contact], node.p_OF);
}

void WalkLattice::find_slopes(Node& node, Work& work) {
  if (!node.slopes.empty()) return;
  find_held(node, work);
  node.slopes.resize(steps_.size() * contacts_);
  work.other += static_cast<std::int64_t>(steps_.size());
  if (PadsAtPlace::are_whole_at(model_, node.p_OF)) {
    find_slopes_of_whole_pads(node);
    return;
  }
  const PadsAtPlace pads(model_, node.p_OF);
  if (pads.are_lost()) return;
  const auto keep = [&](std::size_t s, DirectedDrag& drag) {
    for (int k = 0; k < contacts_; ++k) {
      node.slopes[s * contacts_ + k] = KeptRanges(slopes_along(node, k, drag));
    }
  };
  // The last step is the first one back, and so on.
  for (std::size_t s = 0; s < steps_.size() / 2; ++s) {
    DirectedDrag drag(model_, pads, steps_[s].e, steepness_);
    DirectedDrag back = drag.opposite();
    keep(s, drag);
    keep(steps_.size() - 1 - s, back);
  }
}

void WalkLattice::find_slopes_of_whole_pads(Node& node) {
  if (whole_drags_.empty()) {
    const PadsAtPlace& pads = whole_pads_at(node.p_OF);
    for (const Step& step : steps_) {
      DirectedDrag& drag = whole_drags_.emplace_back(model_, pads, step.e, steepness_);
      for (const StickContact& contact : weak_) {
        are_in_cone_.push_back(drag.is_in_cone(contact) ? 1 : 0);
      }
    }
  }
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    for (int k = 0; k < contacts_; ++k) {
      const std::size_t at = s * contacts_ + k;
      if (!are_in_cone_[at]) continue;
      node.slopes[at] = KeptRanges(slopes_along(node, k, whole_drags_[s]));
    }
  }
}

/// The same at all places where they are whole.
const PadsAtPlace& WalkLattice::whole_pads_at(const Vec2& p_OF) {
  if (!whole_pads_) whole_pads_.emplace(model_, p_OF);
  return *whole_pads_;
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
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    const Step& step = steps_[s];
    if (!grid_.has(i + step.i, j + step.j)) continue;
    const int to = at_grid_[grid_.index(i + step.i, j + step.j)];
    if (to < 0 || !segment_on_object(model_, node.p_OF, place(to))) continue;
    find_slopes(nodes_[to], work);
    OfContacts slopes = slopes_of_step(s, node, nodes_[to]);
    look_between(index, to, s, slopes, work);
    for (int k = 0; k < contacts_; ++k) {
      add_edges(slopes[k], k, to, step.length, edges);
    }
  }
}

WalkLattice::OfContacts WalkLattice::slopes_of_step(std::size_t step, const Node& from,
                                                    const Node& to) const {
  OfContacts slopes(static_cast<std::size_t>(contacts_));
  for (int k = 0; k < contacts_; ++k) {
    const std::size_t at = step * contacts_ + k;
    slopes[k] = common(from.slopes[at].ranges(), to.slopes[at].ranges());
  }
  return slopes;
}

/// Keeps the slopes that stick half way as well: where the face clips the pads the ends
/// do not decide. What the step back needs is found with it.
void WalkLattice::look_between(int from, int to, std::size_t step, OfContacts& slopes,
                               Work& work) {
  const auto is_any = [](const KappaRanges& ranges) { return ranges.count > 0; };
  const Vec2 middle = 0.5 * (place(from) + place(to));
  if (std::ranges::none_of(slopes, is_any) || PadsAtPlace::are_whole_at(model_, middle)) {
    return;
  }
  if (const auto known = backwards_.find(from * steps_.size() + step);
      known != backwards_.end()) {
    slopes = std::move(known->second);
    backwards_.erase(known);
    return;
  }
  ++work.other;
  const PadsAtPlace& pads = pads_between(from, steps_[step], middle);
  DirectedDrag drag(model_, pads, steps_[step].e, steepness_);
  DirectedDrag drag_back = drag.opposite();
  const auto keep_common = [&](DirectedDrag& along, OfContacts& of_contacts) {
    for (int k = 0; k < contacts_; ++k) {
      KappaRanges& ranges = of_contacts[k];
      if (!is_any(ranges)) continue;
      ranges = pads.are_lost() ? KappaRanges()
                               : common(ranges, along.kappas(weak_[k], middle));
    }
  };
  keep_common(drag, slopes);
  const std::size_t back = steps_.size() - 1 - step;
  OfContacts slopes_back = slopes_of_step(back, nodes_[to], nodes_[from]);
  if (nodes_[to].knows_steps || std::ranges::none_of(slopes_back, is_any)) return;
  keep_common(drag_back, slopes_back);
  backwards_.emplace(to * steps_.size() + back, std::move(slopes_back));
}

const PadsAtPlace& WalkLattice::pads_between(int from, const Step& step,
                                             const Vec2& middle) {
  const int column = 2 * grid_.column(on_grid_[from]) + step.i;
  const int row = 2 * grid_.row(on_grid_[from]) + step.j;
  const int place = column * 2 * grid_.ny + row;
  if (const auto known = between_.find(place); known != between_.end()) {
    return known->second;
  }
  if (between_.size() >= kMostBetween) between_.clear();
  return between_.try_emplace(place, model_, middle).first->second;
}

/// The pads at the start, a goal, or the node whose pushes to the goals are looked for.
const PadsAtPlace& WalkLattice::kept_pads_at(int node) {
  if (PadsAtPlace::are_whole_at(model_, place(node))) return whole_pads_at(place(node));
  if (node >= start_) {
    std::optional<PadsAtPlace>& pads = pads_of_ends_[node - start_];
    return pads ? *pads : pads.emplace(model_, place(node));
  }
  if (pads_of_node_.first != node) {
    pads_of_node_.second.emplace(model_, place(node));
    pads_of_node_.first = node;
  }
  return *pads_of_node_.second;
}

/// Between the start or a goal and any other place.
void WalkLattice::add_given(int from, int to, Work& work, std::vector<WalkEdge>& edges) {
  const Vec2 way = place(to) - place(from);
  const double length = way.norm();
  if (length < kShortestLeg || rows_.coordinates(way).norm() > kReach * grid_.spacing) {
    return;
  }
  if (!segment_on_object(model_, place(from), place(to))) return;
  find_held(nodes_[from], work);
  find_held(nodes_[to], work);
  ++work.other;
  const Vec2 e = -way / length;
  const PadsAtPlace& pads_from = kept_pads_at(from);
  const PadsAtPlace& pads_to = kept_pads_at(to);
  DirectedDrag drag_from(model_, pads_from, e, steepness_);
  std::optional<DirectedDrag> drag_to;  // where it differs
  for (int k = 0; k < contacts_; ++k) {
    const KappaRanges at_from = slopes_along(nodes_[from], k, drag_from);
    if (at_from.count == 0) continue;
    if (&pads_to != &pads_from && !drag_to) {
      drag_to.emplace(model_, pads_to, e, steepness_);
    }
    const KappaRanges at_to = slopes_along(nodes_[to], k, drag_to ? *drag_to : drag_from);
    add_edges(common(at_from, at_to), k, to, length, edges);
  }
}

const std::vector<WalkEdge>& WalkLattice::edges_from(int index, Work& work) {
  Node& node = nodes_[index];
  if (!node.knows_steps) {
    node.knows_steps = true;
    if (index < start_) add_steps_from(index, work, node.edges);
    for (int to = 0; index == start_ && to < start_; ++to) {
      add_given(index, to, work, node.edges);
    }
    node.steps = node.edges.size();
  }
  if (!node.knows_goals) {
    node.knows_goals = true;
    for (int to = start_ + 1; index <= start_ && to < nodes(); ++to) {
      add_given(index, to, work, node.edges);
    }
  }
  return node.edges;
}

FreeDirections WalkLattice::headings_at(const Vec2& p_OF, Work& work) const {
  Node node{p_OF};
  find_held(node, work);
  const PadsAtPlace pads(model_, p_OF);
  if (pads.are_lost() || std::ranges::none_of(node.held, [](char yes) { return yes; })) {
    return {};
  }
  return FreeDirections::where([&](double angle) {
    ++work.other;
    DirectedDrag drag(model_, pads, -towards(angle), steepness_);
    for (int k = 0; k < contacts_; ++k) {
      if (slopes_along(node, k, drag).count > 0) return true;
    }
    return false;
  });
}

WalkLattice& WalkLattices::between(const SearchModel& search, const FlatState& start,
                                   const GoalPlaces& goals, const Fineness& fineness,
                                   Steepness steepness) {
  if (search_ != &search || steepness_ != steepness) by_fineness_.clear();
  search_ = &search;
  steepness_ = steepness;
  const auto known = by_fineness_.find(fineness);
  if (known == by_fineness_.end()) {
    return by_fineness_.try_emplace(fineness, search, start, goals, fineness, steepness)
        .first->second;
  }
  known->second.set_ends(start, goals);
  return known->second;
}

}  // namespace prehensile
