#include "planner/lattice.h"

#include <algorithm>
#include <cmath>

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

/// Legs between one fixed place and every node, by contact: empty kappas where none.
class LegTable {
 public:
  /// `place`: start or goal; `outward`: from the place to the nodes.
  LegTable(const Steering& steering, const std::vector<Vec2>& nodes, const Vec2& place,
           bool outward, Work& work)
      : contacts_(steering.search.contacts.size()), legs_(contacts_ * nodes.size()) {
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      for (std::size_t contact = 0; contact < contacts_; ++contact) {
        Leg& leg = legs_[node * contacts_ + contact];
        const int index = static_cast<int>(contact);
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

 private:
  std::size_t contacts_;
  std::vector<Leg> legs_;
};

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
  const LegTable out(steering, nodes, start.p_OF, true, work);
  const std::size_t contacts = steering.search.contacts.size();
  Chain chain;
  for (int place = 0; place < goals.count && !work.spent(); ++place) {
    const LegTable in(steering, nodes, goals.places[place].p_OF, false, work);
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      for (std::size_t i = 0; i < contacts * contacts; ++i) {
        const Leg& first = out.at(node, i / contacts);
        const Leg& second = in.at(node, i % contacts);
        if (first.contact < 0 || second.contact < 0) continue;
        add_way_point(steering, start.theta, goals, place, first, second, chain, best);
      }
    }
  }
}

}  // namespace prehensile
