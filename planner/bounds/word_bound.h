/// Lower bounds from branch and bound over the words of contacts and their switch points.
/// Internal to the planner.
#pragma once

#include <cstdint>

#include "planner/bounds/word_goal.h"

namespace prehensile {

/// A bound on J over all plans in the pad plane that is at most `target`: equal to it if
/// that is proved. `nodes` counts down; no more work is done at 0, and what is left open
/// counts with the bound that it has.
double word_bound(const WordScene& scene, const WordQuestion& question, double target,
                  std::int64_t& nodes, const WordVisitor& visit = {});

/// The scene of a model; `laws` must outlive it.
WordScene word_scene(const Model& model, const RunLaws& laws);

}  // namespace prehensile
