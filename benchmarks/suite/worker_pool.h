/// Work, or other programs, in processes of their own: what crashes, hangs or eats memory
/// there harms nobody else. Processes are forked from this one, which has to be
/// single-threaded; they end with it, however it ends.
#pragma once

#include <filesystem>
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
  int exit_code = -1;      ///< -1: it did not exit
  std::string text;        ///< what the work returned, of kDone; what a program printed
  double cpu_time = 0.0;   ///< [s] of the whole process
  double wall_time = 0.0;  ///< [s]
  double memory_MB = 0.0;  ///< most resident memory
};

/// A program as it is started.
struct ProgramCall {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::filesystem::path folder;  ///< where it runs
};
inline constexpr int kExitNotStarted = 127;

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

  /// Likewise another program, whose both outputs come back with the ending, at most a
  /// few MB. It is done if its exit code is 0, and crashed with kExitNotStarted where it
  /// cannot be started.
  void start(int ticket, const ProgramCall& call);

  /// One process that has ended, waiting for at most `seconds`; nothing if none did.
  std::optional<Ending> wait(double seconds);

 private:
  struct Worker {
    int ticket = 0;
    pid_t process = -1;
    int pipe = -1;
    double begin = 0.0;       // [s] of the steady clock
    bool is_program = false;  // leads a group of processes
    bool is_late = false;     // killed by us
    std::string text;
  };
  void add(int ticket, bool is_program, const std::function<void(int pipe)>& child);
  static void kill(const Worker& worker);
  double deadline(const Worker& worker) const { return worker.begin + limits_.wall_time; }
  Ending reap(std::size_t index);
  void kill_late_ones();

  int jobs_;
  ProcessLimits limits_;
  std::vector<Worker> workers_;
};

}  // namespace prehensile::suite
