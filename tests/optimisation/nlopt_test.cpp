/// NLopt through the plain programme: known minima, and honest statuses.
#include <gtest/gtest.h>

#include "tests/optimisation/classic_programs.h"

namespace prehensile {
namespace {

using testing::hock_schittkowski_71;
using testing::kHockSchittkowski71;
using testing::largest_difference;
using testing::random_quadratic;
using testing::rosenbrock;

class Nlopt : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!nlopt_is_built()) GTEST_SKIP() << "built without NLopt";
  }
};

TEST_F(Nlopt, SlsqpDescendsTheValley) {
  const NlpResult result = minimise_nlopt(rosenbrock(), LocalMethod::kSlsqp,
                                          {.tolerance = 1e-14, .max_evaluations = 500});
  EXPECT_EQ(result.status, NlpStatus::kConverged) << result.message;
  EXPECT_LT(largest_difference(result.x, {1.0, 1.0}), 1e-5);
  EXPECT_NEAR(result.objective, 0.0, 1e-10);
  EXPECT_GT(result.evaluations, 5);
}

TEST_F(Nlopt, SlsqpKeepsConstraints) {
  const NlpResult result = minimise_nlopt(hock_schittkowski_71(), LocalMethod::kSlsqp);
  EXPECT_EQ(result.status, NlpStatus::kConverged) << result.message;
  EXPECT_LT(largest_difference(result.x, kHockSchittkowski71), 1e-5);
  EXPECT_NEAR(result.objective, 17.0140173, 1e-6);
}

TEST_F(Nlopt, CobylaNeedsNoGradients) {
  NonlinearProgram program = hock_schittkowski_71();
  program.jacobian = nullptr;
  const NlpResult result = minimise_nlopt(
      program, LocalMethod::kCobyla, {.tolerance = 1e-10, .max_evaluations = 20000}, 0.1);
  EXPECT_NE(result.status, NlpStatus::kFailed) << result.message;
  EXPECT_LT(largest_difference(result.x, kHockSchittkowski71), 1e-3);
}

TEST_F(Nlopt, SubplexToleratesForbiddenRegions) {
  NonlinearProgram program;
  program.start = {0.5, 0.5, 0.5};
  program.lower.assign(3, -2.0);
  program.upper.assign(3, 2.0);
  program.objective = [](std::span<const double> x, std::span<double>) {
    if (x[0] + x[1] > 1.5) return kUnbounded;
    return std::abs(x[0] + 0.3) + 2.0 * std::abs(x[1] - 0.7) + x[2] * x[2];
  };
  const NlpResult result =
      minimise_nlopt(program, LocalMethod::kSubplex,
                     {.tolerance = 1e-10, .max_evaluations = 20000}, 0.2);
  EXPECT_EQ(result.status, NlpStatus::kConverged) << result.message;
  EXPECT_LT(largest_difference(result.x, {-0.3, 0.7, 0.0}), 1e-5);
}

TEST_F(Nlopt, SlsqpFindsKnownQuadraticMinima) {
  testing::Random random(11);
  for (int i = 0; i < 50; ++i) {
    const auto [program, answer] = random_quadratic(random, 6 + i % 5, 2);
    const NlpResult result = minimise_nlopt(program, LocalMethod::kSlsqp,
                                            {.tolerance = 1e-12, .max_evaluations = 500});
    EXPECT_NE(result.status, NlpStatus::kFailed) << result.message;
    EXPECT_LT(largest_difference(result.x, answer), 1e-5) << i;
  }
}

TEST_F(Nlopt, EqualRunsGiveEqualNumbers) {
  for (const LocalMethod method : {LocalMethod::kSlsqp, LocalMethod::kCobyla}) {
    const NlpResult one = minimise_nlopt(hock_schittkowski_71(), method);
    const NlpResult two = minimise_nlopt(hock_schittkowski_71(), method);
    EXPECT_EQ(one.x, two.x);
    EXPECT_EQ(one.evaluations, two.evaluations);
  }
}

TEST_F(Nlopt, SaysWhenTheBudgetEndedTheSearch) {
  const NlpResult result =
      minimise_nlopt(rosenbrock(), LocalMethod::kSlsqp, {.max_evaluations = 4});
  EXPECT_EQ(result.status, NlpStatus::kLimit);
  EXPECT_LE(result.evaluations, 5);
}

TEST_F(Nlopt, EndsWhenToldTo) {
  for (const LocalMethod method : {LocalMethod::kSlsqp, LocalMethod::kSubplex}) {
    NonlinearProgram program = rosenbrock();
    int asked = 0;
    program.stop = [&asked] { return ++asked == 5; };
    const NlpResult result = minimise_nlopt(program, method);
    EXPECT_EQ(result.status, NlpStatus::kLimit) << result.message;
    EXPECT_EQ(asked, 5);
  }
}

TEST_F(Nlopt, RefusesWhatItCannotTake) {
  const NlpResult bounds_only =
      minimise_nlopt(hock_schittkowski_71(), LocalMethod::kSubplex);
  EXPECT_EQ(bounds_only.status, NlpStatus::kFailed);
  EXPECT_NE(bounds_only.message.find("bounds only"), std::string::npos);

  NonlinearProgram program = hock_schittkowski_71();
  program.jacobian = nullptr;
  EXPECT_EQ(minimise_nlopt(program, LocalMethod::kSlsqp).status, NlpStatus::kFailed);
}

TEST_F(Nlopt, RefusesMalformedPrograms) {
  const auto refused = [](void (*spoil)(NonlinearProgram&)) {
    NonlinearProgram program = hock_schittkowski_71();
    spoil(program);
    const NlpResult result = minimise_nlopt(program, LocalMethod::kSlsqp);
    EXPECT_FALSE(result.message.empty());
    return result.status == NlpStatus::kFailed && result.evaluations == 0;
  };
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.start.clear(); }));
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.start[1] = std::nan(""); }));
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.objective = nullptr; }));
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.lower.pop_back(); }));
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.lower[2] = 9.0; }));
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.upper[2] = std::nan(""); }));
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.constraint_upper.push_back(0.0); }));
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.constraints = nullptr; }));
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.jacobian_rows[3] = 2; }));
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.jacobian_columns.pop_back(); }));
  EXPECT_TRUE(refused([](NonlinearProgram& p) { p.hessian_columns[0] = -1; }));
}

}  // namespace
}  // namespace prehensile
