/// Ipopt through the plain programme: known minima, silence, honest statuses, threads.
#include <thread>

#include <gtest/gtest.h>

#include "tests/optimisation/classic_programs.h"

namespace prehensile {
namespace {

using testing::hock_schittkowski_71;
using testing::kHockSchittkowski71;
using testing::largest_difference;
using testing::random_quadratic;
using testing::rosenbrock;

class Ipopt : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!ipopt_is_built()) GTEST_SKIP() << "built without Ipopt";
  }
};

TEST_F(Ipopt, SolvesTheClassicWithAndWithoutItsHessian) {
  for (const bool exact : {true, false}) {
    NonlinearProgram program = hock_schittkowski_71();
    if (!exact) program.hessian = nullptr;
    const NlpResult result = minimise_ipopt(program);
    EXPECT_EQ(result.status, NlpStatus::kConverged) << result.message;
    EXPECT_LT(largest_difference(result.x, kHockSchittkowski71), 1e-6) << exact;
    EXPECT_NEAR(result.objective, 17.0140173, 1e-6);
    EXPECT_GT(result.evaluations, 3);
  }
}

TEST_F(Ipopt, DescendsWithoutConstraints) {
  const NlpResult result = minimise_ipopt(rosenbrock());
  EXPECT_EQ(result.status, NlpStatus::kConverged) << result.message;
  EXPECT_LT(largest_difference(result.x, {1.0, 1.0}), 1e-6);
}

TEST_F(Ipopt, FindsKnownQuadraticMinima) {
  testing::Random random(12);
  for (int i = 0; i < 40; ++i) {
    const auto [program, answer] = random_quadratic(random, 8 + i, 2 + i / 5);
    const NlpResult result = minimise_ipopt(program);
    EXPECT_EQ(result.status, NlpStatus::kConverged) << result.message;
    EXPECT_LT(largest_difference(result.x, answer), 1e-5) << i;
  }
}

TEST_F(Ipopt, IsQuietAndRepeatable) {
  ::testing::internal::CaptureStdout();
  const NlpResult one = minimise_ipopt(hock_schittkowski_71());
  const NlpResult two = minimise_ipopt(hock_schittkowski_71());
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.evaluations, two.evaluations);
}

TEST_F(Ipopt, SaysWhenItFailed) {
  EXPECT_EQ(minimise_ipopt(rosenbrock(), {.max_evaluations = 3}).status,
            NlpStatus::kLimit);

  NonlinearProgram infeasible = hock_schittkowski_71();
  infeasible.constraint_lower[1] = infeasible.constraint_upper[1] = 200.0;
  const NlpResult nothing = minimise_ipopt(infeasible);
  EXPECT_NE(nothing.status, NlpStatus::kConverged) << nothing.message;

  NonlinearProgram malformed = hock_schittkowski_71();
  malformed.jacobian = nullptr;
  EXPECT_EQ(minimise_ipopt(malformed).status, NlpStatus::kFailed);
  malformed = hock_schittkowski_71();
  malformed.start[0] = kUnbounded;
  EXPECT_EQ(minimise_ipopt(malformed).status, NlpStatus::kFailed);
}

TEST_F(Ipopt, EndsWhenToldTo) {
  NonlinearProgram program = hock_schittkowski_71();
  int asked = 0;
  program.stop = [&asked] { return ++asked == 3; };
  const NlpResult result = minimise_ipopt(program);
  EXPECT_EQ(result.status, NlpStatus::kLimit) << result.message;
  EXPECT_EQ(asked, 3);
  EXPECT_GT(largest_difference(result.x, kHockSchittkowski71), 1e-6);
}

TEST_F(Ipopt, MovesTheStartIntoTheBounds) {
  NonlinearProgram program = hock_schittkowski_71();
  program.start = {-7.0, 30.0, 2.0, 2.0};
  const NlpResult result = minimise_ipopt(program);
  EXPECT_LT(largest_difference(result.x, kHockSchittkowski71), 1e-6) << result.message;
}

// The library crashes when two threads are inside it: the lock has to keep them apart.
TEST_F(Ipopt, ThreadsTakeTurns) {
  std::vector<double> worst(3, kUnbounded);
  std::vector<std::thread> threads;
  threads.reserve(worst.size());
  for (std::size_t t = 0; t < worst.size(); ++t) {
    threads.emplace_back([t, &worst] {
      testing::Random random(100 + t);
      worst[t] = 0.0;
      for (int i = 0; i < 10; ++i) {
        const auto [program, answer] = random_quadratic(random, 20, 4);
        worst[t] =
            std::max(worst[t], largest_difference(minimise_ipopt(program).x, answer));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double w : worst) EXPECT_LT(w, 1e-5);
}

}  // namespace
}  // namespace prehensile
