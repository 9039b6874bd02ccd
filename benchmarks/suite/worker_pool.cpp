#include "benchmarks/suite/worker_pool.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <poll.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace prehensile::suite {
namespace {

constexpr int kExitOutOfMemory = 71;  // of the child; no planner ends a process itself
constexpr std::size_t kMostText = 8'000'000;  // of one process

double now() {
  return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// [byte] of address space that this process has.
double address_space() {
  std::ifstream in("/proc/self/statm");
  double pages = 0.0;
  in >> pages;
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// Out of memory in code that may not throw: say so before the end.
[[noreturn]] void terminate_with_reason() {
  if (const std::exception_ptr thrown = std::current_exception()) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
      ::_exit(kExitOutOfMemory);
    } catch (...) {
    }
  }
  std::abort();
}

void set_limits(const ProcessLimits& limits) {
  const auto bytes = static_cast<rlim_t>(address_space() + 1e6 * limits.memory_MB);
  const rlimit memory{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &memory);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(limits.cpu_time);
  timer.it_value.tv_usec =
      static_cast<suseconds_t>(1e6 * (limits.cpu_time - std::floor(limits.cpu_time)));
  ::setitimer(ITIMER_PROF, &timer, nullptr);
}

/// The child's side of a run: quiet, mortal and limited.
void become_worker(pid_t parent, const ProcessLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before
  // Ctrl-C goes to all processes of a terminal, and a batch system's SIGTERM to all of a
  // job: what runs is for the parent to decide, and no run ends as if by its own fault.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  std::signal(SIGPROF, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere >= 0) {
    ::dup2(nowhere, STDIN_FILENO);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  std::set_terminate(terminate_with_reason);
  set_limits(limits);
}

/// Writes all of it; false where nobody reads.
bool write_all(int pipe, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t put = ::write(pipe, text.data() + done, text.size() - done);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return false;
    done += static_cast<std::size_t>(put);
  }
  return true;
}

[[noreturn]] void work_and_exit(int pipe, const std::function<std::string()>& work) {
  int code = 1;
  try {
    if (write_all(pipe, work())) code = 0;
  } catch (const std::bad_alloc&) {
    code = kExitOutOfMemory;
  } catch (...) {  // the parent sees that nothing came
  }
  ::_exit(code);  // without destructors: files of the parent are the parent's
}

/// Becomes the program, whose outputs go to the pipe.
[[noreturn]] void run_and_exit(int pipe, const ProgramCall& call) {
  std::string program = call.program.string();
  std::vector<std::string> words = call.arguments;
  std::vector<char*> pointers = {program.data()};
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::setpgid(0, 0);  // it may start others: they end with it
  const bool ready = ::dup2(pipe, STDOUT_FILENO) >= 0 && ::dup2(pipe, STDERR_FILENO) >= 0;
  if (ready && ::chdir(call.folder.c_str()) == 0)
    ::execv(program.c_str(), pointers.data());
  ::_exit(kExitNotStarted);
}

/// Whether a child has not ended yet; its end stays there to be asked for.
bool is_alive(pid_t process) {
  siginfo_t info{};
  const auto id = static_cast<id_t>(process);
  return ::waitid(P_PID, id, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
}

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
}

}  // namespace

WorkerPool::WorkerPool(int jobs, const ProcessLimits& limits)
    : jobs_(std::max(1, jobs)), limits_(limits) {}

WorkerPool::~WorkerPool() {
  for (const Worker& worker : workers_) {
    kill(worker);
    ::waitpid(worker.process, nullptr, 0);
    ::close(worker.pipe);
  }
}

void WorkerPool::add(int ticket, bool is_program,
                     const std::function<void(int pipe)>& child) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail("cannot make a pipe");
  const pid_t parent = ::getpid();
  const pid_t process = ::fork();
  if (process < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    fail("cannot start a process");
  }
  if (process == 0) {
    // The other workers' pipes are not ours to hold open.
    for (const Worker& other : workers_) ::close(other.pipe);
    ::close(ends[0]);
    become_worker(parent, limits_);
    child(ends[1]);
    ::_exit(1);
  }
  if (is_program) ::setpgid(process, process);  // whichever of the two is first
  ::close(ends[1]);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  workers_.push_back({.ticket = ticket,
                      .process = process,
                      .pipe = ends[0],
                      .begin = now(),
                      .is_program = is_program});
}

