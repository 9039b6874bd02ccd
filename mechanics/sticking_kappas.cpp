#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/stick_rows.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Rounding of a direction cosine: lets a frictionless pusher push exactly along its
/// normal.
constexpr double kConeRounding = 1e-12;

struct Gap {
  double lo = kInfinity;
  double hi = -kInfinity;
};

/// Solutions of one inequality in kappa: the closed interval [lo, hi] without the open
/// gap.
struct Solutions {
  double lo = -kInfinity;
  double hi = kInfinity;
  Gap gap;

  static Solutions none() { return {kInfinity, -kInfinity, {}}; }
};

/// { kappa : A >= B sigma }, sigma = sqrt(1 + kappa^2): an edge of the friction cone.
Solutions friction_solutions(double A, double B) {
  Solutions solutions;
  if (B == 0.0) return A >= -kConeRounding ? solutions : Solutions::none();
  if (A >= B && B < 0.0) return solutions;
  if (A < B && B > 0.0) return Solutions::none();
  const double K = std::sqrt((A - B) * (A + B)) / std::abs(B);
  if (B > 0.0) {
    solutions.lo = -K;
    solutions.hi = K;
  } else {
    solutions.gap = {-K, K};
  }
  return solutions;
}

/// { kappa : q kappa + A >= B sigma }, q > 0: the moment about a face end has the right
/// sign.
///
/// Squared, the border is D kappa^2 + 2 q A kappa + A^2 - B^2 = 0 with D = q^2 - B^2 and
/// roots (-q A -+ B S) / D, S = sqrt(A^2 + D). Where -q A and B S cancel, the root is
/// taken from the product (B^2 - A^2) / (q A + B S), which also stays finite at D = 0.
/// |B| < q: the left side less the right rises strictly, a ray. B >= q: it is concave,
/// an interval or nothing. B <= -q: it is convex, everything or all but a gap.
Solutions end_solutions(double q, double A, double B) {
  Solutions solutions;
  const double D = (q - B) * (q + B);
  const double squared = A * A + D;
  if (D > 0.0) {
    const double S = std::sqrt(squared);
    solutions.lo =
        A * B > 0.0 ? (B - A) * (B + A) / (q * A + B * S) : (B * S - q * A) / D;
    return solutions;
  }
  if (B > 0.0) {
    if (A <= 0.0 || squared < 0.0) return Solutions::none();
    const double sum = q * A + B * std::sqrt(squared);
    solutions.lo = (B - A) * (B + A) / sum;
    solutions.hi = sum / std::abs(D);
    return solutions;
  }
  if (A >= 0.0 || squared <= 0.0) return solutions;
  const double sum = -q * A - B * std::sqrt(squared);
  solutions.gap = {-sum / std::abs(D), (A - B) * (A + B) / sum};
  return solutions;
}

Solutions mirrored(const Solutions& s) { return {-s.hi, -s.lo, {-s.gap.hi, -s.gap.lo}}; }

/// Intersection of solutions. Gaps of the same constraint in different members of the box
/// are joined to one, which can only make the set smaller.
class Intersection {
 public:
  enum Constraint { kFriction, kEndA, kEndB, kAdvance, kConstraintCount };

  /// `scale`: kappa of the set over kappa of these solutions.
  void keep(Constraint constraint, const Solutions& solutions, double scale) {
    lo_ = std::max(lo_, solutions.lo * scale);
    hi_ = std::min(hi_, solutions.hi * scale);
    if (solutions.gap.lo >= solutions.gap.hi) return;
    Gap& gap = gaps_[constraint];
    gap.lo = std::min(gap.lo, solutions.gap.lo * scale);
    gap.hi = std::max(gap.hi, solutions.gap.hi * scale);
    has_gaps_ = true;
  }

