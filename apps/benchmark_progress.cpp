#include "apps/benchmark_progress.h"

#include <cstdio>
#include <unistd.h>

#include "apps/table.h"

namespace prehensile::apps {
namespace {

constexpr double kTerminalInterval = 0.1;  // [s]

std::string duration(double seconds) {
  if (!(seconds >= 0.0)) return "?";
  if (seconds < 90.0) return text("%.0f s", seconds);
  if (seconds < 5400.0) return text("%.0f min", seconds / 60.0);
  return text("%.1f h", seconds / 3600.0);
}

}  // namespace

SuiteProgressLine::SuiteProgressLine(double interval)
    : is_terminal_(::isatty(STDERR_FILENO) != 0),
      interval_(is_terminal_ ? kTerminalInterval : interval),
      next_(interval_) {}

void SuiteProgressLine::show(const suite::RunProgress& progress) {
  if (seconds() < next_) return;
  next_ = seconds() + interval_;
  is_shown_ = true;
  const std::string line =
      text("%d of %d runs, %.1f runs/s, %s left", progress.done, progress.wanted,
           progress.runs_per_second, duration(progress.seconds_left).c_str());
  if (is_terminal_) {
    std::fprintf(stderr, "\r%s\033[K", line.c_str());
    std::fflush(stderr);
  } else {
    std::fprintf(stderr, "%s\n", line.c_str());
  }
}

void SuiteProgressLine::end() {
  if (is_shown_ && is_terminal_) std::fputs("\r\033[K", stderr);
  is_shown_ = false;
}

double SuiteProgressLine::seconds() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

}  // namespace prehensile::apps
