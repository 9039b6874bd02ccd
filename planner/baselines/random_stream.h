/// Random numbers: the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>

#include "scene/split_mix.h"

namespace prehensile {

/// SplitMix64.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    const std::uint64_t drawn = split_mix(state_);
    state_ += kSplitMixStride;
    return drawn;
  }

  /// Uniform in [low, high).
  double in(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1.0p-53);
  }

  /// Log-uniform in [low, high), low > 0.
  double log_in(double low, double high) {
    return std::exp(in(std::log(low), std::log(high)));
  }

  /// 0 .. count - 1.
  int below(int count) {
    return static_cast<int>(bits() % static_cast<std::uint64_t>(count));
  }

  bool chance(double share) { return in(0.0, 1.0) < share; }

 private:
  std::uint64_t state_;
};

}  // namespace prehensile
