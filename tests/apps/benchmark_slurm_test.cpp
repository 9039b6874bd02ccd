/// `prehensile benchmark slurm` on a real Slurm of two nodes, where that is installed.
#include <chrono>
#include <cstdlib>
#include <sys/wait.h>
#include <thread>

#include <gtest/gtest.h>

#include "benchmarks/suite/results.h"
#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;

const std::string kSuite =
    "version: 1\nname: small\nfamilies:\n"
    "  - {name: wide, among_walls: {object: tee, count: 40}}\n"
    "  - {name: boxes, random: {object: box, count: 40}}\n"
    "planners:\n  - {planner: push}\n";

int shell(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Two nodes, from beginning to end.
class Cluster {
 public:
  explicit Cluster(const fs::path& folder) : folder_(folder) {
    outcome_ = run("start");
    ::setenv("SLURM_CONF", (folder / "slurm.conf").c_str(), 1);
  }
  ~Cluster() {
    run("stop");
    ::unsetenv("SLURM_CONF");
  }
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;
  int outcome() const { return outcome_; }

 private:
  int run(const std::string& what) const {
    return shell("bash " PREHENSILE_SOURCE_DIR "/tests/apps/slurm_cluster.sh " + what +
                 ' ' + folder_.string() + " > /dev/null 2>&1");
  }
  fs::path folder_;
  int outcome_ = -1;
};

/// Waits for a file, freeing a requeued task from the two minutes that Slurm holds it.
bool wait_for(const fs::path& file, const std::string& task) {
  for (int i = 0; i < 600; ++i) {
    if (fs::exists(file)) return true;
    if (!task.empty()) {
      shell("scontrol update JobId=" + task + " StartTime=now > /dev/null 2>&1");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  return false;
}

/// Rows without what depends on clock, load or machine.
std::string facts(const fs::path& file) {
  std::string out;
  for (const suite::ResultRow& row : suite::read_results(file).rows) {
    out += std::to_string(row.key.family) + ' ' + std::to_string(row.key.problem) + ' ' +
           std::string(suite::name(row.record.status)) + ' ' + row.record.plan + ' ' +
           std::to_string(row.record.stick_tests) + '\n';
  }
  return out;
}

TEST(BenchmarkSlurm, WritesScripts) {
  const Folder folder;
  write_text(folder.path("suite.yaml"), kSuite);
  const Outcome out =
      run_program("benchmark slurm " + folder.path("suite.yaml").string() +
                  " --tasks 3 -o " + folder.path("job").string());
  ASSERT_EQ(out.exit_code, 0) << out.err;
  EXPECT_NE(out.out.find("80 runs in 3 tasks"), std::string::npos) << out.out;
  EXPECT_EQ(read_text(folder.path("job/suite.yaml")), kSuite);
  EXPECT_NE(read_text(folder.path("job/array.sh")).find("#SBATCH --array=1-3"),
            std::string::npos);
}

TEST(BenchmarkSlurm, FullTwoNodesGiveWhatOneMachineGives) {
  const Folder folder;
  const Cluster cluster(folder.path("slurm"));
  if (cluster.outcome() == 77) {
    GTEST_SKIP() << "Slurm is not installed (Debian: slurm-wlm munge)";
  }
  ASSERT_EQ(cluster.outcome(), 0) << "the nodes did not come up";
  const std::string suite_file = folder.path("suite.yaml").string();
  write_text(suite_file, kSuite);
  const Outcome out =
      run_program("benchmark slurm " + suite_file + " --tasks 4 --submit -o " +
                  folder.path("job").string());
  ASSERT_EQ(out.exit_code, 0) << out.err;
  const std::size_t at = out.out.find("submitted array ");
  ASSERT_NE(at, std::string::npos) << out.out;
  const std::string array = out.out.substr(at + 16, out.out.find(' ', at + 16) - at - 16);
  // A task that is taken back while it runs goes on later where it was.
  ASSERT_TRUE(wait_for(folder.path("job/log/1.txt"), ""));
  shell("scontrol requeue " + array + "_1 > /dev/null 2>&1");
  ASSERT_TRUE(wait_for(folder.path("job/shard_1.sqlite"), array + "_1"));
  ASSERT_TRUE(wait_for(folder.path("job/results.sqlite"), array + "_1"));

  const std::string alone = folder.path("alone.sqlite").string();
  ASSERT_EQ(run_program("benchmark " + suite_file + " -o " + alone).exit_code, 0);
  EXPECT_EQ(facts(folder.path("job/results.sqlite")), facts(alone));

  // Everything submitted again: nothing is done twice.
  const std::string before = read_text(folder.path("job/results.sqlite"));
  ASSERT_EQ(shell("cd " + folder.path("job").string() +
                  " && sbatch --wait array.sh > /dev/null && sbatch --wait merge.sh > "
                  "/dev/null"),
            0);
  EXPECT_EQ(read_text(folder.path("job/results.sqlite")), before);
}

}  // namespace
}  // namespace prehensile::testing
