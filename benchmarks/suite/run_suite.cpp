#include "benchmarks/suite/run_suite.h"

#include <chrono>
#include <csignal>
#include <stdexcept>

#include "benchmarks/suite/worker_pool.h"

namespace prehensile::suite {
namespace {

ProcessLimits process_limits(const Limits& limits) {
  return {.cpu_time = limits.cpu_time,
          .wall_time = limits.wall_time,
          .memory_MB = limits.memory_MB};
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

/// Calls f(key) for all runs in their order.
template <typename F>
void for_each_run(const Suite& suite, const ProblemList& problems, const F& f) {
  for (int family = 0; family < problems.families(); ++family) {
    for (int problem = 0; problem < problems.count(family); ++problem) {
      for (std::size_t planner = 0; planner < suite.planners.size(); ++planner) {
        for (int seed = 1; seed <= suite.planners[planner].seeds; ++seed) {
          for (int repetition = 1; repetition <= suite.repetitions; ++repetition) {
            f(RunKey{family, problem, static_cast<int>(planner), seed, repetition});
          }
        }
      }
    }
  }
}

bool is_of_shard(int number, const RunOptions& options) {
  return number % options.shards == options.shard - 1;
}

/// What the file lacks.
template <typename Key>
std::vector<Key> missing(std::vector<Key> wanted, const std::set<Key>& done) {
  std::erase_if(wanted, [&done](const Key& key) { return done.contains(key); });
  return wanted;
}

}  // namespace

std::vector<RunKey> runs_of(const Suite& suite, const ProblemList& problems,
                            const RunOptions& options) {
  std::vector<RunKey> keys;
  int number = 0;
  for_each_run(suite, problems, [&](const RunKey& key) {
    if (is_of_shard(number++, options)) keys.push_back(key);
  });
  return keys;
}

std::vector<int> studies_of(const Suite& suite, const ProblemList& problems,
                            const RunOptions& options) {
  std::vector<int> studies;
  int number = 0;
  for_each_run(suite, problems, [&number](const RunKey&) { ++number; });
  for (std::size_t i = 0; i < suite.studies.size(); ++i) {
    if (is_of_shard(number++, options)) studies.push_back(static_cast<int>(i));
  }
  return studies;
}

StudyRecord study_apart(const Suite& suite, StudyRunner& runner, int study) {
  WorkerPool pool(1, process_limits(suite.limits));
  if (auto refused = runner.start(study, 0, pool)) return *std::move(refused);
  for (;;) {
    if (const auto ending = pool.wait(3600.0)) return runner.record_of(study, *ending);
  }
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
  const std::vector<RunKey> all_runs = runs_of(suite, problems, options);
  const std::vector<int> all_studies =
      options.studies ? studies_of(suite, problems, options) : std::vector<int>();
  // Tickets count the missing runs, then the missing studies.
  const std::vector<RunKey> keys = missing(all_runs, results.done());
  const std::vector<int> studies = missing(all_studies, results.studies_done());
  const std::size_t wanted = all_runs.size() + all_studies.size();
  std::size_t done = wanted - keys.size() - studies.size();
  const Pace pace(static_cast<int>(done), static_cast<int>(wanted));
  RunCount count;
  std::size_t next = 0;
  int running = 0;
  const auto add = [&](const auto& row) {
    results.add(row);
    ++count.done;
    if (options.progress) options.progress(pace.at(static_cast<int>(++done), running));
  };
  WorkerPool pool(options.jobs, process_limits(suite.limits));
  const auto start = [&](std::size_t i) {
    const int ticket = static_cast<int>(i);
    ++running;
    if (i < keys.size()) {
      pool.start(ticket,
                 [&] { return to_text(run_one(suite, problems, planners, keys[i])); });
    } else if (const auto refused =
                   options.studies->start(studies[i - keys.size()], ticket, pool)) {
      --running;
      add(*refused);
    }
  };
  const auto finish = [&](const Ending& ending) {
    const auto i = static_cast<std::size_t>(ending.ticket);
    --running;
    if (i < keys.size()) {
      const bool is_constructed = problems.is_constructed(keys[i].family);
      add(ResultRow{keys[i], record_of(ending, is_constructed)});
    } else {
      add(options.studies->record_of(studies[i - keys.size()], ending));
    }
  };
  while (!is_stopped(options)) {
    if (next < keys.size() + studies.size() && !pool.is_full()) {
      start(next++);
      continue;
    }
    if (pool.is_idle()) break;
    if (const auto ending = pool.wait(1.0)) finish(*ending);
  }
  count.stopped = is_stopped(options);
  return count;
}

}  // namespace prehensile::suite
