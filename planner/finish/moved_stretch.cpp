#include "planner/finish/moved_stretch.h"

#include <cstdint>
#include <utility>

#include "planner/checks/exact_check.h"
#include "planner/steering/draft.h"
#include "planner/steering/goal.h"

namespace prehensile {
namespace {

constexpr int kSpreadParts = 8;     // of a push over clipped discs
constexpr double kRoom = 2.0;       // of the margin
constexpr std::int64_t kLook = 10;  // work of the slack of a push, in stick tests

}  // namespace

bool MovedStretch::read(std::span<const PlannedPush> pushes) {
  if (!read_stretch(search_, pushes, stretch_) || any_by_point(search_, stretch_)) {
    return false;
  }
  for (const PlannedPush& push : pushes.first(pushes.size() - 1)) {
    const FlatState at = flat_state(push.end);
    way_points_.insert(way_points_.end(),
                       {at.p_OF.x(), at.p_OF.y(), search_.model->c * at.theta});
  }
  return true;
}

bool MovedStretch::look(std::span<const double> way_points,
                        std::vector<PlannedPush>& pushes, std::vector<MovedPush>& looks) {
  Plan part{.start = grasp_of(stretch_.start, stretch_.psi)};
  looks.clear();
  FlatState from = stretch_.start;
  double travelled = travelled_;
  const std::size_t last = stretch_.contacts.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const FlatState to = state_at(way_points, k);
    if ((to.p_OF - from.p_OF).norm() < kShortestLeg) return false;
    append_move(search_, {stretch_.contacts[k], from, to}, part);
    const PlannedPush& push = part.pushes.back();
    looks.push_back(look_at(stretch_.contacts[k], push, {from.p_OF, k == 0},
                            {to.p_OF, k == last}, travelled));
    work_.other += kLook;
    travelled += travel_in_pad_plane(push.push);
    from = to;
  }
  pushes = std::move(part.pushes);
  return true;
}

FlatState MovedStretch::state_at(std::span<const double> way_points,
                                 std::size_t point) const {
  if (3 * point == way_points.size()) return stretch_.end;
  return {{way_points[3 * point], way_points[3 * point + 1]},
          way_points[3 * point + 2] / search_.model->c};
}

MovedPush MovedStretch::look_at(int contact, const PlannedPush& push, const Stop& from,
                                const Stop& to, double travelled) const {
  const auto stays = [&](const Margin& margin) {
    return path_on_object(*search_.model, {from.p_OF, from.given}, {to.p_OF, to.given},
                          carried(margin, travelled));
  };
  return {.slack = push_slack(*search_.model, push.start, push.push,
                              carried(margin_, travelled), kSpreadParts),
          .is_allowed = is_held(search_, contact, from) &&
                        is_held(search_, contact, to) && stays(margin_),
          .has_room = stays(margin_.scaled(kRoom))};
}

}  // namespace prehensile
