/// What every benchmark needs: run times, order statistics, and where it ran.
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace prehensile::benchmarks {

/// CPU time of this thread [us]: what others do on the machine does not count in it.
inline double thread_time_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Time of one call [us]: the least of `batches` means over batches that are long
/// against the clock's grain. Calls longer than that are timed one by one.
template <typename Call>
double time_us(Call&& call, int batches) {
  constexpr double kLongEnough = 50.0;  // [us]
  double start = thread_time_us();
  call();
  double least = thread_time_us() - start;
  const int calls =
      std::clamp(static_cast<int>(kLongEnough / std::max(least, 0.05)), 1, 256);
  if (calls > 1) least = std::numeric_limits<double>::infinity();
  for (int batch = calls > 1 ? 0 : 1; batch < batches; ++batch) {
    start = thread_time_us();
    for (int i = 0; i < calls; ++i) call();
    least = std::min(least, (thread_time_us() - start) / calls);
  }
  return least;
}

/// Time of one search [us], of all planners alike: the least of three batches, so that
/// what the first call of a program costs once is in none of them; a single call where it
/// takes milliseconds, beside which that is nothing.
template <typename Search>
double search_time_us(Search&& search) {
  constexpr double kLong = 5e3;  // [us]
  const double start = thread_time_us();
  search();
  const double first = thread_time_us() - start;
  return first >= kLong ? first : time_us(search, 3);
}

/// The smallest value that at least `share` of the values do not exceed; NaN values are
/// left out, and without any value the answer is NaN.
inline double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

inline std::string compiler_name() {
#if defined(__clang__)
  return "clang " __clang_version__;
#elif defined(__GNUC__)
  return "gcc " __VERSION__;
#else
  return "unknown";
#endif
}

/// Which of the two builds this is: see the presets.
inline const char* build_name() {
#if !defined(NDEBUG)
  return "debug build";
#elif defined(__AVX__)
  return "tuned release build";
#else
  return "portable release build";
#endif
}

/// The processor as the kernel names it.
inline std::string cpu_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

/// A field of a CSV file: no commas or quotes.
inline std::string field(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '"'; }, ' ');
  return text;
}

}  // namespace prehensile::benchmarks
