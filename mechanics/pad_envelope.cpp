#include "mechanics/pad_envelope.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanics/pad_drag.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr int kAngles = 48;              // over a whole turn
constexpr double kBetweenAngles = 3e-3;  // of the wrench, in F and F c
constexpr int kAnglesOfDisc = 12;        // its quadrature is nearly the same at all

/// The most that a term of the weight may come to.
double worst(double term, const Margin& margin) {
  return term > 0.0 ? margin.most_weight() * term : margin.least_weight() * term;
}

Vec2 unit_vector(int k, int angles) {
  return rotated(2.0 * std::numbers::pi * (k + 0.5) / angles, Vec2(1.0, 0.0));
}

}  // namespace

PadEnvelope::PadEnvelope(const Model& model, const Margin& margin)
    : margin_(margin), c_(model.c) {
  for (int i = 0; i < kKappas; ++i) {
    grid_[i] = 0.25 * std::sinh(6.0 * (2.0 * i / (kKappas - 1) - 1.0));
    turns_[i] = grid_[i] / c_;
  }
  table_[tables_++] = tabulate(model, grid_, 1.0);
  if (margin.torque_radius == 0.0) return;
  table_[tables_++] = tabulate(model, grid_, 1.0 - margin.torque_radius);
  table_[tables_++] = tabulate(model, grid_, 1.0 + margin.torque_radius);
}

PadEnvelope::Table PadEnvelope::tabulate(const Model& model, const Row& grid,
                                         double stretch) {
  const ContactPoints& points = model.region.whole();
  const int angles = model.has_soft_points()       ? 1
                     : model.region.is_isotropic() ? kAnglesOfDisc
                                                   : kAngles;
  Table table;
  for (int i = 0; i < kKappas; ++i) {
    const double omega = grid[i] / model.c;
    table.along_low[i] = table.moment_low[i] = kInfinity;
    table.along_high[i] = table.moment_high[i] = -kInfinity;
    table.across[i] = 0.0;
    for (int k = 0; k < angles; ++k) {
      const Vec2 e = unit_vector(k, angles);
      const PadDrag drag = model.has_soft_points()
                               ? drag_of_ellipsoid(stretch * model.c, e, omega)
                               : drag_of_points(points.count, points.x, points.y,
                                                points.weight, stretch, e, omega);
      const double moment = drag.moment / model.c;
      const double along = drag.force.dot(e);
      table.along_low[i] = std::min(table.along_low[i], along);
      table.along_high[i] = std::max(table.along_high[i], along);
      table.across[i] = std::max(table.across[i], std::abs(cross(e, drag.force)));
      table.moment_low[i] = std::min(table.moment_low[i], moment);
      table.moment_high[i] = std::max(table.moment_high[i], moment);
    }
    if (model.region.is_isotropic()) continue;
    table.along_low[i] -= kBetweenAngles;
    table.along_high[i] += kBetweenAngles;
    table.across[i] += kBetweenAngles;
    table.moment_low[i] -= kBetweenAngles;
    table.moment_high[i] += kBetweenAngles;
  }
  table.most_along = std::ranges::max(table.along_low);
  table.least_along = std::ranges::min(table.along_high);
  table.least_across = std::ranges::min(table.across);
  table.most_moment = std::ranges::max(table.moment_low);
  table.least_moment = std::ranges::min(table.moment_high);
  return table;
}

bool PadEnvelope::may_hold(const Inequality& row, const Table& table) noexcept {
  const double along = row.along > 0.0 ? table.most_along : table.least_along;
  const double moment = row.moment > 0.0 ? table.most_moment : table.least_moment;
  const double left =
      row.along * along - row.across * table.least_across + row.moment * moment;
  return left - row.right >= 0.0;
}

