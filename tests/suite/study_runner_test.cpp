#include "benchmarks/suite/study_runner.h"

#include <csignal>
#include <map>

#include <gtest/gtest.h>

#include "tests/suite/asked.h"
#include "tests/suite/small_suite.h"

namespace prehensile::suite {
namespace {

namespace fs = std::filesystem;
using prehensile::testing::message_of;
using testing::asked;
using testing::Bench;
using testing::Folder;

/// Stands for a program of the build.
void write_double(const fs::path& file, const std::string& script) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "#!/bin/bash\n" << script;
  fs::permissions(file, fs::perms::owner_all);
}

/// What can become of a program, each under the name of one.
void write_doubles(const fs::path& build) {
  write_double(build / "benchmarks/bench_instant",
               "echo \"table $*\" >&2\nprintf 'a,b\\n1,2\\n3,4\\n' > \"$2\"\n");
  write_double(build / "benchmarks/bench_integrators",
               "echo \"$*\"\nprintf 'a\\n1\\n' > \"$2\"\necho '<svg/>' > \"$4\"\n");
  write_double(build / "benchmarks/bench_precision",
               "echo \"$*\"\nfor i in b a; do echo \"<svg>$i</svg>\" > $4/$i.svg; done\n"
               "ln -s /etc/passwd $4/link.svg\n");
  write_double(build / "benchmarks/bench_spatial", "echo 'half a table'\nexit 3\n");
  write_double(build / "benchmarks/bench_extremes", "kill -SEGV $$\n");
  write_double(build / "benchmarks/bench_push", "while :; do :; done\n");
  write_double(build / "benchmarks/bench_planner",
               "echo \"terminate called: std::bad_alloc\" >&2\nkill -ABRT $$\n");
  write_double(build / "benchmarks/bench_truth", "echo \"$*\"; ls \"$1\"\n");
  write_double(build / "tests/planner_tests", "echo \"$*\"\n");
}

const std::string kStudies =
    "version: 1\nname: s\nlimits: {cpu_time: 0.2, wall_time: 60}\nstudies:\n"
    "  - {name: good, program: instant, arguments: ['--seed', '7']}\n"
    "  - {name: charts, program: integrators}\n"
    "  - {name: plots, program: precision}\n"
    "  - {name: fails, program: spatial}\n"
    "  - {name: crashes, program: extremes}\n"
    "  - {name: hangs, program: push}\n"
    "  - {name: starves, program: planner}\n"
    "  - {name: absent, program: baselines}\n"
    "  - {name: data, program: truth, data: real}\n"
    "  - {name: tests, program: planner_tests, arguments: ['--gtest_filter=A.*']}\n";

class Studies : public ::testing::Test {
 protected:
  Studies() {
    write_doubles(folder_ / "build");
    fs::create_directories(folder_ / "suite");
  }
  SuiteFile file(const std::string& text = kStudies) const {
    return parse_suite(text, "s.yaml", {"push"}, folder_ / "suite");
  }
  /// Runs all that the file lacks.
  RunCount run(const std::string& output, RunOptions options = {}, bool quick = false,
               const std::string& text = kStudies) const {
    const SuiteFile suite = file(text);
    const ProblemList problems(suite, quick);
    StudyRunner runner(suite, folder_ / "build", quick);
    options.studies = &runner;
    ResultsWriter writer(folder_ / output,
                         header_of(suite, problems, provenance_here("test")), true);
    const RunCount count = run_suite(suite.suite, problems, {}, options, writer);
    writer.close(1.0);
    return count;
  }
  std::map<std::string, StudyRecord> read(const std::string& output) const {
    std::map<std::string, StudyRecord> found;
    for (StudyRecord& record : read_results(folder_ / output).studies) {
      found.emplace(record.name, std::move(record));
    }
    return found;
  }
  Folder folder_;
};

TEST_F(Studies, EveryEndIsARow) {
  const RunCount count = run("a", {.jobs = 2});
  EXPECT_EQ(count.done, 10);
  const auto found = read("a");
  ASSERT_EQ(found.size(), 10u);
  const std::map<std::string, StudyStatus> wanted = {
      {"good", StudyStatus::kDone},           {"charts", StudyStatus::kDone},
      {"plots", StudyStatus::kDone},          {"fails", StudyStatus::kFailed},
      {"crashes", StudyStatus::kCrashed},     {"hangs", StudyStatus::kTimeout},
      {"starves", StudyStatus::kOutOfMemory}, {"absent", StudyStatus::kNotBuilt},
      {"data", StudyStatus::kSkipped},        {"tests", StudyStatus::kDone}};
  for (const auto& [name, status] : wanted) {
    EXPECT_EQ(suite::name(found.at(name).status), suite::name(status))
        << name << ": " << found.at(name).message;
    EXPECT_EQ(found.at(name).message.empty(), status == StudyStatus::kDone) << name;
    EXPECT_NE(found.at(name).machine, "");
  }
  const StudyRecord& good = found.at("good");
  EXPECT_EQ(good.printed, "table -o runs.csv --seed 7\n");
  EXPECT_EQ(good.csv, "a,b\n1,2\n3,4\n");
  EXPECT_EQ(good.command, "benchmarks/bench_instant -o runs.csv --seed 7");
  EXPECT_GE(good.time, 0.0);
  EXPECT_GT(good.wall_time, 0.0);
  ASSERT_EQ(found.at("charts").charts.size(), 1u);
  EXPECT_EQ(found.at("charts").charts[0].svg, "<svg/>\n");
  ASSERT_EQ(found.at("plots").charts.size(), 2u) << "a link leads elsewhere";
  EXPECT_EQ(found.at("plots").charts[0].name, "a");
  EXPECT_EQ(found.at("fails").exit_code, 3);
  EXPECT_EQ(found.at("fails").printed, "half a table\n");
  EXPECT_EQ(found.at("crashes").signal, SIGSEGV);
  EXPECT_GE(found.at("hangs").time, 0.1);
  EXPECT_EQ(found.at("tests").printed, "--gtest_filter=A.*\n");
  EXPECT_EQ(asked(folder_ / "a",
                  "SELECT count(*) FROM studies JOIN study_charts ON "
                  "studies.id = studyid WHERE status = 'done'"),
            3);
}

TEST_F(Studies, NothingStaysBehind) {
  ::setenv("TMPDIR", (folder_ / "suite").c_str(), 1);
  run("a");
  std::atomic<bool> stop{true};
  run("b", {.stop = &stop});
  ::unsetenv("TMPDIR");
  EXPECT_TRUE(fs::is_empty(folder_ / "suite"));
}

TEST_F(Studies, QuickIsPassedOn) {
  run("a", {}, true);
  const auto found = read("a");
  EXPECT_EQ(found.at("good").printed, "table -o runs.csv --seed 7 --quick\n");
  EXPECT_EQ(found.at("tests").status, StudyStatus::kSkipped);
  EXPECT_EQ(found.at("tests").message, "has no quick variant");
}

TEST_F(Studies, WhatRanIsNotRepeatedWhatDidNotIs) {
  run("a");
  const std::string before = read("a").at("good").date;
  EXPECT_EQ(run("a").done, 2) << "the absent program and the missing data";
  fs::create_directories(folder_ / "suite/real/pin_push");
  write_double(folder_ / "build/benchmarks/bench_baselines", "echo there\n");
  EXPECT_EQ(run("a").done, 2);
  EXPECT_EQ(run("a").done, 0);
  const auto found = read("a");
  EXPECT_EQ(found.at("absent").printed, "there\n");
  const std::string data = fs::canonical(folder_ / "suite/real").string();
  EXPECT_EQ(found.at("data").printed, data + " -o runs.csv\npin_push\n");
  EXPECT_EQ(found.at("good").date, before);
}

TEST_F(Studies, DataStayInTheFolderOfTheSuite) {
  fs::create_directories(folder_ / "elsewhere");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "suite/real");
  const std::string message = message_of([&] { run("a"); });
  EXPECT_NE(message.find("study data: real: leads out of"), std::string::npos) << message;
}

