#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits.h>
#include <set>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "planner/search/frame.h"
#include "tests/planner/ompl_regrasps.h"

namespace prehensile {
namespace {

void mix(double value, std::uint64_t& hash) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  hash = (hash ^ bits) * 0x100000001b3;
}

/// Every bit of the pushes and the work.
std::uint64_t fingerprint(const Plan& plan) {
  std::uint64_t hash = 0xcbf29ce484222325;
  mix(static_cast<double>(plan.status), hash);
  mix(static_cast<double>(plan.propagations), hash);
  for (const PlannedPush& planned : plan.pushes) {
    const LinearPush push = as_linear(planned.push);
    for (const double value :
         {1.0 * push.contact, push.place, push.e.x(), push.e.y(), push.travel, push.turn,
          planned.end.X_HO.x, planned.end.X_HO.y, planned.end.X_HO.theta}) {
      mix(value, hash);
    }
  }
  return hash;
}

std::uint64_t fingerprint(const std::string& planner, std::uint64_t seed,
                          std::int64_t budget = 300) {
  const Scene scene = testing::regrasps()[3];  // two pushes: chance has a say
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  Work work{.budget = budget};
  return fingerprint(solve_in_frame(search, scene.start, *scene.goal,
                                    {.planner = planner, .seed = seed}, work));
}

std::string fingerprints() {
  std::string text;
  for (const std::string& planner : frame_planners()) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      text += std::to_string(fingerprint(planner, seed)) + " ";
    }
  }
  return text;
}

TEST(OmplDeterminism, SameSeedSamePlanInOneProcess) {
  EXPECT_EQ(fingerprints(), fingerprints());
}

TEST(OmplDeterminism, SeedsMatterToRandomPlannersOnly) {
  for (const std::string& planner : frame_planners()) {
    if (planner.starts_with("blind::")) continue;  // find nothing with so little work
    const std::int64_t budget = planner == "geometric::FMT" ? 6000 : 1500;
    std::set<std::uint64_t> plans;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      plans.insert(fingerprint(planner, seed, budget));
    }
    EXPECT_EQ(plans.size() == 1, planner == "push") << planner;
  }
}

TEST(OmplDeterminism, ThreadsDoNotDisturbEachOther) {
  const std::uint64_t alone = fingerprint("control::RRT", 5);
  std::uint64_t one = 0;
  std::uint64_t other = 0;
  std::thread first([&] { one = fingerprint("control::RRT", 5); });
  std::thread second([&] { other = fingerprint("control::EST", 5); });
  fingerprint("push", 1);
  first.join();
  second.join();
  EXPECT_EQ(one, alone);
  EXPECT_EQ(other, fingerprint("control::EST", 5));
}

/// Set in child processes, which print their fingerprints and do nothing else.
constexpr const char* kChild = "PREHENSILE_PRINT_FINGERPRINTS";

std::string fingerprints_of_a_child() {
  char self[PATH_MAX] = {};
  if (readlink("/proc/self/exe", self, sizeof self - 1) < 0)
    return "no path to this test";
  const std::string command =
      std::string(kChild) + "=1 '" + self +
      "' --gtest_filter=OmplDeterminism.SameSeedSamePlanInFreshProcesses";
  FILE* child = popen(command.c_str(), "r");
  if (child == nullptr) return "no child process";
  std::string found;
  char line[4096];
  while (std::fgets(line, sizeof line, child) != nullptr) {
    if (std::strncmp(line, "fingerprints: ", 14) == 0) found = line + 14;
  }
  pclose(child);
  while (!found.empty() && found.back() == '\n') found.pop_back();
  return found;
}

TEST(OmplDeterminism, SameSeedSamePlanInFreshProcesses) {
  const std::string here = fingerprints();
  if (std::getenv(kChild) != nullptr) {
    std::printf("fingerprints: %s\n", here.c_str());
    return;
  }
  const std::string child = fingerprints_of_a_child();
  EXPECT_EQ(child, here);
  EXPECT_EQ(child, fingerprints_of_a_child());
}

}  // namespace
}  // namespace prehensile
