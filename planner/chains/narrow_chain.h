/// Chains of which a push slips with the pads as they are. Internal to the own planner.
#pragma once

#include <bitset>

#include "planner/steering/chain.h"

namespace prehensile {

struct NarrowedChain {
  bool sticks = false;
  std::bitset<Chain::kMaxLegs> narrowed;  ///< legs that have lost kappas
};

/// Solves a chain; of a leg that slips over the margin of `search` only those kappas are
/// kept that stick, as far as a few of them tell, and the rest is solved again, some
/// times over. Where it is not a slip that keeps a chain from passing, it is moved to the
/// middle of its kappas (make_chain_stick). No heap.
///
/// `to_beat`: chains that cost as much are not looked at.
NarrowedChain narrow_until_it_sticks(const SearchModel& search, double theta_start,
                                     double dtheta, double to_beat, Chain& chain,
                                     Work& work) noexcept;

}  // namespace prehensile