TEST_F(Studies, StopKeepsWhatIsThere) {
  std::atomic<bool> stop{false};
  RunOptions options;
  options.stop = &stop;
  options.progress = [&](const RunProgress& progress) { stop = progress.done == 3; };
  EXPECT_TRUE(run("a", options).stopped);
  EXPECT_EQ(read("a").size(), 3u);
  EXPECT_EQ(run("a").done, 7);
  EXPECT_EQ(read("a").size(), 10u);
}

TEST_F(Studies, ShardsHaveEachOnceAndMerge) {
  const std::string text = kStudies +
                           "families:\n  - {name: f, published: {object: square, count: "
                           "3}}\nplanners:\n  - {planner: push}\n";
  const SuiteFile suite = file(text);
  const ProblemList problems(suite, false);
  std::map<int, int> seen;
  for (int shard = 1; shard <= 3; ++shard) {
    const RunOptions options{.shard = shard, .shards = 3};
    const std::size_t studies = studies_of(suite.suite, problems, options).size();
    EXPECT_GE(studies, 3u);
    for (const int study : studies_of(suite.suite, problems, options)) ++seen[study];
  }
  ASSERT_EQ(seen.size(), 10u);
  for (const auto& [study, times] : seen) EXPECT_EQ(times, 1) << study;

  run("a", {.shard = 1, .shards = 2});
  run("b", {.shard = 2, .shards = 2});
  run("again", {.shard = 2, .shards = 2});
  const Merged merged =
      merge_results({folder_ / "a", folder_ / "b", folder_ / "again"}, folder_ / "m");
  EXPECT_EQ(merged.rows, 10);
  EXPECT_EQ(merged.doubled, 5);
  const auto found = read("m");
  ASSERT_EQ(found.size(), 10u);
  EXPECT_EQ(found.at("charts").charts.size(), 1u);
  EXPECT_EQ(found.at("charts").study, 1);
}

