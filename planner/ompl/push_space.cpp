#include "planner/ompl/push_space.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

#include <ompl/base/spaces/RealVectorStateProjections.h>

#include "scene/constants.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;

constexpr unsigned kTheta = 2;
constexpr unsigned kPsi = 3;

void bound(ob::RealVectorBounds& bounds, unsigned dimension, double low, double high) {
  bounds.setLow(dimension, low);
  bounds.setHigh(dimension, high);
}

ob::RealVectorBounds bounds_of(const PushSteps& steps, const Grasp& start) {
  const unsigned dimensions = static_cast<unsigned>(steps.model().state_dimensions());
  const FlatBox box = box_around(steps.model(), start, steps.goal());
  ob::RealVectorBounds bounds(dimensions);
  bound(bounds, 0, box.low.p_OF.x(), box.high.p_OF.x());
  bound(bounds, 1, box.low.p_OF.y(), box.high.p_OF.y());
  bound(bounds, kTheta, steps.theta_scale() * box.low.theta,
        steps.theta_scale() * box.high.theta);
  if (dimensions > kPsi) {
    const double psi = member_near(steps.goal(), start).psi;
    bound(bounds, kPsi, steps.psi_scale() * (std::min(start.psi, psi) - kPi),
          steps.psi_scale() * (std::max(start.psi, psi) + kPi));
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
