/// Plans of one placement, for lower bounds: runs of one contact, by winding and range of
/// turns. Internal to the planner.
#pragma once

#include <cstdint>

#include "planner/bounds/word_goal.h"

namespace prehensile {

/// A bound on J over all plans of one placement, at most `target`; as word_bound.
double single_runs(const WordScene& scene, const WordQuestion& question, double target,
                   std::int64_t& nodes, const WordVisitor& visit);

}  // namespace prehensile
