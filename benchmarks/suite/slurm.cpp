#include "benchmarks/suite/slurm.h"

#include <algorithm>
#include <cmath>

namespace prehensile::suite {

std::string shell_word(const std::string& word) {
  std::string out = "'";
  for (const char c : word) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out + '\'';
}

int number_of_tasks(int runs, double seconds_per_run, double least_seconds) {
  constexpr int kMostTasks = 1000;  // Slurm's usual limit of an array is 1001
  const double tasks = std::floor(runs * seconds_per_run / least_seconds);
  return static_cast<int>(std::clamp(tasks, 1.0, std::min<double>(kMostTasks, runs)));
}

std::string array_script(const SlurmJob& job) {
  const std::string count = std::to_string(job.tasks);
  std::string out = "#!/bin/bash\n";
  out += "#SBATCH --job-name=" + job.name + '\n';
  out += "#SBATCH --array=1-" + count + '\n';
  out += "#SBATCH --output=log/%a.txt\n#SBATCH --open-mode=append\n#SBATCH --requeue\n";
  out += "set -eu\ncd " + shell_word(job.folder.string()) + '\n';
  out += "shard=shard_$SLURM_ARRAY_TASK_ID.sqlite\n";
  out += "if [ -e \"$shard\" ]; then echo \"$shard is complete\"; exit 0; fi\n";
  out += shell_word(job.program.string()) + " benchmark " +
         shell_word(job.suite.string()) + " --data " + shell_word(job.data.string());
  if (job.quick) out += " --quick";
  out += " \\\n  -o \"$shard.part\" --resume --shard \"$SLURM_ARRAY_TASK_ID/" + count +
         "\" --jobs \"${SLURM_CPUS_PER_TASK:-1}\"\n";
  return out + "mv \"$shard.part\" \"$shard\"\n";
}

std::string merge_script(const SlurmJob& job) {
  std::string out = "#!/bin/bash\n";
  out += "#SBATCH --job-name=" + job.name + "-merge\n";
  out += "#SBATCH --output=log/merge.txt\n#SBATCH --open-mode=append\n";
  out += "set -eu\ncd " + shell_word(job.folder.string()) + '\n';
  out += "if [ -e results.sqlite ]; then echo \"results.sqlite is there\"; exit 0; fi\n";
  out += "missing=\nfor i in $(seq " + std::to_string(job.tasks) + "); do\n";
  out += "  [ -e shard_$i.sqlite ] || missing=\"$missing $i\"\ndone\n";
  out += "if [ -n \"$missing\" ]; then\n";
  out += "  echo \"no shards of tasks$missing: submit them again\" >&2\n  exit 1\nfi\n";
  return out + shell_word(job.program.string()) +
         " benchmark merge shard_*.sqlite -o results.sqlite\n";
}

std::string submit_script(const SlurmJob& job) {
  std::string out = "#!/bin/bash\nset -eu\ncd " + shell_word(job.folder.string()) + '\n';
  out += "array=$(sbatch --parsable array.sh)\narray=${array%%;*}\n";
  out += "merge=$(sbatch --parsable --dependency=afterany:\"$array\" merge.sh)\n";
  return out + "echo \"submitted array $array and merge ${merge%%;*}\"\n";
}

}  // namespace prehensile::suite
