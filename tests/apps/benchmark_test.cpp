/// `prehensile benchmark` as a user sees it: results, reports, interruptions, deaths.
#include <chrono>
#include <csignal>
#include <fstream>
#include <set>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/suite/results.h"
#include "tests/apps/program.h"
#include "tests/apps/running.h"
#include "tests/plot/svg_text.h"
#include "tests/support/random.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kSuite =
    "version: 1\nname: small\nfamilies:\n"
    "  - {name: published, published: {object: square, count: 6}}\n"
    "  - {name: boxes, random: {object: box, count: 6}}\n"
    "  - {name: convex, fixtures: {object: convex, goals: random, count: 6}}\n"
    "planners:\n  - {planner: push}\n  - {name: nominal, planner: push, margin: 0}\n";
constexpr int kRuns = 36;

/// Rows without what depends on clock, load or machine.
std::string facts(const fs::path& file) {
  const suite::Results results = suite::read_results(file);
  std::string out;
  for (const suite::ResultRow& row : results.rows) {
    suite::RunRecord record = row.record;
    record.progress.clear();
    suite::visit_columns(record, [](const char* name, auto& value) {
      if (suite::is_measurement(name)) value = {};
    });
    for (const int part : {row.key.family, row.key.problem, row.key.planner, row.key.seed,
                           row.key.repetition}) {
      out += std::to_string(part) + ' ';
    }
    out += suite::to_text(record);
  }
  return out;
}