  KappaSet set() {
    KappaSet set;
    if (!(lo_ <= hi_)) return set;
    if (!has_gaps_) {
      append(set, lo_, hi_);
      return set;
    }
    std::sort(gaps_.begin(), gaps_.end(),
              [](const Gap& x, const Gap& y) { return x.lo < y.lo; });
    double from = lo_;
    for (const Gap& gap : gaps_) {
      if (gap.lo >= hi_) break;
      if (gap.hi <= from) continue;
      if (gap.lo >= from && gap.lo > -kInfinity) append(set, from, gap.lo);
      from = gap.hi;
    }
    if (from <= hi_ && from < kInfinity) append(set, from, hi_);
    return set;
  }

 private:
  static void append(KappaSet& set, double lo, double hi) {
    set.intervals[set.count] = {lo, hi};
    ++set.count;
  }

  double lo_ = -kInfinity;
  double hi_ = kInfinity;
  bool has_gaps_ = false;
  std::array<Gap, kConstraintCount> gaps_;
};

/// Least and greatest factor of the torque radius.
struct Factors {
  explicit Factors(double relative) : lo(1.0 - relative), hi(1.0 + relative) {}
  double lo, hi;
};

/// Friction cone over the box. Between least and greatest c, sigma is monotone, so the
/// two ends decide.
void keep_cone(const StickRows& rows, const Factors& radius, Intersection& kept) {
  for (int i = 0; i < rows.edges; ++i) {
    const Solutions solutions = friction_solutions(rows.edge[i].A, rows.edge[i].B);
    kept.keep(Intersection::kFriction, solutions, 1.0 / radius.hi);
    if (radius.lo == radius.hi) continue;
    kept.keep(Intersection::kFriction, solutions, 1.0 / radius.lo);
  }
}

/// One face end over the box: { kappa : c kappa + A >= B sigma } for end b; the mirror
/// image (kappa, A, B with the other sign) is the condition of end a.
///
/// At fixed w = omega/|v| > 0 the left side over sigma, as a function of c, either rises
/// or first falls to 2 sqrt(1 + c^2 w^2) / w >= 2 c and then rises. So the ends of the
/// box decide unless B > 2 c and A > 0; there the bound c^2 w / sigma >= c_lo^2 w /
/// sigma_hi joins in.
template <class Keep>
void keep_end(double c, double A, double B, const Factors& radius, Keep&& keep) {
  keep(end_solutions(c * radius.hi, A, B), 1.0 / radius.hi);
  if (radius.lo == radius.hi) return;
  keep(end_solutions(c * radius.lo, A, B), 1.0 / radius.lo);
  if (B <= 2.0 * c * radius.lo || A <= 0.0) return;
  keep(end_solutions(c * radius.lo * radius.lo / radius.hi, A, B), 1.0 / radius.hi);
}

void keep_ends(const StickContact& contact, const StickRows& rows, const Factors& radius,
               Intersection& kept) {
  keep_end(contact.c, rows.end_a.A, rows.end_a.B, radius,
           [&](const Solutions& solutions, double scale) {
             kept.keep(Intersection::kEndA, mirrored(solutions), scale);
           });
  keep_end(contact.c, rows.end_b.A, rows.end_b.B, radius,
           [&](const Solutions& solutions, double scale) {
             kept.keep(Intersection::kEndB, solutions, scale);
           });
}

}  // namespace

bool KappaSet::contains(double kappa) const {
  for (int i = 0; i < count; ++i) {
    if (kappa >= intervals[i].lo && kappa <= intervals[i].hi) return true;
  }
  return false;
}

KappaSet sticking_kappas(const StickContact& contact, const Vec2& p_OF,
                         const Vec2& e) noexcept {
  return robust_kappas(contact, p_OF, e, Margin::none());
}

KappaSet robust_kappas(const StickContact& contact, const Vec2& p_OF, const Vec2& e,
                       const Margin& margin) noexcept {
  const StickRows rows = stick_rows(contact, p_OF, e, margin);
  Intersection kept;
  keep_cone(rows, Factors(margin.torque_radius), kept);
  keep_ends(contact, rows, Factors(contact.is_point ? 0.0 : margin.torque_radius), kept);
  const auto [lo, hi] = receding_kappas(contact, p_OF, e, margin);
  kept.keep(Intersection::kAdvance, {.gap = {lo, hi}}, 1.0);
  return kept.set();
}

}  // namespace prehensile
