/// The moves that stick at one place, as generators of a cone in the flat space
/// (p_OF, c theta), and the shortest combination of them that makes a wanted step.
/// Internal to the planner.
///
/// The flat space has no curvature: moves add up in any order. Where the generators
/// positively span it, the object is locally controllable and every step can be made; the
/// moves of a short step start at places so close that they still stick there.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "mechanics/pad_envelope.h"
#include "planner/steering/steering.h"

namespace prehensile {

/// One straight move of unit length in the flat space.
struct Generator {
  int contact = -1;       ///< index in SearchModel::contacts; -1: no push, free rotation
  Vec3 u = Vec3::Zero();  ///< (dp_OF, c dtheta), |u| = 1
};

/// All contacts in all directions that stick at p_OF with the real pads over the margin
/// box, each with the ends and the middle of its feasible rotations. `depth` in [0, 1):
/// moves this share of the way from the ends of their range of directions and rotations
/// to its middle.
std::vector<Generator> fan_at(const SearchModel& search, const PadEnvelope& envelope,
                              const Vec2& p_OF, double depth, Work& work);

/// Fans of a search that comes by the same places again and again.
class Fans {
 public:
  Fans(const SearchModel& search, const PadEnvelope& envelope)
      : search_(search), envelope_(envelope) {}

  /// `fan_at`; valid until the next call. Counts as much work where it is known already.
  const std::vector<Generator>& at(const Vec2& p_OF, double depth, Work& work);

 private:
  using Key = std::array<double, 3>;  // p_OF, depth
  struct Known {
    std::vector<Generator> fan;
    std::int64_t work = 0;
  };
  static constexpr std::size_t kMostGenerators = 300'000;  // 10 MB

  const SearchModel& search_;
  const PadEnvelope& envelope_;
  std::map<Key, Known> known_;
  std::size_t generators_ = 0;
};

/// Non-negative multiples of up to three generators.
struct Combination {
  int count = 0;
  std::array<int, 3> generator{};
  std::array<double, 3> amount{};  ///< [m] > 0
};

inline constexpr double kFreeRotationCost = 0.2;

/// The combination with sum amount u = step of least cost sum amount, where free rotation
/// counts `free_rotation_cost` of its length; none if the fan does not reach the step.
/// Revised simplex on three rows.
std::optional<Combination> combine(const std::vector<Generator>& fan, const Vec3& step,
                                   double free_rotation_cost = kFreeRotationCost);

/// A sequence of the generators of a combination, and all sequences of so many (up to
/// three), each once.
using Order = std::array<int, 3>;
std::span<const Order> orders_of(int count);

/// The moves of a combination one after the other, from a state on; free rotation is
/// left out.
std::vector<Move> moves_in_order(const SearchModel& search,
                                 const std::vector<Generator>& fan,
                                 const Combination& combination, const Order& order,
                                 const FlatState& from);

/// Adds a generator each way that turns the object without a push: steps then fix the
/// place only, and the rotation that the real pushes make is a by-product.
void free_rotation(std::vector<Generator>& fan);

/// The fan positively spans the flat space, and not too thinly: no step costs more than
/// about `kMostCost` of its length.
bool is_controllable(const std::vector<Generator>& fan);

inline constexpr double kMostCost = 20.0;

}  // namespace prehensile
