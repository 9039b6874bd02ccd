#include "benchmarks/suite/results.h"

#include <csignal>
#include <fstream>
#include <sys/resource.h>
#include <sys/wait.h>

#include <gtest/gtest.h>

#include "tests/suite/asked.h"
#include "tests/suite/small_suite.h"

namespace prehensile::suite {
namespace {

using prehensile::testing::message_of;
using testing::asked;
using testing::Bench;
using testing::facts;
using testing::Folder;
using testing::small_suite;

ResultRow row_of(int problem, double cost = 1.5) {
  ResultRow row;
  row.key.problem = problem;
  row.record.status = RunStatus::kSolved;
  row.record.cost = cost;
  row.record.time = 0.25;
  row.record.message = "'; DROP TABLE runs; --";
  row.record.progress = {{0.1, kNothing}, {0.2, 1.75}, {0.25, cost}};
  return row;
}

TEST(Results, ComeBackAsWritten) {
  const Folder folder;
  const Bench bench(small_suite());
  {
    ResultsWriter writer(folder / "a", bench.header(), false);
    EXPECT_TRUE(writer.add(row_of(1)));
    EXPECT_TRUE(writer.add(row_of(0)));
    EXPECT_FALSE(writer.add(row_of(1, 9.0))) << "a row twice";
    writer.close(2.5);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a-wal"));
  const Results results = read_results(folder / "a");
  ASSERT_EQ(results.rows.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(to_text(results.rows[i].record), to_text(row_of(i).record));
    EXPECT_EQ(results.rows[i].key, row_of(i).key);
  }
  EXPECT_EQ(results.suite, "small");
  EXPECT_EQ(results.families.size(), 3u);
  EXPECT_EQ(results.families[1].name, "boxes");
  EXPECT_EQ(results.provenance.digest(), bench.header().provenance.digest());
}

TEST(Results, HaveTheSchemaOfOmpl) {
  const Folder folder;
  const Bench bench(small_suite());
  {
    ResultsWriter writer(folder / "a", bench.header(), false);
    writer.add(row_of(0));
    writer.close(2.5);
  }
  const auto file = folder / "a";
  EXPECT_EQ(asked(file, "SELECT totaltime FROM experiments WHERE name = 'boxes'"), 2.5);
  EXPECT_EQ(asked(file,
                  "SELECT count(*) FROM experiments WHERE timelimit = 60 AND "
                  "memorylimit = 2000 AND version LIKE 'prehensile %' AND seed = '1' "
                  "AND hostname != '' AND cpuinfo != '' AND date != ''"),
            3);
  EXPECT_EQ(asked(file,
                  "SELECT count(*) FROM runs JOIN plannerConfigs ON "
                  "runs.plannerid = plannerConfigs.id JOIN experiments ON "
                  "runs.experimentid = experiments.id WHERE solved AND time = 0.25"),
            1);
  EXPECT_EQ(asked(file,
                  "SELECT value FROM enums JOIN runs ON enums.value = runs.status "
                  "WHERE enums.name = 'status' AND description = 'solved'"),
            0);
  EXPECT_EQ(asked(file, "SELECT best_cost FROM progress WHERE time = 0.2"), 1.75);
  EXPECT_EQ(asked(file, "SELECT avg_solved FROM bestPlannerConfigs"), 1);
  EXPECT_EQ(asked(file, "SELECT avg_total_time FROM bestPlannerConfigsPerExperiment"),
            0.25);
  EXPECT_EQ(asked(file,
                  "SELECT count(*) FROM pragma_table_info('runs') WHERE type NOT IN "
                  "('INTEGER', 'REAL', 'BOOLEAN', 'ENUM', 'TEXT')"),
            0);
  EXPECT_EQ(asked(file,
                  "SELECT cid FROM pragma_table_info('runs') WHERE "
                  "name = 'plannerid'"),
            2)
      << "the script takes the first three columns for keys";
}

TEST(Results, AreKeptFromOthers) {
  const Folder folder;
  const Bench bench(small_suite());
  ResultsWriter writer(folder / "a", bench.header(), false);
  EXPECT_NE(message_of([&] {
              ResultsWriter(folder / "a", bench.header(), false);
            }).find("exists"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              ResultsWriter(folder / "a", bench.header(), true);
            }).find("another process is using it"),
            std::string::npos);
}

TEST(Results, OfAnotherSuiteAreNotGoneOnWith) {
  const Folder folder;
  const Bench bench(small_suite());
  const Bench other(small_suite("  - {planner: push, budget: 1e5}\n"));
  {
    ResultsWriter writer(folder / "a", bench.header(), false);
    writer.add(row_of(0));
    writer.close(0.0);
  }
  const std::string message =
      message_of([&] { ResultsWriter(folder / "a", other.header(), true); });
  EXPECT_NE(message.find("another suite"), std::string::npos) << message;
  EXPECT_EQ(read_results(folder / "a").rows.size(), 1u);
}

TEST(Results, OtherFilesAreRefused) {
  const Folder folder;
  std::ofstream(folder / "text")
      << "not a database, but long enough to look at: " << std::string(2000, 'x');
  std::ofstream(folder / "empty") << "";
  for (const char* name : {"text", "empty", "absent", "."}) {
    EXPECT_NE(message_of([&] { read_results(folder / name); }), "") << name;
  }
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "other").c_str(), &handle), SQLITE_OK);
  sqlite3_exec(handle, "CREATE TABLE suite (key TEXT, value TEXT)", nullptr, nullptr,
               nullptr);
  sqlite3_close(handle);
  EXPECT_NE(message_of([&] { read_results(folder / "other"); }).find("expected results"),
            std::string::npos);
}