KappaSet PadEnvelope::kappas(const StickContact& contact, const Vec2& from,
                             const Vec2& to) const noexcept {
  const Vec2 e = (from - to).normalized();
  const Vec2 o = perp(e);
  // A point pusher takes the place that the moment asks for.
  const Margin margin = contact.is_point ? Margin::none() : margin_;
  const Vec2 a = contact.a + margin.place * contact.t;
  const Vec2 b = contact.b - margin.place * contact.t;

  std::array<Inequality, 5> rows{};
  int count = 0;
  const double mu = contact.mu * std::max(0.0, 1.0 - margin_.friction);
  const auto add_edge = [&](const Vec2& edge) {
    const double turned =
        margin_.tilt * (std::abs(edge.dot(o)) +
                        (1.0 + margin_.force) * std::abs(cross(edge, contact.gamma)));
    rows[count++] = {edge.dot(e), std::abs(edge.dot(o)), 0.0,
                     worst(edge.dot(contact.gamma), margin_) + turned};
  };
  add_edge(mu * contact.n + contact.t);
  add_edge(mu * contact.n - contact.t);
  if (mu == 0.0) add_edge(contact.n);
  // Friction is at most 1 in F, whatever the place of the finger axis.
  const double shift = margin.centre_of_mass * contact.gamma.norm() + margin.grasp;
  const auto add_end = [&](const Vec2& end, double side) {
    const double across =
        std::max(std::abs(cross(from - end, o)), std::abs(cross(to - end, o)));
    const double lever = std::abs((contact.p_OCom - end).dot(contact.gamma));
    const double right = shift + side * cross(contact.p_OCom - end, contact.gamma);
    rows[count++] = {side * cross(from - end, e) / c_, across / c_, side,
                     (worst(right, margin) + margin.tilt * (across + lever)) / c_};
  };
  add_end(a, -1.0);
  add_end(b, 1.0);

  for (int t = 0; t < tables_; ++t) {
    for (int k = 0; k < count; ++k) {
      if (!may_hold(rows[k], table_[t])) return {};
    }
  }
  // The normal rate at an end x is e_n - kappa s_x / c; one of them must not recede.
  const double e_n = e.dot(contact.n);
  const double s_a = std::max((a - from).dot(contact.t), (a - to).dot(contact.t));
  const double s_b = std::min((b - from).dot(contact.t), (b - to).dot(contact.t));
  Slack slack;
  for (int i = 0; i < kKappas; ++i) {
    slack.row[i] = std::max(e_n - turns_[i] * s_a, e_n - turns_[i] * s_b);
  }
  slack.close_in();
  for (int t = 0; t < tables_; ++t) {
    for (int k = 0; k < count && slack.is_left(); ++k) keep(rows[k], table_[t], slack);
  }
  return intervals(slack);
}

void PadEnvelope::Slack::close_in() noexcept {
  while (first <= last && !(row[first] >= 0.0)) ++first;
  while (first <= last && !(row[last] >= 0.0)) --last;
}

/// Lowers the slack to that of one inequality, worst over the box of the wrench.
void PadEnvelope::keep(const Inequality& row, const Table& table, Slack& slack) noexcept {
  const Row& along = row.along > 0.0 ? table.along_low : table.along_high;
  const Row& moment = row.moment > 0.0 ? table.moment_low : table.moment_high;
  for (int i = slack.begin(); i < slack.end(); ++i) {
    const double left =
        row.along * along[i] - row.across * table.across[i] + row.moment * moment[i];
    slack.row[i] = std::min(slack.row[i], left - row.right);
  }
  slack.close_in();
}

KappaSet PadEnvelope::intervals(const Slack& slack) const noexcept {
  KappaSet set;
  if (!slack.is_left()) return set;
  double last = -1.0;
  for (int i = slack.begin(); i < slack.end(); ++i) {
    const double now = slack.row[i];
    const auto border = [&] {
      return std::lerp(grid_[i - 1], grid_[i], last / (last - now));
    };
    if (now >= 0.0 && last < 0.0) {
      if (set.count == static_cast<int>(set.intervals.size())) return set;
      set.intervals[set.count++].lo = i > 0 ? border() : grid_[i];
    }
    if (now < 0.0 && last >= 0.0) set.intervals[set.count - 1].hi = border();
    if (now >= 0.0 && i + 1 == kKappas) set.intervals[set.count - 1].hi = grid_[i];
    last = now;
  }
  return set;
}

}  // namespace prehensile
