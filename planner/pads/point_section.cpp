#include "planner/pads/point_section.h"

#include <algorithm>
#include <cmath>

#include "scene/constants.h"

namespace prehensile {
namespace {

/// Directions of motion that are looked at, over a quarter turn. Where quarter turns
/// differ there are boxes for each of some sectors of it, in each of which more are.
constexpr int kAngles = 24;
constexpr int kSectors = 12;
constexpr int kAnglesOfSector = 4;

constexpr int kDense = 128;  // kappas of either sign, evenly up to kDenseKappa
constexpr int kSparse = 64;  // and with a constant ratio up to kMostKappa
constexpr double kDenseKappa = 3.2;
constexpr int kDirections = 24;  // of the force of a pad point at the centre of rotation
constexpr double kMostKappa = 1e4;

constexpr double kSlowRatio = 0.6;
constexpr double kFastRatio = 1.6;

constexpr double kLeastAlong = 1e-6;  // of F: a ratio to less is infinite

/// By which the boxes are widened, as shares of their width and of the value; where the
/// object turns, sigma > kTurning, the force may deviate by a little more.
constexpr double kBetweenSamples = 0.05;
constexpr double kRelative = 2e-3;
constexpr double kDeviation = 2e-3;
constexpr double kTurning = 1.05;

struct Friction {
  double along, across, moment;
};

/// Sums the pads' friction; the point `pivot`, at the centre of rotation, has the force
/// `pivot_force` of its bound.
Friction friction_of(const ContactPoints& points, double c, double kappa, const Vec2& e,
                     int pivot = -1, const Vec2& pivot_force = Vec2::Zero()) {
  const double omega = kappa / c;
  Vec2 force = Vec2::Zero();
  double moment = 0.0;
  for (int j = 0; j < points.count; ++j) {
    const Vec2 r(points.x[j], points.y[j]);
    const Vec2 slip = e + omega * perp(r);
    const double speed = slip.norm();
    if (j != pivot && speed == 0.0) continue;
    const Vec2 f = points.weight[j] * (j == pivot ? pivot_force : Vec2(slip / speed));
    force += f;
    moment += cross(r, f);
  }
  return {force.dot(e), std::abs(cross(e, force)), moment / c};
}

/// Every point has a partner with its weight where a turn about the finger axis takes it.
bool alike_after(const ContactPoints& points, double angle, double size) {
  for (int i = 0; i < points.count; ++i) {
    const Vec2 turned = rotated(angle, {points.x[i], points.y[i]});
    bool found = false;
    for (int j = 0; j < points.count && !found; ++j) {
      const double off = (Vec2(points.x[j], points.y[j]) - turned).norm();
      found = off < 1e-9 * size && std::abs(points.weight[i] - points.weight[j]) < 1e-9;
    }
    if (!found) return false;
  }
  return true;
}

/// After so many quarter turns the pads are alike.
int quarters_of(const ContactPoints& points, double size) {
  if (alike_at_quarter_turns(points, size)) return 1;
  return alike_after(points, kPi, size) ? 2 : 4;
}

/// Directions of motion in the hand [rad], of pads that are alike after `period`.
struct Sector {
  double low, width, period;
  int angles;  // looked at

