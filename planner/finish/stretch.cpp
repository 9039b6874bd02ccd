#include "planner/finish/stretch.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "planner/checks/exact_check.h"
#include "planner/steering/draft.h"
#include "planner/steering/goal.h"

namespace prehensile {
namespace {

int search_contact(const SearchModel& search, const LinearPush& push) {
  for (std::size_t i = 0; i < search.contacts.size(); ++i) {
    const SearchContact& contact = search.contacts[i];
    if (contact.contact == push.contact && push.place >= contact.place_low - 1e-9 &&
        push.place <= contact.place_high + 1e-9) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

}  // namespace

bool read_stretch(const SearchModel& search, std::span<const PlannedPush> pushes,
                  Stretch& stretch) {
  stretch.start = flat_state(pushes.front().start);
  stretch.end = flat_state(pushes.back().end);
  stretch.psi = pushes.front().start.psi;
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    stretch.contacts.push_back(search_contact(search, as_linear(pushes[i].push)));
    if (stretch.contacts.back() < 0) return false;
    if (i + 1 == pushes.size()) break;
    const Vec2 p_OF = finger_in_object(pushes[i].end.X_HO);
    stretch.way_points.push_back(p_OF.x());
    stretch.way_points.push_back(p_OF.y());
  }
  return true;
}

bool chain_of(const Steering& steering, const Stretch& stretch,
              std::span<const double> way_points, Work& work, Chain& chain) {
  chain.count = static_cast<int>(stretch.contacts.size());
  Stop from{stretch.start.p_OF, true};
  for (int k = 0; k < chain.count; ++k) {
    const bool last = k + 1 == chain.count;
    const Stop to = last ? Stop{stretch.end.p_OF, true}
                         : Stop{{way_points[2 * k], way_points[2 * k + 1]}};
    if (!make_leg(steering, stretch.contacts[k], from, to, work, chain.legs[k])) {
      return false;
    }
    from = to;
  }
  return solve_chain(steering.search, stretch.end.theta - stretch.start.theta, chain,
                     turns_from(steering.search, stretch.start.theta));
}

std::vector<PlannedPush> pushes_of(const SearchModel& search, const Stretch& stretch,
                                   const Chain& chain) {
  Plan part;
  part.start = grasp_of(stretch.start, stretch.psi);
  append_chain(search, stretch.start, chain, part);
  return part.pushes;
}

void change_stretches(Plan& plan,
                      const std::function<void(std::vector<PlannedPush>&)>& change) {
  std::vector<PlannedPush> result, stretch;
  const auto finish_stretch = [&] {
    if (!stretch.empty()) change(stretch);
    result.insert(result.end(), std::make_move_iterator(stretch.begin()),
                  std::make_move_iterator(stretch.end()));
    stretch.clear();
  };
  for (const PlannedPush& push : plan.pushes) {
    if (!std::holds_alternative<Roll>(push.push)) {
      stretch.push_back(push);
      continue;
    }
    finish_stretch();
    result.push_back(push);
  }
  finish_stretch();
  plan.pushes = std::move(result);
}

bool any_by_point(const SearchModel& search, const Stretch& stretch) {
  return std::ranges::any_of(stretch.contacts, [&](int contact) {
    return search.contacts[contact].stick.is_point;
  });
}

bool repair_stretches(Plan& plan, std::size_t most, const StretchMender& mend) {
  bool repaired = false;
  double travelled = 0.0;
  change_stretches(plan, [&](std::vector<PlannedPush>& pushes) {
    if (pushes.size() >= 2 && pushes.size() <= most) repaired |= mend(pushes, travelled);
    for (const PlannedPush& push : pushes) travelled += travel_in_pad_plane(push.push);
  });
  return repaired;
}

}  // namespace prehensile
