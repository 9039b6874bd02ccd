/// Studies of `prehensile benchmark` as a user sees them: the program with doubles of the
/// programs that lie beside it.
#include <cstdlib>
#include <sys/wait.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/suite/results.h"
#include "tests/apps/program.h"
#include "tests/plot/svg_text.h"
#include "tests/suite/asked.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kChart =
    "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\">"
    "<rect id=\"r\" x=\"1\" y=\"1\" width=\"5\" height=\"5\" fill=\"#123456\"/></svg>";
const std::string kSuite =
    "version: 1\nname: numbers\nstudies:\n"
    "  - {name: steps, program: integrators, arguments: ['--pushes', '4']}\n"
    "  - {name: broken, program: push}\n"
    "  - {name: real, program: truth, data: pushes}\n";

class BenchmarkStudies : public ::testing::Test {
 protected:
  BenchmarkStudies() {
    fs::create_directories(folder_.path("build/benchmarks"));
    fs::copy_file(PREHENSILE_PROGRAM, folder_.path("build/prehensile"));
    write_double("integrators",
                 "printf 'set <none> & more: \\033[31m12 of 12\\n' >&2\n"
                 "printf 'set,error\\na,1e-9\\n' > \"$2\"\necho '" +
                     kChart + "' > \"$4\"\n");
    write_double("push", "echo 'error: no pushes' >&2; exit 3\n");
    write_double("truth", "echo \"$1\"\n");
    write_text(folder_.path("suite.yaml"), kSuite);
  }
  std::string at(const std::string& name) const { return folder_.path(name).string(); }
  void write_double(const std::string& name, const std::string& script) const {
    const fs::path file = folder_.path("build/benchmarks/bench_" + name);
    write_text(file, "#!/bin/bash\n" + script);
    fs::permissions(file, fs::perms::owner_all);
  }
  /// The copy of the program that the doubles lie beside.
  Outcome benchmark(const std::string& arguments) const {
    const int status = std::system((at("build/prehensile") + " benchmark " + arguments +
                                    " >" + at("out") + " 2>" + at("err") + " </dev/null")
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(at("out")),
            read_text(at("err"))};
  }
  Folder folder_;
};

TEST_F(BenchmarkStudies, RunReportAndGoOn) {
  const Outcome out = benchmark(at("suite.yaml") + " -o " + at("a.sqlite"));
  EXPECT_EQ(out.exit_code, 1) << "one failed";
  EXPECT_NE(out.err.find("study broken: failed: exit code 3"), std::string::npos)
      << out.err;
  for (const char* part :
       {"integrators -o runs.csv --charts charts.svg --pushes 4", "set <none> & more",
        "error: no pushes", "skipped: no folder", "3 rows in"}) {
    EXPECT_NE(out.out.find(part), std::string::npos) << part << '\n' << out.out;
  }

  const Outcome report = benchmark("report " + at("a.sqlite") + " -o " + at("a.html"));
  EXPECT_EQ(report.exit_code, 0) << report.err;
  const std::string page = read_text(at("a.html"));
  EXPECT_NE(page.find("set &lt;none&gt; &amp; more:"), std::string::npos);
  EXPECT_NE(page.find("<rect id=\"study-steps-charts-r\""), std::string::npos);
  EXPECT_NE(page.find("failed: exit code 3"), std::string::npos);
  EXPECT_EQ(page.find('\x1b'), std::string::npos) << "an order to a terminal";
  EXPECT_EQ(page.find("success-chart"), std::string::npos) << "there are no planners";
  EXPECT_EQ(plot::testing::fault_of_svg(page.substr(page.find('\n') + 1)), "");
  EXPECT_EQ(read_text(at("a_study_steps.csv")), "set,error\na,1e-9\n");
  EXPECT_FALSE(fs::exists(at("a_study_broken.csv")));
  EXPECT_FALSE(fs::exists(at("a_runs.csv"))) << "there are no runs";

  const json told = json::parse(benchmark("report " + at("a.sqlite") + " --json").out);
  ASSERT_EQ(told["studies"].size(), 3u);
  EXPECT_EQ(told["studies"][0]["runs"], 1);
  EXPECT_EQ(told["studies"][0]["charts"][0], "charts");
  EXPECT_EQ(told["studies"][1]["exit_code"], 3);
  EXPECT_EQ(told["studies"][2]["status"], "skipped");

  // What failed ran, and is not repeated; the data have come.
  write_double("push", "exit 0\n");
  fs::create_directories(folder_.path("data/pushes"));
  const Outcome more = benchmark(at("suite.yaml") + " --resume --json --data " +
                                 at("data") + " -o " + at("a.sqlite"));
  EXPECT_EQ(more.exit_code, 1) << more.err;
  const json after = json::parse(more.out);
  EXPECT_EQ(after["studies"][1]["status"], "failed");
  EXPECT_EQ(after["studies"][2]["status"], "done");
  EXPECT_EQ(after["studies"][2]["printed"],
            fs::canonical(folder_.path("data/pushes")).string() + '\n');
}

