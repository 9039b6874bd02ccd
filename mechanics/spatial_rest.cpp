/// Whether the pads alone hold the object, and how it falls where they do not.
#include <algorithm>

#include "mechanics/spatial_search.h"

namespace prehensile {
namespace {

constexpr int kFirstBudget = 150;
constexpr int kBudget = 200;
constexpr int kRestBudget = 60;
constexpr double kRestTolerance = 1e-8;
constexpr double kLeastStride = 1e-3;    ///< shares of the weight
constexpr double kHeldRate = 10.0;       ///< rates of a held object, as foundations yield
constexpr double kAtRest = 1e-7;         ///< rates of an object at rest on rigid pads
constexpr double kMostYield = 0.05;      ///< the most that still counts as rest
constexpr double kIdle = 1e-9;           ///< a pusher that carries less carries nothing
constexpr double kFallRate = 10.0;       ///< rates that no pusher or foundation causes
constexpr double kFallTolerance = 1e-8;  ///< enough for evidence

/// Gravity and the drive of the jaws gain more power than pads and pusher (seen at rest)
/// take, by a margin.
bool gains(const ScaledSpatial& problem, const SpatialRates& v,
           const SpatialForces& forces, bool pads_only) {
  double gain = problem.f.dot(v);
  double pusher_takes = 0.0;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ScaledPatch& patch = problem.patch[k];
    const LocalRates y = patch.local_rates(v);
    double power = 0.0;
    for (int j = patch.first; j < patch.first + patch.count; ++j) {
      const double a = problem.a[j];
      const double b = problem.b[j];
      power += forces.n[j] * (y[0] + b * y[1] - a * y[2]) +
               forces.t[j] * (y[3] - b * y[5]) + forces.o[j] * (y[4] + a * y[5]);
      if (patch.soft) power += forces.s[j] * patch.e * y[5];
    }
    if (patch.body != ContactBody::kPusher) {
      gain += power;
    } else if (!pads_only) {
      pusher_takes -= power;
    }
  }
  return gain > std::max(0.0, pusher_takes) + 1e-8 * v.norm();
}

}  // namespace

/// The pads alone; keeps how the object rests, if it does.
NewtonResult SpatialSearch::rest_from(NewtonStart start, int budget) {
  start.pads_only = true;
  int steps = 0;
  const NewtonResult rest =
      run_newton(problem_, start, kRestTolerance, budget, rest_forces_, steps);
  steps_ += steps;
  rest_rates_ = rest.v;
  return rest;
}

SpatialSearch::Hold SpatialSearch::judge_hold(const NewtonStart* last) {
  if (last != nullptr) {
    const NewtonResult rest = rest_from(*last, kFirstBudget);
    if (rest.converged && rest.v.norm() <= kHeldRate) return Hold::kHeld;
  }
  return judge_hold(false);
}

SpatialSearch::Hold SpatialSearch::judge_hold_patiently() { return judge_hold(true); }

/// Weight by weight: close to the limit a rest is seldom found at once.
bool SpatialSearch::approach_rest() {
  ScaledSpatial lighter = problem_;
  SpatialForces known;
  NewtonStart start = {.pads_only = true};
  double level = 0.5;
  double known_level = 0.0;
  double stride = 0.25;
  while (stride > kLeastStride) {
    lighter.f.head<6>() = level * problem_.f.head<6>();
    int steps = 0;
    const NewtonResult rest =
        run_newton(lighter, start, kRestTolerance, kRestBudget, rest_forces_, steps);
    steps_ += steps;
    if (rest.converged && rest.v.norm() <= kHeldRate) {
      rest_rates_ = rest.v;
      if (level == 1.0) return true;
      known = rest_forces_;
      known_level = level;
      start = {.v = rest.v, .forces = &known, .r = 0.03, .pads_only = true};
    } else {
      if (known_level == 0.0) return false;
      stride *= 0.25;
    }
    level = std::min(1.0, known_level + stride);
  }
  return false;
}

