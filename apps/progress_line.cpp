#include "apps/progress_line.h"

#include <cmath>
#include <cstdio>
#include <unistd.h>

#include "apps/table.h"

namespace prehensile::apps {
ProgressLine::ProgressLine(double interval)
    : is_terminal_(::isatty(STDERR_FILENO) != 0), interval_(interval), next_(interval) {}

ProgressLine::~ProgressLine() {
  if (is_shown_ && is_terminal_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(const SearchProgress& progress) {
  if (progress.seconds < next_) return;
  is_shown_ = true;
  const std::string line = progress_text(progress);
  if (is_terminal_) {
    std::fprintf(stderr, "\r%s\033[K", line.c_str());
    std::fflush(stderr);
    return;
  }
  next_ = progress.seconds + interval_;
  std::fprintf(stderr, "%s\n", line.c_str());
}

std::string progress_text(const SearchProgress& progress) {
  std::string out(progress.stage);
  out += std::isnan(progress.best_cost) ? std::string(": no plan yet")
                                        : text(": best J %.3f", progress.best_cost);
  if (!std::isnan(progress.lower_bound))
    out += text(", bound %.3f", progress.lower_bound);
  if (std::isfinite(progress.gap())) out += text(", gap %.1f %%", 100.0 * progress.gap());
  return out + text(", %.2g tests, %.2g tests/s, %.1f s",
                    static_cast<double>(progress.tests), progress.tests_per_second(),
                    progress.seconds);
}

}  // namespace prehensile::apps
