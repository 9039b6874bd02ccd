#include "planner/finish/loosen_grip.h"

#include <algorithm>
#include <vector>

#include "planner/checks/exact_check.h"
#include "planner/costs.h"
#include "planner/steering/holding.h"

namespace prehensile {
namespace {

/// The same pusher on the same face with every grip, its own included, weakest first.
std::vector<int> contacts_beside(const Model& model, int contact) {
  const PushContact& own = model.contacts[contact];
  std::vector<int> beside;
  for (int i = 0; i < static_cast<int>(model.contacts.size()); ++i) {
    const PushContact& other = model.contacts[i];
    if (other.pusher == own.pusher && other.face == own.face) beside.push_back(i);
  }
  std::sort(beside.begin(), beside.end(), [&](int a, int b) {
    return model.contacts[a].grip_share < model.contacts[b].grip_share;
  });
  return beside;
}

Push with_contact(Push push, int contact) {
  std::visit([contact](auto& kind) { kind.contact = contact; }, push);
  return push;
}

/// Pushes [first, last) of a plan, one placement.
struct Run {
  std::size_t first, last;
  double travelled;           ///< [m] before
  std::vector<int> contacts;  ///< that it survives with, weakest grip first
};

std::size_t end_of_run(const std::vector<PlannedPush>& pushes, std::size_t first) {
  std::size_t last = first + 1;
  while (last < pushes.size() && same_placement(pushes[last].push, pushes[first].push)) {
    ++last;
  }
  return last;
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

/// The contacts of a run: its own alone for rolls and about points.
std::vector<int> surviving(const SearchModel& search, const Plan& plan, const Run& run,
                           Work& work) {
  const Model& model = *search.model;
  const Push& push = plan.pushes[run.first].push;
  const int own = contact_of(push);
  if (std::holds_alternative<Roll>(push) || model.contacts[own].is_point) return {own};
  std::vector<int> contacts;
  for (const int contact : contacts_beside(model, own)) {
    if (contact == own || survives(search, plan, run, contact, work)) {
      contacts.push_back(contact);
    }
  }
  return contacts;
}

/// The cheapest grip for every run by dynamic programming over runs and their grips.
class GripChoice {
 public:
  GripChoice(const Model& model, const Plan& plan, const std::vector<Run>& runs)
      : model_(model), plan_(plan), runs_(runs), price_(prices(model)) {}

  /// Index into the contacts of each run.
  std::vector<std::size_t> best() {
    std::vector<std::vector<Node>> nodes(runs_.size());
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      for (std::size_t k = 0; k < runs_[i].contacts.size(); ++k) {
        nodes[i].push_back(reached(i, k, i > 0 ? nodes[i - 1] : std::vector<Node>{}));
      }
    }
    std::vector<std::size_t> chosen(runs_.size());
    std::size_t at = cheapest_end(nodes.back());
    for (std::size_t i = runs_.size(); i-- > 0;) {
      chosen[i] = at;
      at = nodes[i][at].before;
    }
    return chosen;
  }

 private:
  /// Best choice up to a run: what it costs, and the choice of the run before. Of equal
  /// ones the weakest grips come first, and stay.
  struct Node {
    double cost = 0.0;
    std::size_t before = 0;
    bool operator<(const Node& other) const { return cost < other.cost; }
  };

  Push push_of(std::size_t run, std::size_t choice) const {
    return with_contact(plan_.pushes[runs_[run].first].push, runs_[run].contacts[choice]);
  }

  double change_cost(const Push* before, const Push* after) const {
    return price_.grip_change * grip_changes_on_way(model_, before, after);
  }

  Node reached(std::size_t run, std::size_t choice,
               const std::vector<Node>& befores) const {
    const Push push = push_of(run, choice);
    Node best{.cost = change_cost(nullptr, &push)};
    for (std::size_t k = 0; k < befores.size(); ++k) {
      Node node = befores[k];
      const Push before = push_of(run - 1, k);
      node.cost += change_cost(&before, &push);
      node.before = k;
      if (k == 0 || node < best) best = node;
    }
    if (price_.work > 0.0) best.cost += price_.work * work_of(run, choice);
    return best;
  }

  double work_of(std::size_t run, std::size_t choice) const {
    double work = 0.0;
    for (std::size_t i = runs_[run].first; i < runs_[run].last; ++i) {
      PlannedPush planned = plan_.pushes[i];
      planned.push = with_contact(planned.push, runs_[run].contacts[choice]);
      work += friction_work(model_, planned);
    }
    return work;
  }

  std::size_t cheapest_end(std::vector<Node> ends) const {
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const Push push = push_of(runs_.size() - 1, k);
      ends[k].cost += change_cost(&push, nullptr);
    }
    return std::min_element(ends.begin(), ends.end()) - ends.begin();
  }

  const Model& model_;
  const Plan& plan_;
  const std::vector<Run>& runs_;
  CostWeights price_;
};

}  // namespace

bool loosen_grip(const SearchModel& search, Work& work, Plan& plan) {
  const Model& model = *search.model;
  if (!model.scene.gripper.grip_range || plan.pushes.empty()) return false;
  std::vector<Run> runs;
  double travelled = 0.0;
  for (std::size_t i = 0; i < plan.pushes.size(); i = runs.back().last) {
    Run run{i, end_of_run(plan.pushes, i), travelled, {}};
    run.contacts = surviving(search, plan, run, work);
    for (; i < run.last; ++i) travelled += travel_in_pad_plane(plan.pushes[i].push);
    runs.push_back(std::move(run));
  }
  const std::vector<std::size_t> chosen = GripChoice(model, plan, runs).best();
  bool changed = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const int contact = runs[i].contacts[chosen[i]];
    for (std::size_t k = runs[i].first; k < runs[i].last; ++k) {
      Push& push = plan.pushes[k].push;
      changed |= contact_of(push) != contact;
      push = with_contact(push, contact);
    }
  }
  return changed;
}

}  // namespace prehensile
