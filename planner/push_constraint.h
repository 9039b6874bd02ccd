/// What stopped the pushes that a search tried, counted by constraint.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace prehensile {

enum class PushConstraint {
  kOffObject,     ///< the pads would leave the face on the way
  kGravity,       ///< the grasp alone would not hold the object at an end of the push
  kBackwards,     ///< the motion leads away from the pusher
  kFrictionCone,  ///< the motion is flatter than the friction of the pusher allows
  kFaceEnds,      ///< the force would have to act beyond the ends of the face
  kRotation,      ///< the pushes stick, but cannot turn the object as far as needed
  kRealPads,      ///< sticks by the closed form, but not with the real pads
  kThetaLimit,    ///< the angle of the object would leave its limits
  kReach,         ///< the finger axis or the hand would leave its limits
  kCollision,     ///< hand or object would come too near to an obstacle or each other
  kCount
};
inline constexpr int kPushConstraints = static_cast<int>(PushConstraint::kCount);

/// "the pads would leave the object", ...
std::string_view name(PushConstraint constraint);

/// How often each was met.
struct ConstraintCounts {
  std::array<std::int64_t, kPushConstraints> count{};

  void add(PushConstraint constraint) { ++count[static_cast<std::size_t>(constraint)]; }
  std::int64_t operator[](PushConstraint constraint) const {
    return count[static_cast<std::size_t>(constraint)];
  }
  std::int64_t total() const {
    std::int64_t sum = 0;
    for (const std::int64_t n : count) sum += n;
    return sum;
  }
  /// The most frequent; the first of several.
  PushConstraint worst() const {
    std::size_t most = 0;
    for (std::size_t i = 1; i < count.size(); ++i) {
      if (count[i] > count[most]) most = i;
    }
    return static_cast<PushConstraint>(most);
  }
};

}  // namespace prehensile