void sleep_for(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Rows that a stranger can read while or after a program writes them.
int rows_in(const fs::path& file) {
  try {
    return static_cast<int>(suite::read_results(file).rows.size());
  } catch (const std::exception&) {
    return -1;  // not there yet, or in use
  }
}

class BenchmarkCommand : public ::testing::Test {
 protected:
  BenchmarkCommand() { write_text(folder_.path("suite.yaml"), kSuite); }
  std::string at(const std::string& name) const { return folder_.path(name).string(); }
  Outcome benchmark(const std::string& arguments) const {
    return run_program("benchmark " + arguments);
  }
  Folder folder_;
};

TEST_F(BenchmarkCommand, RunsAndReports) {
  const Outcome out =
      benchmark(at("suite.yaml") + " -o " + at("a.sqlite") + " --jobs 2 --json");
  ASSERT_EQ(out.exit_code, 0) << out.err;
  const json told = json::parse(out.out);
  EXPECT_EQ(told["rows"], kRuns);
  EXPECT_EQ(told["groups"].size(), 6u);
  EXPECT_EQ(told["totals"][0]["runs"], 18);
  EXPECT_EQ(rows_in(at("a.sqlite")), kRuns);

  const Outcome report = benchmark("report " + at("a.sqlite") + " -o " + at("a.html"));
  ASSERT_EQ(report.exit_code, 0) << report.err;
  const std::string page = read_text(at("a.html"));
  for (const char* part :
       {"id=\"success-chart\"", "id=\"time-chart\"", "id=\"profile-chart\"",
        "id=\"cost-chart\"", "id=\"gap-chart\"", "id=\"failures\"", "id=\"pairs\"",
        "id=\"origin\"", "families:", ">nominal only</th>"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(plot::testing::fault_of_svg(page.substr(page.find('\n') + 1)), "");
  // The axis of the success chart says the families in words.
  EXPECT_NE(page.find("text-anchor=\"end\">boxes</text>"), std::string::npos);
  EXPECT_NE(page.find("prefers-color-scheme: dark"), std::string::npos);
  for (const char* outside : {"src=", "@import", "<link", "<script", "url(http"}) {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  const std::string runs = read_text(at("a_runs.csv"));
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), kRuns + 1);
  EXPECT_NE(read_text(at("a_summary.csv")).find("boxes,push,6,6,"), std::string::npos);
  EXPECT_NE(read_text(at("a_pairs.csv")).find("all,push,nominal,18"), std::string::npos);
}

TEST_F(BenchmarkCommand, FloorsDecideTheExitCode) {
  ASSERT_EQ(benchmark(at("suite.yaml") + " -o " + at("a") + " --quick").exit_code, 0);
  EXPECT_EQ(benchmark("report " + at("a") + " --fail-below success=0.2").exit_code, 0);
  const Outcome missed =
      benchmark("report " + at("a") + " --fail-below nominal.decided=1");
  const Outcome met = benchmark("report " + at("a") + " --fail-below decided=0");
  EXPECT_EQ(met.exit_code, 0);
  const json told = json::parse(benchmark("report " + at("a") + " --json").out);
  const json& nominal = told["totals"][1];
  const bool all_decided =
      nominal["runs"] == nominal["solved"].get<int>() + nominal["infeasible"].get<int>();
  EXPECT_EQ(missed.exit_code, all_decided ? 0 : 1);
  for (const char* bad : {"success", "success=2", "speed=1", "pull.success=1", "=1"}) {
    EXPECT_EQ(benchmark("report " + at("a") + " --fail-below " + bad).exit_code, 2)
        << bad;
  }
}

TEST_F(BenchmarkCommand, OneRunCanBeLookedAt) {
  ASSERT_EQ(benchmark(at("suite.yaml") + " -o " + at("a")).exit_code, 0);
  const Outcome out =
      benchmark(at("suite.yaml") + " --only boxes/3,push,1 --scene " + at("scene.yaml"));
  ASSERT_EQ(out.exit_code, 0) << out.err;
  const json again = json::parse(out.out);
  const suite::Results results = suite::read_results(at("a"));
  int found = 0;
  for (const suite::ResultRow& row : results.rows) {
    if (row.key != suite::RunKey{1, 2, 0, 1, 1}) continue;
    ++found;
    EXPECT_EQ(again["plan"], row.record.plan);
    EXPECT_EQ(again["cost"].get<double>(), row.record.cost);
    EXPECT_EQ(again["stick_tests"], row.record.stick_tests);
  }
  EXPECT_EQ(found, 1);
  // The scene is one that `plan` takes.
  EXPECT_EQ(run_program("plan " + at("scene.yaml") + " -o " + at("plan.json")).exit_code,
            0);
  for (const char* bad : {"boxes/3", "boxes/7,push,1", "boxes/0,push,1", "bx/1,push,1",
                          "boxes/1,pull,1", "boxes/1,push,0", "boxes/1x,push,1"}) {
    EXPECT_EQ(benchmark(at("suite.yaml") + " --only " + bad).exit_code, 2) << bad;
  }
}

TEST_F(BenchmarkCommand, TheSameTwiceDiffersByNoiseOnly) {
  ASSERT_EQ(benchmark(at("suite.yaml") + " -o " + at("a") + " --jobs 1").exit_code, 0);
  ASSERT_EQ(benchmark(at("suite.yaml") + " -o " + at("b") + " --jobs 2").exit_code, 0);
  EXPECT_EQ(facts(at("a")), facts(at("b")));
  const Outcome out =
      benchmark("report " + at("a") + ' ' + at("b") + " --json -o " + at("ab.html"));
  ASSERT_EQ(out.exit_code, 0) << out.err;
  const json told = json::parse(out.out);
  for (const json& finding : told["findings"]) {
    const std::string what = finding["what"];
    EXPECT_EQ(what.find(": success"), std::string::npos) << what;
    EXPECT_EQ(what.find(": cost"), std::string::npos) << what;
  }
}

TEST_F(BenchmarkCommand, AChangeIsFound) {
  // Enough work for all these problems, and next to none.
  const std::string head =
      "version: 1\nname: s\nfamilies:\n"
      "  - {name: wide, among_walls: {object: tee, count: 30}}\n"
      "  - {name: can, random: {object: cylinder, count: 20}}\n"
      "planners:\n  - {planner: push, budget: ";
  write_text(at("good.yaml"), head + "100}\n");
  write_text(at("poor.yaml"), head + "1}\n");
  ASSERT_EQ(benchmark(at("good.yaml") + " -o " + at("good")).exit_code, 0);
  ASSERT_EQ(benchmark(at("poor.yaml") + " -o " + at("poor")).exit_code, 0);
  const Outcome worse =
      benchmark("report " + at("good") + ' ' + at("poor") + " --fail-if-worse");
  EXPECT_EQ(worse.exit_code, 1) << worse.out;
  EXPECT_NE(worse.out.find("success worse"), std::string::npos) << worse.out;
  const Outcome better =
      benchmark("report " + at("poor") + ' ' + at("good") + " --fail-if-worse");
  EXPECT_EQ(better.exit_code, 0) << better.out;
  EXPECT_NE(better.out.find("success better"), std::string::npos) << better.out;
}

TEST_F(BenchmarkCommand, BadInputIsRefused) {
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const Outcome out = benchmark(arguments);
    EXPECT_EQ(out.exit_code, 2) << arguments;
    EXPECT_NE(out.err.find(words), std::string::npos) << out.err;
  };
  refused("", "expected a suite file");
  refused(at("suite.yaml"), "-o: missing");
  refused(at("absent.yaml") + " -o " + at("a"), "cannot be opened");
  refused(at("suite.yaml") + " -o " + at("no/folder/a"), "cannot be written");
  refused(at("suite.yaml") + " -o " + at("suite.yaml"), "SUITE does not name");
  write_text(at("other"), "mine");
  refused(at("suite.yaml") + " -o " + at("other"), "exists");
  refused(at("suite.yaml") + " -o " + at("other") + " --resume",
          "expected a file of results");
  EXPECT_EQ(read_text(at("other")), "mine");
  refused(at("suite.yaml") + " -o " + at("a") + " --fail-below x", "--fail-below");
  EXPECT_FALSE(std::filesystem::exists(at("a")));
  refused(at("suite.yaml") + " -o " + at("a") + " --shard 3/2", "1 <= I <= N");
  refused("report " + at("suite.yaml"), "file of results");
  refused("merge " + at("suite.yaml") + " -o " + at("m"), "file of results");
  EXPECT_EQ(read_text(at("suite.yaml")), kSuite);
}

TEST_F(BenchmarkCommand, CtrlCKeepsTheRows) {
  Running running({"benchmark", at("suite.yaml"), "-o", at("a"), "--jobs", "1"});
  while (!fs::exists(at("a"))) sleep_for(1e-3);
  sleep_for(0.02);
  running.signal(SIGINT);
  const int code = running.wait();
  const int rows = rows_in(at("a"));
  EXPECT_TRUE(code == 1 || (code == 0 && rows == kRuns)) << code;
  EXPECT_FALSE(fs::exists(at("a") + "-wal"));
  const Outcome out = benchmark(at("suite.yaml") + " -o " + at("a") + " --resume");
  EXPECT_EQ(out.exit_code, 0) << out.err;
  EXPECT_EQ(rows_in(at("a")), kRuns);
}

/// A run that was going on is not done: it is no row, and is done when it is resumed.
TEST_F(BenchmarkCommand, AStopOfTheWholeGroupLeavesNoFalseRow) {
  ASSERT_EQ(benchmark(at("suite.yaml") + " -o " + at("whole")).exit_code, 0);
  for (const int number : {SIGTERM, SIGINT, SIGTERM, SIGTERM, SIGINT, SIGTERM}) {
    Running running({"benchmark", at("suite.yaml"), "-o", at("a"), "--resume"});
    while (running.children().empty() && !running.has_ended()) sleep_for(1e-4);
    // Terminals and batch systems send it to all, in any order: this one is the worst.
    for (const pid_t child : running.children()) ::kill(child, number);
    sleep_for(0.01);
    running.signal(number);
    running.wait();
  }
  ASSERT_EQ(benchmark(at("suite.yaml") + " -o " + at("a") + " --resume").exit_code, 0);
  const suite::Results stopped = suite::read_results(at("a"));
  const suite::Results whole = suite::read_results(at("whole"));
  ASSERT_EQ(stopped.rows.size(), whole.rows.size());
  for (std::size_t i = 0; i < whole.rows.size(); ++i) {
    EXPECT_EQ(stopped.rows[i].record.status, whole.rows[i].record.status)
        << stopped.rows[i].record.message;
  }
}

/// Kills the program, one of its runs, or both, at random times until it gets through.
/// A run that was killed alone is a row that says so: those are not compared.
void kill_at_random(const std::string& suite, const std::string& file, int kills,
                    double longest, std::uint64_t seed) {
  Random random(seed);
  int before = 0;
  for (int i = 0; i < kills; ++i) {
    Running running({"benchmark", suite, "-o", file, "--resume", "--jobs", "2"});
    while (!fs::exists(file)) sleep_for(1e-3);
    sleep_for(random.in(0.0, longest));
    const int what = i % 3;
    if (what != 0) {
      for (const pid_t child : running.children()) ::kill(child, SIGKILL);
    }
    if (what == 1) {
      sleep_for(0.01);
      running.signal(SIGTERM);
    } else {
      running.signal(SIGKILL);
    }
    running.wait();
    // Killed before the first transaction was through, a file holds nothing yet.
    const int rows = std::max(0, rows_in(file));
    EXPECT_GE(rows, before) << "rows were lost at kill " << i;
    before = std::max(rows, before);
  }
}

/// All keys once, and apart from killed runs the facts of the undisturbed file.
void expect_same_but_for_killed(const fs::path& disturbed, const fs::path& whole) {
  const suite::Results a = suite::read_results(disturbed);
  const suite::Results b = suite::read_results(whole);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    ASSERT_EQ(a.rows[i].key, b.rows[i].key);
    if (a.rows[i].record.signal == SIGKILL) continue;
    EXPECT_EQ(a.rows[i].record.status, b.rows[i].record.status);
    EXPECT_EQ(a.rows[i].record.plan, b.rows[i].record.plan);
    EXPECT_EQ(a.rows[i].record.stick_tests, b.rows[i].record.stick_tests);
  }
}

