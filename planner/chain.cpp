#include "planner/chain.h"

#include <algorithm>
#include <cmath>

#include "mechanics/certificate.h"

namespace prehensile {
namespace {

constexpr int kMaxCombinations = 256;
constexpr double kMostKappa = 1e4;  // beyond it a leg is a rotation on the spot

/// Slack of gravity above rounding, in units of the friction force.
constexpr double kFirmlyHeld = 1e-6;

using Intervals = std::array<KappaSet::Interval, Chain::kMaxLegs>;

/// The common value whose clipped copies sum up to `wanted` = c dtheta; NaN if out of
/// reach. sum_k l_k clip(x, I_k) rises with x and is linear between the ends of the I_k.
double common_kappa(const Chain& chain, const Intervals& intervals, double wanted) {
  const auto sum_at = [&](double x) {
    double sum = 0.0;
    for (int k = 0; k < chain.count; ++k) {
      sum += chain.legs[k].length * std::clamp(x, intervals[k].lo, intervals[k].hi);
    }
    return sum;
  };
  std::array<double, 2 * Chain::kMaxLegs> ends;
  for (int k = 0; k < chain.count; ++k) {
    ends[2 * k] = intervals[k].lo;
    ends[2 * k + 1] = intervals[k].hi;
  }
  const auto last = ends.begin() + 2 * chain.count;
  std::sort(ends.begin(), last);
  double low = ends[0];
  double sum_low = sum_at(low);
  if (wanted < sum_low) return kNan;
  for (auto end = ends.begin() + 1; end != last; ++end) {
    const double sum = sum_at(*end);
    if (wanted <= sum) {
      return sum > sum_low ? low + (*end - low) * (wanted - sum_low) / (sum - sum_low)
                           : low;
    }
    low = *end;
    sum_low = sum;
  }
  return kNan;
}

double travel_at(const Chain& chain, const Intervals& intervals, double kappa) {
  double travel = 0.0;
  for (int k = 0; k < chain.count; ++k) {
    const double clipped = std::clamp(kappa, intervals[k].lo, intervals[k].hi);
    travel += chain.legs[k].length * std::sqrt(1.0 + clipped * clipped);
  }
  return travel;
}

/// Steps to the next choice of one interval per leg, like an odometer.
bool next_choice(const Chain& chain, std::array<int, Chain::kMaxLegs>& choice) {
  for (int k = 0; k < chain.count; ++k) {
    if (++choice[k] < chain.legs[k].kappas.count) return true;
    choice[k] = 0;
  }
  return false;
}

/// A whole disc feels the same along a straight move, so its ends decide; other pads are
/// looked at every 2 mm and 0.1 rad.
int points_along(const SearchModel& search, const Move& move) {
  if (search.exact_everywhere) return 2;
  const double steps = std::max((move.to.p_OF - move.from.p_OF).norm() / 2e-3,
                                std::abs(move.to.theta - move.from.theta) / 0.1);
  return static_cast<int>(std::clamp(std::ceil(steps) + 1.0, 3.0, 24.0));
}

/// A uniform disc is at most 7 % weaker than the ellipsoid of the same F and c.
constexpr Margin kDiscBelowEllipsoid{.force = 0.08, .torque_radius = 0.0};

/// Whether the pads alone hold gravity at points along a move; for a whole disc its ends
/// decide.
bool pads_hold_gravity(const SearchModel& search, const Move& move, int points) {
  const Model& model = *search.model;
  const Vec2& g_O = model.contacts[search.contacts[move.contact].contact].g_O;
  if (g_O.isZero(0.0)) return true;
  const auto surely = [&](const FlatState& end) {
    return holding_slack(model, end.p_OF, g_O, kDiscBelowEllipsoid) > 0.0;
  };
  if (search.exact_everywhere && surely(move.from) && surely(move.to)) return true;
  for (int i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / (points - 1);
    const PlanarGrasp grasp = grasp_at(model, pose_along(move.from, move.to, share), g_O);
    if (!(gravity_slack(grasp) > kFirmlyHeld)) return false;
  }
  return true;
}

bool is_held(const SearchModel& search, int contact, const Stop& stop) {
  const Vec2& g_O = search.model->contacts[search.contacts[contact].contact].g_O;
  const Margin& margin = stop.given ? Margin::none() : search.margin;
  return holding_slack(*search.model, stop.p_OF, g_O, margin) > 0.0;
}

}  // namespace

bool make_leg(const SearchModel& search, int contact, const Stop& from, const Stop& to,
              Work& work, Leg& leg) noexcept {
  const SearchContact& pusher = search.contacts[contact];
  const Vec2 d = to.p_OF - from.p_OF;
  const double length = d.norm();
  if (length < kShortestLeg) return false;
  ++work.stick_tests;
  leg.kappas = robust_kappas(pusher.stick, from.p_OF, -d / length, search.margin);
  if (leg.kappas.empty() || !is_held(search, contact, from) ||
      !is_held(search, contact, to) ||
      !segment_on_object(*search.model, from.p_OF, to.p_OF)) {
    return false;
  }
  for (int i = 0; i < leg.kappas.count; ++i) {
    KappaSet::Interval& interval = leg.kappas.intervals[i];
    interval.lo = std::clamp(interval.lo, -kMostKappa, kMostKappa);
    interval.hi = std::clamp(interval.hi, -kMostKappa, kMostKappa);
  }
  leg.contact = contact;
  leg.from = from.p_OF;
  leg.to = to.p_OF;
  leg.length = length;
  return true;
}

int placements(const Chain& chain) noexcept {
  int runs = 0;
  for (int k = 0; k < chain.count; ++k) {
    if (k == 0 || chain.legs[k].contact != chain.legs[k - 1].contact) ++runs;
  }
  return runs;
}

bool solve_chain(const SearchModel& search, double dtheta, Chain& chain) noexcept {
  const double wanted = search.model->c * dtheta;
  double best_travel = std::numeric_limits<double>::infinity();
  std::array<int, Chain::kMaxLegs> choice{};
  for (int tried = 0; tried < kMaxCombinations; ++tried) {
    Intervals intervals;
    for (int k = 0; k < chain.count; ++k) {
      intervals[k] = chain.legs[k].kappas.intervals[choice[k]];
    }
    const double kappa = common_kappa(chain, intervals, wanted);
    const double travel =
        std::isnan(kappa) ? best_travel : travel_at(chain, intervals, kappa);
    if (travel < best_travel) {
      best_travel = travel;
      for (int k = 0; k < chain.count; ++k) {
        chain.kappa[k] = std::clamp(kappa, intervals[k].lo, intervals[k].hi);
      }
    }
    if (!next_choice(chain, choice)) break;
  }
  chain.cost = placements(chain) + best_travel / search.model->L;
  return std::isfinite(best_travel);
}

double turn_of(const SearchModel& search, const Chain& chain, int leg) {
  return chain.kappa[leg] * chain.legs[leg].length / search.model->c;
}

Move move_of(const SearchModel& search, const Chain& chain, int leg, double theta_from) {
  return {chain.legs[leg].contact,
          {chain.legs[leg].from, theta_from},
          {chain.legs[leg].to, theta_from + turn_of(search, chain, leg)}};
}

double exact_slack(const SearchModel& search, const Move& move, Work& work) noexcept {
  const int points = points_along(search, move);
  const double slack = move_slack(search, move, points, work);
  if (!(slack >= -kStickTolerance)) return slack;
  return pads_hold_gravity(search, move, points)
             ? slack
             : -std::numeric_limits<double>::infinity();
}

double chain_slack(const SearchModel& search, const Chain& chain, double theta_start,
                   Work& work) noexcept {
  double slack = std::numeric_limits<double>::infinity();
  double theta = theta_start;
  for (int k = 0; k < chain.count; ++k) {
    const Move move = move_of(search, chain, k, theta);
    slack = std::min(slack, exact_slack(search, move, work));
    if (slack < -kStickTolerance) return slack;
    theta = move.to.theta;
  }
  return slack;
}

}  // namespace prehensile
