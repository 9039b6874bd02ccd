#include "planner/chains/turn_buckets.h"

#include <algorithm>
#include <limits>

namespace prehensile {

TurnBuckets::TurnBuckets(int states, double c, double L)
    : buckets_per_metre_(static_cast<float>(kBuckets / (2.0 * kMostTurn) / c)),
      cost_per_metre_(static_cast<float>(1.0 / L)),
      labels_(static_cast<std::size_t>(states) * kBuckets, -1),
      costs_(labels_.size(), std::numeric_limits<float>::infinity()) {}

float TurnBuckets::bucket_at(float turn) const {
  constexpr float kMiddle = 0.5F * (kBuckets - 1);
  return std::clamp(turn * buckets_per_metre_ + kMiddle, 0.0F, kBuckets - 1.0F);
}

std::pair<int, int> TurnBuckets::range(const TurnCost& paid) const {
  const auto bucket_of = [&](float turn) {
    const float from_first = turn * buckets_per_metre_ + kBuckets / 2.0F;
    return static_cast<int>(std::clamp(from_first, 0.0F, kBuckets - 1.0F));
  };
  return {bucket_of(paid.low()), bucket_of(paid.high())};
}

/// In the middle of each bucket, between the points of the way's cost; most of a search
/// goes on here.
void TurnBuckets::find_costs(const TurnCost& paid, int placements, int low, int high) {
  std::array<float, TurnCost::kCount> at;
  std::array<float, TurnCost::kCount> cost;
  for (int k = 0; k < TurnCost::kCount; ++k) {
    at[k] = bucket_at(paid.turn[k]);
    cost[k] = static_cast<float>(placements) + cost_per_metre_ * paid.travel[k];
  }
  int b = low;
  for (int k = 0; k + 1 < TurnCost::kCount; ++k) {
    const int last = std::min(high, static_cast<int>(at[k + 1]));
    if (b > last) continue;
    const float width = at[k + 1] - at[k];
    const float slope = width > 0.0F ? (cost[k + 1] - cost[k]) / width : 0.0F;
    const float first = cost[k] - slope * at[k];
    for (; b <= last; ++b) offered_[b] = first + slope * static_cast<float>(b);
  }
  for (; b <= high; ++b) offered_[b] = cost.back();
  offered_[low] = std::max(offered_[low], cost[TurnCost::kFree]);  // it may end within
}

/// Whole blocks at a time, without branches.
int TurnBuckets::first_improved(const float* costs, int low, int high) const {
  constexpr int kBlock = 8;
  int b = low;
  for (; b + kBlock <= high + 1; b += kBlock) {
    int improved = 0;
    for (int k = 0; k < kBlock; ++k) {
      improved |= costs[b + k] > offered_[b + k] ? 1 : 0;
    }
    if (improved != 0) break;
  }
  while (b <= high && costs[b] <= offered_[b]) ++b;
  return b;
}

bool TurnBuckets::offer(int state, const TurnCost& paid, int placements, float least_gain,
                        int label) {
  const auto [low, high] = range(paid);
  find_costs(paid, placements, low, high);
  for (int b = low; b <= high; ++b) offered_[b] += least_gain;
  const std::size_t first = static_cast<std::size_t>(state) * kBuckets;
  int b = first_improved(&costs_[first], low, high);
  if (b > high) return false;
  for (; b <= high; ++b) {
    if (costs_[first + b] <= offered_[b]) continue;
    costs_[first + b] = offered_[b] - least_gain;
    labels_[first + b] = label;
  }
  return true;
}

bool TurnBuckets::holds(int state, const TurnCost& paid, int label) const {
  const auto [low, high] = range(paid);
  const int* const labels = &labels_[static_cast<std::size_t>(state) * kBuckets];
  return std::find(labels + low, labels + high + 1, label) != labels + high + 1;
}

}  // namespace prehensile
