#include "planner/pads/run_law.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner/pads/point_section.h"
#include "planner/pads/ring_pads.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Cones wider than this have no useful edges.
constexpr double kWidestCone = 1.4;  // [rad] from the normal

/// A little friction where there is none: the edges of a cone without width are parallel.
constexpr double kNarrowestCone = 1e-6;

/// One edge of the friction cone of a contact, with G = w.m g / F of it and of the other
/// edge, and the cone widened by `widening` [rad].
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

/// An end of a face: side +1 bounds dtheta from below; g [m]: moment of gravity about it.
struct End {
  double side, g;
};

/// What the moment of the pads and gravity allow per dT beyond `ratio` c^2 dtheta, over
/// c.
double excess(const SectionCell& cell, double c, const End& end, double ratio) {
  const double turning = end.side > 0.0 ? cell.turning_high : -cell.turning_low;
  const double sine = end.side > 0.0
                          ? std::min(ratio * cell.sine_low, ratio * cell.sine_high)
                          : -std::max(ratio * cell.sine_low, ratio * cell.sine_high);
  const double weight =
      -end.side * end.g / (end.side * end.g > 0.0 ? cell.drag_high : cell.drag_low);
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

/// The edges of a contact whose cone is widened, and what gravity asks of them.
std::array<Edge, 2> edges_of(double mu, double widening, const Vec2& gamma,
                             const RunLaw& law) {
  std::array<Edge, 2> edges;
  for (int k = 0; k < 2; ++k) {
    const Vec2 side = k == 0 ? law.t : Vec2(-law.t);
    edges[k] = {std::atan(mu),
                widening,
                std::hypot(1.0, mu),
                law.w[k].norm(),
                (mu * law.n + side).dot(gamma),
                (mu * law.n - side).dot(gamma)};
  }
  return edges;
}

/// Slow turning is charged with so much more per dT than it has to, which leaves less per
/// |dp|.
constexpr double kSlowCharge = 1.3;

void set_end(const Cells& cells, const Model& model, double ratio, bool is_slow,
             double detour, const End& end, const RunLaw& law, EndLaw& result) {
  const double c = model.c;
  const double fast = excess_per_travel(cells, c, end, ratio);
  const double per_travel = std::max(1e-4, fast) * (is_slow ? kSlowCharge : 1.0);
  const double per_path = excess_per_path(cells, c, end, ratio, per_travel);
  const double beyond = std::max(0.0, per_path);
  result.per_travel = c * (per_travel + beyond * detour);
  result.per_path = c * std::min(0.0, per_path);
  result.slope = deviation_rate(cells);
  result.place += end.side * c * beyond * std::hypot(1.0, law.mu) * law.t;
}

void set_ends(const PadSection& section, const Cells& cells, const Model& model,
              const PushContact& contact, double detour, const Vec2& gamma, RunLaw& law) {
  for (int set = 0; set < RunLaw::kSets; ++set) {
    const bool is_slow = set == 0;
    const double ratio = is_slow ? section.slow_ratio : section.fast_ratio;
    for (int k = 0; k < 2; ++k) {
      EndLaw& end = law.end[set][k];
      end.place = k == 0 ? contact.b : contact.a;
      const double g = cross(model.p_OCom - end.place, gamma);
      set_end(cells, model, ratio, is_slow, detour, {k == 0 ? 1.0 : -1.0, g}, law, end);
    }
  }
}

/// The law of a contact, from the motions that its edges leave.
RunLaw run_law(const Model& model, const PushContact& contact, const PadSection& section,
               double widening) {
  RunLaw law;
  law.n = contact.n;
  law.t = contact.t;
  law.mu = std::max(kNarrowestCone, std::tan(std::atan(contact.mu) + widening));
  law.jacobian = 2.0 * law.mu;
  law.face = {law.t.dot(contact.a), law.t.dot(contact.b)};
  law.w = {law.mu * law.n + law.t, law.mu * law.n - law.t};
  const Vec2 gamma = model.mass / model.F * contact.g_O;
  const std::array<Edge, 2> edges = edges_of(contact.mu, widening, gamma, law);
  Cells cells;
  std::copy_if(
      section.cells.begin(), section.cells.end(), std::back_inserter(cells),
      [&edges](const SectionCell& cell) { return !asks_too_much(edges[0], cell); });
  const SectionCell& last = section.cells.back();
  const double fastest = asks_too_much(edges[0], last) ? kInfinity : last.sigma_high;
  for (int k = 0; k < 2; ++k) law.back[k] = -least_advance(cells, edges[k], fastest);
  if (cells.empty()) cells = section.cells;  // its edges let this contact do nothing
  set_ends(section, cells, model, contact, greatest_detour(cells, edges), gamma, law);
  return law;
}

/// Of soft points, whose friction is the ellipsoid: at every place of a pusher on the
/// face.
RunLaw soft_point_law(const Model& model, const PushContact& contact, bool weightless) {
  StickContact stick = stick_contact(model, contact, 0.0);
  stick.a = contact.a;
  stick.b = contact.b;
  Margin margin = Margin::none();
  margin.weightless = weightless;
  return ellipsoid_law(stick, margin);
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

/// Greatest distance of a place of the object from another.
double size_of(const std::vector<Vec2>& outline) {
  double size = 0.0;
  for (const Vec2& u : outline) {
    for (const Vec2& v : outline) size = std::max(size, (u - v).norm());
  }
  return size;
}

}  // namespace

RunLaw ellipsoid_law(const StickContact& stick, const Margin& margin) {
  RunLaw law;
  law.n = stick.n;
  law.t = stick.t;
  law.mu = std::max(kNarrowestCone, stick.mu * (1.0 - margin.friction));
  law.jacobian = 2.0 * law.mu;
  law.face = {law.t.dot(stick.a) + margin.place, law.t.dot(stick.b) - margin.place};
  for (int k = 0; k < 2; ++k) {
    const double side = k == 0 ? 1.0 : -1.0;
    law.w[k] = law.mu * law.n + side * law.t;
    const double pressed = -law.w[k].dot(stick.gamma);
    law.back[k] = margin.weightless ? std::min(0.0, pressed) : pressed;
    EndLaw end;
    end.place = k == 0 ? stick.b : stick.a;
    end.place -= side * margin.place * stick.t;
    end.per_travel = -side * cross(stick.p_OCom - end.place, stick.gamma);
    if (margin.weightless) end.per_travel = std::min(0.0, end.per_travel);
    for (auto& set : law.end) set[k] = end;
  }
  return law;
}

RunLaws run_laws(const Model& model, bool weightless) {
  RunLaws laws;
  for (const PushContact& contact : model.contacts) {
    if (model.needs_space(contact)) return laws;
  }
  laws.reach = size_of(model.outline);
  if (model.has_soft_points()) {
    if (!(model.F > 0.0 && model.c > 0.0)) return laws;
    laws.C.fill(model.c * model.c);
    std::vector<RunLaw> contacts;
    contacts.reserve(model.contacts.size());
    for (const PushContact& contact : model.contacts) {
      if (std::atan(contact.mu) > kWidestCone) return laws;
      contacts.push_back(soft_point_law(model, contact, weightless && !contact.is_point));
    }
    laws.contacts = std::move(contacts);
    return laws;
  }
  if (!has_ring_pads(model) && !alike_at_quarter_turns(model.region.whole(), model.c)) {
    return laws;
  }
  const PadSection section = pad_section(model);
  if (section.cells.empty()) return laws;
  double deviation = 0.0;
  for (const SectionCell& cell : section.cells) {
    deviation = std::max(deviation, cell.deviation);
  }
  const double widening = std::atan(deviation);
  laws.C = {section.slow_ratio * model.c * model.c,
            section.fast_ratio * model.c * model.c};
  std::vector<RunLaw> contacts;
  contacts.reserve(model.contacts.size());
  for (const PushContact& contact : model.contacts) {
    if (std::atan(contact.mu) + widening > kWidestCone) return laws;
    contacts.push_back(run_law(model, contact, section, widening));
    if (!weightless || contact.is_point) continue;
    PushContact floating = contact;
    floating.g_O.setZero();
    contacts.back() =
        stricter(contacts.back(), run_law(model, floating, section, widening));
  }
  laws.contacts = std::move(contacts);
  return laws;
}

}  // namespace prehensile
