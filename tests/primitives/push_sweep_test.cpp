/// Long sweeps over random pushes.
#include <algorithm>
#include <array>
#include <ctime>

#include <gtest/gtest.h>

#include "problems/random_pushes.h"
#include "tests/primitives/push_checks.h"

namespace prehensile {
namespace {

using testing::distance;

/// CPU time of one push [us].
double push_time(const Model& model, const RandomPush& c, double tolerance) {
  const TransitionOptions options{.tolerance = tolerance};
  const std::clock_t start = std::clock();
  int count = 0;
  while (std::clock() - start < CLOCKS_PER_SEC / 2000) {
    (void)apply(model, c.scene.start, c.push, options);
    ++count;
  }
  return 1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / count;
}

double quantile(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// Accuracy, honesty of the estimate and time over tolerances, for pushes that slip or
// tip.
TEST(PushSweepFull, ErrorAndTimeOverTolerances) {
  constexpr int kPushes = 3000;
  std::vector<Transition> references;
  for (int seed = 0; seed < kPushes; ++seed) {
    const RandomPush c = random_push(2, seed);
    references.push_back(apply(prepare(c.scene), c.scene.start, c.push,
                               {.tolerance = 1e-11, .max_steps = 20000}));
  }
  std::printf("tolerance  instants med/p99   us med/p99   error med/p99/max   covered\n");
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    std::vector<double> instants, times, errors;
    int covered = 0;
    int agree = 0;
    for (int seed = 0; seed < kPushes; ++seed) {
      const RandomPush c = random_push(2, seed);
      const Model model = prepare(c.scene);
      const Transition& reference = references[seed];
      const Transition t = apply(model, c.scene.start, c.push, {.tolerance = tolerance});
      agree += t.status == reference.status ? 1 : 0;
      const bool integrated = t.event_count > 0 || t.slipped > 0.0;
      if (t.status != reference.status || !integrated || t.done == 0.0) continue;
      errors.push_back(distance(t.end.X_HO, reference.end.X_HO, model.c));
      covered += errors.back() <= 3.0 * t.error_estimate + 1e-11 ? 1 : 0;
      instants.push_back(t.instants);
      if (seed % 10 == 0) times.push_back(push_time(model, c, tolerance));
    }
    const double share = covered / static_cast<double>(errors.size());
    std::printf("%7.0e   %5.0f %5.0f   %6.1f %6.1f   %.1e %.1e %.1e   %.4f\n", tolerance,
                quantile(instants, 0.5), quantile(instants, 0.99), quantile(times, 0.5),
                quantile(times, 0.99), quantile(errors, 0.5), quantile(errors, 0.99),
                quantile(errors, 1.0), share);
    EXPECT_GE(agree, 0.997 * kPushes);
    EXPECT_GT(share, 0.98);  // pads of few points: see push_estimate_test.cpp
    EXPECT_LT(quantile(errors, 0.99), tolerance);
  }
}

TEST(PushSweepFull, SweepHasNoUncertifiedOutcome) {
  std::array<int, 11> counts{};
  constexpr int kPushes = 50000;
  for (int seed = 0; seed < kPushes; ++seed) {
    const RandomPush c = random_push(3, seed);
    const Transition t = apply(prepare(c.scene), c.scene.start, c.push);
    ++counts[static_cast<int>(t.status)];
    EXPECT_NE(t.status, TransitionStatus::kUncertified) << seed;
  }
  for (int i = 0; i < 11; ++i) {
    const auto status = static_cast<TransitionStatus>(i);
    if (counts[i] > 0) std::printf("%6d %s\n", counts[i], name(status).data());
  }
  EXPECT_LE(counts[static_cast<int>(TransitionStatus::kIterationLimit)], kPushes / 1000);
}

}  // namespace
}  // namespace prehensile