/// Logs and pages are named after families.
TEST(Results, NamesThatLeadElsewhereAreRefused) {
  const Folder folder;
  const Bench bench(small_suite());
  { ResultsWriter(folder / "a", bench.header(), false); }
  ASSERT_EQ(message_of([&] { read_results(folder / "a"); }), "");
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "a").c_str(), &handle), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(handle, "UPDATE experiments SET name = '../mine'", nullptr,
                         nullptr, nullptr),
            SQLITE_OK);
  sqlite3_close(handle);
  EXPECT_NE(message_of([&] { read_results(folder / "a"); }).find("../mine"),
            std::string::npos);
}

TEST(Results, MergeKeepsRowsOnceAndRefusesDisagreement) {
  const Folder folder;
  const Bench bench(small_suite());
  const auto write = [&](const char* name, const std::vector<ResultRow>& rows) {
    ResultsWriter writer(folder / name, bench.header(), false);
    for (const ResultRow& row : rows) writer.add(row);
    writer.close(0.0);
  };
  write("a", {row_of(0), row_of(1)});
  write("b", {row_of(1), row_of(2)});
  write("c", {row_of(2, 7.0)});
  const Merged merged = merge_results({folder / "a", folder / "b"}, folder / "ab");
  EXPECT_EQ(merged.rows, 3);
  EXPECT_EQ(merged.doubled, 1);
  EXPECT_EQ(read_results(folder / "ab").rows.size(), 3u);
  EXPECT_EQ(read_results(folder / "ab").rows[2].record.progress.size(), 3u);
  EXPECT_NE(message_of([&] {
              merge_results({folder / "b", folder / "c"}, folder / "bc");
            }).find("another result"),
            std::string::npos);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    files += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_EQ(files, 4) << "a failed merge leaves nothing behind";
}

/// What a child process does with files limited in size; the rows it had added, and its
/// message.
TEST(Results, AFullDiskLeavesTheRowsThatWereThere) {
  const Folder folder;
  const Bench bench(small_suite());
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{400'000, 400'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int added = 0;
    const std::string message = message_of([&] {
      ResultsWriter writer(folder / "a", bench.header(), false);
      for (;; ++added) {
        ResultRow row = row_of(added);
        row.record.message = std::string(3000, 'x');
        writer.add(row);
      }
    });
    std::ofstream(folder / "said") << added << ' ' << message;
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  std::ifstream said(folder / "said");
  int added = 0;
  std::string message;
  said >> added;
  std::getline(said, message);
  EXPECT_GT(added, 5);
  EXPECT_NE(message.find("cannot be written"), std::string::npos) << message;
  EXPECT_NE(message.find("a:"), std::string::npos) << message;
  const Results results = read_results(folder / "a");
  ASSERT_EQ(results.rows.size(), static_cast<std::size_t>(added));
  for (int i = 0; i < added; ++i) EXPECT_EQ(results.rows[i].key.problem, i);
}

}  // namespace
}  // namespace prehensile::suite
