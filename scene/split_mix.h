/// Random bits: the same on every machine.
#pragma once

#include <cstdint>

namespace prehensile {

/// What SplitMix64 adds to its state with every number.
inline constexpr std::uint64_t kSplitMixStride = 0x9e3779b97f4a7c15u;

/// The number that SplitMix64 draws at this state (Steele, Lea, Flood 2014).
constexpr std::uint64_t split_mix(std::uint64_t state) {
  std::uint64_t z = state + kSplitMixStride;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace prehensile
