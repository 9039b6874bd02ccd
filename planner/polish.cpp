#include "planner/polish.h"

#include <cmath>

#include "optimisation/nonlinear_program.h"
#include "planner/chain.h"
#include "planner/goal.h"
#include "planner/push_search.h"

namespace prehensile {
namespace {

constexpr int kEvaluations = 600;
constexpr double kFirstStep = 0.03;      // over L
constexpr double kInfeasible = 1e6;      // cost of way-points that no chain passes
constexpr double kWorthwhile = 1e-4;     // relative gain below which the plan stays
constexpr std::size_t kMostPushes = 12;  // beyond it sub-plex gains too little
constexpr double kWorthBending = 0.02;   // relative gain for which pushes may be doubled

/// The part of a plan between two rolls: moves only.
struct Stretch {
  FlatState start, end;
  double psi = 0.0;
  std::vector<int> contacts;       // by push, index in SearchModel::contacts
  std::vector<double> way_points;  // x, y of p_OF between the pushes
};

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

/// The chain of a stretch through these way-points, solved; false if there is none.
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

/// The best chain of a stretch that still sticks with the real pad; false if it gains
/// nothing.
bool shorten(const Steering& steering, const Limits& limits, Work& work,
             const Stretch& stretch, Chain& chain) {
  if (!chain_of(steering, stretch, stretch.way_points, work, chain)) return false;
  const double before = chain.cost;
  NonlinearProgram program;
  program.start = stretch.way_points;
  program.objective = [&](std::span<const double> x, std::span<double> /*gradient*/) {
    const bool possible =
        !limits.reached() && chain_of(steering, stretch, x, work, chain);
    return possible ? chain.cost : kInfeasible;
  };
  const NlpResult result =
      minimise_nlopt(program, LocalMethod::kSubplex,
                     {.tolerance = 1e-6, .max_evaluations = kEvaluations},
                     kFirstStep * steering.search.model->L);
  if (result.x.size() != stretch.way_points.size()) return false;
  return chain_of(steering, stretch, result.x, work, chain) &&
         chain.cost < before * (1.0 - kWorthwhile) &&
         chain_passes(steering.search, chain, stretch.start.theta, work);
}

/// Same, with one push of the stretch left out.
bool drop_a_push(const Steering& steering, Work& work, const Stretch& stretch,
                 Chain& chain) {
  if (!chain_of(steering, stretch, stretch.way_points, work, chain)) return false;
  const double before = chain.cost;
  for (std::size_t k = 0; k < stretch.contacts.size(); ++k) {
    Stretch shorter = stretch;
    shorter.contacts.erase(shorter.contacts.begin() + static_cast<std::ptrdiff_t>(k));
    const std::size_t point = std::min(k, stretch.contacts.size() - 2);
    const auto x = shorter.way_points.begin() + static_cast<std::ptrdiff_t>(2 * point);
    shorter.way_points.erase(x, x + 2);
    if (chain_of(steering, shorter, shorter.way_points, work, chain) &&
        chain.cost <= before &&
        chain_passes(steering.search, chain, stretch.start.theta, work)) {
      return true;
    }
  }
  return false;
}

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

std::vector<PlannedPush> pushes_of(const SearchModel& search, const Stretch& stretch,
                                   const Chain& chain) {
  Plan part;
  part.start = grasp_of(stretch.start, stretch.psi);
  double theta = stretch.start.theta;
  for (int k = 0; k < chain.count; ++k) {
    const Move move = move_of(search, chain, k, theta);
    append_move(search, move, part);
    theta = move.to.theta;
  }
  return part.pushes;
}

/// The stretch with each push in two halves, which the same contact makes.
Stretch halved(const Stretch& stretch) {
  Stretch halves = stretch;
  halves.contacts.clear();
  halves.way_points.clear();
  const auto keep = [&halves](const Vec2& p_OF) {
    halves.way_points.push_back(p_OF.x());
    halves.way_points.push_back(p_OF.y());
  };
  Vec2 from = stretch.start.p_OF;
  for (std::size_t k = 0; k < stretch.contacts.size(); ++k) {
    const bool last = k + 1 == stretch.contacts.size();
    const Vec2 to = last ? stretch.end.p_OF
                         : Vec2(stretch.way_points[2 * k], stretch.way_points[2 * k + 1]);
    halves.contacts.insert(halves.contacts.end(), 2, stretch.contacts[k]);
    keep(0.5 * (from + to));
    if (!last) keep(to);
    from = to;
  }
  return halves;
}

/// Leaves out pushes and moves way-points until neither brings anything.
void tighten(const SearchModel& search, const Limits& limits, Work& work,
             std::vector<PlannedPush>& pushes) {
  Chain chain;
  while (pushes.size() >= 2 && pushes.size() <= kMostPushes && !limits.reached()) {
    Stretch stretch;
    if (!read_stretch(search, pushes, stretch)) return;
    if (drop_a_push({search}, work, stretch, chain)) {
      pushes = pushes_of(search, stretch, chain);
      continue;
    }
    if (shorten({search}, limits, work, stretch, chain)) {
      pushes = pushes_of(search, stretch, chain);
    }
    return;
  }
}

/// Lets every push bend in its middle, where the plan gets shorter by that.
void bend(const SearchModel& search, const Limits& limits, Work& work,
          std::vector<PlannedPush>& pushes) {
  Chain chain;
  while (2 * pushes.size() <= kMostPushes && !limits.reached()) {
    Stretch stretch;
    if (!read_stretch(search, pushes, stretch)) return;
    if (!chain_of({search}, stretch, stretch.way_points, work, chain)) return;
    const double before = chain.cost;
    const Stretch halves = halved(stretch);
    if (!shorten({search}, limits, work, halves, chain) ||
        chain.cost > before * (1.0 - kWorthBending)) {
      return;
    }
    pushes = pushes_of(search, halves, chain);
    tighten(search, limits, work, pushes);
  }
}

/// Pushes of one stretch, shorter if possible.
std::vector<PlannedPush> polished(const SearchModel& search, const Limits& limits,
                                  Work& work, std::vector<PlannedPush> pushes) {
  tighten(search, limits, work, pushes);
  if (pushes.size() >= 2) bend(search, limits, work, pushes);
  return pushes;
}

}  // namespace

void polish(const SearchModel& search, const Limits& limits, Work& work, Plan& plan) {
  if (!nlopt_is_built()) return;
  std::vector<PlannedPush> result, stretch;
  const auto finish_stretch = [&] {
    for (PlannedPush& push : polished(search, limits, work, stretch)) {
      result.push_back(std::move(push));
    }
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

}  // namespace prehensile
