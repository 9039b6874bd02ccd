#include "planner/loosen_grip.h"

#include <algorithm>
#include <vector>

#include "planner/exact_check.h"
#include "planner/holding.h"

namespace prehensile {
namespace {

/// The same pusher on the same face with a weaker grip, weakest first.
std::vector<int> weaker_contacts(const Model& model, int contact) {
  const PushContact& own = model.contacts[contact];
  std::vector<int> weaker;
  for (int i = 0; i < static_cast<int>(model.contacts.size()); ++i) {
    const PushContact& other = model.contacts[i];
    const bool same_place = other.pusher == own.pusher && other.face == own.face;
    if (same_place && other.grip_share < own.grip_share) weaker.push_back(i);
  }
  std::sort(weaker.begin(), weaker.end(), [&](int a, int b) {
    return model.contacts[a].grip_share < model.contacts[b].grip_share;
  });
  return weaker;
}

Push with_contact(Push push, int contact) {
  std::visit([contact](auto& kind) { kind.contact = contact; }, push);
  return push;
}

/// Pushes [first, last) of a plan, one placement, and what they travelled before [m].
struct Run {
  std::size_t first, last;
  double travelled;
};

Run run_from(const Plan& plan, std::size_t first, double travelled) {
  const auto place = [&](std::size_t i) { return as_linear(plan.pushes[i].push).place; };
  std::size_t last = first + 1;
  while (last < plan.pushes.size() &&
         !std::holds_alternative<Roll>(plan.pushes[last].push) &&
         contact_of(plan.pushes[last].push) == contact_of(plan.pushes[first].push) &&
         place(last) == place(first)) {
    ++last;
  }
  return {first, last, travelled};
}

bool survives(const SearchModel& search, const Plan& plan, const Run& run, int contact,
              Work& work) {
  const Model& model = *search.model;
  const Vec2& g_O = model.contacts[contact].g_O;
  double travelled = run.travelled;
  for (std::size_t i = run.first; i < run.last; ++i) {
    const PlannedPush& push = plan.pushes[i];
    const Margin margin = carried(plan.margin, travelled);
    for (const Grasp& grasp : {push.start, push.end}) {
      const Vec2 p_OF = finger_in_object(grasp.X_HO);
      if (!(holding_slack(model, p_OF, g_O, margin) > 0.0)) return false;
      if (!pads_hold_gravity(model, grasp.X_HO, g_O, work)) return false;
    }
    if (!(push_slack(model, push.start, with_contact(push.push, contact), margin) >=
          0.0)) {
      return false;
    }
    travelled += travel_in_pad_plane(push.push);
  }
  return true;
}

}  // namespace

bool loosen_grip(const SearchModel& search, Work& work, Plan& plan) {
  const Model& model = *search.model;
  if (!model.scene.gripper.grip_range) return false;
  bool changed = false;
  double travelled = 0.0;
  for (std::size_t i = 0; i < plan.pushes.size();) {
    if (std::holds_alternative<Roll>(plan.pushes[i].push)) {
      ++i;
      continue;
    }
    const Run run = run_from(plan, i, travelled);
    const int own = contact_of(plan.pushes[i].push);
    const std::vector<int> weaker =
        model.contacts[own].is_point ? std::vector<int>{} : weaker_contacts(model, own);
    const auto weakest = std::find_if(weaker.begin(), weaker.end(), [&](int contact) {
      return survives(search, plan, run, contact, work);
    });
    for (; i < run.last; ++i) {
      travelled += travel_in_pad_plane(plan.pushes[i].push);
      if (weakest == weaker.end()) continue;
      plan.pushes[i].push = with_contact(plan.pushes[i].push, *weakest);
      changed = true;
    }
  }
  return changed;
}

}  // namespace prehensile
