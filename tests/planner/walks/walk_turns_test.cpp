#include "planner/walks/walk_turns.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// Whatever a walk can have turned by in the end, its pushes make, each within its own
/// range, and all within the window.
TEST(WalkTurns, EveryEndIsMadeByThePushes) {
  Random random(1);
  int ends = 0;
  for (int i = 0; i < 500; ++i) {
    const TurnWindow window{random.in(-2.0, -0.1), random.in(0.1, 2.0)};
    std::vector<WalkEdge> edges(8);
    std::vector<Turned> turned = {Turned{}};
    for (WalkEdge& edge : edges) {
      edge.lo = random.in(-1.0, 1.0);
      edge.hi = edge.lo + (random.chance(0.2) ? 0.0 : random.in(0.0, 1.0));
      turned.push_back(turned_after(turned.back(), edge, window));
      if (turned.back().lo > turned.back().hi) break;
    }
    if (turned.back().lo > turned.back().hi) continue;
    ++ends;
    for (const double share : {0.0, 0.3, 1.0}) {
      double after = std::lerp(turned.back().lo, turned.back().hi, share);
      for (std::size_t k = edges.size(); k-- > 0;) {
        EXPECT_GE(after, window.low - 1e-12);
        EXPECT_LE(after, window.high + 1e-12);
        const double before = turned_before(turned[k], edges[k], turned[k + 1], after);
        EXPECT_GE(after - before, edges[k].lo - 1e-12);
        EXPECT_LE(after - before, edges[k].hi + 1e-12);
        after = before;
      }
      EXPECT_NEAR(after, 0.0, 1e-12);
    }
  }
  EXPECT_GE(ends, 100);
}

}  // namespace
}  // namespace prehensile
