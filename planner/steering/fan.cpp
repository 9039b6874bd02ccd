#include "planner/steering/fan.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace prehensile {
namespace {

constexpr int kDirections = 72;
constexpr double kMostKappa = 30.0;  // beyond it a move is nearly a rotation on the spot
constexpr double kShortStep = 1e-3;  // over L: a move must stick so far
constexpr int kMostPivots = 200;
constexpr double kArtificialCost = 1e4;
constexpr double kReducedCostFloor = 1e-9;
constexpr double kPivotFloor = 1e-9;
constexpr double kAmountFloor = 1e-12;  // relative to the step

void add_move(int contact, const Vec2& e, double kappa, std::vector<Generator>& fan) {
  const Vec3 u(-e.x(), -e.y(), kappa);
  fan.push_back({contact, u.normalized()});
}

/// The ends, moved inwards, and the middle, by the angle of the move in the flat space.
void add_interval(int contact, const Vec2& e, const KappaSet::Interval& interval,
                  double depth, std::vector<Generator>& fan) {
  const double low = std::atan(std::max(interval.lo, -kMostKappa));
  const double high = std::atan(std::min(interval.hi, kMostKappa));
  const double middle = 0.5 * (low + high);
  add_move(contact, e, std::tan(std::lerp(low, middle, depth)), fan);
  add_move(contact, e, std::tan(std::lerp(high, middle, depth)), fan);
  add_move(contact, e, std::tan(middle), fan);
}

/// The basis of the simplex: three generators or artificial unit columns (negative
/// index).
class Basis {
 public:
  Basis(const std::vector<Generator>& fan, const Vec3& step, double free_rotation_cost)
      : fan_(fan), step_(step), free_rotation_cost_(free_rotation_cost) {
    for (int i = 0; i < 3; ++i) {
      column_[i] = -1 - i;
      sign_[i] = step[i] < 0.0 ? -1.0 : 1.0;
    }
    factor();
  }

  /// The generator whose entry lowers the cost most; -1 at the optimum. `first`: the
  /// first one that lowers it at all, which cannot cycle.
  int entering(bool first) const {
    int best = -1;
    double best_cost = -kReducedCostFloor;
    for (std::size_t j = 0; j < fan_.size(); ++j) {
      const double reduced = cost(static_cast<int>(j)) - prices_.dot(fan_[j].u);
      if (reduced >= best_cost) continue;
      best = static_cast<int>(j);
      if (first) return best;
      best_cost = reduced;
    }
    return best;
  }

  /// False if nothing limits the entering column, which only rounding can cause.
  bool pivot(int entering) {
    const Vec3 change = inverse_ * fan_[entering].u;
    int leaving = -1;
    double least = 0.0;
    for (int i = 0; i < 3; ++i) {
      if (change[i] <= kPivotFloor) continue;
      const double ratio = amounts_[i] / change[i];
      if (leaving < 0 || ratio < least ||
          (ratio == least && column_[i] < column_[leaving])) {
        leaving = i;
        least = ratio;
      }
    }
    if (leaving < 0) return false;
    column_[leaving] = entering;
    factor();
    return true;
  }

  std::optional<Combination> combination() const {
    Combination found;
    const double floor = kAmountFloor * step_.norm();
    for (int i = 0; i < 3; ++i) {
      if (column_[i] < 0) {
        if (std::abs(amounts_[i]) > 1e-9 * step_.norm()) return std::nullopt;
        continue;
      }
      if (amounts_[i] <= floor) continue;
      found.generator[found.count] = column_[i];
      found.amount[found.count++] = amounts_[i];
    }
    return found;
  }

 private:
  double cost(int column) const {
    if (column < 0) return kArtificialCost;
    return fan_[column].contact < 0 ? free_rotation_cost_ : 1.0;
  }

  void factor() {
    Eigen::Matrix3d columns;
    Vec3 costs;
    for (int i = 0; i < 3; ++i) {
      columns.col(i) = column_[i] >= 0 ? fan_[column_[i]].u : unit(-1 - column_[i]);
      costs[i] = cost(column_[i]);
    }
    inverse_ = columns.inverse();
    amounts_ = inverse_ * step_;
    prices_ = inverse_.transpose() * costs;
  }

  Vec3 unit(int row) const { return sign_[row] * Vec3::Unit(row); }

