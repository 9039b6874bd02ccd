#include "planner/pads/run_law.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner/pads/point_section.h"
#include "planner/pads/ring_pads.h"
#include "planner/pads/weak_contact.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Cones wider than this have no useful edges.
constexpr double kWidestCone = 1.4;  // [rad] from the normal

/// A little friction where there is none: the edges of a cone without width are parallel.
constexpr double kNarrowestCone = 1e-6;

/// One edge of the friction cone of a contact, with what gravity asks of it, G, and of
/// the other edge, over F; the motions that it allows lie within half_angle [rad] of the
/// normal, and with pads that pull aside in a cone widened by `widening` [rad].
struct Edge {
  double half_angle, widening;
  double w, w_wide;  // lengths
  double G, G_other;
};

using Cells = std::vector<SectionCell>;

/// The force of the pads that goes farthest towards G, over F.
double helpful_force(double G, const SectionCell& cell) {
  return G > 0.0 ? std::hypot(1.0, cell.deviation) * cell.drag_high / cell.sigma_low
                 : cell.drag_low / cell.sigma_high;
}

/// Least angle of a force from the edge for which w.f >= G is possible.
double lean(double G, double w, const SectionCell& cell) {
  if (G == 0.0) return 0.0;
  return std::asin(std::clamp(G / (w * helpful_force(G, cell)), -1.0, 1.0));
}

/// The pads are too weak at such a rate of turning for what the edge asks for: nothing
/// sticks.
bool asks_too_much(const Edge& edge, const SectionCell& cell) {
  return edge.G > edge.w * helpful_force(edge.G, cell) ||
         edge.G_other > edge.w * helpful_force(edge.G_other, cell);
}

/// Gravity may let the force pass round behind the cone, from edge to edge.
bool passes_behind(const Edge& edge, double from, double other) {
  return from + other <= -2.0 * edge.half_angle;
}

/// The least of w'.e / sigma for an edge w' of the widened cone over all motions that the
/// two edges allow. The force is inside its edge by at least lean(G), and no farther from
/// it than the other edge allows; the motion is within the deviation of the force.
/// `fastest`: the sigma up to which the cells reach where motions beyond are possible.
double least_advance(const Cells& cells, const Edge& edge, double fastest) {
  double least = edge.w_wide;
  for (const SectionCell& cell : cells) {
    const double from = lean(edge.G, edge.w, cell);
    const double other = lean(edge.G_other, edge.w, cell);
    const bool behind = passes_behind(edge, from, other);
    const double to =
        behind ? kPi - from : std::min(kPi - from, 2.0 * edge.half_angle - other);
    const double deviation = std::atan(cell.deviation);
    const double low = from + edge.widening - deviation;
    const double high = to + edge.widening + deviation;
    if (high < low) continue;
    const double sine =
        high >= 1.5 * kPi ? -1.0 : std::min(std::sin(low), std::sin(high));
    least = std::min(
        least, edge.w_wide * sine / (sine < 0.0 ? cell.sigma_low : cell.sigma_high));
  }
  // Turning on the spot, beyond the cells, gravity may drag the object out of the cone.
  return edge.G < 0.0 ? std::min(least, -edge.w_wide / fastest) : least;
}

/// How far along the motion, at most, the direction of a motion leans from the normal:
/// the least of (1 - e.n / cos(wide angle)) / sigma, from above.
double greatest_detour(const Cells& cells, const std::array<Edge, 2>& edges) {
  double greatest = 0.0;
  const double wide = edges[0].half_angle + edges[0].widening;
  for (const SectionCell& cell : cells) {
    const double from = lean(edges[0].G, edges[0].w, cell);
    const double other = lean(edges[1].G, edges[1].w, cell);
    const bool behind = passes_behind(edges[0], from, other);
    const double angle =
        edges[0].half_angle - std::min(from, other) + std::atan(cell.deviation);
    const double missing =
        1.0 - std::cos(behind ? kPi : std::min(kPi, angle)) / std::cos(wide);
    greatest = std::max(greatest, missing / cell.sigma_low);
  }
  return greatest;
}

/// An end of a face: side +1 bounds dtheta from below; help [m]: moment of gravity about
/// it, over F, positive where it helps to stay on it.
struct End {
  double side, help;
};

/// What the moment of the pads and gravity allow per dT beyond `ratio` c^2 dtheta, over
/// c.
double excess(const SectionCell& cell, double c, const End& end, double ratio) {
  const double turning = end.side > 0.0 ? cell.turning_high : -cell.turning_low;
  const double sine = end.side > 0.0
                          ? std::min(ratio * cell.sine_low, ratio * cell.sine_high)
                          : -std::max(ratio * cell.sine_low, ratio * cell.sine_high);
  const double weight = end.help / (end.help < 0.0 ? cell.drag_high : cell.drag_low);
  return turning - sine + weight / c;
}

