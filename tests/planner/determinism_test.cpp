/// Same seed and budget, same plan: on any load, and in every build type. The hashes are
/// pinned; a change of one is a change of behaviour and belongs in the changelog.
#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "planner/planner.h"
#include "problems/published_regrasps.h"

namespace prehensile {
namespace {

/// FNV-1a over integers; reals enter rounded to 1e-9.
class Hash {
 public:
  void add(std::int64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      state_ ^= static_cast<std::uint64_t>(value >> (8 * byte)) & 0xFFU;
      state_ *= 1099511628211U;
    }
  }
  void add(double value) { add(static_cast<std::int64_t>(std::llround(value * 1e9))); }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 14695981039346656037U;
};

void add(Hash& hash, const Plan& plan) {
  hash.add(static_cast<std::int64_t>(plan.status));
  hash.add(plan.stick_tests);
  for (const PlannedPush& planned : plan.pushes) {
    const LinearPush push = as_linear(planned.push);
    hash.add(static_cast<std::int64_t>(push.contact));
    for (const double value :
         {push.place, push.e.x(), push.e.y(), push.travel, push.turn, planned.end.X_HO.x,
          planned.end.X_HO.y, planned.end.X_HO.theta}) {
      hash.add(value);
    }
  }
}

/// `polish` depends on how NLopt was built.
std::uint64_t hash_of_tees(std::uint64_t seed, bool polish,
                           const std::optional<Margin>& margin = {}) {
  Hash hash;
  for (int i = 0; i < kPublishedRegrasps; ++i) {
    PlanOptions options;
    options.seed = seed;
    options.polish = polish;
    options.margin = margin;
    add(hash, plan_regrasp(prepare(published_tee(i)), options));
  }
  return hash.value();
}

TEST(Determinism, PinnedHashOfPlans) {
  EXPECT_EQ(hash_of_tees(1, false), 5506638376410753841U);
  // Without grasp and tilt, which margins did not know of once.
  EXPECT_EQ(hash_of_tees(1, false, Margin{}), 1785823863524728227U);
}

TEST(Determinism, TheSameTwiceInOneProcess) {
  EXPECT_EQ(hash_of_tees(5, true), hash_of_tees(5, true));
}

TEST(Determinism, OurPlannerDrawsNothing) {
  EXPECT_EQ(hash_of_tees(1, true), hash_of_tees(2, true));
}

}  // namespace
}  // namespace prehensile
