#include "mechanics/spatial_instant.h"

#include <iostream>

#include <gtest/gtest.h>

#include "problems/random_spatial.h"
#include "problems/random_stream.h"
#include "tests/mechanics/spatial_cases.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

using testing::grasp_of;
using testing::push;
using testing::square_points;
using testing::told;
using testing::weight_at;

constexpr double kRate = 0.01;
constexpr std::array kJawModes = {JawMode::kCoupled, JawMode::kFixedJaw1,
                                  JawMode::kFixedJaw2, JawMode::kIndependent,
                                  JawMode::kLocked};
constexpr std::array kJawNames = {"coupled", "fixed jaw 1", "fixed jaw 2", "independent",
                                  "locked"};

SpatialInstant certified(const SpatialProblem& problem,
                         const SpatialSolveOptions& options = {}) {
  SpatialInstant answer = solve_spatial(problem, options);
  const SpatialCertificate certificate = certify(problem, answer);
  EXPECT_TRUE(certificate.holds()) << name(answer.status) << ": " << told(certificate);
  return answer;
}

/// Statuses of many instants; every answer but kOutOfIterations must be certified.
struct Tally {
  std::array<int, 10> count{};
  int total = 0;
  int wrong = 0;
  long steps = 0;

  void add(const SpatialProblem& problem, const SpatialInstant& answer,
           const std::string& which) {
    ++total;
    ++count[static_cast<std::size_t>(answer.status)];
    steps += answer.iterations;
    if (answer.status == InstantStatus::kOutOfIterations) return;
    const SpatialCertificate certificate = certify(problem, answer);
    if (certificate.holds()) return;
    if (++wrong < 5) {
      ADD_FAILURE() << which << " " << name(answer.status) << ": " << told(certificate);
    }
  }

  int out_of_iterations() const {
    return count[static_cast<std::size_t>(InstantStatus::kOutOfIterations)];
  }

  void print(const std::string& title) const {
    std::cout << title << ":";
    for (std::size_t s = 0; s < count.size(); ++s) {
      if (count[s] == 0) continue;
      std::cout << "  " << name(static_cast<InstantStatus>(s)) << " "
                << 100.0 * count[s] / total << " %";
    }
    std::cout << "  wrong " << wrong << ", mean steps " << steps / std::max(1, total)
              << "\n";
  }
};

Tally tally(SpatialRange range, int total, std::uint64_t seed) {
  Tally result;
  for (int i = 0; i < total; ++i) {
    range.points_per_pad = std::array{1, 2, 4, 8, 16, 32, 64}[i % 7];
    const SpatialProblem problem = random_spatial(seed, i, range);
    result.add(problem, solve_spatial(problem), std::to_string(i));
  }
  return result;
}

void sweep(int total, double allowed_share) {
  for (std::size_t j = 0; j < kJawModes.size(); ++j) {
    for (const double acceleration : {0.0, 0.1, 10.0}) {
      const Tally t = tally({.jaw_mode = kJawModes[j], .acceleration = acceleration},
                            total, 61 + static_cast<int>(j));
      t.print(std::string(kJawNames[j]) + ", acceleration " +
              std::to_string(acceleration));
      EXPECT_EQ(t.wrong, 0);
      EXPECT_LE(t.out_of_iterations(), allowed_share * total);
    }
  }
}

TEST(SpatialInstant, RandomInstantsEndWithEvidence) { sweep(250, 4e-3); }

TEST(SpatialInstant, FullRandomInstantsEndWithEvidence) { sweep(20000, 5e-4); }

TEST(SpatialInstant, OtherContactsEndWithEvidence) {
  const std::array<std::pair<const char*, SpatialRange>, 5> kinds = {
      {{"soft points", {.spin_radius = 0.003}},
       {"given loads", {.pressure = PressureLaw::kGiven}},
       {"free loads", {.pressure = PressureLaw::kFree}},
       {"stiff foundations", {.compliance = 1e-4}},
       {"soft foundations", {.compliance = 1.0}}}};
  for (const auto& [title, range] : kinds) {
    const Tally t = tally(range, 420, 67);
    t.print(title);
    EXPECT_EQ(t.wrong, 0);
    EXPECT_LE(t.out_of_iterations(), 2);
  }
}