/// Of the excess, what has to be counted per dT, over c: that of fast turning.
double excess_per_travel(const Cells& cells, double c, const End& end, double ratio) {
  constexpr double kFast = 50.0;  // sigma
  double most = -kInfinity;
  for (const SectionCell& cell : cells) {
    if (cell.sigma_high > kFast) most = std::max(most, excess(cell, c, end, ratio));
  }
  return most;
}

/// The rest of it, per |dp|.
double excess_per_path(const Cells& cells, double c, const End& end, double ratio,
                       double per_travel) {
  double most = -kInfinity;
  for (const SectionCell& cell : cells) {
    const double rest = excess(cell, c, end, ratio) - per_travel;
    most = std::max(most, rest * (rest > 0.0 ? cell.sigma_high : cell.sigma_low));
  }
  return most;
}

/// Greatest part of the slack that grows with the distance from the end.
double deviation_rate(const Cells& cells) {
  double most = 0.0;
  for (const SectionCell& cell : cells) {
    most = std::max(most, cell.deviation / cell.sigma_low);
  }
  return most;
}

/// The edges of a contact whose cone is widened, and what gravity asks of them at so much
/// of the weight.
std::array<Edge, 2> edges_of(const WeakContact& contact, double widening, double weight,
                             const RunLaw& law) {
  std::array<Edge, 2> edges;
  for (int k = 0; k < 2; ++k) {
    edges[k] = {contact.half_angle,
                widening,
                contact.w[k].norm(),
                law.w[k].norm(),
                contact.asked_of_edge(k, weight),
                contact.asked_of_edge(1 - k, weight)};
  }
  return edges;
}

/// Slow turning is charged with so much more per dT than it has to, which leaves less per
/// |dp|.
constexpr double kSlowCharge = 1.3;

void set_end(const Cells& cells, double c, double ratio, bool is_slow, double detour,
             const End& end, const RunLaw& law, EndLaw& result) {
  const double fast = excess_per_travel(cells, c, end, ratio);
  const double per_travel = std::max(1e-4, fast) * (is_slow ? kSlowCharge : 1.0);
  const double per_path = excess_per_path(cells, c, end, ratio, per_travel);
  const double beyond = std::max(0.0, per_path);
  result.per_travel = c * (per_travel + beyond * detour);
  result.per_path = c * std::min(0.0, per_path);
  result.slope = deviation_rate(cells);
  result.place += end.side * c * beyond * std::hypot(1.0, law.mu) * law.t;
}

/// With pads stretched as the margin has it, whose dT counts turns with their own torque
/// radius; and with the finger axis off its place across the motion.
void set_ends(const PadSection& section, const Cells& cells, const Model& model,
              const WeakContact& contact, double weight, double detour, double grasp,
              RunLaw& law) {
  for (int set = 0; set < RunLaw::kSets; ++set) {
    const bool is_slow = set == 0;
    const double ratio = is_slow ? section.slow_ratio : section.fast_ratio;
    const double stretch = contact.stretch[set];
    for (int k = 0; k < 2; ++k) {
      EndLaw& end = law.end[set][k];
      end.place = contact.tilted_end[k];
      set_end(cells, stretch * model.c, ratio, is_slow, detour,
              {k == 0 ? 1.0 : -1.0, contact.help_at_end(k, weight)}, law, end);
      end.per_travel *= std::max(1.0, stretch);
      end.slope *= std::max(1.0, stretch);
      end.per_path -= grasp;
    }
  }
}

/// The law of a contact at so much of the weight, from the motions that its edges leave.
RunLaw law_at(const Model& model, const WeakContact& contact, const PadSection& section,
              double widening, double weight, double grasp) {
  RunLaw law;
  law.n = contact.n;
  law.t = contact.t;
  law.mu = std::max(kNarrowestCone, std::tan(contact.half_angle + widening));
  law.jacobian = 2.0 * law.mu;
  law.face = contact.face;
  law.level = contact.n.dot(contact.end[0]);
  law.w = {law.mu * law.n + law.t, law.mu * law.n - law.t};
  const std::array<Edge, 2> edges = edges_of(contact, widening, weight, law);
  Cells cells;
  std::copy_if(
      section.cells.begin(), section.cells.end(), std::back_inserter(cells),
      [&edges](const SectionCell& cell) { return !asks_too_much(edges[0], cell); });
  const SectionCell& last = section.cells.back();
  const double fastest = asks_too_much(edges[0], last) ? kInfinity : last.sigma_high;
  for (int k = 0; k < 2; ++k) law.back[k] = -least_advance(cells, edges[k], fastest);
  if (cells.empty()) cells = section.cells;  // its edges let this contact do nothing
  set_ends(section, cells, model, contact, weight, greatest_detour(cells, edges), grasp,
           law);
  return law;
}

