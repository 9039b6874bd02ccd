#include "viewer/film_state.h"

#include <algorithm>
#include <cmath>

namespace prehensile::viewer {
namespace {

PlanarPose between(const PlanarPose& a, const PlanarPose& b, double share) {
  return {std::lerp(a.x, b.x, share), std::lerp(a.y, b.y, share),
          std::lerp(a.theta, b.theta, share)};
}

FilmState state_of(const FilmFrame& frame) {
  FilmState state;
  state.grasp = frame.grasp;
  state.z_HO = frame.z_HO;
  state.jaw_z = frame.jaw_z;
  return state;
}

/// The poses in H, and of the pusher, at a share of the push.
FilmState pushed_to(const FilmPush& push, double s, PlanarPose& X_HP) {
  auto next = std::find_if(push.frames.begin(), push.frames.end(),
                           [s](const FilmFrame& frame) { return frame.s >= s; });
  if (next == push.frames.end()) --next;
  const FilmFrame& b = *next;
  const FilmFrame& a = next == push.frames.begin() ? b : *(next - 1);
  const double share = b.s > a.s ? (s - a.s) / (b.s - a.s) : 1.0;
  FilmState state = state_of(b);
  state.grasp.X_HO = between(a.grasp.X_HO, b.grasp.X_HO, share);
  state.grasp.psi = std::lerp(a.grasp.psi, b.grasp.psi, share);
  state.z_HO = std::lerp(a.z_HO, b.z_HO, share);
  for (std::size_t jaw = 0; jaw < 2; ++jaw) {
    state.jaw_z[jaw] = std::lerp(a.jaw_z[jaw], b.jaw_z[jaw], share);
  }
  X_HP = between(a.X_HP, b.X_HP, share);
  return state;
}

/// The hand changes its grip before a push and after it.
bool comes_after_push(const std::vector<FilmPhase>& phases, const FilmPhase& phase) {
  return std::any_of(phases.begin(), phases.end(), [&](const FilmPhase& other) {
    return other.kind == ArmPhase::kPush && other.push == phase.push &&
           other.end <= phase.begin;
  });
}

}  // namespace

double duration_of(const Film& film) {
  return film.phases.empty() ? 0.0 : film.phases.back().end;
}

FilmState state_at(const Film& film, double time) {
  auto phase = std::find_if(film.phases.begin(), film.phases.end(),
                            [time](const FilmPhase& p) { return time < p.end; });
  if (phase == film.phases.end()) --phase;
  const double length = phase->end - phase->begin;
  const double u =
      length > 0.0 ? std::clamp((time - phase->begin) / length, 0.0, 1.0) : 1.0;
  const double done = rest_to_rest(u);
  const FilmPush& push = film.pushes[static_cast<std::size_t>(phase->push)];
  FilmState state;
  if (phase->kind == ArmPhase::kPush) {
    PlanarPose X_HP;
    state = pushed_to(push, done * push.frames.back().s, X_HP);
    const PlanarPose X_WP = compose(phase->X_WH_from, push.frames.front().X_HP);
    state.X_WH = compose(X_WP, inverse(X_HP));
  } else {
    const bool after =
        phase->kind == ArmPhase::kRetreat || comes_after_push(film.phases, *phase);
    state = state_of(after ? push.frames.back() : push.frames.front());
    state.X_WH = between(phase->X_WH_from, phase->X_WH_to, done);
  }
  state.z_WH = std::lerp(phase->z_from, phase->z_to, done);
  return state;
}

}  // namespace prehensile::viewer