TEST(SpatialInstant, FullOtherContactsEndWithEvidence) {
  for (const double compliance : {1e-6, 1e-4, 1e-3, 1.0, 1e3}) {
    const Tally t = tally({.compliance = compliance}, 7000, 71);
    t.print("compliance " + std::to_string(compliance));
    EXPECT_EQ(t.wrong, 0);
    EXPECT_LE(t.out_of_iterations(), 14);
  }
  for (const PressureLaw law : {PressureLaw::kGiven, PressureLaw::kFree}) {
    const Tally t = tally({.pressure = law}, 7000, 73);
    t.print(law == PressureLaw::kGiven ? "given loads" : "free loads");
    EXPECT_EQ(t.wrong, 0);
    EXPECT_LE(t.out_of_iterations(), 14);
  }
}

/// The pusher turned to press onto jaw 1, along the grip within 45 degrees.
SpatialProblem pushed_along_grip(std::uint64_t index, const SpatialRange& range) {
  SpatialProblem problem = random_spatial(5, index, range);
  RandomStream random(index);
  ContactPatch& patch = problem.patch[2];
  patch.n = Vec3(random.in(-0.7, 0.7), random.in(-0.7, 0.7), -1.0).normalized();
  patch.t = patch.n.cross(Vec3::UnitX()).normalized();
  problem.x[patch.first] = random.in(-0.02, 0.02);
  problem.y[patch.first] = random.in(-0.02, 0.02);
  problem.z[patch.first] = problem.z[problem.patch[1].first];
  const Vec3 off(random.in(-0.5, 0.5), random.in(-0.5, 0.5), random.in(-0.5, 0.5));
  problem.V_HP << kRate * (patch.n + off).normalized(), Vec3::Zero();
  return problem;
}

void push_along_grip(int total) {
  for (std::size_t j = 0; j < kJawModes.size(); ++j) {
    Tally tally;
    for (int i = 0; i < total; ++i) {
      const SpatialProblem problem =
          pushed_along_grip(i, {.points_per_pad = std::array{1, 2, 4, 8, 16}[i % 5],
                                .pusher_points = 1,
                                .jaw_mode = kJawModes[j],
                                .compliance = 1e-3});
      tally.add(problem, solve_spatial(problem), std::to_string(i));
    }
    tally.print(std::string("along the grip, ") + kJawNames[j]);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_LE(tally.out_of_iterations(), 1 + total / 100);
    const int jammed = tally.count[static_cast<std::size_t>(InstantStatus::kJammed)];
    // Only a jaw that does not give way can be pressed against: jaw 1.
    const bool can_jam =
        kJawModes[j] == JawMode::kFixedJaw1 || kJawModes[j] == JawMode::kLocked;
    EXPECT_EQ(jammed > total / 10, can_jam);
    EXPECT_TRUE(can_jam || jammed == 0);
  }
}

TEST(SpatialInstant, PushesAlongTheGripEndWithEvidence) { push_along_grip(100); }

TEST(SpatialInstant, FullPushesAlongTheGripEndWithEvidence) { push_along_grip(2000); }

TEST(SpatialInstant, StepsDoNotDependOnTheQuasiStaticNumber) {
  for (const double acceleration : {1e-6, 1e-3, 1.0, 1e2}) {
    std::vector<int> steps;
    for (int i = 0; i < 200; ++i) {
      const SpatialProblem problem =
          random_spatial(79, i, {.acceleration = acceleration, .compliance = 1e-2});
      steps.push_back(solve_spatial(problem).iterations);
    }
    std::nth_element(steps.begin(), steps.begin() + 100, steps.end());
    std::cout << "acceleration " << acceleration << ": median steps " << steps[100]
              << "\n";
    EXPECT_LE(steps[100], 36);
  }
}

TEST(SpatialInstant, QuasiStaticIsTheLimitOfSmallAccelerations) {
  int both = 0;
  for (int i = 0; i < 300; ++i) {
    const SpatialProblem slow = random_spatial(83, i);
    const SpatialProblem fast = random_spatial(83, i, {.acceleration = 1e-7});
    const SpatialInstant limit = solve_spatial(slow);
    const SpatialInstant near = solve_spatial(fast);
    if (limit.status != InstantStatus::kMoves || near.status != InstantStatus::kMoves) {
      continue;
    }
    ++both;
    EXPECT_NEAR(near.push_force, limit.push_force, 1e-5 * slow.grip_force) << i;
  }
  EXPECT_GT(both, 150);
}