/// Of two laws that a run obeys, for each inequality the one that leaves less.
RunLaw stricter(const RunLaw& one, const RunLaw& other) {
  RunLaw law = one;
  for (int k = 0; k < 2; ++k) {
    law.back[k] = std::min(one.back[k], other.back[k]);
    for (int set = 0; set < RunLaw::kSets; ++set) {
      if (other.end[set][k].per_travel < one.end[set][k].per_travel) {
        law.end[set][k] = other.end[set][k];
      }
    }
  }
  return law;
}

double greatest_deviation(const Cells& cells) {
  double most = 0.0;
  for (const SectionCell& cell : cells) most = std::max(most, cell.deviation);
  return most;
}

RunLaw run_law(const Model& model, const PushContact& pushed, const PadSection& section,
               double widening, const Margin& margin, const Vec2& begin) {
  const WeakContact contact(face_contact(model, pushed), margin, begin);
  const double grasp = margin.grasp;
  const double least = margin.least_weight(), most = margin.most_weight();
  const RunLaw law = law_at(model, contact, section, widening, most, grasp);
  if (least == most || pushed.g_O.isZero(0.0)) return law;
  return stricter(law, law_at(model, contact, section, widening, least, grasp));
}

/// Greatest distance of a place of the object from another.
double size_of(const std::vector<Vec2>& outline) {
  double size = 0.0;
  for (const Vec2& u : outline) {
    for (const Vec2& v : outline) size = std::max(size, (u - v).norm());
  }
  return size;
}

}  // namespace

Margin margin_of_laws(const Model& model, const PushContact& contact,
                      const Margin& margin) {
  const auto is_point = [](const PushContact& other) { return other.is_point; };
  Margin part = margin;
  if (std::any_of(model.contacts.begin(), model.contacts.end(), is_point)) {
    part.torque_radius = 0.0;
  }
  if (!model.region.is_isotropic()) part.tilt = 0.0;  // turns their friction otherwise
  if (!contact.is_point) return part;
  Margin of_point = Margin::none();
  if (!contact.g_O.isZero(0.0)) return of_point;
  of_point.friction = part.friction;
  of_point.tilt = part.tilt;
  return of_point;
}

RunLaw ellipsoid_law(const StickContact& stick, const Margin& margin, const Vec2& begin) {
  const WeakContact contact(stick, margin, begin);
  RunLaw law;
  law.n = contact.n;
  law.t = contact.t;
  law.mu = std::max(kNarrowestCone, std::tan(contact.half_angle));
  law.jacobian = 2.0 * law.mu;
  law.face = contact.face;
  law.level = contact.n.dot(contact.end[0]);
  for (int k = 0; k < 2; ++k) {
    const double side = k == 0 ? 1.0 : -1.0;
    law.w[k] = law.mu * law.n + side * law.t;
    law.back[k] = -contact.most_asked_of_edge(k) * law.w[k].norm() / contact.w[k].norm();
    const double help = contact.least_help_at_end(k);
    for (int set = 0; set < RunLaw::kSets; ++set) {
      EndLaw& end = law.end[set][k];
      end.place = contact.tilted_end[k];
      // dT of the stretched pads is at most, and at least, so much of that of others.
      const double stretch = contact.stretch[set];
      end.per_travel =
          help * (help > 0.0 ? std::max(1.0, stretch) : std::min(1.0, stretch));
      end.per_path = -margin.grasp;
    }
  }
  return law;
}

std::array<double, RunLaw::kSets> ellipsoid_moments(double c, const Margin& margin) {
  std::array<double, RunLaw::kSets> C = stretches_of(margin);
  for (double& moment : C) moment = moment * moment * c * c;
  return C;
}

RunLaws run_laws(const Model& model) {
  return run_laws(model, Margin::none(), Vec2::Zero());
}

RunLaws run_laws(const Model& model, const Margin& margin, const Vec2& begin) {
  if (!(model.F > 0.0 && model.c > 0.0) || model.contacts.empty()) return {};
  for (const PushContact& contact : model.contacts) {
    if (model.needs_space(contact)) return {};
  }
  const bool soft = model.has_soft_points();
  if (!has_round_pads(model) && !alike_at_quarter_turns(model.region.whole(), model.c)) {
    return {};
  }
  PadSection section;
  if (!soft) section = pad_section(model);
  if (!soft && section.cells.empty()) return {};
  const double widening = std::atan(greatest_deviation(section.cells));
  RunLaws laws;
  laws.reach = size_of(model.outline);
  laws.contacts.reserve(model.contacts.size());
  for (const PushContact& contact : model.contacts) {
    if (std::atan(contact.mu) + widening > kWidestCone) return {};
    const Margin part = margin_of_laws(model, contact, margin);
    laws.contacts.push_back(
        soft ? ellipsoid_law(face_contact(model, contact), part, begin)
             : run_law(model, contact, section, widening, part, begin));
    laws.C = ellipsoid_moments(model.c, part);
  }
  if (!soft) {
    laws.C[0] *= section.slow_ratio;
    laws.C[1] *= section.fast_ratio;
  }
  return laws;
}

}  // namespace prehensile
