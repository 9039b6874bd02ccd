#include "planner/run_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace prehensile {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Cones wider than this have no useful edges.
constexpr double kWidestCone = 1.4;  // [rad] from the normal

/// One edge of the friction cone of a contact, with G = w.m g / F of it and of the other
/// edge, and the cone widened by `widening` [rad].
struct Edge {
  double half_angle, widening;
  double w, w_wide;  // lengths
  double G, G_other;
};

/// Least angle of a force from the edge for which w.f >= G is possible.
double lean(double G, double w, const SectionCell& cell) {
  const double force =
      G > 0.0 ? std::hypot(1.0, cell.deviation) * cell.drag_high / cell.sigma_low
              : cell.drag_low / cell.sigma_high;
  return std::asin(std::clamp(G / (w * force), -1.0, 1.0));
}

/// The least of w'.e / sigma for an edge w' of the widened cone over all motions that the
/// two edges allow. The force is inside its edge by at least lean(G), and no farther from
/// it than the other edge allows; the motion is within the deviation of the force.
double least_advance(const std::vector<SectionCell>& section, const Edge& edge) {
  double least = kInfinity;
  for (const SectionCell& cell : section) {
    const double from = lean(edge.G, edge.w, cell);
    const double other = lean(edge.G_other, edge.w, cell);
    // Gravity may let the force pass round behind the cone, from edge to edge.
    const bool behind = from + other <= -2.0 * edge.half_angle;
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
  const double beyond = edge.w_wide / section.back().sigma_high;
  return edge.G < 0.0 ? std::min(least, -beyond) : least;
}

/// Greatest slack of an end per dT with the finger axis at this distance from it.
/// side +1: the end that bounds dtheta from below; g [m]: moment of gravity about it.
double greatest_slack(const std::vector<SectionCell>& section, double c, double side,
                      double g, double distance) {
  double greatest = -kInfinity;
  for (const SectionCell& cell : section) {
    const double turning = side > 0.0 ? cell.turning_high : -cell.turning_low;
    const double weight = -side * g / (side * g > 0.0 ? cell.drag_high : cell.drag_low);
    greatest = std::max(
        greatest, c * turning + distance * cell.deviation / cell.sigma_low + weight);
  }
  return greatest;
}

void set_cone(const std::vector<SectionCell>& section, double mu, double widening,
              const Vec2& gamma, RunLaw& law) {
  const double half_angle = std::atan(mu);
  law.mu = std::tan(half_angle + widening);
  law.jacobian = 2.0 * law.mu;
  for (int k = 0; k < 2; ++k) {
    const Vec2 side = k == 0 ? law.t : Vec2(-law.t);
    law.w[k] = law.mu * law.n + side;
    law.back[k] = -least_advance(
        section, {half_angle, widening, std::hypot(1.0, mu), law.w[k].norm(),
                  (mu * law.n + side).dot(gamma), (mu * law.n - side).dot(gamma)});
  }
}

void set_ends(const std::vector<SectionCell>& section, const Model& model, double reach,
              const Vec2& gamma, RunLaw& law) {
  for (int k = 0; k < 2; ++k) {
    const Vec2& end = k == 0 ? law.low : law.high;
    const double side = k == 0 ? 1.0 : -1.0;
    const double g = cross(model.p_OCom - end, gamma);
    law.slack[k] = greatest_slack(section, model.c, side, g, 0.0);
    const double far = greatest_slack(section, model.c, side, g, reach);
    law.slack_slope[k] = (far - law.slack[k]) / reach;
  }
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

RunLaws run_laws(const Model& model) {
  RunLaws laws;
  for (const PushContact& contact : model.contacts) {
    if (model.needs_space(contact)) return laws;
  }
  const std::vector<SectionCell> section = pad_section(model);
  if (section.empty()) return laws;
  double deviation = 0.0;
  for (const SectionCell& cell : section) deviation = std::max(deviation, cell.deviation);
  const double widening = std::atan(deviation);
  laws.C = kSectionRatio * model.c * model.c;
  laws.reach = size_of(model.outline);
  std::vector<RunLaw> contacts;
  contacts.reserve(model.contacts.size());
  for (const PushContact& contact : model.contacts) {
    if (std::atan(contact.mu) + widening > kWidestCone) return laws;
    RunLaw law;
    law.n = contact.n;
    law.t = contact.t;
    law.low = contact.b;
    law.high = contact.a;
    const Vec2 gamma = model.mass / model.F * contact.g_O;
    set_cone(section, contact.mu, widening, gamma, law);
    set_ends(section, model, laws.reach, gamma, law);
    contacts.push_back(law);
  }
  laws.contacts = std::move(contacts);
  return laws;
}

}  // namespace prehensile
