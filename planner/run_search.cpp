#include "planner/run_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/bounds.h"
#include "planner/push_search.h"
#include "planner/run_bound.h"

namespace prehensile {
namespace {

constexpr std::array<int, 7> kStrides = {12, 8, 6, 4, 3, 2, 1};  // of the way-points
/// The laws are a little wider than what sticks; so far inwards are their ends moved,
/// over c, until a chain follows.
constexpr std::array<double, 3> kInwards = {0.0, 0.7, 1.5};
constexpr double kPerPush = 2e-3;        // of J, that one push less is worth
constexpr double kDearest = 5.0;         // J of plans looked for
constexpr std::int64_t kProgram = 2000;  // work of one convex program, in stick tests

static_assert(kRunPieces <= Chain::kMaxLegs);

/// The laws of single instants over the ellipsoid, for which they are exact.
RunLaw instant_law(const StickContact& stick, const Margin& margin) {
  RunLaw law;
  law.n = stick.n;
  law.t = stick.t;
  law.mu = stick.mu * std::max(0.0, 1.0 - margin.friction);
  law.jacobian = 2.0 * law.mu;
  for (int k = 0; k < 2; ++k) {
    const double side = k == 0 ? 1.0 : -1.0;
    law.w[k] = law.mu * law.n + side * law.t;
    law.back[k] = -law.w[k].dot(stick.gamma);
    EndLaw end;
    end.place = k == 0 ? stick.b : stick.a;
    end.place -= side * margin.place * stick.t;
    end.per_travel = -side * cross(stick.p_OCom - end.place, stick.gamma);
    for (auto& set : law.end) set[k] = end;
  }
  return law;
}

class RunSearch {
 public:
  RunSearch(const SearchModel& search, const FlatState& start, const GoalPlaces& goals,
            double to_beat, Work& work)
      : search_(search), start_(start), goals_(goals), to_beat_(to_beat), work_(work) {
    if (search.rings) laws_ = run_laws(*search.model);
    if (!laws_.empty()) return;
    const double c = search.model->c;
    laws_.C.fill(c * c);
    for (const SearchContact& contact : search.contacts) {
      laws_.contacts.push_back(instant_law(contact.stick, search.margin));
    }
  }

  std::optional<FoundChain> run(const Limits& limits) {
    const int contacts = static_cast<int>(search_.contacts.size());
    for (int place = 0; place < goals_.count; ++place) {
      for (int angle = 0; angle < goals_.places[place].count; ++angle) {
        for (int contact = 0; contact < contacts && !limits.reached(); ++contact) {
          try_contact(contact, place, angle);
        }
      }
    }
    return found_;
  }

 private:
  void try_contact(int contact, int place, int angle) {
    const GoalPlace& goal = goals_.places[place];
    const double turn = goal.theta[angle] - start_.theta;
    const double L = search_.model->L;
    const Vec2 d = goal.p_OF - start_.p_OF;
    const double cap = (std::min(to_beat_, kDearest) - 1.0) * L;
    const RunLaw& law = laws_.contacts[contact];
    const auto is_behind = [&](int k) {
      return law.back[k] <= 0.0 && law.w[k].dot(-d) < -law.back[k] * d.norm();
    };
    const bool near = std::hypot(d.norm(), search_.model->c * turn) < cap;
    if (!near || law.mu <= 0.0 || is_behind(0) || is_behind(1)) return;
    const double before = to_beat_;
    for (const double inwards : kInwards) {
      RunLaws laws;
      laws.C = laws_.C;
      laws.reach = laws_.reach;
      laws.contacts = {law};
      for (auto& set : laws.contacts[0].end) {
        set[0].place -= inwards * search_.model->c * law.t;
        set[1].place += inwards * search_.model->c * law.t;
      }
      work_.other += kProgram;
      RunPath path;
      if (!run_path({.laws = &laws,
                     .contact = 0,
                     .c = search_.model->c,
                     .outline = &search_.model->pad_face,
                     .start = start_.p_OF,
                     .goal = {.centre = goal.p_OF},
                     .turn_low = turn,
                     .turn_high = turn,
                     .cap = cap,
                     .chords_only = true},
                    path)) {
        return;
      }
      for (const int stride : kStrides) follow(contact, path, stride, place, angle);
      if (to_beat_ < before) return;
    }
  }

  void follow(int contact, const RunPath& path, int stride, int place, int angle) {
    const GoalPlace& goal = goals_.places[place];
    Chain& chain = scratch_.chain;
    chain.count = kRunPieces / stride;
    Stop from{start_.p_OF, true};
    for (int k = 0; k < chain.count; ++k) {
      const bool last = k + 1 == chain.count;
      const Stop to = last ? Stop{goal.p_OF, true} : Stop{path[(k + 1) * stride - 1]};
      if (!make_leg({search_}, contact, from, to, work_, chain.legs[k])) return;
      from = to;
    }
    const double dtheta = goal.theta[angle] - start_.theta;
    const double charge = kPerPush * chain.count;
    if (!solve_chain(search_, dtheta, chain) || chain.cost + charge >= to_beat_) return;
    if (!make_chain_stick(search_, start_.theta, dtheta, chain, work_)) return;
    if (chain.cost + charge >= to_beat_) return;
    to_beat_ = chain.cost + charge;
    scratch_.place = place;
    scratch_.angle = angle;
    found_ = scratch_;
  }

  const SearchModel& search_;
  const FlatState& start_;
  const GoalPlaces& goals_;
  double to_beat_;
  Work& work_;
  RunLaws laws_;
  FoundChain scratch_;
  std::optional<FoundChain> found_;
};

}  // namespace

std::optional<FoundChain> search_runs(const SearchModel& search, const FlatState& start,
                                      const GoalPlaces& goals, double to_beat,
                                      const Limits& limits, Work& work) {
  return RunSearch(search, start, goals, to_beat, work).run(limits);
}

void improve_by_run(const SearchModel& search, const Limits& limits, Work& work,
                    Plan& plan) {
  const Model& model = *search.model;
  const bool rolls = std::any_of(
      plan.pushes.begin(), plan.pushes.end(),
      [](const PlannedPush& push) { return std::holds_alternative<Roll>(push.push); });
  if (!search.exact_everywhere || rolls || plan.pushes.empty()) return;
  const Goal goal = planar_goal(*model.scene.goal);
  account(model, plan);
  if (plan.cost <= kGoodEnough * guide_bound(model, plan.start, goal)) return;
  const FlatState from = flat_state(plan.start);
  const GoalPlaces goals = goal_places(model, goal, from);
  const auto found = search_runs(search, from, goals, plan.cost, limits, work);
  if (!found) return;
  plan.pushes.clear();
  append_chain(search, from, found->chain, plan);
}

}  // namespace prehensile
