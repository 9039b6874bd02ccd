#include "mechanics/spatial_search.h"

#include <algorithm>

namespace prehensile {
namespace {

constexpr int kFirstBudget = 150;
constexpr int kBudget = 200;
constexpr int kSpread = 12;
constexpr double kStiff = 1e-4;  ///< compliance below which continuation comes first
constexpr double kOtherMotion = 1e-5;
constexpr double kJamBalance = 1e-7;  ///< imbalance of unit forces that counts as none
constexpr int kJamTrials = 12;
constexpr double kJamShare = 1e-4;  ///< least force of a jam: push rate over compliance

/// All foundations at least this soft.
void soften(const ScaledSpatial& problem, double R, ScaledSpatial& softer) {
  for (int k = 0; k < problem.patch_count; ++k) {
    const double own = problem.patch[k].R;
    softer.patch[k].R = own > 0.0 ? std::max(own, R) : 0.0;
  }
}

/// Starts far from each other: fast turns either way, on which the object may leave the
/// pusher; the pusher's own motion; and a spread of rates.
NewtonStart spread_start(const ScaledSpatial& problem, int trial) {
  constexpr int kTurns = 6;
  NewtonStart start = {.r = trial % 2 == 0 ? 0.1 : 3.0, .e = 0.1};
  if (trial < kTurns) {
    start.v[5 - trial / 2] = trial % 2 == 0 ? 5.0 : -5.0;
  } else if (trial == kTurns) {
    start.v = problem.pusher;
  } else {
    for (int i = 0; i < problem.freedoms; ++i) {
      start.v[i] = 6.0 * (std::fmod(0.6180339887498949 * (8 * trial + i), 1.0) - 0.5);
    }
  }
  return start;
}

}  // namespace

bool SpatialSearch::attempt(const NewtonStart& start, int budget) {
  const int last = std::min(max_steps_, steps_ + budget);
  if (steps_ >= last) return false;
  result_ = run_newton(problem_, start, tolerance_, last, forces_, steps_);
  return result_.converged;
}

bool SpatialSearch::solve_directly(const NewtonStart* warm) {
  if (warm != nullptr && attempt(*warm, 40)) return true;
  if (problem_.least_compliance() < kStiff) return approach_compliance();
  return attempt({}, kFirstBudget);
}

bool SpatialSearch::solve_otherwise() {
  // An instant that resists one start mostly yields to the next.
  const SpatialRates& along = problem_.pusher;
  const std::array<NewtonStart, 5> starts = {{{.r = 3.0},
                                              {.v = along},
                                              {.e = 10.0, .pace = 30.0},
                                              {.r = 3.0, .e = 10.0},
                                              {.r = 3.0, .e = 0.1, .pace = 30.0}}};
  for (const NewtonStart& start : starts) {
    if (attempt(start, kBudget)) return true;
  }
  return false;
}

bool SpatialSearch::solve_stubbornly() {
  const SpatialRates& along = problem_.pusher;
  if (attempt({.e = 0.1}, kBudget)) return true;
  if (attempt({.r = 3.0, .pace = 1e-4}, kBudget)) return true;
  if (approach_friction() || approach_compliance() || approach_statics()) return true;
  // Small paces suit a pusher that all but grazes, large ones an object that swings.
  const std::array<NewtonStart, 16> slow = {
      {{.r = 3.0, .pace = 30.0},
       {.r = 3.0, .pace = 10.0},
       {.r = 3.0, .pace = 100.0},
       {.r = 3.0, .e = 0.1, .pace = 1e3},
       {.v = along, .r = 3.0, .e = 0.01, .pace = 1e3},
       {.v = along, .r = 0.03, .e = 0.1, .pace = 1e3},
       {.r = 3.0, .pace = 1e3},
       {.v = along, .r = 3.0, .e = 10.0},
       {.r = 30.0, .e = 10.0, .pace = 30.0},
       {.r = 3.0, .pace = 1e-2},
       {.r = 3.0, .pace = 1e-6},
       {.r = 3.0, .e = 0.1, .pace = 0.1},
       {.r = 30.0, .pace = 30.0},
       {.v = along, .r = 3.0, .e = 10.0, .pace = 3.0},
       {.r = 0.1, .e = 1.0, .pace = 0.03},
       {.v = along, .r = 0.03, .e = 0.1}}};
  for (const NewtonStart& start : slow) {
    if (attempt(start, 2 * kBudget)) return true;
  }
  for (int trial = 0; trial < kSpread; ++trial) {
    if (attempt(spread_start(problem_, trial), kBudget)) return true;
  }
  return false;
}

bool SpatialSearch::approach_statics() {
  SpatialForces known;
  NewtonStart start = {.r = 3.0};
  double mass = 1.0;
  for (int power = 0; power < 8; ++power, mass *= 0.1) {
    start.added_mass = mass;
    const int until = std::min(max_steps_, steps_ + kBudget);
    if (steps_ >= until) return false;
    result_ = run_newton(problem_, start, 1e-6, until, forces_, steps_);
    if (!result_.converged) return false;
    known = forces_;
    start = {.v = result_.v, .forces = &known};
  }
  return attempt(start, kBudget);
}

bool SpatialSearch::approach_friction() {
  double most = 0.0;
  for (int k = 0; k < problem_.patch_count; ++k) {
    most = std::max(most, problem_.patch[k].mu);
  }
  ScaledSpatial easier = problem_;
  SpatialForces known;
  NewtonStart start = {.r = 3.0};
  double level = std::min(0.3, 0.3 * most);
  double known_level = 0.0;
  double factor = 1.5;
  for (int trial = 0; trial < 40; ++trial) {
    const bool last = level >= most;
    for (int k = 0; k < problem_.patch_count; ++k) {
      easier.patch[k].mu = std::min(problem_.patch[k].mu, level);
    }
    const int until = std::min(max_steps_, steps_ + 100);
    if (steps_ >= until) return false;
    result_ = run_newton(easier, start, last ? tolerance_ : 1e-5, until, forces_, steps_);
    if (result_.converged) {
      if (last) return true;
      known = forces_;
      known_level = level;
      start = {.v = result_.v, .forces = &known, .r = 0.03};
      factor = std::min(1.5, factor * factor);
    } else {
      if (known_level == 0.0) return false;
      factor = std::sqrt(factor);
      if (factor < 1.001) return false;
    }
    level = std::min(most, known_level * factor);
  }
  return false;
}

bool SpatialSearch::approach_compliance() {
  const double target = problem_.least_compliance();
  if (!std::isfinite(target)) return false;
  ScaledSpatial softer = problem_;
  SpatialForces known;
  NewtonStart start = {.r = 3.0};
  double known_R = 0.0;
  double R = std::max(1e-2, target);
  double factor = 0.1;
  for (int trial = 0; trial < 40; ++trial) {
    const bool last = R <= target;
    soften(problem_, R, softer);
    const int until = std::min(max_steps_, steps_ + (known_R > 0.0 ? 80 : kBudget));
    if (steps_ >= until) return false;
    result_ = run_newton(softer, start, last ? tolerance_ : 1e-6, until, forces_, steps_);
    if (result_.converged) {
      if (last) return true;
      known = forces_;
      known_R = R;
      start = {.v = result_.v, .forces = &known, .r = 0.03};
      factor = std::max(0.1, factor * factor);
    } else {
      if (known_R == 0.0) return false;
      factor = std::sqrt(factor);
      if (factor > 0.98) return false;
    }
    R = std::max(target, known_R * factor);
  }
  return false;
}

bool SpatialSearch::find_other(SpatialForces& forces, SpatialRates& rates) {
  for (int trial = 0; trial < kSpread; ++trial) {
    int steps = 0;
    const NewtonResult other = run_newton(problem_, spread_start(problem_, trial),
                                          tolerance_, kBudget, forces, steps);
    steps_ += steps;
    if (!other.converged) continue;
    const double apart = (other.v - result_.v).norm();
    if (apart > kOtherMotion * (1.0 + result_.v.norm())) {
      rates = other.v;
      return true;
    }
  }
  return false;
}

/// In a jam forces grow like 1 / R, so in units that grow with them compliance stays and
/// gravity, drive, inertia and preload vanish: the jam is what is left.
bool SpatialSearch::find_jam(SpatialForces& forces) {
  double softest = 0.0;
  for (int k = 0; k < problem_.patch_count; ++k) {
    softest = std::max(softest, problem_.patch[k].R);
  }
  if (softest <= 0.0) return false;
  if (result_.converged) {
    SpatialForces known;
    for (int j = 0; j < problem_.padded; ++j) {
      known.n[j] = softest * forces_.n[j];
      known.t[j] = softest * forces_.t[j];
      known.o[j] = softest * forces_.o[j];
      known.s[j] = softest * forces_.s[j];
    }
    return follow_jam(softest, {.v = result_.v, .forces = &known, .r = 0.03}, forces);
  }
  // Compliance is of order one here, and little else holds the object.
  const std::array<NewtonStart, 3> starts = {{{.e = 10.0, .pace = 100.0},
                                              {.r = 0.03, .e = 10.0, .pace = 100.0},
                                              {.r = 3.0, .e = 10.0}}};
  for (const NewtonStart& start : starts) {
    if (follow_jam(softest, start, forces)) return true;
  }
  return false;
}

bool SpatialSearch::follow_jam(double softest, NewtonStart start, SpatialForces& forces) {
  ScaledSpatial jam = problem_;
  for (int k = 0; k < jam.patch_count; ++k) jam.patch[k].R /= softest;
  SpatialForces known;
  const double first = start.forces != nullptr ? 1.0 / softest : 100.0;
  double unit = first;
  for (int trial = 0; trial < kJamTrials; ++trial, unit *= 10.0) {
    jam.f = problem_.f / unit;
    jam.M = problem_.M / unit;
    for (int j = 0; j < jam.padded; ++j) jam.preload[j] = problem_.preload[j] / unit;
    int steps = 0;
    const NewtonResult next =
        run_newton(jam, start, tolerance_, 2 * kBudget, forces, steps);
    steps_ += steps;
    // Forces that do not grow with their unit are no jam.
    if (!next.converged || !(next.largest_force > kJamShare)) return false;
    if (1.0 / (unit * next.largest_force) < kJamBalance) {
      for (int j = 0; j < jam.padded; ++j) {
        for (double* f : {&forces.n[j], &forces.t[j], &forces.o[j], &forces.s[j]}) {
          *f /= next.largest_force;
        }
      }
      return true;
    }
    known = forces;
    start = {.v = next.v, .forces = &known, .r = 0.03};
  }
  return false;
}

}  // namespace prehensile
