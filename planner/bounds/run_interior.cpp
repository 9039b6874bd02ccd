#include "planner/bounds/run_interior.h"

#include <algorithm>
#include <cmath>

namespace prehensile {
namespace {

constexpr double kViolation = 1e3;  // cost of what is violated, per m
constexpr double kNearly = 0.99;    // of the way to the border of what is positive
constexpr double kStuck = 0.1;      // after a share of less the next step is central
constexpr double kNear = 2.0;       // times the last weight
constexpr int kMostHalvings = 30;

/// Of the objective.
RunVector slope_of_objective() {
  RunVector slope = RunVector::Zero();
  for (int k = 0; k < kRunPieces; ++k) slope[3 * k + 2] = 1.0;
  slope[RunIndex::kRestTau] = 1.0;
  slope[RunIndex::kV] = kViolation;
  return slope;
}

/// The share of a change, up to 1, by which positive numbers come nearly to zero.
double share_within(const RunNumbers& numbers, const RunNumbers& change) {
  double steepest = kNearly;
  for_each_law(
      [&steepest](const auto& number, const auto& by) {
        const auto none = std::decay_t<decltype(number)>::Zero();
        steepest =
            std::max(steepest, (number > 0.0).select(-by / number, none).maxCoeff());
      },
      numbers, change);
  return kNearly / steepest;
}

double least_of(const RunNumbers& numbers) {
  double least = numbers.end[0];
  for_each_law([&](const auto& number) { least = std::min(least, number.minCoeff()); },
               numbers);
  return least;
}

}  // namespace

RunInterior::RunInterior(const RunProgram& program) : p_(program), laws_(program) {
  for_each_law([this](const auto& there) { count_ += there.sum(); }, laws_.is_there());
  start();
}

/// The straight way, longer than need be, and the violation that it takes. Together the
/// multipliers weigh the violation as the objective does.
void RunInterior::start() {
  x_.setZero();
  const double u = p_.goal_u;
  const double z = 0.5 * (p_.goal_z[0] + p_.goal_z[1]);
  const double depth = p_.level[kRunPieces - 1];
  for (int k = 0; k < kRunPieces; ++k) {
    const double share = p_.level[k] / depth;
    x_[3 * k] = share * u;
    x_[3 * k + 1] = share * z;
    x_[3 * k + 2] = 1.5 * std::sqrt(depth * depth + u * u + z * z) * p_.D[k] / depth;
  }
  x_[RunIndex::kRest] = 0.5 * p_.rest;
  x_[RunIndex::kRestTau] = p_.rest;
  // The laws of the ends are in m^2, v counts `ratio` of that.
  const double worst =
      least_of(laws_.slacks_at(x_)) / std::min({1.0, p_.ratio[0], p_.ratio[1]});
  x_[RunIndex::kV] = std::max(0.0, -worst) * 1.5 + depth / kRunPieces;
  slack_ = laws_.slacks_at(x_);
  for_each_law([](auto& y, const auto& there, const auto& slack) { y = there / slack; },
               y_, laws_.is_there(), slack_);
  RunVector sum = RunVector::Zero();
  laws_.add_slopes(y_, sum);
  const double weight = kViolation / sum[RunIndex::kV];
  for_each_law([weight](auto& y) { y *= weight; }, y_);
}

double RunInterior::weight() const {
  double sum = 0.0;
  for_each_law([&sum](const auto& y, const auto& slack) { sum += (y * slack).sum(); }, y_,
               slack_);
  return sum / count_;
}

bool RunInterior::is_central(double weight) const {
  bool is_central = true;
  for_each_law(
      [&](const auto& y, const auto& slack, const auto& there) {
        const auto off = (y * slack - weight * there).abs();
        is_central = is_central && (off <= 0.5 * weight).all();
      },
      y_, slack_, laws_.is_there());
  return is_central;
}

double RunInterior::objective() const { return slope_of_objective().dot(x_); }

bool RunInterior::factor() {
  RunNumbers weights;
  for_each_law([](auto& weight, const auto& y, const auto& slack) { weight = y / slack; },
               weights, y_, slack_);
  hessian_.set_zero();
  laws_.add_squares(weights, hessian_);
  return hessian_.factor();
}

/// Towards these products of slack and multiplier.
RunInterior::Direction RunInterior::direction(const RunNumbers& products) const {
  Direction direction;
  for_each_law(
      [](auto& y, const auto& product, const auto& slack) { y = product / slack; },
      direction.y, products, slack_);
  RunVector downhill = -slope_of_objective();
  laws_.add_slopes(direction.y, downhill);
  direction.x = hessian_.solve(downhill);
  direction.slack = laws_.along(direction.x);
  for_each_law([](auto& by, const auto& y, const auto& slack,
                  const auto& change) { by -= y * (1.0 + change / slack); },
               direction.y, y_, slack_, direction.slack);
  return direction;
}

/// How far they may go.
RunInterior::Shares RunInterior::shares_of(const Direction& direction) const {
  return {share_within(slack_, direction.slack), share_within(y_, direction.y)};
}

/// If all went so far.
double RunInterior::weight_after(const Direction& direction, const Shares& shares) const {
  double sum = 0.0;
  for_each_law(
      [&](const auto& slack, const auto& by, const auto& y, const auto& by_y) {
        sum += ((slack + shares.slack * by) * (y + shares.y * by_y)).sum();
      },
      slack_, direction.slack, y_, direction.y);
  return sum / count_;
}

bool RunInterior::step(double least_weight) {
  laws_.linearise(x_, y_);
  if (!factor()) return false;
  RunNumbers products;
  for_each_law([](auto& product) { product.setZero(); }, products);
  const Direction predicted = direction(products);
  if (!predicted.x.allFinite()) return false;
  const Shares shares = shares_of(predicted);
  const double now = weight();
  const bool is_stuck = last_share_ < kStuck;
  const double ratio = is_stuck ? 1.0 : weight_after(predicted, shares) / now;
  const double aim = std::max(least_weight, ratio * ratio * ratio * now);
  for_each_law([aim](auto& product, const auto& there) { product = aim * there; },
               products, laws_.is_there());
  // What slack and multiplier change together; not of predictions that lead elsewhere.
  if (!is_stuck && std::min(shares.slack, shares.y) > kStuck &&
      now > kNear * least_weight) {
    for_each_law(
        [](auto& product, const auto& slack, const auto& y) { product -= slack * y; },
        products, predicted.slack, predicted.y);
  }
  return move(direction(products));
}

/// Both as far as they may; places by the laws themselves.
bool RunInterior::move(const Direction& direction) {
  if (!direction.x.allFinite()) return false;
  const RunVector from = x_;
  const Shares shares = shares_of(direction);
  last_share_ = shares.slack;
  for (int halvings = 0;; ++halvings, last_share_ *= 0.5) {
    if (halvings > kMostHalvings) return false;
    x_ = from + last_share_ * direction.x;
    const RunNumbers slack = laws_.slacks_at(x_);
    if (!(least_of(slack) > 0.0)) continue;
    slack_ = slack;
    break;
  }
  for_each_law([&](auto& y, const auto& by) { y += shares.y * by; }, y_, direction.y);
  return true;
}

}  // namespace prehensile
