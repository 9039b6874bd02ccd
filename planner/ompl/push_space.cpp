#include "planner/ompl/push_space.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

#include <ompl/base/spaces/RealVectorStateProjections.h>

namespace prehensile {
namespace {

namespace ob = ompl::base;

constexpr unsigned kTheta = 2;
constexpr unsigned kPsi = 3;

void bound_angle(ob::RealVectorBounds& bounds, unsigned dimension, double start,
                 double goal, double scale) {
  bounds.setLow(dimension, scale * (std::min(start, goal) - std::numbers::pi));
  bounds.setHigh(dimension, scale * (std::max(start, goal) + std::numbers::pi));
}

ob::RealVectorBounds bounds_of(const PushSteps& steps, const Grasp& start) {
  const Grasp goal = member_near(steps.goal(), start);
  const unsigned dimensions = static_cast<unsigned>(steps.model().state_dimensions());
  ob::RealVectorBounds bounds(dimensions);
  for (unsigned axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::ranges::minmax(
        steps.model().pad_face, {}, [axis](const Vec2& corner) { return corner[axis]; });
    bounds.setLow(axis, low[axis]);
    bounds.setHigh(axis, high[axis]);
  }
  bound_angle(bounds, kTheta, start.X_HO.theta, goal.X_HO.theta, steps.theta_scale());
  if (dimensions > kPsi) {
    bound_angle(bounds, kPsi, start.psi, goal.psi, steps.psi_scale());
  }
  return bounds;
}

}  // namespace

PushSpace::PushSpace(const PushSteps& steps, const Grasp& start)
    : ob::RealVectorStateSpace(static_cast<unsigned>(steps.model().state_dimensions())),
      theta_scale_(steps.theta_scale()),
      psi_scale_(steps.psi_scale()),
      cell_(steps.model().L / 20.0) {
  setName("PushSpace");
  setBounds(bounds_of(steps, start));
}

PushState PushSpace::read(const ob::State* state) const {
  const double* q = state->as<StateType>()->values;
  return {{{q[0], q[1]}, q[kTheta] / theta_scale_},
          dimension_ > kPsi ? q[kPsi] / psi_scale_ : 0.0};
}

void PushSpace::write(const PushState& from, ob::State* state) const {
  double* q = state->as<StateType>()->values;
  q[0] = from.flat.p_OF.x();
  q[1] = from.flat.p_OF.y();
  q[kTheta] = from.flat.theta * theta_scale_;
  if (dimension_ > kPsi) q[kPsi] = from.psi * psi_scale_;
}

void PushSpace::write_refusal(ob::State* state) const {
  double* q = state->as<StateType>()->values;
  std::fill(q, q + dimension_, std::numeric_limits<double>::quiet_NaN());
}

void PushSpace::registerProjections() {
  std::vector<unsigned> all(dimension_);
  std::iota(all.begin(), all.end(), 0U);
  const std::vector<double> cells(dimension_, cell_);
  registerDefaultProjection(
      std::make_shared<ob::RealVectorOrthogonalProjectionEvaluator>(this, cells, all));
}

}  // namespace prehensile
