#include "benchmarks/suite/run_suite.h"

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <unistd.h>

#include "benchmarks/suite/worker_pool.h"

namespace prehensile::suite {
namespace {

ProcessLimits process_limits(const Limits& limits) {
  return {.cpu_time = limits.cpu_time,
          .wall_time = limits.wall_time,
          .memory_MB = limits.memory_MB};
}

std::string host_name() {
  char host[256] = "unknown";
  if (::gethostname(host, sizeof host - 1) != 0) return "unknown";
  return host;
}

/// The row of a run that did not report.
RunRecord record_of_loss(const Ending& ending) {
  RunRecord record;
  record.host = host_name();
  record.time = ending.cpu_time;
  record.signal = ending.signal;
  switch (ending.kind) {
    case Ending::Kind::kTimeout:
      record.status = RunStatus::kTimeout;
      record.message = "killed at the time limit of the suite";
      break;
    case Ending::Kind::kOutOfMemory:
      record.status = RunStatus::kOutOfMemory;
      record.message = "ended at the memory limit of the suite";
      break;
    case Ending::Kind::kDone:
    case Ending::Kind::kCrashed:
      record.status = RunStatus::kCrashed;
      record.message = ending.signal != 0
                           ? "ended by signal " + std::to_string(ending.signal)
                           : "ended without a result";
      break;
  }
  return record;
}

RunRecord record_of(const Ending& ending, bool is_constructed) {
  RunRecord record;
  const bool reported =
      ending.kind == Ending::Kind::kDone && from_text(ending.text, record);
  if (!reported) record = record_of_loss(ending);
  record.constructed = is_constructed;
  record.memory = ending.memory_MB;
  return record;
}

class Pace {
 public:
  Pace(int before, int wanted) : before_(before), wanted_(wanted), begin_(now()) {}

  RunProgress at(int done, int running) const {
    RunProgress progress{.done = done, .wanted = wanted_, .running = running};
    progress.runs_per_second = (done - before_) / std::max(1e-3, now() - begin_);
    if (done > before_) {
      progress.seconds_left = (wanted_ - done) / progress.runs_per_second;
    }
    return progress;
  }

 private:
  static double now() {
    return std::chrono::duration<double>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }

  int before_, wanted_;
  double begin_;
};

bool is_stopped(const RunOptions& options) {
  return options.stop && options.stop->load();
}

}  // namespace

std::vector<RunKey> runs_of(const Suite& suite, const ProblemList& problems,
                            const RunOptions& options) {
  std::vector<RunKey> keys;
  int number = 0;
  for (int family = 0; family < problems.families(); ++family) {
    for (int problem = 0; problem < problems.count(family); ++problem) {
      for (std::size_t planner = 0; planner < suite.planners.size(); ++planner) {
        for (int seed = 1; seed <= suite.planners[planner].seeds; ++seed) {
          for (int repetition = 1; repetition <= suite.repetitions; ++repetition) {
            if (number++ % options.shards != options.shard - 1) continue;
            keys.push_back(
                {family, problem, static_cast<int>(planner), seed, repetition});
          }
        }
      }
    }
  }
  return keys;
}

RunRecord run_apart(const Suite& suite, const ProblemList& problems,
                    const PlannerTable& planners, const RunKey& key) {
  WorkerPool pool(1, process_limits(suite.limits));
  pool.start(0, [&] { return to_text(run_one(suite, problems, planners, key)); });
  for (;;) {
    if (const auto ending = pool.wait(3600.0)) {
      return record_of(*ending, problems.is_constructed(key.family));
    }
  }
}

RunCount run_suite(const Suite& suite, const ProblemList& problems,
                   const PlannerTable& planners, const RunOptions& options,
                   ResultsWriter& results) {
  const std::vector<RunKey> keys = runs_of(suite, problems, options);
  int done = 0;
  for (const RunKey& key : keys) done += results.done().contains(key) ? 1 : 0;
  const Pace pace(done, static_cast<int>(keys.size()));
  RunCount count;
  std::size_t next = 0;
  int running = 0;
  WorkerPool pool(options.jobs, process_limits(suite.limits));
  while (!is_stopped(options)) {
    while (next < keys.size() && results.done().contains(keys[next])) ++next;
    if (next < keys.size() && !pool.is_full()) {
      const RunKey& key = keys[next];
      pool.start(static_cast<int>(next++),
                 [&] { return to_text(run_one(suite, problems, planners, key)); });
      ++running;
      continue;
    }
    if (pool.is_idle()) break;
    const auto ending = pool.wait(1.0);
    if (!ending) continue;
    --running;
    const RunKey& key = keys[static_cast<std::size_t>(ending->ticket)];
    results.add({key, record_of(*ending, problems.is_constructed(key.family))});
    ++count.done;
    if (options.progress) options.progress(pace.at(++done, running));
  }
  count.stopped = is_stopped(options);
  return count;
}

}  // namespace prehensile::suite
