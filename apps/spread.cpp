#include "apps/spread.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/parallel.h"
#include "apps/table.h"

namespace prehensile::apps {
namespace {

Deviation deviation(const Vec2& n, const Vec2& difference, double angle) {
  return {difference.dot(n), difference.dot(perp(n)), angle};
}

/// Motion from start to end, in H turned so that the start has the attitude of `frame`.
PlanarPose motion_of(const PlanarPose& start, const PlanarPose& end,
                     const PlanarPose& frame) {
  const Vec2 moved = translation(end) - translation(start);
  const Vec2 turned = rotated(frame.theta - start.theta, moved);
  return {turned.x(), turned.y(), end.theta - start.theta};
}

}  // namespace

int Ensemble::completed() const {
  return static_cast<int>(
      std::count_if(members.begin(), members.end(),
                    [](const EnsembleMember& member) { return member.completed(); }));
}

std::vector<double> Ensemble::sorted(Deviation EnsembleMember::*of,
                                     double Deviation::*part) const {
  std::vector<double> values;
  for (const EnsembleMember& member : members) {
    if (member.completed()) values.push_back(member.*of.*part);
  }
  std::sort(values.begin(), values.end());
  return values;
}

std::string Ensemble::tally() const {
  std::map<std::string, int> counts;
  for (const EnsembleMember& member : members) {
    ++counts[member.is_scene ? std::string(name(member.status)) : "no possible scene"];
  }
  std::string out;
  for (const auto& [status, count] : counts) {
    out += out.empty() ? "" : ", ";
    out += text("%d ", count) + status;
  }
  return out;
}

Ensemble run_ensemble(const Model& model, const Grasp& start, const Push& push,
                      const EnsembleOptions& options) {
  Ensemble out;
  const TransitionOptions how{.tolerance = options.tolerance};
  out.nominal = apply(model, start, push, how);
  const Vec2 n = rotated(start.X_HO.theta, model.contacts[contact_of(push)].n);
  // A roll turns the object about its own axis.
  const bool rolls = std::holds_alternative<Roll>(push);
  const auto turned = [rolls](const Grasp& from, const Grasp& to) {
    return rolls ? to.psi - from.psi : to.X_HO.theta - from.X_HO.theta;
  };
  const PlanarPose moved = motion_of(start.X_HO, out.nominal.end.X_HO, start.X_HO);
  out.nominal_motion = deviation(n, translation(moved), turned(start, out.nominal.end));
  out.members.resize(static_cast<std::size_t>(options.samples));
  for_each_index(options.samples, options.jobs, [&](int i) {
    EnsembleMember& member = out.members[static_cast<std::size_t>(i)];
    const UncertainPush varied =
        vary(model.scene, start, push, options.box,
             random_point(options.seed, static_cast<std::uint64_t>(i)));
    member.is_scene = check(varied.scene).empty();
    if (!member.is_scene) return;
    const Model other = prepare(varied.scene, model.options);
    const Transition end = apply(other, varied.start, varied.push, how);
    member.status = end.status;
    member.max_push_force = end.max_push_force;
    const PlanarPose& X_HO = end.end.X_HO;
    const PlanarPose& nominal = out.nominal.end.X_HO;
    member.end = deviation(n, translation(X_HO) - translation(nominal),
                           turned(out.nominal.end, end.end));
    const PlanarPose motion = motion_of(varied.start.X_HO, X_HO, start.X_HO);
    member.motion = deviation(n, translation(motion) - translation(moved),
                              turned(varied.start, end.end) - out.nominal_motion.angle);
  });
  return out;
}

}  // namespace prehensile::apps
