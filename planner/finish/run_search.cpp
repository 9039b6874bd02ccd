#include "planner/finish/run_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/bounds/bounds.h"
#include "planner/bounds/run_bound.h"
#include "planner/costs.h"
#include "planner/pads/spread_pads.h"
#include "planner/steering/draft.h"

namespace prehensile {
namespace {

constexpr std::array<int, 7> kStrides = {12, 8, 6, 4, 3, 2, 1};  // of the way-points
/// The laws are a little wider than what sticks, and the pads' points pull aside where
/// round pads would not: so far inwards are the ends of the face moved, over c, and the
/// edges of the cone, as a share of the friction, until a chain follows.
struct Inwards {
  double ends = 0.0, cone = 0.0;
};
constexpr std::array<Inwards, 2> kInwards = {{{0.7, 0.0}, {1.5, 0.0}}};
/// The same where the points themselves say how legs may turn.
constexpr std::array<Inwards, 3> kInwardsOfPoints = {
    {{0.0, 0.0}, {0.7, 0.0}, {0.7, 0.12}}};
/// Slack times multiplier of the laws of a path, over its cap: near their borders first,
/// and where that does not help farther from them. Of lines: points are aimed anew.
constexpr double kInside = 2.4e-4;
constexpr double kFartherIn = 2e-3;
constexpr double kPerPush = 2e-3;        // of J, that one push less is worth
constexpr double kLongest = 4.0;         // travel over L of plans looked for
constexpr std::int64_t kProgram = 2000;  // work of one convex program, in stick tests

static_assert(kRunPieces <= Chain::kMaxLegs);

class RunSearch {
 public:
  RunSearch(const SearchModel& search, const FlatState& start, double to_beat, Work& work)
      : search_(search), start_(start), to_beat_(to_beat), work_(work) {
    RunLaws rings;
    if (search.rings) {
      rings = run_laws(*search.model, search.margin, search.p_OF_start);
    }
    laws_.C.fill(search.model->c * search.model->c);
    if (!rings.empty()) {
      laws_.C = rings.C;
      laws_.reach = rings.reach;
    }
    // Ways within all of a margin's laws lie at their borders, where chains do not stick.
    Margin part = Margin::none();
    part.friction = search.margin.friction;
    part.place = search.margin.place;
    part.weightless = search.margin.weightless;
    for (const SearchContact& contact : search.contacts) {
      laws_.contacts.push_back(rings.empty()
                                   ? ellipsoid_law(contact.stick, part, start.p_OF)
                                   : rings.contacts[contact.contact]);
    }
  }

  std::optional<Chain> run(const Goal& goal, const Limits& limits) {
    const GoalPlaces goals = goal_places(*search_.model, goal, start_, search_.margin);
    for (int i = 0; i < goals.count; ++i) {
      const GoalPlace& place = goals.places[i];
      for (int j = 0; j < place.count; ++j) {
        try_contacts({{.centre = place.p_OF}, place.theta[j] - start_.theta}, limits);
      }
    }
    if (!search_.may_end_beside || !goal.x || !goal.y || !goal.theta) return found_;
    to_beat_ *= kWorthTolerance;
    const int windings = goal.theta_is == ThetaMeaning::kNumber ? 1 : 3;
    for (int k = 0; k < windings; ++k) {
      const double whole = 2.0 * std::numbers::pi * (k == 2 ? -1 : k);
      try_contacts(ends_within_tolerance(goal, whole), limits);
    }
    return found_;
  }

 private:
  /// Ends at one angle, or at those between which the goal's tolerances let it lie.
  struct Ends {
    GoalArc arc;
    double turn = 0.0, half = 0.0;  // [rad] from the start: the middle, and to both sides
  };

  /// Ends that use up to kUsedTolerance of the tolerances; a turn of the angle moves the
  /// place along an arc.
  Ends ends_within_tolerance(const Goal& goal, double whole_turns) const {
    const bool shared = goal.test == GoalTest::kWeightedSum;
    Ends ends;
    const double angle = nearest_angle(goal, start_.theta) + whole_turns;
    ends.turn = angle - start_.theta;
    ends.half =
        kUsedTolerance * (shared ? goal.position_tolerance / goal.characteristic_length
                                 : goal.angle_tolerance);
    ends.arc.centre = -rotated(-angle, {*goal.x, *goal.y});
    ends.arc.arc = -ends.half * perp(ends.arc.centre);
    const double bulge = 0.5 * ends.arc.centre.norm() * ends.half * ends.half;
    const double used = kUsedTolerance * goal.position_tolerance;
    ends.arc.slack.fill(used - bulge);
    if (shared) ends.arc.slope = {-used, used};
    return ends;
  }

  void try_contacts(const Ends& ends, const Limits& limits) {
    const int contacts = static_cast<int>(search_.contacts.size());
    for (int contact = 0; contact < contacts && !limits.reached(); ++contact) {
      try_contact(contact, ends);
    }
  }