TEST(SpatialInstant, WarmStartGivesTheSameAnswerSooner) {
  long cold_steps = 0;
  long warm_steps = 0;
  for (int i = 0; i < 100; ++i) {
    SpatialProblem problem = random_spatial(89, i);
    SpatialWarmStart warm;
    for (int step = 0; step < 5; ++step) {
      for (int j = 0; j < problem.count; ++j) problem.x[j] += 1e-5;
      const SpatialInstant cold = solve_spatial(problem);
      const SpatialInstant next = solve_spatial(problem, {}, &warm);
      if (cold.status != InstantStatus::kMoves || next.status != cold.status) continue;
      if (step == 0) continue;
      cold_steps += cold.iterations;
      warm_steps += next.iterations;
      EXPECT_NEAR(next.push_force, cold.push_force, 1e-6 * problem.grip_force) << i;
    }
  }
  std::cout << "steps cold " << cold_steps << ", warm " << warm_steps << "\n";
  EXPECT_LT(2 * warm_steps, cold_steps);
}

TEST(SpatialInstant, RigidLimitIsTheLimitOfStiffFoundations) {
  int both = 0;
  std::vector<double> off;
  for (int i = 0; i < 100; ++i) {
    const SpatialProblem soft = random_spatial(97, i, {.compliance = 1e-5});
    const SpatialInstant stiff = solve_spatial(soft);
    const SpatialInstant rigid = solve_spatial(soft, {.rigid_limit = true});
    const SpatialCertificate certificate = certify(rigid_limit_of(soft), rigid);
    EXPECT_TRUE(certificate.holds()) << i << " " << told(certificate);
    if (stiff.status != InstantStatus::kMoves || rigid.status != stiff.status) continue;
    ++both;
    off.push_back(std::abs(stiff.push_force - rigid.push_force) / soft.grip_force);
  }
  std::nth_element(off.begin(), off.begin() + off.size() / 2, off.end());
  EXPECT_GT(both, 50);
  EXPECT_LT(off[off.size() / 2], 1e-3);
}

// What the pusher may do besides pushing.

SpatialProblem square_grasp() {
  return grasp_of(square_points(4, 0.006), 0.01, 20.0, {.mu = 0.5});
}

TEST(SpatialInstant, RecedingPusherLeavesAHeldObject) {
  SpatialProblem problem = square_grasp();
  problem.w_g = weight_at({0.002, 0.0, 0.0}, {0.0, -4.0, 0.0});
  push(problem, {{-0.04, -0.03, 0.002}, {-0.04, 0.03, 0.002}}, Vec3::UnitX(), 0.5,
       {-kRate, 0.2 * kRate, 0.0});
  const SpatialInstant answer = certified(problem);
  EXPECT_EQ(answer.status, InstantStatus::kSeparated);
  EXPECT_NEAR(answer.V_HO.norm(), 0.0, 1e-6 * kRate);
}

TEST(SpatialInstant, PusherThatMovesAlongTheFaceLeavesTheObjectAtRest) {
  SpatialProblem problem = square_grasp();
  push(problem, {{-0.04, 0.0, 0.0}}, Vec3::UnitX(), 0.5, {0.0, kRate, 0.0});
  EXPECT_EQ(certified(problem).status, InstantStatus::kHolds);
}

TEST(SpatialInstant, HeavyObjectOnAShelfIsCarriedAndFallsFromAWall) {
  SpatialProblem shelf = square_grasp();
  shelf.w_g = weight_at(Vec3::Zero(), {0.0, -40.0, 0.0});
  SpatialProblem wall = shelf;
  push(shelf, {{-0.03, -0.03, 0.0}, {0.03, -0.03, 0.0}}, Vec3::UnitY(), 0.5,
       {0.0, kRate, 0.0});
  EXPECT_EQ(certified(shelf).status, InstantStatus::kAmbiguous);
  push(wall, {{-0.03, -0.03, 0.0}, {-0.03, 0.03, 0.0}}, Vec3::UnitX(), 0.0,
       {kRate, 0.0, 0.0});
  EXPECT_EQ(certified(wall).status, InstantStatus::kDynamic);
}