void WorkerPool::start(int ticket, const std::function<std::string()>& work) {
  add(ticket, false, [&work](int pipe) { work_and_exit(pipe, work); });
}

void WorkerPool::start(int ticket, const ProgramCall& call) {
  add(ticket, true, [&call](int pipe) { run_and_exit(pipe, call); });
}

void WorkerPool::kill(const Worker& worker) {
  ::kill(worker.is_program ? -worker.process : worker.process, SIGKILL);
}

void WorkerPool::kill_late_ones() {
  const double time = now();
  for (Worker& worker : workers_) {
    if (worker.is_late || time < deadline(worker)) continue;
    worker.is_late = true;
    kill(worker);
  }
}

Ending WorkerPool::reap(std::size_t index) {
  Worker worker = std::move(workers_[index]);
  workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(index));
  ::close(worker.pipe);
  int status = 0;
  rusage usage{};
  // A program may close its outputs and live on, though not beyond its time.
  while (worker.is_program && !worker.is_late && is_alive(worker.process)) {
    worker.is_late = now() >= deadline(worker);
    if (worker.is_late) kill(worker);
    ::usleep(500);
  }
  while (::wait4(worker.process, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  Ending ending{.ticket = worker.ticket,
                .cpu_time = seconds(usage.ru_utime) + seconds(usage.ru_stime),
                .wall_time = now() - worker.begin,
                .memory_MB = 1e-3 * 1.024 * static_cast<double>(usage.ru_maxrss)};
  if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
  if (WIFEXITED(status)) ending.exit_code = WEXITSTATUS(status);
  const bool is_done = ending.exit_code == 0;
  if (is_done || worker.is_program) ending.text = std::move(worker.text);
  if (is_done) {
    ending.kind = Ending::Kind::kDone;
  } else if (worker.is_late || ending.signal == SIGPROF) {
    ending.kind = Ending::Kind::kTimeout;
  } else if (ending.exit_code == kExitOutOfMemory && !worker.is_program) {
    ending.kind = Ending::Kind::kOutOfMemory;
  } else {
    ending.kind = Ending::Kind::kCrashed;
  }
  return ending;
}

std::optional<Ending> WorkerPool::wait(double seconds) {
  const double end = now() + seconds;
  while (!workers_.empty()) {
    double next = end;
    std::vector<pollfd> polled;
    polled.reserve(workers_.size());
    for (const Worker& worker : workers_) {
      polled.push_back({worker.pipe, POLLIN, 0});
      if (!worker.is_late) next = std::min(next, deadline(worker));
    }
    const double left = std::max(0.0, next - now());
    const int ready = ::poll(polled.data(), polled.size(),
                             static_cast<int>(std::ceil(1e3 * std::min(left, 3600.0))));
    if (ready < 0) {
      if (errno != EINTR) fail("cannot wait for processes");
      return std::nullopt;  // a signal: the caller may want to stop
    }
    for (std::size_t i = 0; i < polled.size(); ++i) {
      if (polled[i].revents == 0) continue;
      char buffer[16384];
      const ssize_t got = ::read(workers_[i].pipe, buffer, sizeof buffer);
      if (got > 0) {
        std::string& text = workers_[i].text;
        const std::size_t room = kMostText - std::min(kMostText, text.size());
        text.append(buffer, std::min(room, static_cast<std::size_t>(got)));
      } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
        return reap(i);
      }
    }
    kill_late_ones();
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      if (workers_[i].is_late) return reap(i);
    }
    if (ready == 0 && now() >= end) break;
  }
  return std::nullopt;
}

}  // namespace prehensile::suite