SpatialSearch::Hold SpatialSearch::judge_hold(bool patiently) {
  // Where every point sticks, one stiff step tells.
  const std::array<NewtonStart, 5> starts = {
      {{.r = 1e-9}, {}, {.e = 0.1}, {.r = 3.0, .pace = 1e-3}, {.r = 3.0, .e = 10.0}}};
  // Jaws that both give way leave the object free along the grip: that is no fall.
  const bool drifts = problem_.freedoms == 8;
  bool ran_away = false;
  for (std::size_t k = patiently || drifts ? 2 : 0; k < starts.size(); ++k) {
    const NewtonResult rest = rest_from(starts[k], k == 0 ? 3 : kFirstBudget);
    if (rest.converged) return rest.v.norm() <= kHeldRate ? Hold::kHeld : Hold::kFalls;
    if (k == 0) continue;
    ran_away = ran_away || rest.runs_away;
    if (ran_away && !patiently) break;
  }
  return ran_away ? Hold::kFalls : Hold::kUnknown;
}

bool SpatialSearch::is_at_rest() const {
  double yield = kAtRest;
  for (int k = 0; k < problem_.patch_count; ++k) {
    yield = std::max(yield, std::min(kMostYield, 5.0 * problem_.patch[k].R));
  }
  return result_.v.norm() <= yield;
}

bool SpatialSearch::rests_in_pads() const {
  bool idle = true;
  for (int k = 0; k < problem_.patch_count; ++k) {
    const ScaledPatch& patch = problem_.patch[k];
    for (int j = patch.first; j < patch.first + patch.count; ++j) {
      if (patch.body == ContactBody::kPusher && forces_.n[j] > kIdle) idle = false;
    }
  }
  return idle && is_at_rest();
}

bool SpatialSearch::find_fall(bool pads_only, SpatialForces& forces,
                              SpatialRates& rates) {
  // Rounding of the rates against the yield of foundations: no faster than needed.
  const double enough = std::clamp(1e8 * problem_.least_compliance(), 100.0, 1e4);
  SpatialForces known;
  NewtonStart start;
  const auto fall_with = [&](double mass, int budget) {
    start.pads_only = pads_only;
    start.added_mass = mass;
    int steps = 0;
    const NewtonResult fall =
        run_newton(problem_, start, kFallTolerance, budget, forces, steps);
    steps_ += steps;
    if (fall.converged) rates = fall.v;
    return fall.converged;
  };
  const auto settle_at = [&](double mass) {
    start = {.r = 3.0};
    if (fall_with(mass, kBudget)) return true;
    start = {.r = 3.0, .pace = 10.0};
    return fall_with(mass, kBudget);
  };
  double mass = 1e-4;
  // Any object is slow if it is heavy enough.
  for (const double heavier : {1e-4, 1.0}) {
    mass = heavier;
    if (!settle_at(mass)) continue;
    // The rates are the imbalance over the mass: follow it down, or back up.
    for (int trial = 0; trial < 20; ++trial) {
      const double rate = rates.norm();
      const bool proves = gains(problem_, rates, forces, pads_only);
      if (proves && rate > 0.3 * enough && rate < 30.0 * enough) return true;
      if (rate < 1e-8 / mass || rate > 1e6) return false;
      const double factor = proves ? std::clamp(rate / enough, 0.1, 10.0) : 0.1;
      mass *= factor;
      known = forces;
      const SpatialRates before = rates;
      // Rates that follow the mass, unless the pusher holds them.
      start = {.v = before / factor, .forces = &known};
      if (fall_with(mass, kBudget)) continue;
      start.v = before;
      if (fall_with(mass, kBudget) || settle_at(mass)) continue;
      forces = known;
      rates = before;
      break;
    }
    if (rates.norm() > kFallRate && gains(problem_, rates, forces, pads_only)) {
      return true;
    }
  }
  return false;
}

}  // namespace prehensile
