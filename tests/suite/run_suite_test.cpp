#include "benchmarks/suite/run_suite.h"

#include <csignal>
#include <map>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/suite/small_suite.h"
#include "tests/support/sanitizers.h"

namespace prehensile::suite {
namespace {

using testing::Bench;
using testing::facts;
using testing::Folder;
using testing::small_suite;

volatile unsigned sink = 0;  // counts for ever without an overflow

/// Planners that no program has: what can go wrong with one.
PlannerTable with_bad_planners() {
  PlannerTable planners = planners_of_build();
  planners["segfaults"] = [](const Model&, const PlanOptions&) -> Plan {
    ::raise(SIGSEGV);
    return {};
  };
  planners["never_returns"] = [](const Model&, const PlanOptions&) -> Plan {
    for (;;) sink = sink + 1;
  };
  planners["eats_memory"] = [](const Model&, const PlanOptions&) -> Plan {
    std::vector<std::vector<char>> eaten;
    for (;;) eaten.emplace_back(10'000'000, 'x');
  };
  planners["throws"] = [](const Model&, const PlanOptions&) -> Plan {
    throw std::runtime_error("a fault of its own");
  };
  planners["lies"] = [](const Model& model, const PlanOptions& options) {
    Plan plan = plan_regrasp(model, options);
    if (plan.pushes.empty()) {
      plan.status = PlanStatus::kNothingToDo;
    } else {
      plan.pushes.back().end.X_HO.x += 1e-3;
    }
    return plan;
  };
  planners["refuses"] = [](const Model&, const PlanOptions&) {
    Plan plan;
    plan.status = PlanStatus::kInfeasible;
    plan.proof.kind = Proof::Kind::kNoPusher;
    return plan;
  };
  planners["exits"] = [](const Model&, const PlanOptions&) -> Plan { std::_Exit(0); };
  return planners;
}

std::map<std::string, std::map<RunStatus, int>> statuses(const Results& results) {
  std::map<std::string, std::map<RunStatus, int>> count;
  for (const ResultRow& row : results.rows) {
    ++count[results.planners[static_cast<std::size_t>(row.key.planner)].name]
           [row.record.status];
  }
  return count;
}

TEST(RunSuite, MakesARowOfEveryRun) {
  const Folder folder;
  const Bench bench(small_suite());
  const RunCount count = bench.run(folder / "a.sqlite");
  EXPECT_EQ(count.done, 12);
  const Results results = read_results(folder / "a.sqlite");
  ASSERT_EQ(results.rows.size(), 12u);
  for (const ResultRow& row : results.rows) {
    if (row.key.family < 2) {
      EXPECT_EQ(row.record.status, RunStatus::kSolved) << row.record.message;
      EXPECT_TRUE(row.record.certified);
      EXPECT_GT(row.record.pushes, 0);
      EXPECT_GE(row.record.cost, row.record.bound);
      EXPECT_FALSE(row.record.progress.empty());
      EXPECT_EQ(row.record.progress.back().best_cost, row.record.cost);
    }
    EXPECT_EQ(row.record.constructed, row.key.family == 1);
    EXPECT_EQ(row.record.scene.size(), 16u);
    EXPECT_GT(row.record.memory, 1.0);
  }
}

TEST(RunSuite, BadPlannersAreRows) {
  const Folder folder;
  std::string text =
      "version: 1\nname: bad\nfamilies:\n"
      "  - {name: published, published: {object: square, count: 2}}\n"
      "limits: {cpu_time: 2, wall_time: 60, memory_MB: 300}\nplanners:\n";
  std::map<std::string, RunStatus> wanted = {
      {"segfaults", RunStatus::kCrashed}, {"never_returns", RunStatus::kTimeout},
      {"throws", RunStatus::kFault},      {"lies", RunStatus::kRefuted},
      {"refuses", RunStatus::kRefuted},   {"exits", RunStatus::kCrashed}};
#if !PREHENSILE_SANITIZED  // which needs more than any limit
  wanted["eats_memory"] = RunStatus::kOutOfMemory;
#endif
  for (const auto& [name, status] : wanted) text += "  - {planner: " + name + "}\n";
  const Bench bench(text, with_bad_planners());
  bench.run(folder / "bad.sqlite", {.jobs = 2});
  const auto found = statuses(read_results(folder / "bad.sqlite"));
  for (const auto& [name, status] : wanted) {
    ASSERT_EQ(found.at(name).size(), 1u) << name;
    EXPECT_EQ(found.at(name).begin()->first, status)
        << name << ": " << suite::name(found.at(name).begin()->first);
    EXPECT_EQ(found.at(name).begin()->second, 2) << name;
  }
}

TEST(RunSuite, JobsDoNotChangeResults) {
  const Folder folder;
  const Bench bench(
      small_suite("  - {planner: push}\n"
                  "  - {name: nominal, planner: push, margin: 0}\n"));
  bench.run(folder / "one.sqlite", {.jobs = 1});
  bench.run(folder / "two.sqlite", {.jobs = 2});
  EXPECT_EQ(facts(read_results(folder / "one.sqlite")),
            facts(read_results(folder / "two.sqlite")));
}

TEST(RunSuite, StopsAndGoesOn) {
  const Folder folder;
  const Bench bench(small_suite());
  bench.run(folder / "whole.sqlite");
  std::atomic<bool> stop{false};
  RunOptions options;
  options.stop = &stop;
  options.progress = [&stop](const RunProgress& progress) {
    if (progress.done == 5) stop = true;
  };
  const RunCount first = bench.run(folder / "parts.sqlite", options);
  EXPECT_TRUE(first.stopped);
  EXPECT_EQ(first.done, 5);
  EXPECT_EQ(read_results(folder / "parts.sqlite").rows.size(), 5u);
  const RunCount second = bench.run(folder / "parts.sqlite", {}, true);
  EXPECT_EQ(second.done, 7);
  EXPECT_EQ(bench.run(folder / "parts.sqlite", {}, true).done, 0);
  EXPECT_EQ(facts(read_results(folder / "parts.sqlite")),
            facts(read_results(folder / "whole.sqlite")));
}

TEST(RunSuite, ShardsMakeTheWhole) {
  const Folder folder;
  const Bench bench(small_suite());
  bench.run(folder / "whole.sqlite");
  std::vector<std::filesystem::path> files;
  for (int shard = 1; shard <= 3; ++shard) {
    files.push_back(folder / ("shard" + std::to_string(shard)));
    bench.run(files.back(), {.shard = shard, .shards = 3});
    EXPECT_EQ(read_results(files.back()).rows.size(), 4u);
  }
  const Merged merged = merge_results(files, folder / "merged.sqlite");
  EXPECT_EQ(merged.files, 3);
  EXPECT_EQ(merged.rows, 12);
  EXPECT_EQ(merged.doubled, 0);
  EXPECT_EQ(facts(read_results(folder / "merged.sqlite")),
            facts(read_results(folder / "whole.sqlite")));
}

TEST(RunSuite, OneRunAgainIsTheSameRow) {
  const Folder folder;
  const Bench bench(small_suite());
  bench.run(folder / "a.sqlite");
  Results results = read_results(folder / "a.sqlite");
  Results again = results;
  for (ResultRow& row : again.rows) {
    row.record = run_apart(bench.file.suite, bench.problems, bench.planners, row.key);
  }
  EXPECT_EQ(facts(again), facts(results));
}

}  // namespace
}  // namespace prehensile::suite
