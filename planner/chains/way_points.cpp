#include "planner/chains/way_points.h"

#include <algorithm>
#include <cmath>

#include "planner/costs.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

/// Directions in which the finger axis may leave (or reach) a place, as unit e of the
/// object's motion.
struct Directions {
  static constexpr int kCapacity = 12;  // of more reflex corners the first
  int count = 0;
  std::array<Vec2, kCapacity> e;
  void add(const Vec2& direction) {
    if (count < kCapacity) e[count++] = direction;
  }
};

/// Share of the friction angle that counts as the edge: on the edge itself rounding
/// decides.
constexpr double kNearEdge = 0.98;

/// Of a way round a corner, over the straight one.
constexpr double kDetour = 1.05;

Directions promising_directions(const SearchModel& search, int contact,
                                const Vec2& p_OF) {
  const StickContact& stick = search.contacts[contact].stick;
  const double edge =
      kNearEdge * std::atan(stick.mu * std::max(0.0, 1.0 - search.margin.friction));
  Directions directions;
  const auto add_angle = [&](double angle) {
    directions.add(std::cos(angle) * stick.n + std::sin(angle) * stick.t);
  };
  add_angle(0.0);
  add_angle(edge);
  add_angle(-edge);
  for (const Vec2& end : {stick.a, stick.b}) {
    const Vec2 away = p_OF - end;
    const double angle = std::atan2(away.dot(stick.t), away.dot(stick.n));
    if (std::abs(angle) < edge) add_angle(angle);
  }
  return directions;
}

/// Directions from a place past the reflex corners of the object, so near to each as the
/// margin lets a way come that has been so long [m] when it gets there.
template <class WayTo>
Directions past_corners(const SearchModel& search, const Vec2& p_OF,
                        const WayTo& way_to) {
  const std::vector<Vec2>& outline = search.model->pad_face;
  const std::size_t n = outline.size();
  Directions directions;
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_reflex(outline, i)) continue;
    const Vec2& corner = outline[i];
    const Vec2 to_last = (outline[(i + n - 1) % n] - corner).normalized();
    const Vec2 to_next = (outline[(i + 1) % n] - corner).normalized();
    const Vec2 d = corner - p_OF;
    const double room = carried(search.margin, way_to(corner)).grasp;
    if (d.norm() <= room || d.norm() < kShortestLeg) continue;
    const double off = std::asin(room / d.norm());
    const bool is_left = cross(d, to_last + to_next) < 0.0;  // of it the object lies
    directions.add(rotated(is_left ? off : -off, d.normalized()));
  }
  return directions;
}

/// The point start - s e_1 = goal + r e_2 with s, r > 0; false if there is none.
bool crossing(const Vec2& start, const Vec2& e_1, const Vec2& goal, const Vec2& e_2,
              Vec2& p_OF) {
  const double sine = cross(e_1, e_2);
  if (std::abs(sine) < 1e-3) return false;
  const Vec2 d = start - goal;
  const double s = cross(d, e_2) / sine;
  const double r = cross(e_1, d) / sine;
  if (s < kShortestLeg || r < kShortestLeg) return false;
  p_OF = start - s * e_1;
  return true;
}

double least_turn(const GoalPlace& goal, double theta_start) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < goal.count; ++i) {
    least = std::min(least, std::abs(goal.theta[i] - theta_start));
  }
  return least;
}

}  // namespace

double BestWayPoints::worst_cost() const {
  return count_ < kCapacity ? to_beat_ : points_[count_ - 1].cost;
}

void BestWayPoints::add(const WayPoint& point) noexcept {
  if (!(point.cost < worst_cost())) return;
  int i = std::min(count_, kCapacity - 1);
  for (; i > 0 && points_[i - 1].cost > point.cost; --i) points_[i] = points_[i - 1];
  points_[i] = point;
  count_ = std::min(count_ + 1, kCapacity);
}

void add_way_point(const Steering& steering, double theta_start, const GoalPlaces& goals,
                   int place, const Leg& first, const Leg& second, Chain& chain,
                   BestWayPoints& best) noexcept {
  const SearchModel& search = steering.search;
  const int placed = is_placed_anew(search, second.contact, first.contact) ? 2 : 1;
  const double length = first.length + second.length;
  const TurnWindow window = turns_from(search, theta_start);
  const GoalPlace& goal = goals.places[place];
  for (int angle = 0; angle < goal.count; ++angle) {
    const double dtheta = goal.theta[angle] - theta_start;
    const double least = straight_cost(*search.model, placed, length, dtheta);
    if (least >= best.worst_cost()) continue;
    chain.count = 2;
    chain.legs[0] = first;
    chain.legs[1] = second;
    if (!solve_chain(search, dtheta, chain, window)) continue;
    best.add({chain.cost, first.contact, second.contact, first.to, place, angle});
  }
}

void add_crossings(const Steering& steering, const FlatState& start,
                   const GoalPlaces& goals, int place, Work& work,
                   BestWayPoints& best) noexcept {
  const SearchModel& search = steering.search;
  const Vec2& goal = goals.places[place].p_OF;
  const int contacts = static_cast<int>(search.contacts.size());
  const double turn = least_turn(goals.places[place], start.theta);
  const auto may_be_kept = [&](int placements, const Vec2& p_OF) {
    const double length = (start.p_OF - p_OF).norm() + (goal - p_OF).norm();
    return straight_cost(*search.model, placements, length, turn) < best.worst_cost();
  };
  Directions round_from, round_to;
  if (!segment_on_object(*search.model, start.p_OF, goal)) {
    const auto way_to = [&](const Vec2& corner) {
      return kDetour * (corner - start.p_OF).norm();
    };
    round_from = past_corners(search, start.p_OF, way_to);
    round_to = past_corners(search, goal, way_to);
  }
  Chain chain;
  for (int i = 0; i < contacts; ++i) {
    Directions from = promising_directions(search, i, start.p_OF);
    for (int k = 0; k < round_from.count; ++k) from.add(-round_from.e[k]);
    for (int j = 0; j < contacts && !work.spent(); ++j) {
      Directions to = promising_directions(search, j, goal);
      for (int k = 0; k < round_to.count; ++k) to.add(round_to.e[k]);
      for (int k = 0; k < from.count * to.count; ++k) {
        Vec2 p_OF;
        Leg first, second;
        if (crossing(start.p_OF, from.e[k / to.count], goal, to.e[k % to.count], p_OF) &&
            may_be_kept(is_placed_anew(search, j, i) ? 2 : 1, p_OF) &&
            make_leg(steering, i, {start.p_OF, true}, {p_OF}, work, first) &&
            make_leg(steering, j, {p_OF}, {goal, true}, work, second)) {
          add_way_point(steering, start.theta, goals, place, first, second, chain, best);
        }
      }
    }
  }
}

}  // namespace prehensile