  /// Whether a direction is in it or less than a width beside it.
  bool is_near(double angle) const {
    const double off = std::remainder(angle - low - 0.5 * width, period);
    return std::abs(off) < 1.5 * width;
  }
};

/// Dense where centres of rotation lie in the pads, sparse elsewhere.
double kappa_at(int i) {
  if (i <= kDense) return kDenseKappa * i / kDense;
  return kDenseKappa *
         std::pow(kMostKappa / kDenseKappa, static_cast<double>(i - kDense) / kSparse);
}

/// Motions of one kappa, or of those between two.
struct Motions {
  SectionCell cell;
  FrictionBox box;
};

Motions motions_of(double kappa) {
  const double sigma = std::hypot(1.0, kappa);
  const double cosine = 1.0 / sigma, sine = kappa / sigma;
  return {
      {sigma, sigma, kInfinity, -kInfinity, 0.0, sine, sine, kInfinity, -kInfinity},
      {kInfinity, -kInfinity, 0.0, kInfinity, -kInfinity, cosine, cosine, sine, sine}};
}

void extend(double value, double& low, double& high) {
  low = std::min(low, value);
  high = std::max(high, value);
}

void keep(const Friction& friction, Motions& motions) {
  auto& [cell, box] = motions;
  extend(friction.along, box.along_low, box.along_high);
  extend(friction.moment, box.moment_low, box.moment_high);
  box.across = std::max(box.across, friction.across);
  const double along = std::max(friction.along, kLeastAlong);
  const double sigma = cell.sigma_low;
  extend(friction.along * sigma, cell.drag_low, cell.drag_high);
  extend(friction.moment / along / sigma, cell.turning_low, cell.turning_high);
  cell.deviation =
      std::max(cell.deviation, along > kLeastAlong ? friction.across / along : kInfinity);
}

SectionCell joined(const SectionCell& a, const SectionCell& b) {
  return {std::min(a.sigma_low, b.sigma_low),      std::max(a.sigma_high, b.sigma_high),
          std::min(a.drag_low, b.drag_low),        std::max(a.drag_high, b.drag_high),
          std::max(a.deviation, b.deviation),      std::min(a.sine_low, b.sine_low),
          std::max(a.sine_high, b.sine_high),      std::min(a.turning_low, b.turning_low),
          std::max(a.turning_high, b.turning_high)};
}

Motions joined(const Motions& a, const Motions& b) {
  return {joined(a.cell, b.cell), joined(a.box, b.box)};
}

/// The friction of more motions, for the same kappas.
void keep_friction_of(const Motions& others, Motions& motions) {
  const auto [cell, box] = motions;
  motions = joined(motions, others);
  motions.cell.sigma_low = cell.sigma_low;
  motions.cell.sigma_high = cell.sigma_high;
  motions.cell.sine_low = motions.box.sine_low = cell.sine_low;
  motions.cell.sine_high = motions.box.sine_high = cell.sine_high;
  motions.box.cosine_low = box.cosine_low;
  motions.box.cosine_high = box.cosine_high;
}

void widen(double least, double& low, double& high) {
  const double by = kBetweenSamples * (high - low) + least;
  low -= by;
  high += by;
}

SectionCell widened(SectionCell cell) {
  const double drag =
      kBetweenSamples * (cell.drag_high - cell.drag_low) + kRelative * cell.drag_high;
  cell.drag_low -= std::min(drag, 0.5 * std::abs(cell.drag_low));
  cell.drag_high += drag;
  cell.deviation *= 1.0 + kBetweenSamples;
  if (cell.sigma_high > kTurning) cell.deviation += kDeviation;
  widen(kRelative, cell.turning_low, cell.turning_high);
  return cell;
}

FrictionBox widened(FrictionBox box) {
  widen(kRelative, box.along_low, box.along_high);
  widen(kRelative, box.moment_low, box.moment_high);
  box.across *= 1.0 + kBetweenSamples;
  if (box.cosine_low * kTurning < 1.0) box.across += kDeviation;
  return box;
}

/// Where the centre of rotation is on a pad point: the kappa, and the direction of
/// motion.
struct TurningPlace {
  int point;
  double kappa;
  Vec2 e;
};

std::vector<TurningPlace> pivots_of(const ContactPoints& points, double c) {
  std::vector<TurningPlace> pivots;
  for (int j = 0; j < points.count; ++j) {
    const Vec2 r(points.x[j], points.y[j]);
    if (r.norm() < 1e-9 * c) continue;
    for (const double sign : {1.0, -1.0}) {
      pivots.push_back({j, sign * c / r.norm(), -sign * perp(r).normalized()});
    }
  }
  return pivots;
}

/// Looked at of pads of points, in ascending order.
std::vector<double> kappas_of(const std::vector<TurningPlace>& pivots) {
  std::vector<double> kappas;
  for (int i = -kDense - kSparse; i <= kDense + kSparse; ++i) {
    kappas.push_back(i < 0 ? -kappa_at(-i) : kappa_at(i));
  }
  for (const TurningPlace& pivot : pivots) kappas.push_back(pivot.kappa);
  std::ranges::sort(kappas);
  const auto same = [](double a, double b) { return b - a < 1e-12 * std::abs(b); };
  kappas.erase(std::unique(kappas.begin(), kappas.end(), same), kappas.end());
  return kappas;
}

/// The motions in a sector, for each of the kappas.
std::vector<Motions> rows_of(const ContactPoints& points, double c,
                             const std::vector<TurningPlace>& pivots,
                             const std::vector<double>& kappas, const Sector& sector) {
  std::vector<Motions> rows;
  rows.reserve(kappas.size());
  for (const double kappa : kappas) {
    rows.push_back(motions_of(kappa));
    for (int k = 0; k <= sector.angles; ++k) {
      const double angle = sector.low + sector.width * k / sector.angles;
      keep(friction_of(points, c, kappa, rotated(angle, Vec2(1.0, 0.0))), rows.back());
    }
  }
  for (const TurningPlace& pivot : pivots) {
    if (!sector.is_near(std::atan2(pivot.e.y(), pivot.e.x()))) continue;
    const auto at =
        std::ranges::lower_bound(kappas, pivot.kappa - 1e-9 * std::abs(pivot.kappa));
    for (int k = 0; k < kDirections; ++k) {
      const Vec2 force = rotated(2.0 * kPi * k / kDirections, pivot.e);
      keep(friction_of(points, c, pivot.kappa, pivot.e, pivot.point, force),
           rows[static_cast<std::size_t>(at - kappas.begin())]);
    }
  }
  return rows;
}

/// Those between each row and the next; near a pivot a neighbour is one.
std::vector<Motions> between(const std::vector<Motions>& rows) {
  std::vector<Motions> all;
  all.reserve(rows.size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    Motions motions = joined(rows[i - 1], rows[i]);
    if (i >= 2) keep_friction_of(rows[i - 2], motions);
    if (i + 1 < rows.size()) keep_friction_of(rows[i + 1], motions);
    all.push_back(motions);
  }
  return all;
}

}  // namespace

bool alike_at_quarter_turns(const ContactPoints& points, double c) {
  return alike_after(points, 0.5 * kPi, c);
}

PadSection section_of_points(const ContactPoints& points, double c) {
  PadSection section{.slow_ratio = kSlowRatio, .fast_ratio = kFastRatio};
  const std::vector<TurningPlace> pivots = pivots_of(points, c);
  const std::vector<double> kappas = kappas_of(pivots);
  const int quarters = quarters_of(points, c);
  const int sectors = quarters == 1 ? 1 : kSectors * quarters;
  const double period = 0.5 * kPi * quarters;
  const double width = period / sectors;
  for (int i = 0; i < sectors; ++i) {
    const Sector sector{i * width, width, period,
                        quarters == 1 ? kAngles : kAnglesOfSector};
    for (const Motions& motions : between(rows_of(points, c, pivots, kappas, sector))) {
      section.boxes.push_back(widened(motions.box));
      if (quarters == 1) section.cells.push_back(widened(motions.cell));
    }
  }
  return section;
}

}  // namespace prehensile
