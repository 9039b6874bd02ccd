#include "planner/chains/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/costs.h"

namespace prehensile {
namespace {

bool held_by_some(const SearchModel& search, const Vec2& p_OF) {
  if (can_roll(search.model->scene.object)) return true;  // see make_leg
  return std::any_of(
      search.contacts.begin(), search.contacts.end(), [&](const SearchContact& contact) {
        const Vec2& g_O = search.model->contacts[contact.contact].g_O;
        return holding_slack(*search.model, p_OF, g_O, search.margin) > 0.0;
      });
}

/// Legs between one fixed place and nodes, by contact.
class LegTable {
 public:
  /// `place`: start or goal; `outward`: from the place to the nodes. `is_asked(node,
  /// contact)`: of which legs.
  template <typename IsAsked>
  LegTable(const Steering& steering, const std::vector<Vec2>& nodes, const Vec2& place,
           bool outward, const IsAsked& is_asked, Work& work)
      : contacts_(steering.search.contacts.size()), legs_(contacts_ * nodes.size()) {
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      for (std::size_t contact = 0; contact < contacts_; ++contact) {
        Leg& leg = legs_[node * contacts_ + contact];
        const int index = static_cast<int>(contact);
        if (!is_asked(node, contact)) continue;
        if (is_blocked(steering.search, index, nodes[node], work)) continue;
        const Stop end{place, true};
        const Stop way_point{nodes[node]};
        const Stop& from = outward ? end : way_point;
        const Stop& to = outward ? way_point : end;
        if (!make_leg(steering, index, from, to, work, leg)) {
          leg.contact = -1;
        }
      }
    }
  }

  const Leg& at(std::size_t node, std::size_t contact) const {
    return legs_[node * contacts_ + contact];
  }

  bool has(std::size_t node, std::size_t contact) const {
    return at(node, contact).contact >= 0;
  }

  bool has_any(std::size_t node) const {
    for (std::size_t i = 0; i < contacts_; ++i) {
      if (has(node, i)) return true;
    }
    return false;
  }

 private:
  std::size_t contacts_;
  std::vector<Leg> legs_;
};

/// Least J of plans by one placement that go to a goal place by way of each node;
/// infinity where the place has no angles.
std::vector<double> least_costs(const Model& model, const std::vector<Vec2>& nodes,
                                const FlatState& start, const GoalPlace& goal) {
  std::vector<double> least(nodes.size(), std::numeric_limits<double>::infinity());
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const double way =
        (nodes[node] - start.p_OF).norm() + (goal.p_OF - nodes[node]).norm();
    for (int i = 0; i < goal.count; ++i) {
      const double turn = goal.theta[i] - start.theta;
      least[node] = std::min(least[node], straight_cost(model, 1, way, turn));
    }
  }
  return least;
}

bool is_node(const SearchModel& search, const Vec2& p_OF, double depth) {
  return depth_inside(search.model->pad_face, p_OF) >= depth &&
         held_by_some(search, p_OF);
}

}  // namespace

std::vector<Vec2> lattice_nodes(const SearchModel& search, int wanted) {
  const std::vector<Vec2>& outline = search.model->pad_face;
  const double step = std::sqrt(properties_of(outline).area / wanted);
  Vec2 low = outline[0];
  Vec2 high = outline[0];
  for (const Vec2& vertex : outline) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const Vec2 count = ((high - low) / step).array().floor();
  const Vec2 first = 0.5 * (low + high - step * count);
  std::vector<Vec2> nodes;
  for (int i = 0; i <= static_cast<int>(count.x()); ++i) {
    for (int j = 0; j <= static_cast<int>(count.y()); ++j) {
      const Vec2 p_OF = first + step * Vec2(i, j);
      if (is_node(search, p_OF, 0.25 * step)) nodes.push_back(p_OF);
    }
  }
  return nodes;
}

void add_local_nodes(const SearchModel& search, const Vec2& a, const Vec2& b,
                     int per_side, std::vector<Vec2>& nodes) {
  constexpr double kLeastWidth = 0.2;  // of the object's longer side
  const double width = std::max(kLeastWidth * search.model->L, 2.0 * (b - a).norm());
  const Vec2 first = 0.5 * (a + b) - Vec2::Constant(0.5 * width);
  const double step = width / (per_side - 1);
  for (int i = 0; i < per_side; ++i) {
    for (int j = 0; j < per_side; ++j) {
      const Vec2 p_OF = first + step * Vec2(i, j);
      if (is_node(search, p_OF, 0.25 * step)) nodes.push_back(p_OF);
    }
  }
}

void add_nodes(const Steering& steering, const std::vector<Vec2>& nodes,
               const FlatState& start, const GoalPlaces& goals, Work& work,
               BestWayPoints& best) {
  const std::size_t contacts = steering.search.contacts.size();
  std::vector<std::vector<double>> least;  // by goal place and node
  least.reserve(static_cast<std::size_t>(goals.count));
  for (int place = 0; place < goals.count; ++place) {
    least.push_back(least_costs(*steering.search.model, nodes, start,
                                goals.places[static_cast<std::size_t>(place)]));
  }
  const auto is_near = [&](std::size_t node, std::size_t) {
    return std::any_of(least.begin(), least.end(), [&](const auto& of_place) {
      return of_place[node] < best.worst_cost();
    });
  };
  const LegTable out(steering, nodes, start.p_OF, true, is_near, work);
  Chain chain;
  for (int place = 0; place < goals.count && !work.spent(); ++place) {
    const auto leads_on = [&](std::size_t node, std::size_t contact) {
      const auto index = static_cast<int>(contact);
      const bool stays =
          out.has(node, contact) && !is_placed_anew(steering.search, index, index);
      const double placements_more = stays ? 0.0 : 1.0;
      return least[static_cast<std::size_t>(place)][node] + placements_more <
                 best.worst_cost() &&
             out.has_any(node);
    };
    const LegTable in(steering, nodes, goals.places[place].p_OF, false, leads_on, work);
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      for (std::size_t i = 0; i < contacts * contacts; ++i) {
        if (!out.has(node, i / contacts) || !in.has(node, i % contacts)) continue;
        add_way_point(steering, start.theta, goals, place, out.at(node, i / contacts),
                      in.at(node, i % contacts), chain, best);
      }
    }
  }
}

}  // namespace prehensile
