#include "benchmarks/suite/worker_pool.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/sanitizers.h"

namespace prehensile::suite {
namespace {

Ending end_of(const ProcessLimits& limits, const std::function<std::string()>& work) {
  WorkerPool pool(1, limits);
  pool.start(7, work);
  for (;;) {
    if (const auto ending = pool.wait(1.0)) return *ending;
  }
}

Ending end_of(const ProcessLimits& limits, const std::string& script) {
  WorkerPool pool(1, limits);
  pool.start(7, ProgramCall{.program = "/bin/sh",
                            .arguments = {"-c", script, "name", "two words"},
                            .folder = "/tmp"});
  for (;;) {
    if (const auto ending = pool.wait(1.0)) return *ending;
  }
}

/// Not to be optimised away.
volatile unsigned sink = 0;  // counts for ever without an overflow

TEST(WorkerPool, BringsBackWhatTheWorkReturns) {
  const std::string large(300'000, 'x');  // more than a pipe holds
  const Ending ending = end_of({}, [&] { return large; });
  EXPECT_EQ(ending.kind, Ending::Kind::kDone);
  EXPECT_EQ(ending.ticket, 7);
  EXPECT_EQ(ending.text, large);
  EXPECT_GT(ending.memory_MB, 0.0);
}

TEST(WorkerPool, SurvivesACrash) {
  const Ending ending = end_of({}, []() -> std::string {
    ::signal(SIGSEGV, SIG_DFL);  // a sanitizer has a handler of its own
    ::raise(SIGSEGV);
    return "not reached";
  });
  EXPECT_EQ(ending.kind, Ending::Kind::kCrashed);
  EXPECT_EQ(ending.signal, SIGSEGV);
}

/// They come to whole groups of processes, of which the parent decides what ends.
TEST(WorkerPool, RequestsToStopAreNotForTheWork) {
  for (const int number : {SIGINT, SIGTERM}) {
    const Ending work = end_of({}, [number]() -> std::string {
      ::raise(number);
      return "done";
    });
    EXPECT_EQ(work.kind, Ending::Kind::kDone) << number;
    EXPECT_EQ(work.text, "done");
    const Ending program =
        end_of({}, "kill -" + std::to_string(number) + " $$; echo done");
    EXPECT_EQ(program.kind, Ending::Kind::kDone) << number;
    EXPECT_EQ(program.text, "done\n");
  }
}

TEST(WorkerPool, NoticesAnEarlyExit) {
  const Ending ending = end_of({}, []() -> std::string { ::_exit(3); });
  EXPECT_EQ(ending.kind, Ending::Kind::kCrashed);
  EXPECT_EQ(ending.signal, 0);
}

TEST(WorkerPool, EndsWhatComputesForEver) {
  const Ending ending =
      end_of({.cpu_time = 0.05, .wall_time = 60.0}, []() -> std::string {
        for (;;) sink = sink + 1;
      });
  EXPECT_EQ(ending.kind, Ending::Kind::kTimeout);
  EXPECT_GE(ending.cpu_time, 0.04);
}

TEST(WorkerPool, EndsWhatWaitsForEver) {
  const Ending ending =
      end_of({.cpu_time = 60.0, .wall_time = 0.05}, []() -> std::string {
        for (;;) ::pause();
      });
  EXPECT_EQ(ending.kind, Ending::Kind::kTimeout);
}

#if !PREHENSILE_SANITIZED  // which needs more than any limit
TEST(WorkerPool, EndsWhatEatsMemory) {
  const ProcessLimits limits{.memory_MB = 100.0};
  const auto eat = [] {
    std::vector<std::vector<char>> eaten;
    for (;;) eaten.emplace_back(10'000'000, 'x');
  };
  const Ending thrown = end_of(limits, [&]() -> std::string {
    eat();
    return "";
  });
  EXPECT_EQ(thrown.kind, Ending::Kind::kOutOfMemory);
  EXPECT_LT(thrown.memory_MB, 400.0);
  const Ending inside_noexcept = end_of(limits, [&]() -> std::string {
    [&]() noexcept { eat(); }();
    return "";
  });
  EXPECT_EQ(inside_noexcept.kind, Ending::Kind::kOutOfMemory);
}
#endif

TEST(WorkerPool, BringsBackWhatAProgramPrints) {
  const Ending ending = end_of({}, "pwd; echo \"$1\" >&2; cat");
  EXPECT_EQ(ending.kind, Ending::Kind::kDone);
  EXPECT_EQ(ending.exit_code, 0);
  EXPECT_EQ(ending.text, "/tmp\ntwo words\n");
  EXPECT_GT(ending.wall_time, 0.0);
}

TEST(WorkerPool, TellsHowAProgramEnded) {
  const Ending failed = end_of({}, "echo sorry; exit 71");
  EXPECT_EQ(failed.kind, Ending::Kind::kCrashed);
  EXPECT_EQ(failed.exit_code, 71);
  EXPECT_EQ(failed.text, "sorry\n");
  const Ending killed = end_of({}, "kill -SEGV $$");
  EXPECT_EQ(killed.kind, Ending::Kind::kCrashed);
  EXPECT_EQ(killed.signal, SIGSEGV);
  EXPECT_EQ(killed.exit_code, -1);
  WorkerPool pool(1, {});
  pool.start(0,
             ProgramCall{.program = "/no/such/program", .arguments = {}, .folder = "/"});
  auto ending = pool.wait(60.0);
  while (!ending) ending = pool.wait(60.0);
  EXPECT_EQ(ending->exit_code, kExitNotStarted);
}

TEST(WorkerPool, EndsAProgramWithAllThatItStarted) {
  const Ending busy =
      end_of({.cpu_time = 0.05, .wall_time = 60.0}, "while :; do :; done");
  EXPECT_EQ(busy.kind, Ending::Kind::kTimeout);
  const Ending silent =
      end_of({.cpu_time = 60.0, .wall_time = 0.3}, "echo here; exec >&- 2>&-; sleep 600");
  EXPECT_EQ(silent.kind, Ending::Kind::kTimeout);
  EXPECT_EQ(silent.text, "here\n");
  // The second sleep would hold the pipe open for long.
  const Ending idle = end_of({.cpu_time = 60.0, .wall_time = 0.3},
                             "echo here; sleep 600 & echo $!; sleep 600");
  EXPECT_EQ(idle.kind, Ending::Kind::kTimeout);
  EXPECT_EQ(idle.signal, SIGKILL);
  ASSERT_TRUE(idle.text.starts_with("here\n")) << idle.text;
  const pid_t other = std::stoi(idle.text.substr(5));
  bool is_gone = false;
  for (int i = 0; i < 500 && !is_gone; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::ifstream in("/proc/" + std::to_string(other) + "/stat");
    std::string id, name, state;
    is_gone = !(in >> id >> name >> state) || state == "Z" || state == "X";
  }
  EXPECT_TRUE(is_gone);
}

TEST(WorkerPool, KeepsTheFirstOfWhatIsTooMuch) {
  const Ending ending = end_of({}, "head -c 9000000 /dev/zero");
  EXPECT_EQ(ending.kind, Ending::Kind::kDone);
  EXPECT_EQ(ending.text.size(), 8'000'000u);
}

TEST(WorkerPool, RunsSeveralAtATime) {
  WorkerPool pool(3, {});
  std::map<int, std::string> texts;
  int started = 0;
  while (started < 20 || !pool.is_idle()) {
    if (started < 20 && !pool.is_full()) {
      pool.start(started, [started] { return std::to_string(started * started); });
      ++started;
      continue;
    }
    if (const auto ending = pool.wait(10.0)) texts[ending->ticket] = ending->text;
  }
  ASSERT_EQ(texts.size(), 20u);
  for (const auto& [ticket, text] : texts)
    EXPECT_EQ(text, std::to_string(ticket * ticket));
}

TEST(WorkerPool, KillsWhatRunsWhenItIsDestroyed) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  {
    WorkerPool pool(1, {});
    pool.start(0, [&]() -> std::string {
      for (;;) ::pause();
    });
  }
  // The worker held the writing end as well: with it gone, reading ends.
  ::close(ends[1]);
  char byte = 0;
  EXPECT_EQ(::read(ends[0], &byte, 1), 0);
  ::close(ends[0]);
}

}  // namespace
}  // namespace prehensile::suite
