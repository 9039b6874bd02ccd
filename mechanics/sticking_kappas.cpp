#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/sticking.h"
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

/// Least and greatest factor of a parameter with a relative uncertainty.
struct Factors {
  explicit Factors(double relative) : lo(1.0 - relative), hi(1.0 + relative) {}
  Factors(double least, double most) : lo(least), hi(most) {}
  double lo, hi;

  /// The greatest value of factor x B: the worst right side of A >= B.
  double worst(double B) const { return B > 0.0 ? hi * B : lo * B; }
};

/// Friction cone over the box. Between least and greatest c, sigma is monotone, so the
/// two ends decide; the least friction is the worst because the normal force is positive.
void keep_cone(const StickContact& contact, const Vec2& e, const Margin& margin,
               Intersection& kept) {
  const Factors force(margin.least_weight(), margin.most_weight());
  const Factors radius(margin.torque_radius);
  const double mu = contact.mu * std::max(0.0, 1.0 - margin.friction);
  const double e_n = e.dot(contact.n);
  const double e_t = e.dot(contact.t);
  const double gamma_n = contact.gamma.dot(contact.n);
  const double gamma_t = contact.gamma.dot(contact.t);
  const auto keep_row = [&](double A, double B) {
    const Solutions solutions = friction_solutions(A, force.worst(B));
    kept.keep(Intersection::kFriction, solutions, 1.0 / radius.hi);
    if (radius.lo == radius.hi) return;
    kept.keep(Intersection::kFriction, solutions, 1.0 / radius.lo);
  };
  const auto keep_edge = [&](double n, double t) {  // the row n, t of force >= 0
    keep_row(least_turned(n * e_n + t * e_t, n * e_t - t * e_n, margin.tilt),
             -least_turned(-(n * gamma_n + t * gamma_t), n * gamma_t - t * gamma_n,
                           margin.tilt));
  };
  keep_edge(mu, -1.0);
  keep_edge(mu, 1.0);
  if (mu == 0.0) keep_edge(1.0, 0.0);  // the edges of a cone without width allow pulling
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

/// The kappas with which the pusher recedes at both face ends: an open gap, perhaps
/// without end. The normal rate at x is e_n - kappa s_x / c with s_x the place of x along
/// t from the finger axis, `place` [m] uncertain; omega/|v| = kappa / c holds for all
/// members of the box.
Gap receding(const StickContact& contact, const Vec2& p_OF, const Vec2& e, double place,
             double tilt) {
  Gap gap{-kInfinity, kInfinity};
  const double rate = contact.c * least_turned(e.dot(contact.n), e.dot(contact.t), tilt);
  for (const double s : {(contact.a - p_OF).dot(contact.t) + place,
                         (contact.b - p_OF).dot(contact.t) - place}) {
    if (s > 0.0) gap.lo = std::max(gap.lo, rate / s);
    if (s < 0.0) gap.hi = std::min(gap.hi, rate / s);
    if (s == 0.0 && rate >= 0.0) return {};
  }
  return gap;
}

/// Both face ends over the box. The moments are affine in m/F, in the places of pusher,
/// finger axis and centre of mass, so the worst of each is known beforehand. The finger
/// axis counts for the drag only: of gravity the lever about a face end is that of the
/// centre of mass.
void keep_ends(const StickContact& contact, const Vec2& p_OF, const Vec2& e,
               const Margin& margin, Intersection& kept) {
  const Factors force(margin.least_weight(), margin.most_weight());
  const Factors radius(margin.torque_radius);
  const Vec2 a = contact.a + margin.place * contact.t;
  const Vec2 b = contact.b - margin.place * contact.t;
  const double shift = margin.centre_of_mass * contact.gamma.norm();
  const auto turned = [&](double sign, const Vec2& lever, const Vec2& vector) {
    return least_turned(sign * cross(lever, vector), lever.dot(vector), margin.tilt);
  };
  const double A_a = turned(-1.0, p_OF - a, e) - margin.grasp;
  const double A_b = turned(1.0, p_OF - b, e) - margin.grasp;
  const double B_a = shift - turned(1.0, contact.p_OCom - a, contact.gamma);
  const double B_b = shift - turned(-1.0, contact.p_OCom - b, contact.gamma);
  keep_end(contact.c, A_a, force.worst(B_a), radius,
           [&](const Solutions& solutions, double scale) {
             kept.keep(Intersection::kEndA, mirrored(solutions), scale);
           });
  keep_end(contact.c, A_b, force.worst(B_b), radius,
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
  Intersection kept;
  keep_cone(contact, e, margin, kept);
  keep_ends(contact, p_OF, e, contact.is_point ? Margin::none() : margin, kept);
  const double place = contact.is_point ? 0.0 : margin.place + margin.grasp;
  kept.keep(Intersection::kAdvance,
            {.gap = receding(contact, p_OF, e, place, margin.tilt)}, 1.0);
  return kept.set();
}

}  // namespace prehensile
