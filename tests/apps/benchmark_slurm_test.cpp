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

/// What a command prints, wherever.
std::string said(const std::string& command) {
  std::string text;
  std::FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  for (int c = 0; pipe && (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  if (!pipe || ::pclose(pipe) != 0) text += "\n(failed: " + command + ")";
  return text;
}

/// Two nodes, from beginning to end.
class Cluster {
 public:
  explicit Cluster(const fs::path& folder) : folder_(folder) {
    outcome_ = run("start");
    ::setenv("SLURM_CONF", (folder / "slurm.conf").c_str(), 1);
  }
  ~Cluster() {
    const int stopped = run("stop");
    if (outcome_ == 0) {
      EXPECT_EQ(stopped, 0) << story();
    }
    ::unsetenv("SLURM_CONF");
  }
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;
  int outcome() const { return outcome_; }

  /// Kills a node with all that it runs; whether it ran anything.
  bool kill_node(const std::string& node) const { return run("kill_node", node) == 0; }

  /// What went wrong, and the last lines of every daemon.
  std::string story() const {
    return said("tail -n 20 " + log() + ' ' + folder_.string() + "/log/*.log");
  }

 private:
  std::string log() const { return folder_.string() + ".log"; }
  int run(const std::string& what, const std::string& node = "") const {
    return shell("bash " PREHENSILE_SOURCE_DIR "/tests/apps/slurm_cluster.sh " + what +
                 ' ' + folder_.string() + ' ' + node + " >> " + log() + " 2>&1");
  }
  fs::path folder_;
  int outcome_ = -1;
};

/// Waits for a file, freeing a requeued task from the two minutes that Slurm holds it.
bool wait_for(const fs::path& file, const std::string& task) {
  for (int i = 0; i < 1500; ++i) {
    if (fs::exists(file)) return true;
    if (!task.empty()) {
      // Refused, with a message, as long as the task is not the one that is held.
      shell("scontrol update JobId=" + task + " StartTime=now > /dev/null 2>&1");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  return false;
}

/// Submits a suite in some tasks to job/ in the folder; the number of the array.
std::string submit(const Folder& folder, const std::string& suite, int tasks) {
  write_text(folder.path("suite.yaml"), suite);
  const Outcome out =
      run_program("benchmark slurm " + folder.path("suite.yaml").string() + " --tasks " +
                  std::to_string(tasks) + " --submit -o " + folder.path("job").string());
  EXPECT_EQ(out.exit_code, 0) << out.err;
  const std::size_t at = out.out.find("submitted array ");
  if (at == std::string::npos) return out.out;
  return out.out.substr(at + 16, out.out.find(' ', at + 16) - at - 16);
}

/// The rows of a file that a program is writing; 0 where it cannot be read just now.
int rows_under_way(const Folder& folder, const std::string& file) {
  const fs::path copy = folder.path("copy");
  std::error_code ignored;
  try {
    for (const char* ending : {"", "-wal"}) {
      fs::copy_file(file + ending, copy.string() + ending,
                    fs::copy_options::overwrite_existing, ignored);
    }
    return static_cast<int>(suite::read_results(copy).rows.size());
  } catch (const std::exception&) {
    return 0;
  }
}

/// The number of the task of an array that a node runs, once it has added some rows.
std::string task_with_rows(const Folder& folder, const std::string& node, int rows) {
  for (int i = 0; i < 1500; ++i) {
    const std::string task = said("squeue -h -t R -w " + node + " -o %K");
    const std::string number = task.substr(0, task.find('\n'));
    const fs::path part = folder.path("job/shard_" + number + ".sqlite.part");
    if (!number.empty() && rows_under_way(folder, part.string()) >= rows) return number;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return {};
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
  ASSERT_EQ(cluster.outcome(), 0) << cluster.story();
  const std::string suite_file = folder.path("suite.yaml").string();
  const std::string array = submit(folder, kSuite, 4);
  // A task that is taken back while it runs goes on later where it was.
  ASSERT_TRUE(wait_for(folder.path("job/log/1.txt"), "")) << cluster.story();
  ASSERT_EQ(said("scontrol requeue " + array + "_1"), "");
  ASSERT_TRUE(wait_for(folder.path("job/shard_1.sqlite"), array + "_1"))
      << cluster.story();
  const std::string task = said("scontrol show job " + array + "_1");
  EXPECT_NE(task.find("Restarts=1"), std::string::npos) << task;
  ASSERT_TRUE(wait_for(folder.path("job/results.sqlite"), "")) << cluster.story();

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

TEST(BenchmarkSlurm, FullADeadNodeLosesNothing) {
  const Folder folder;
  const Cluster cluster(folder.path("slurm"));
  if (cluster.outcome() == 77) {
    GTEST_SKIP() << "Slurm is not installed (Debian: slurm-wlm munge)";
  }
  ASSERT_EQ(cluster.outcome(), 0) << cluster.story();
  // Runs of some tenths of a second, so that a task can be met half way.
  const std::string suite =
      "version: 1\nname: slow\nfamilies:\n"
      "  - {name: wide, among_walls: {object: tee, count: 40}}\n"
      "planners:\n  - {planner: push, budget: 1e6, until: budget}\n";
  const std::string array = submit(folder, suite, 2);
  const std::string number = task_with_rows(folder, "b", 3);
  ASSERT_NE(number, "") << cluster.story();
  ASSERT_TRUE(cluster.kill_node("b")) << cluster.story();

  // Slurm finds that the node is gone, and gives its task to the other one.
  const std::string task = array + '_' + number;
  const fs::path shard = folder.path("job/shard_" + number + ".sqlite");
  ASSERT_TRUE(wait_for(shard, task))
      << said("scontrol show job " + task) << cluster.story();
  EXPECT_EQ(said("sinfo -h -n b -o %t").substr(0, 4), "down");
  const std::string shown = said("scontrol show job " + task);
  EXPECT_NE(shown.find("Restarts=1"), std::string::npos) << shown;
  EXPECT_NE(shown.find("BatchHost=a"), std::string::npos) << shown;
  // It went on where it had been.
  const std::string log = read_text(folder.path("job/log/" + number + ".txt"));
  const std::size_t at = log.rfind(" runs in ");
  ASSERT_NE(at, std::string::npos) << log;
  const int added = std::stoi(log.substr(log.rfind('\n', at) + 1));
  EXPECT_LE(added, 20 - 3) << log;

  ASSERT_TRUE(wait_for(folder.path("job/results.sqlite"), "")) << cluster.story();
  const std::string alone = folder.path("alone.sqlite").string();
  ASSERT_EQ(
      run_program("benchmark " + folder.path("suite.yaml").string() + " -o " + alone)
          .exit_code,
      0);
  EXPECT_EQ(suite::read_results(folder.path("job/results.sqlite")).rows.size(), 40u);
  EXPECT_EQ(facts(folder.path("job/results.sqlite")), facts(alone));
}

}  // namespace
}  // namespace prehensile::testing
