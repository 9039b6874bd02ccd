/// Work in processes of its own: what crashes, hangs or eats memory there harms nobody
/// else. Processes are forked from this one, which has to be single-threaded; they end
/// with it, however it ends.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace prehensile::suite {

/// What ends a process.
struct ProcessLimits {
  double cpu_time = 60.0;     ///< [s]
  double wall_time = 600.0;   ///< [s]
  double memory_MB = 2000.0;  ///< of address space, beyond what this process has
};

/// How a process ended.
struct Ending {
  enum class Kind { kDone, kCrashed, kTimeout, kOutOfMemory };
  int ticket = 0;
  Kind kind = Kind::kDone;
  int signal = 0;          ///< that ended it; 0: none
  std::string text;        ///< what the work returned; only of kDone
  double cpu_time = 0.0;   ///< [s] of the whole process
  double memory_MB = 0.0;  ///< most resident memory
};

class WorkerPool {
 public:
  WorkerPool(int jobs, const ProcessLimits& limits);
  /// Kills what still runs.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  bool is_full() const { return static_cast<int>(workers_.size()) >= jobs_; }
  bool is_idle() const { return workers_.empty(); }

  /// Calls `work` in a new process; what it returns comes back with the ending. Throws
  /// std::runtime_error where the system has no process left.
  void start(int ticket, const std::function<std::string()>& work);

  /// One process that has ended, waiting for at most `seconds`; nothing if none did.
  std::optional<Ending> wait(double seconds);

 private:
  struct Worker {
    int ticket = 0;
    pid_t process = -1;
    int pipe = -1;
    double deadline = 0.0;  // [s] of the steady clock
    bool is_late = false;   // killed by us
    std::string text;
  };
  Ending reap(std::size_t index);
  void kill_late_ones();

  int jobs_;
  ProcessLimits limits_;
  std::vector<Worker> workers_;
};

}  // namespace prehensile::suite