  const std::vector<Generator>& fan_;
  Vec3 step_;
  double free_rotation_cost_;
  std::array<int, 3> column_{};
  std::array<double, 3> sign_{};
  Eigen::Matrix3d inverse_ = Eigen::Matrix3d::Identity();
  Vec3 amounts_ = Vec3::Zero(), prices_ = Vec3::Zero();
};

}  // namespace

std::vector<Generator> fan_at(const SearchModel& search, const PadEnvelope& envelope,
                              const Vec2& p_OF, double depth, Work& work) {
  const double step = kShortStep * search.model->L;
  std::vector<Generator> fan;
  for (std::size_t i = 0; i < search.contacts.size(); ++i) {
    const StickContact& stick = search.contacts[i].stick;
    const double cone = std::atan(stick.mu);
    for (int k = 0; k < kDirections; ++k) {
      const double angle =
          2.0 * std::numbers::pi * (k + 0.5) / kDirections - std::numbers::pi;
      // Inside the friction cone, towards its middle.
      const bool inside = std::abs(angle) < cone;
      const Vec2 e = rotated(inside ? angle * (1.0 - depth) : angle, stick.n);
      ++work.stick_tests;
      const KappaSet kappas = envelope.kappas(stick, p_OF, p_OF - step * e);
      for (int j = 0; j < kappas.count; ++j) {
        add_interval(static_cast<int>(i), e, kappas.intervals[j], depth, fan);
      }
    }
  }
  return fan;
}

const std::vector<Generator>& Fans::at(const Vec2& p_OF, double depth, Work& work) {
  const Key key{p_OF.x(), p_OF.y(), depth};
  const auto found = known_.find(key);
  if (found != known_.end()) {
    work.stick_tests += found->second.work;
    return found->second.fan;
  }
  if (generators_ > kMostGenerators) {
    known_.clear();
    generators_ = 0;
  }
  const std::int64_t before = work.stick_tests;
  Known& known = known_[key];
  known.fan = fan_at(search_, envelope_, p_OF, depth, work);
  known.work = work.stick_tests - before;
  generators_ += known.fan.size();
  return known.fan;
}

std::optional<Combination> combine(const std::vector<Generator>& fan, const Vec3& step,
                                   double free_rotation_cost) {
  Basis basis(fan, step, free_rotation_cost);
  for (int pivots = 0; pivots < kMostPivots; ++pivots) {
    const int entering = basis.entering(pivots > kMostPivots / 2);
    if (entering < 0) return basis.combination();
    if (!basis.pivot(entering)) return std::nullopt;
  }
  return std::nullopt;
}

std::span<const Order> orders_of(int count) {
  static constexpr std::array<Order, 1> kOfOne = {{{0, 1, 2}}};
  static constexpr std::array<Order, 2> kOfTwo = {{{0, 1, 2}, {1, 0, 2}}};
  static constexpr std::array<Order, 6> kOfThree = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  if (count <= 1) return kOfOne;
  return count == 2 ? std::span<const Order>(kOfTwo) : kOfThree;
}

std::vector<Move> moves_in_order(const SearchModel& search,
                                 const std::vector<Generator>& fan,
                                 const Combination& combination, const Order& order,
                                 const FlatState& from) {
  std::vector<Move> moves;
  FlatState at = from;
  for (int k = 0; k < combination.count; ++k) {
    const Generator& generator = fan[combination.generator[order[k]]];
    if (generator.contact < 0) continue;
    const Vec3 d = combination.amount[order[k]] * generator.u;
    const FlatState next{at.p_OF + d.head<2>(), at.theta + d[2] / search.model->c};
    moves.push_back({generator.contact, at, next});
    at = next;
  }
  return moves;
}

void free_rotation(std::vector<Generator>& fan) {
  fan.push_back({-1, Vec3::UnitZ()});
  fan.push_back({-1, -Vec3::UnitZ()});
}

bool is_controllable(const std::vector<Generator>& fan) {
  for (const Vec3& step :
       {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, -1, -1)}) {
    const auto found = combine(fan, step);
    if (!found) return false;
    double cost = 0.0;
    for (int i = 0; i < found->count; ++i) cost += found->amount[i];
    if (cost > kMostCost * step.norm()) return false;
  }
  return true;
}

}  // namespace prehensile