TEST_F(BenchmarkCommand, SurvivesKills) {
  ASSERT_EQ(benchmark(at("suite.yaml") + " -o " + at("whole")).exit_code, 0);
  kill_at_random(at("suite.yaml"), at("a"), 4, 0.06, 1);
  ASSERT_EQ(benchmark(at("suite.yaml") + " -o " + at("a") + " --resume").exit_code, 0);
  expect_same_but_for_killed(at("a"), at("whole"));
}

TEST_F(BenchmarkCommand, FullSurvivesTwentyKills) {
  std::string suite = kSuite;
  for (std::size_t at = suite.find("count: 6"); at != std::string::npos;
       at = suite.find("count: 6")) {
    suite.replace(at, 8, "count: 40");
  }
  write_text(at("long.yaml"), suite);
  ASSERT_EQ(benchmark(at("long.yaml") + " -o " + at("whole")).exit_code, 0);
  kill_at_random(at("long.yaml"), at("a"), 20, 0.4, 2);
  ASSERT_EQ(benchmark(at("long.yaml") + " -o " + at("a") + " --resume").exit_code, 0);
  expect_same_but_for_killed(at("a"), at("whole"));
}

TEST_F(BenchmarkCommand, KillingTheProgramEndsItsRuns) {
  write_text(at("slow.yaml"),
             "version: 1\nname: slow\nfamilies:\n"
             "  - {name: f, scenes: {files: [long_search.yaml]}}\n"
             "planners:\n  - {planner: push, budget: 1e12, until: budget}\n");
  fs::copy_file(fs::path(PREHENSILE_SOURCE_DIR) / "tests/apps/long_search.yaml",
                at("long_search.yaml"));
  Running running({"benchmark", at("slow.yaml"), "-o", at("a")});
  std::vector<pid_t> children;
  for (int i = 0; i < 2000 && children.empty(); ++i) {
    sleep_for(0.005);
    children = running.children();
  }
  ASSERT_EQ(children.size(), 1u);
  running.signal(SIGKILL);
  running.wait();
  bool is_gone = false;
  for (int i = 0; i < 2000 && !is_gone; ++i) {
    sleep_for(0.005);
    std::ifstream in("/proc/" + std::to_string(children[0]) + "/stat");
    std::string id, name, state;
    is_gone = !(in >> id >> name >> state) || state == "Z" || state == "X";
  }
  EXPECT_TRUE(is_gone);
  EXPECT_EQ(rows_in(at("a")), 0) << "a row of a run that did not end";
}

TEST_F(BenchmarkCommand, ShardsMergeAndExport) {
  for (const char* shard : {"1/2", "2/2"}) {
    const std::string file = at(std::string("s") + shard[0]);
    ASSERT_EQ(benchmark(at("suite.yaml") + " -o " + file + " --shard " + shard).exit_code,
              0);
  }
  const Outcome merged =
      benchmark("merge " + at("s1") + ' ' + at("s2") + " -o " + at("m"));
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(rows_in(at("m")), kRuns);
  ASSERT_EQ(benchmark("export " + at("m") + " -o " + at("logs")).exit_code, 0);
  for (const char* family : {"published", "boxes", "convex"}) {
    EXPECT_TRUE(read_text(at(std::string("logs/") + family + ".log"))
                    .starts_with("prehensile version "));
  }
}

}  // namespace
}  // namespace prehensile::testing