  void try_contact(int contact, const Ends& ends) {
    const double c = search_.model->c;
    const Vec2 d = ends.arc.centre - start_.p_OF;
    const double off = ends.arc.arc.norm() + ends.arc.widest();
    const double cap = std::min((to_beat_ - 1.0) * placement_length(*search_.model),
                                kLongest * search_.model->L);
    const RunLaw& law = laws_.contacts[contact];
    const auto is_behind = [&](int k) {
      return law.back[k] <= 0.0 &&
             law.w[k].dot(-d) < -law.back[k] * d.norm() - 2.0 * off * law.w[k].norm();
    };
    const double least_turn = std::max(0.0, std::abs(ends.turn) - ends.half);
    const bool near = std::hypot(std::max(0.0, d.norm() - off), c * least_turn) < cap;
    if (!near || law.mu <= 0.0 || is_behind(0) || is_behind(1)) return;
    const double before = to_beat_;
    const auto follow_all = [&](const Steering& steering, const Inwards& inwards,
                                double weight = kInside) {
      RunLaws laws;
      laws.C = laws_.C;
      laws.reach = laws_.reach;
      laws.contacts = {law};
      for (auto& set : laws.contacts[0].end) {
        set[0].place -= inwards.ends * c * law.t;
        set[1].place += inwards.ends * c * law.t;
      }
      laws.contacts[0].mu *= 1.0 - inwards.cone;
      work_.other += kProgram;
      RunPath path;
      if (!run_path({.laws = &laws,
                     .contact = 0,
                     .c = c,
                     .outline = &search_.model->pad_face,
                     .start = start_.p_OF,
                     .goal = ends.arc,
                     .turn_low = ends.turn - ends.half,
                     .turn_high = ends.turn + ends.half,
                     .cap = cap,
                     .chords_only = true,
                     .weight = weight * cap},
                    path)) {
        return false;
      }
      if (ends.half == 0.0) path.end = ends.arc.centre;
      const double turn = ends.turn + path.share * ends.half;
      for (const int stride : kStrides) follow(steering, contact, path, stride, turn);
      return true;
    };
    if (!follow_all({search_}, {})) return;  // nor inwards
    for (const Inwards& inwards : kInwards) {
      if (to_beat_ < before) return;
      follow_all({search_}, inwards);
    }
    if (!search_.contacts[contact].stick.is_point && to_beat_ >= before) {
      follow_all({search_}, {}, kFartherIn);
    }
    if (can_roll(search_.model->scene.object)) return;
    if (!envelope_) envelope_.emplace(*search_.model, search_.margin);
    for (const Inwards& inwards : kInwardsOfPoints) {
      if (to_beat_ < before) return;
      follow_all({search_, true, &*envelope_}, inwards);
    }
  }

  void follow(const Steering& steering, int contact, const RunPath& path, int stride,
              double turn) {
    Chain& chain = scratch_;
    chain.count = kRunPieces / stride;
    Stop from{start_.p_OF, true};
    for (int k = 0; k < chain.count; ++k) {
      const bool last = k + 1 == chain.count;
      const Stop to =
          last ? Stop{path.end, true} : Stop{path.places[(k + 1) * stride - 1]};
      if (!make_leg(steering, contact, from, to, work_, chain.legs[k])) return;
      from = to;
    }
    const double charge = kPerPush * chain.count;
    if (!solve_chain(search_, turn, chain) || chain.cost + charge >= to_beat_) return;
    if (!make_chain_stick(search_, start_.theta, turn, chain, work_)) return;
    if (chain.cost + charge >= to_beat_) return;
    to_beat_ = chain.cost + charge;
    found_ = scratch_;
  }

  const SearchModel& search_;
  const FlatState& start_;
  double to_beat_;
  Work& work_;
  RunLaws laws_;  ///< contacts as in SearchModel
  Chain scratch_;
  std::optional<PadEnvelope> envelope_;  ///< of the pads' points at every angle
  std::optional<Chain> found_;
};

}  // namespace

std::optional<Chain> search_runs(const SearchModel& search, const FlatState& start,
                                 const Goal& goal, double to_beat, const Limits& limits,
                                 Work& work) {
  return RunSearch(search, start, to_beat, work).run(goal, limits);
}

bool improve_by_run(const SearchModel& search, const Limits& limits, Work& work,
                    Plan& plan) {
  const Model& model = *search.model;
  const bool clips = has_clipped_discs(model) && search.margin.is_none();
  if (!search.exact_everywhere && !clips) return false;
  if (plan.rolls() || plan.pushes.empty()) return false;
  const Goal goal = planar_goal(*model.scene.goal);
  account(model, plan);
  if (plan.cost <= kGoodEnough * guide_bound(model, plan.start, goal)) return false;
  const FlatState from = flat_state(plan.start);
  const auto found = search_runs(search, from, goal, plan.cost, limits, work);
  if (!found) return false;
  Plan better = plan;
  better.pushes.clear();
  append_chain(search, from, *found, better);
  if (!reaches(goal, better.goal)) return false;
  plan = std::move(better);
  return true;
}

}  // namespace prehensile
