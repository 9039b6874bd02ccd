#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "apps/benchmark_commands.h"
#include "apps/option_checks.h"
#include "benchmarks/suite/run_suite.h"
#include "benchmarks/suite/slurm.h"
#include "io/plan_file.h"
#include "io/scene_file.h"

namespace prehensile::apps {
namespace {

namespace fs = std::filesystem;

struct Options {
  SuiteOptions suite;
  std::string folder;
  int tasks = 0;
  double task_seconds = 30.0;
  bool submit = false;
};

/// [s] of a run, from a few that are spread over the suite.
double seconds_per_run(const suite::SuiteFile& file, const suite::ProblemList& problems,
                       const suite::PlannerTable& planners,
                       const std::vector<suite::RunKey>& runs) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kSamples = 24;
  const std::size_t samples = std::min(kSamples, runs.size());
  const Clock::time_point begin = Clock::now();
  for (std::size_t i = 0; i < samples; ++i) {
    run_apart(file.suite, problems, planners, runs[i * runs.size() / samples]);
  }
  return std::chrono::duration<double>(Clock::now() - begin).count() /
         static_cast<double>(samples);
}

int start_script(const fs::path& script) {
  std::string shell = "bash";
  std::string file = script.string();
  char* const words[] = {shell.data(), file.data(), nullptr};
  pid_t process = -1;
  int status = 0;
  const bool started =
      posix_spawnp(&process, "bash", nullptr, nullptr, words, environ) == 0 &&
      ::waitpid(process, &status, 0) == process;
  if (!started || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw BadInput(file + ": failed: expected `sbatch` of Slurm to accept the job");
  }
  return kDone;
}

int run(const Options& options) {
  const suite::PlannerTable planners = suite::planners_of_build();
  const suite::SuiteFile file =
      suite::read_suite(options.suite.file, suite::names(planners), options.suite.data);
  const suite::ProblemList problems(file, options.suite.quick);
  const std::vector<suite::RunKey> runs = suite::runs_of(file.suite, problems, {});
  const int studies = static_cast<int>(file.suite.studies.size());
  suite::SlurmJob job;
  job.tasks = options.tasks;
  if (job.tasks == 0 && !runs.empty()) {
    const double each = seconds_per_run(file, problems, planners, runs);
    job.tasks =
        suite::number_of_tasks(static_cast<int>(runs.size()), each, options.task_seconds);
  }
  // A study is worth a task.
  if (options.tasks == 0) job.tasks = std::max(job.tasks, studies);
  std::error_code error;
  fs::create_directories(fs::path(options.folder) / "log", error);
  if (error) throw BadInput(options.folder + ": cannot be made: " + error.message());
  job.program = fs::canonical("/proc/self/exe");
  job.folder = fs::canonical(options.folder);
  job.data = fs::canonical(file.folder.empty() ? fs::path(".") : file.folder);
  job.suite =
      job.folder / "suite.yaml";  // the suite as it is now, whatever becomes of it
  job.name = file.suite.name;
  job.quick = options.suite.quick;
  write_atomically(job.suite, file.text);
  write_atomically(job.folder / "array.sh", array_script(job));
  write_atomically(job.folder / "merge.sh", merge_script(job));
  write_atomically(job.folder / "submit.sh", submit_script(job));
  const std::string and_studies =
      studies > 0 ? " and " + std::to_string(studies) + " studies" : "";
  std::printf("%zu runs%s in %d tasks: %s\n", runs.size(), and_studies.c_str(), job.tasks,
              (job.folder / "array.sh").c_str());
  std::fflush(stdout);
  if (options.submit) return start_script(job.folder / "submit.sh");
  std::printf("submit them: bash %s\n", (job.folder / "submit.sh").c_str());
  return kDone;
}

}  // namespace

Command add_benchmark_slurm(CLI::App& benchmark) {
  auto options = std::make_shared<Options>();
  CLI::App& command =
      *benchmark.add_subcommand("slurm", "a suite as a Slurm job array with a merge");
  command.add_option("SUITE", options->suite.file, "suite file (YAML)")->required();
  command
      .add_option("-o,--output", options->folder,
                  "folder for scripts, shards and results; all nodes have to see it")
      ->required();
  command.add_option("--data", options->suite.data,
                     "folder of the files that the suite names; by default its own");
  command.add_flag("--quick", options->suite.quick, "few problems of each family");
  command
      .add_option(
          "--tasks", options->tasks,
          "tasks of the array; 0: as many as --task-s says, after a few runs here")
      ->check(CLI::Range(0, 1000));
  command
      .add_option("--task-s", options->task_seconds,
                  "seconds of work of a task, at least")
      ->check(in_range(10.0, 1e6))
      ->capture_default_str();
  command.add_flag("--submit", options->submit, "submit them with sbatch");
  command.footer(
      "A task that is tried again goes on where it was. Results: DIR/results.sqlite.\n"
      "Example:\n  prehensile benchmark slurm benchmarks/suites/full.yaml --data "
      "problems "
      "-o job --submit");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
