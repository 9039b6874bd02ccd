/// Plans of two and more straight pushes, in stages of growing effort.
/// Internal to the own planner.
#pragma once

#include <optional>

#include "planner/chains/label_search.h"

namespace prehensile {

/// A plan this close to its lower bound is not worth a search for better ones.
inline constexpr double kGoodEnough = 1.05;

/// The first chain found whose pushes stick with the real pad over the margin of
/// `search`, near the cheapest of its kind; none if every stage ends without one or a
/// limit is reached.
///
/// Pads that are not isotropic deflect friction from the motion, which the closed form
/// does not know. For them every stage proposes chains for wider margins first, so that
/// most proposals pass with the real pad.
///
/// `bound`: lower bound of J; no stage is entered once a plan is within 5 % of it.
std::optional<FoundChain> search_chains(const SearchModel& search, const FlatState& start,
                                        const GoalPlaces& goals, double bound,
                                        const Limits& limits, Work& work);

/// Three and more pushes over a lattice, for pads that the closed form knows exactly: the
/// cheapest over few nodes, or over more of them; none for other pads.
std::optional<FoundChain> search_exact_chains(const SearchModel& search,
                                              const FlatState& start,
                                              const GoalPlaces& goals,
                                              const Limits& limits, Work& work);

/// Two pushes through a lattice node with rotations that the real pads allow, cheaper
/// than `to_beat` (infinity: any); without an envelope (cans) also three and more.
std::optional<FoundChain> search_chains_of_real_pads(
    const SearchModel& search, const FlatState& start, const GoalPlaces& goals,
    const PadEnvelope* envelope, double to_beat, const Limits& limits, Work& work);

/// Three and more pushes over a lattice, cheaper than `to_beat` (infinity: any).
std::optional<FoundChain> search_long_chains(const SearchModel& search,
                                             const FlatState& start,
                                             const GoalPlaces& goals,
                                             const PadEnvelope* envelope, double to_beat,
                                             const Limits& limits, Work& work);

/// The first of these stages alone: two pushes through a crossing of cone lines, cheaper
/// than this J.
std::optional<FoundChain> search_crossings(const SearchModel& search,
                                           const FlatState& start,
                                           const GoalPlaces& goals, double to_beat,
                                           const Limits& limits, Work& work);

}  // namespace prehensile
