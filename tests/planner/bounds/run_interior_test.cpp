#include "planner/bounds/run_interior.h"

#include <gtest/gtest.h>

#include "tests/planner/run_programs.h"

namespace prehensile {
namespace {

using testing::for_random_runs;

constexpr int kMostSteps = 60;

/// What is found from above by places, and from below by multipliers alone, is the same;
/// or no run is as short as the cap.
TEST(RunInterior, MeetsItsDual) {
  int programs = 0, met = 0, refuted = 0, steps = 0;
  for_random_runs(40, 1, [&](const RunProgram& program, double cap) {
    RunInterior search(program);
    double bound = 0.0;
    for (int i = 0; i < kMostSteps && search.weight() > 1e-8 * cap; ++i) {
      ++steps;
      if (!search.step(1e-8 * cap)) break;
      bound = std::max(bound, dual_bound(program, search.multipliers()));
    }
    ++programs;
    const double value = search.objective();
    if (bound >= cap) {
      ++refuted;
      EXPECT_GE(value, cap);
    } else {
      // A violation has its price; some laws are worth more.
      EXPECT_LE(bound, value * (1.0 + 1e-4));
      met += value - bound <= 1e-3 * value ? 1 : 0;
    }
  });
  EXPECT_GT(met, programs / 5);
  EXPECT_GT(refuted, programs / 5);
  EXPECT_GT(met + refuted, 0.98 * programs) << programs;
  EXPECT_LT(steps, 25 * programs);
}

/// The nearer to the borders of the laws, the shorter.
TEST(RunInterior, ComesToTheMiddleOfItsLaws) {
  int programs = 0, central = 0, longer = 0;
  for_random_runs(40, 2, [&](const RunProgram& program, double cap) {
    const auto length_at = [&](double weight) {
      RunInterior search(program);
      for (int i = 0; i < kMostSteps && !search.is_central(weight); ++i) {
        if (!search.step(weight)) break;
      }
      central += search.is_central(weight) ? 1 : 0;
      return search.objective();
    };
    ++programs;
    longer += length_at(2e-3 * cap) > length_at(2e-4 * cap) ? 1 : 0;
  });
  EXPECT_GT(central, 0.97 * 2 * programs) << programs;
  EXPECT_GT(longer, 0.97 * programs);
}

}  // namespace
}  // namespace prehensile