TEST(SpatialInstant, JawsShareAPushAlongTheirAxis) {
  // A push along z that coupled jaws take by unequal loads until one lets go.
  SpatialProblem problem = square_grasp();
  push(problem, {{-0.04, 0.0, 0.0}}, Vec3::UnitX(), 0.9, {kRate, 0.0, 0.5 * kRate});
  const SpatialInstant coupled = certified(problem);
  double jaw1 = 0.0;
  double jaw2 = 0.0;
  for (int i = 0; i < 16; ++i) {
    jaw1 += coupled.point[i].normal_force;
    jaw2 += coupled.point[16 + i].normal_force;
  }
  EXPECT_NEAR(jaw1 + jaw2, 40.0, 1e-6);
  EXPECT_NEAR(jaw2 - jaw1, coupled.w_push[2], 1e-6);
  EXPECT_GT(coupled.w_push[2], 1.0);
  // Independent jaws give way instead.
  problem.jaw_mode = JawMode::kIndependent;
  EXPECT_NEAR(certified(problem).w_push[2], 0.0, 1e-6);
  // A fixed jaw takes all of it.
  problem.jaw_mode = JawMode::kFixedJaw2;
  const SpatialInstant fixed = certified(problem);
  double force_jaw = 0.0;
  for (int i = 0; i < 16; ++i) force_jaw += fixed.point[i].normal_force;
  EXPECT_NEAR(force_jaw, 20.0, 1e-6);
}

TEST(SpatialInstant, ProbeFindsTheObjectSwingingOffAPointGrasp) {
  // One finger point has no torsion: a point pusher beside it does not determine the
  // turn.
  SpatialProblem problem = grasp_of({{0.0, 0.0}}, 0.01, 20.0, {.mu = 0.5});
  push(problem, {{-0.03, 0.002, 0.0}}, Vec3::UnitX(), 0.5, {kRate, 0.0, 0.0});
  EXPECT_EQ(certified(problem, {.probe_multiplicity = true}).status,
            InstantStatus::kAmbiguous);
}

TEST(SpatialInstant, RefusesQuestionsWithoutSense) {
  SpatialProblem problem = square_grasp();
  push(problem, {{-0.04, 0.0, 0.0}}, Vec3::UnitX(), 0.5, {kRate, 0.0, 0.0});
  EXPECT_NE(solve_spatial(problem).status, InstantStatus::kBadInput);
  const auto refused = [&](auto&& spoil) {
    SpatialProblem bad = problem;
    spoil(bad);
    const SpatialInstant answer = solve_spatial(bad);
    EXPECT_FALSE(certify(bad, answer).holds());
    return answer.status == InstantStatus::kBadInput;
  };
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch_count = 2; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.V_HP.setZero(); }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.x[3] = kNan; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch[0].mu = -0.1; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch[1].n = {0.0, 0.5, 0.5}; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch[1].compliance = 0.0; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.grip_force = -1.0; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.z[2] += 0.001; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.preload[2] = -1.0; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch[0].count = 200; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) {
    for (int k = 0; k < 2; ++k) q.patch[k].pressure = PressureLaw::kGiven;
    q.preload[0] *= 2.0;
  }));
}

TEST(SpatialInstant, UsesNoHeap) {
  SpatialWarmStart warm;
  const testing::NoHeapScope scope;
  for (int i = 0; i < 200; ++i) {
    const SpatialProblem problem =
        random_spatial(17, i,
                       {.jaw_mode = kJawModes[i % 5],
                        .acceleration = i % 3 == 0 ? 1.0 : 0.0,
                        .spin_radius = i % 2 == 0 ? 0.0 : 0.003});
    const SpatialInstant answer =
        solve_spatial(problem, {.probe_multiplicity = i % 7 == 0}, &warm);
    const SpatialCertificate certificate = certify(problem, answer);
    EXPECT_TRUE(certificate.holds());
  }
  if (testing::heap_is_counted()) {
    EXPECT_EQ(scope.allocations(), 0);
  }
}

}  // namespace
}  // namespace prehensile
