/// A suite as a Slurm job array: every task runs a shard, a last job merges them.
#pragma once

#include <filesystem>
#include <string>

namespace prehensile::suite {

/// What the scripts are made of; paths are absolute.
struct SlurmJob {
  std::filesystem::path program;
  std::filesystem::path suite;
  std::filesystem::path data;    ///< folder of the files that the suite names
  std::filesystem::path folder;  ///< for scripts, shards, logs and results
  std::string name;              ///< one word
  int tasks = 1;
  bool quick = false;
};

/// How many tasks keep each one busy for at least `least_seconds`, as starting one costs
/// the scheduler about a second.
int number_of_tasks(int runs, double seconds_per_run, double least_seconds);

/// A task writes its shard under another name and renames it when it is complete; one
/// that is tried again goes on where the first try ended, or does nothing.
std::string array_script(const SlurmJob& job);

/// Merges, once all shards are there; says which are missing.
std::string merge_script(const SlurmJob& job);

/// Submits the array, and the merge behind it.
std::string submit_script(const SlurmJob& job);

/// A word of a shell script that stands for itself.
std::string shell_word(const std::string& word);

}  // namespace prehensile::suite