TEST_F(BenchmarkStudies, OneAloneAndInShards) {
  const Outcome one = benchmark(at("suite.yaml") + " --only steps");
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(json::parse(one.out)["status"], "done");
  EXPECT_EQ(benchmark(at("suite.yaml") + " --only broken").exit_code, 1);
  EXPECT_EQ(benchmark(at("suite.yaml") + " --only stairs").exit_code, 2);
  const Outcome list = benchmark(at("suite.yaml") + " --list");
  EXPECT_NE(list.out.find("bench_truth pushes -o runs.csv"), std::string::npos);

  for (const char* shard : {"1/2", "2/2"}) {
    const std::string file = at(std::string("s") + shard[0]);
    EXPECT_EQ(benchmark(at("suite.yaml") + " -o " + file + " --shard " + shard).exit_code,
              0)
        << "a part is not judged";
  }
  EXPECT_EQ(benchmark("merge " + at("s1") + ' ' + at("s2") + " -o " + at("m")).exit_code,
            0);
  EXPECT_EQ(suite::read_results(at("m")).studies.size(), 3u);
  const Outcome both = benchmark("report " + at("m") + ' ' + at("m"));
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_NE(both.err.find("studies are not compared"), std::string::npos) << both.err;
}

TEST_F(BenchmarkStudies, ForeignChartsAreLeftOut) {
  benchmark(at("suite.yaml") + " -o " + at("a"));
  suite::testing::asked(at("a"),
                        "UPDATE study_charts SET svg = replace(svg, '<rect', "
                        "'<script>alert(1)</script><rect')");
  suite::testing::asked(at("a"), "UPDATE studies SET printed = x'ff3c2f7072653e1b'");
  ASSERT_EQ(benchmark("report " + at("a") + " -o " + at("a.html")).exit_code, 0);
  const std::string page = read_text(at("a.html"));
  EXPECT_NE(page.find("Left out:"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("</pre>\x1b"), std::string::npos);
  EXPECT_EQ(benchmark("report " + at("a") + " --json").exit_code, 0);
}

TEST_F(BenchmarkStudies, CtrlCKeepsWhatIsThere) {
  // Told by the second study itself, which then waits.
  write_double("push", "kill -INT $PPID; sleep 60\n");
  const Outcome out = benchmark(at("suite.yaml") + " --jobs 1 -o " + at("a"));
  EXPECT_EQ(out.exit_code, 1);
  EXPECT_NE(out.err.find("stopped: go on with --resume"), std::string::npos) << out.err;
  EXPECT_EQ(suite::read_results(at("a")).studies.size(), 1u);
  EXPECT_FALSE(fs::exists(at("a") + "-wal"));
}

}  // namespace
}  // namespace prehensile::testing
