#include "planner/chains/narrow_chain.h"

#include <algorithm>
#include <array>

#include "planner/steering/limits.h"

namespace prehensile {
namespace {

constexpr int kMostNarrowings = 8;
constexpr int kBisections = 4;
constexpr double kMostKappa = 30.0;  // steeper ones are not tried
constexpr double kLeastWidth = 1e-6;

bool sticks(const SearchModel& search, const Leg& leg, double theta, double kappa,
            Work& work) noexcept {
  const double turn = kappa * leg.length / search.model->c;
  const Move move{leg.contact, {leg.from, theta}, {leg.to, theta + turn}};
  return exact_slack(search, move, work) >= -kStickTolerance;
}

/// Keeps of the interval that holds `kappa`, which slips, what is on the side of those
/// that stick: the middle, or no turn at all. None of it if neither does.
void narrow(const SearchModel& search, double theta, double kappa, Leg& leg,
            Work& work) noexcept {
  KappaSet& kappas = leg.kappas;
  const auto end = kappas.intervals.begin() + kappas.count;
  const auto around =
      std::min_element(kappas.intervals.begin(), end, [&](const auto& a, const auto& b) {
        const auto off = [&](const KappaSet::Interval& interval) {
          return std::max({0.0, interval.lo - kappa, kappa - interval.hi});
        };
        return off(a) < off(b);
      });
  const double low = std::max(around->lo, -kMostKappa);
  const double high = std::min(around->hi, kMostKappa);
  const std::array sure = {0.5 * (low + high), std::clamp(0.0, around->lo, around->hi)};
  const auto is_good = [&](double one) {
    return std::abs(one - kappa) > kLeastWidth && sticks(search, leg, theta, one, work);
  };
  const auto good = low < high ? std::ranges::find_if(sure, is_good) : sure.end();
  if (good == sure.end()) {
    std::move(around + 1, end, around);
    --kappas.count;
    return;
  }
  double inside = *good;
  double outside = kappa;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (inside + outside);
    (sticks(search, leg, theta, middle, work) ? inside : outside) = middle;
  }
  (kappa > inside ? around->hi : around->lo) = inside;
}

/// The first push that slips, with its kappas narrowed; negative if none does.
int narrow_first_slip(const SearchModel& search, double theta, Chain& chain,
                      Work& work) noexcept {
  for (int k = 0; k < chain.count; ++k) {
    if (!sticks(search, chain.legs[k], theta, chain.kappa[k], work)) {
      narrow(search, theta, chain.kappa[k], chain.legs[k], work);
      return k;
    }
    theta += turn_of(search, chain, k);
  }
  return -1;
}

}  // namespace

NarrowedChain narrow_until_it_sticks(const SearchModel& search, double theta_start,
                                     double dtheta, double to_beat, Chain& chain,
                                     Work& work) noexcept {
  NarrowedChain result;
  const TurnWindow window = turns_from(search, theta_start);
  for (int i = 0; i < kMostNarrowings; ++i) {
    if (!solve_chain(search, dtheta, chain, window)) {
      work.stopped_by.add(PushConstraint::kRotation);
      return result;
    }
    if (chain.cost >= to_beat) return result;
    if (chain_passes(search, chain, theta_start, work)) {
      result.sticks = true;
      return result;
    }
    const int leg = narrow_first_slip(search, theta_start, chain, work);
    if (leg < 0) {
      result.sticks = make_chain_stick(search, theta_start, dtheta, chain, work);
      return result;
    }
    result.narrowed.set(static_cast<std::size_t>(leg));
    if (chain.legs[leg].kappas.empty()) return result;
  }
  return result;
}

}  // namespace prehensile
