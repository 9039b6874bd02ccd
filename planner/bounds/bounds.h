/// Lower bounds on the cost J of any sticking plan, over the whole goal set: tolerances,
/// free coordinates and whole turns included.
#pragma once

#include <cstdint>
#include <functional>

#include "mechanics/sticking.h"

namespace prehensile {

struct WordNode;

/// Least distance in (p_OF, c theta) from a grasp to the goal set, rounded down [m].
double distance_to_goal(const Model& model, const Grasp& start, const Goal& goal);

/// A goal without the room that its tolerances leave: a thousandth of them.
Goal goal_itself(const Goal& goal);

/// J >= this for every plan of sticking pushes and rolls that reaches the goal; 0 at the
/// goal. From distances alone: one placement, and the straight way.
double trivial_bound(const Model& model, const Grasp& start, const Goal& goal);

/// What the search takes for a bound: it supposes that the friction of round pads points
/// exactly along their motion, which that of a discretised pad does only nearly. A guide,
/// and no bound.
double guide_bound(const Model& model, const Grasp& start, const Goal& goal);

/// Cost over bound that is good enough: a gap of 10 %, and a little less, so that
/// rounding does not make it more.
inline constexpr double kGapAsked = 1.0999;

/// Work of the bounds below: boxes of switch points looked at, about a microsecond each.
/// What slabs cost (slab_travel.h, run_slabs.h) is not in it: 1 to 20 ms for a scene and
/// a goal, where it comes to plans of three placements, and some milliseconds for each
/// contact and winding of which the program alone does not prove enough, nine at most.
inline constexpr std::int64_t kBoundNodes = 6000;

struct BoundOptions {
  std::int64_t nodes = kBoundNodes;
  Margin margin = Margin::none();  ///< of plans that survive it
};

struct LowerBound {
  double value = kNan;
  bool is_trivial = true;  ///< nothing about pushers was proved: value = trivial_bound
  std::int64_t nodes = 0;  ///< work done
};

/// A bound of at most `cost` that can be proved with this work: first it is tried to
/// prove that no plan costs less than `cost` / 1.1, then that none costs less than
/// `cost`. Nothing is tried where the trivial bound is within 10 % of the cost. By a
/// convex program for one placement (run_bound.h), and by branch and bound over the
/// sequences of contacts and the places where they switch (word_bound.h), with what a way
/// across the object costs whichever contacts push (slab_travel.h), those of the nominal
/// scene. Over round pads it is a bound for plans that stick with their rings
/// (ring_pads.h) over the margin, as every plan has to. Trivial where the goal leaves a
/// coordinate of the place free, where the pads are neither soft points nor whole discs
/// wherever they are, and where pushes need the mechanics in space. Deterministic.
LowerBound lower_bound(const Model& model, const Grasp& start, const Goal& goal,
                       double cost, const BoundOptions& options = {});

/// The nodes that the branch and bound of `lower_bound` divides in order to prove
/// `target`: sequences of contacts with the places between them, where a plan cheaper
/// than `target` would have to be, best first for each number of placements. Counts
/// `nodes` down. None where that bound is trivial.
void visit_words(const Model& model, const Grasp& start, const Goal& goal, double target,
                 const Margin& margin, std::int64_t& nodes,
                 const std::function<void(const WordNode&)>& visit);

/// Whether J >= `claimed` can be proved with this work: the answer that a reader of a
/// plan wants.
bool bound_holds(const Model& model, const Grasp& start, const Goal& goal, double claimed,
                 const BoundOptions& options = {.nodes = 4 * kBoundNodes});

}  // namespace prehensile