TEST_F(Studies, OlderFilesHaveNone) {
  const Bench bench(testing::small_suite());
  bench.run(folder_ / "old");
  asked(folder_ / "old", "DROP TABLE study_charts");
  asked(folder_ / "old", "DROP TABLE studies");
  EXPECT_EQ(read_results(folder_ / "old").rows.size(), 12u);
  EXPECT_TRUE(read_results(folder_ / "old").studies.empty());
  EXPECT_EQ(bench.run(folder_ / "old", {}, true).done, 0) << "and may be gone on with";
}

TEST_F(Studies, ForeignRowsAreRefused) {
  run("a");
  for (const char* change : {"UPDATE studies SET name = '../x' WHERE id = 1",
                             "UPDATE study_charts SET name = 'a/b' WHERE name = 'a'"}) {
    fs::copy_file(folder_ / "a", folder_ / "b", fs::copy_options::overwrite_existing);
    asked(folder_ / "b", change);
    EXPECT_NE(message_of([&] { read_results(folder_ / "b"); }).find("no suite may have"),
              std::string::npos)
        << change;
  }
  asked(folder_ / "a", "UPDATE studies SET status = 'fine' WHERE id = 1");
  EXPECT_NE(message_of([&] { read_results(folder_ / "a"); }), "");
}

TEST_F(Studies, OneCanRunAlone) {
  const SuiteFile suite = file();
  StudyRunner runner(suite, folder_ / "build", false);
  EXPECT_EQ(study_apart(suite.suite, runner, 0).csv, "a,b\n1,2\n3,4\n");
  EXPECT_EQ(study_apart(suite.suite, runner, 7).status, StudyStatus::kNotBuilt);
}

}  // namespace
}  // namespace prehensile::suite
