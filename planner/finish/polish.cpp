#include "planner/finish/polish.h"

#include <cmath>

#include "optimisation/nonlinear_program.h"
#include "planner/finish/stretch.h"

namespace prehensile {
namespace {

constexpr int kEvaluations = 600;
constexpr double kFirstStep = 0.03;      // over L
constexpr double kInfeasible = 1e6;      // cost of way-points that no chain passes
constexpr double kWorthwhile = 1e-4;     // relative gain below which the plan stays
constexpr std::size_t kMostPushes = 12;  // beyond it sub-plex gains too little
constexpr double kWorthBending = 0.02;   // relative gain for which pushes may be doubled
constexpr double kWorthBendingOfRealPads = 0.005;  // done once, of the best plan only

/// The best chain of a stretch that still sticks with the real pad; false if it gains
/// nothing.
bool shorten(const Steering& steering, const Limits& limits, Work& work,
             const Stretch& stretch, Chain& chain) {
  if (!chain_of(steering, stretch, stretch.way_points, work, chain)) return false;
  const double before = chain.cost;
  NonlinearProgram program;
  program.start = stretch.way_points;
  program.objective = [&](std::span<const double> x, std::span<double> /*gradient*/) {
    return chain_of(steering, stretch, x, work, chain) ? chain.cost : kInfeasible;
  };
  program.stop = [&limits] { return limits.reached(); };
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
void tighten(const Steering& steering, const Limits& limits, Work& work,
             std::vector<PlannedPush>& pushes) {
  const SearchModel& search = steering.search;
  Chain chain;
  while (pushes.size() >= 2 && pushes.size() <= kMostPushes && !limits.reached()) {
    Stretch stretch;
    if (!read_stretch(search, pushes, stretch)) return;
    if (drop_a_push(steering, work, stretch, chain)) {
      pushes = pushes_of(search, stretch, chain);
      continue;
    }
    if (shorten(steering, limits, work, stretch, chain)) {
      pushes = pushes_of(search, stretch, chain);
    }
    return;
  }
}

/// Lets every push bend in its middle, where the plan gets shorter by that.
void bend(const Steering& steering, const Limits& limits, Work& work,
          std::vector<PlannedPush>& pushes) {
  const SearchModel& search = steering.search;
  const double worth = steering.real_pads ? kWorthBendingOfRealPads : kWorthBending;
  Chain chain;
  while (2 * pushes.size() <= kMostPushes && !limits.reached()) {
    Stretch stretch;
    if (!read_stretch(search, pushes, stretch)) return;
    if (!chain_of(steering, stretch, stretch.way_points, work, chain)) return;
    const double before = chain.cost;
    const Stretch halves = halved(stretch);
    if (!shorten(steering, limits, work, halves, chain) ||
        chain.cost > before * (1.0 - worth)) {
      return;
    }
    pushes = pushes_of(search, halves, chain);
    tighten(steering, limits, work, pushes);
  }
}

void polish_by(const Steering& steering, const Limits& limits, Work& work, Plan& plan) {
  if (!nlopt_is_built()) return;
  change_stretches(plan, [&](std::vector<PlannedPush>& pushes) {
    tighten(steering, limits, work, pushes);
    if (pushes.size() >= 2) bend(steering, limits, work, pushes);
  });
}

}  // namespace

void polish(const SearchModel& search, const Limits& limits, Work& work, Plan& plan) {
  polish_by({search}, limits, work, plan);
}

void polish_with_real_pads(const SearchModel& search, const Limits& limits, Work& work,
                           Plan& plan) {
  const Model& model = *search.model;
  if (can_roll(model.scene.object) || model.has_soft_points()) return;
  const PadEnvelope pads(model, search.margin);
  polish_by({search, true, &pads}, limits, work, plan);
}

}  // namespace prehensile
