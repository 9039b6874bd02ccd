#include "planner/chains/narrow_chain.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::kNoBudget;
using testing::Random;

constexpr double kAnyCost = std::numeric_limits<double>::infinity();

/// A chain of legs between random places of a T; its kappas are those of the rings of
/// discs, which is not all that their points allow.
std::optional<Chain> random_chain(const SearchModel& search, Random& random, Work& work) {
  Chain chain;
  Vec2 at(random.in(-0.04, 0.02), random.in(-0.01, 0.01));
  for (int trial = 0; trial < 60 && chain.count < 3; ++trial) {
    const Vec2 to(random.in(-0.04, 0.02), random.in(-0.01, 0.01));
    const int contact = random.below(static_cast<int>(search.contacts.size()));
    Leg& leg = chain.legs[chain.count];
    if (!make_leg({search}, contact, {at}, {to}, work, leg)) continue;
    ++chain.count;
    at = to;
  }
  if (chain.count < 3) return std::nullopt;
  return chain;
}

/// This share of the range of its rotations [rad].
double turn_at(double share, const SearchModel& search, const Chain& chain) {
  double low = 0.0;
  double high = 0.0;
  for (int k = 0; k < chain.count; ++k) {
    const Leg& leg = chain.legs[k];
    low += leg.length * leg.kappas.intervals[0].lo;
    high += leg.length * leg.kappas.intervals[leg.kappas.count - 1].hi;
  }
  return (low + share * (high - low)) / search.model->c;
}

double width_of(const KappaSet& kappas) {
  double width = 0.0;
  for (int i = 0; i < kappas.count; ++i) {
    width += kappas.intervals[i].hi - kappas.intervals[i].lo;
  }
  return width;
}

TEST(NarrowChain, FindsKappasThatStick) {
  const Model model = prepare(published_tee(0));
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = kNoBudget};
  Random random(1);
  int slips = 0;
  int mended = 0;
  for (int i = 0; i < 300; ++i) {
    auto chain = random_chain(search, random, work);
    if (!chain) continue;
    const double share = random.chance(0.5) ? random.in(0.9, 1.0) : random.in(0.0, 0.1);
    const double dtheta = turn_at(share, search, *chain);
    const Chain before = *chain;
    if (!solve_chain(search, dtheta, *chain)) continue;
    const bool passed = chain_passes(search, *chain, 0.3, work);
    const NarrowedChain result =
        narrow_until_it_sticks(search, 0.3, dtheta, kAnyCost, *chain, work);
    slips += passed ? 0 : 1;
    if (passed) {
      EXPECT_TRUE(result.sticks);
      EXPECT_TRUE(result.narrowed.none());
    }
    for (int k = 0; k < chain->count; ++k) {
      const KappaSet& now = chain->legs[k].kappas;
      const KappaSet& then = before.legs[k].kappas;
      for (int j = 0; j < now.count; ++j) {
        EXPECT_TRUE(then.contains(now.intervals[j].lo));
        EXPECT_TRUE(then.contains(now.intervals[j].hi));
      }
      const bool has_lost = width_of(now) < width_of(then) || now.count < then.count;
      EXPECT_EQ(has_lost, result.narrowed[k]);
    }
    if (!result.sticks) continue;
    mended += passed ? 0 : 1;
    EXPECT_TRUE(chain_passes(search, *chain, 0.3, work));
    double turn = 0.0;
    for (int k = 0; k < chain->count; ++k) turn += turn_of(search, *chain, k);
    EXPECT_NEAR(turn, dtheta, 1e-9);
  }
  EXPECT_GT(slips, 20);
  EXPECT_GT(mended, 5);
}

TEST(NarrowChain, LooksAtNothingThatCostsTooMuch) {
  const Model model = prepare(published_tee(0));
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = kNoBudget};
  Random random(2);
  int chains = 0;
  for (int i = 0; i < 50; ++i) {
    auto chain = random_chain(search, random, work);
    if (!chain) continue;
    const double dtheta = turn_at(0.5, search, *chain);
    if (!solve_chain(search, dtheta, *chain)) continue;
    ++chains;
    const double cost = chain->cost;
    EXPECT_FALSE(narrow_until_it_sticks(search, 0.0, dtheta, cost, *chain, work).sticks);
  }
  EXPECT_GT(chains, 10);
}

}  // namespace
}  // namespace prehensile
