#include "planner/pads/clipped_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace prehensile {
namespace {

/// Velocity of the object at the finger axis and c times its rate of turn.
using Motion = Eigen::Vector3d;

/// By so much an inequality may fail at both ends of the line and still count as met, for
/// the places between: a share of what the friction changes by from one end to the other,
/// and no more than grows with the length of the line over the torque radius. Up to 0.71
/// of what comes of these was seen along lines up to the longest, in 15 million samples
/// over 132 scenes.
constexpr double kShareOfChange = 0.5;
constexpr double kPerLength = 0.3;

/// Triangles of motions are halved until their sides are shorter than this, and so many
/// are looked at, at most.
constexpr double kLeastSide = 0.003;
constexpr int kMostTriangles = 50'000;

using Triangle = std::array<Motion, 3>;

/// One end of the line: the pads there and what the contact asks of them.
struct End {
  const SpreadPads& pads;
  StickDemands demands;
  Vec2 p_OF;
  double c;

  double power(const Motion& motion) const {
    return pads.power(motion.head<2>(), motion[2] / c);
  }

  Motion friction(const Motion& motion) const { return friction_in(pads, motion, c); }
};

/// Motions of a triangle at one end of the line.
class Motions {
 public:
  Motions(const End& end, const Triangle& corners, double widening)
      : end_(end), corners_(corners), widening_(widening) {
    const Motion middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const Motion friction = end.friction(middle);
    for (int j = 0; j < 3; ++j) {
      least_power_[j] = friction.dot(corners[j]);
      step_ = std::max(step_, (corners[j] - middle).norm());
    }
  }

  bool may_meet(int i) const {
    const StickDemands::Inequality& demand = end_.demands[i];
    const double least = -demand.constant - widening_;
    return std::ranges::any_of(std::array{0, 1, 2}, [&](int j) {
      const double power = end_.power(corners_[j] + step_ * demand.eta);
      return power - least_power_[j] >= step_ * least;
    });
  }

 private:
  const End& end_;
  const Triangle& corners_;
  double widening_;
  std::array<double, 3> least_power_;
  double step_ = 0.0;
};

class Crossing {
 public:
  Crossing(const PushContact& contact, const End& a, const End& b)
      : contact_(contact),
        a_(a),
        b_(b),
        widening_(widening_between(a.pads, b.pads, {a.p_OF, b.p_OF}, a.c)) {}

  bool may_be(const Triangle& corners) {
    if (++looked_at_ > kMostTriangles) return true;
    if (!may_advance(corners) || is_denied(corners)) return false;
    const auto side = [&](int i) { return (corners[(i + 1) % 3] - corners[i]).norm(); };
    int longest = side(0) > side(1) ? 0 : 1;
    if (side(2) > side(longest)) longest = 2;
    if (side(longest) < kLeastSide) return true;
    const Motion& from = corners[longest];
    const Motion& to = corners[(longest + 1) % 3];
    const Motion& apex = corners[(longest + 2) % 3];
    const Motion middle = 0.5 * (from + to);
    return may_be({apex, from, middle}) || may_be({apex, middle, to});
  }

 private:
  bool may_advance(const Triangle& corners) const {
    const auto may_at = [&](const Vec2& end) {
      return std::ranges::any_of(corners, [&](const Motion& motion) {
        return rate_at(end, a_, motion) >= 0.0 || rate_at(end, b_, motion) >= 0.0;
      });
    };
    return may_at(contact_.a) || may_at(contact_.b);
  }

  double rate_at(const Vec2& end, const End& of_line, const Motion& motion) const {
    return advance_at(end, contact_, of_line.p_OF, of_line.c, motion);
  }

  /// By one inequality at both ends; first by the one that decided last.
  bool is_denied(const Triangle& corners) {
    const Motions at_a(a_, corners, widening_);
    const Motions at_b(b_, corners, widening_);
    for (int k = 0; k < a_.demands.count(); ++k) {
      const int i = (first_ + k) % a_.demands.count();
      if (at_a.may_meet(i) || at_b.may_meet(i)) continue;
      first_ = i;
      return true;
    }
    return false;
  }

  const PushContact& contact_;
  const End& a_;
  const End& b_;
  double widening_;
  int first_ = 0;
  int looked_at_ = 0;
};

}  // namespace

bool has_clipped_law(const Model& model) {
  return has_clipped_discs(model) &&
         std::ranges::none_of(model.contacts, [&](const PushContact& contact) {
           return model.needs_space(contact);
         });
}

ClippedLaw::ClippedLaw(const Model& model, const PlaceSpan& line, const Vec2& out)
    : model_(model), line_(line), out_(out), at_a_(model, line.a), at_b_(model, line.b) {}

bool ClippedLaw::is_known() const { return !at_a_.are_lost() && !at_b_.are_lost(); }

bool ClippedLaw::may_cross(int contact) const {
  const PushContact& pushed = model_.contacts[contact];
  const End a{at_a_, {model_, pushed, line_.a}, line_.a, model_.c};
  const End b{at_b_, {model_, pushed, line_.b}, line_.b, model_.c};
  Crossing crossing(pushed, a, b);
  const Motion across(-out_.x(), -out_.y(), 0.0);
  for (const double side : {1.0, -1.0}) {
    for (const double turn : {1.0, -1.0}) {
      const Motion along(side * out_.y(), -side * out_.x(), 0.0);
      if (crossing.may_be({across, along, Motion(0.0, 0.0, turn)})) return true;
    }
  }
  return false;
}

bool ClippedLaw::falls(const PushContact& contact, const PlanarTwist& twist,
                       double share) const {
  const auto falls_at = [&](const SpreadPads& pads, const Vec2& p_OF) {
    const Vec2 at_com = twist.head<2>() + twist[2] * perp(model_.p_OCom - p_OF);
    const double gravity = model_.mass * contact.g_O.dot(at_com);
    return gravity > (1.0 + share) * model_.F * pads.power(twist.head<2>(), twist[2]);
  };
  return falls_at(at_a_, line_.a) && falls_at(at_b_, line_.b);
}

StickDemands::StickDemands(const Model& model, const PushContact& contact,
                           const Vec2& p_OF) {
  const Vec2 gamma = model.mass / model.F * contact.g_O;
  const auto add_force = [&](const Vec2& w) {
    add(Motion(w.x(), w.y(), 0.0), -w.dot(gamma));
  };
  const auto add_moment = [&](const Vec2& end, double sense) {
    const Vec2 lever = perp(p_OF - end);
    add(sense * Motion(lever.x(), lever.y(), model.c),
        -sense * cross(model.p_OCom - end, gamma));
  };
  add_force(contact.mu * contact.n + contact.t);
  add_force(contact.mu * contact.n - contact.t);
  if (contact.mu == 0.0) add_force(contact.n);
  add_moment(contact.b, 1.0);
  add_moment(contact.a, -1.0);
}

void StickDemands::add(const Motion& eta, double constant) {
  const double size = eta.norm();
  inequalities_[count_++] = {eta / size, constant / size};
}

double StickDemands::slack(const Motion& friction) const {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count_; ++i) {
    const Inequality& one = inequalities_[i];
    least = std::min(least, one.eta.dot(friction) + one.constant);
  }
  return least;
}

double widening_between(const SpreadPads& at_a, const SpreadPads& at_b,
                        const PlaceSpan& line, double c) {
  double change = 0.0;
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double turn : {0.01, 1.0}) {
        const Motion motion(x, y, turn);
        change = std::max(
            change, (friction_in(at_a, motion, c) - friction_in(at_b, motion, c)).norm());
      }
    }
  }
  const double length = (line.b - line.a).norm() / c;
  return std::min(kShareOfChange * change, kPerLength * length);
}

double advance_at(const Vec2& end, const PushContact& contact, const Vec2& p_OF, double c,
                  const Motion& motion) {
  return contact.n.dot(motion.head<2>() + motion[2] / c * perp(end - p_OF));
}

}  // namespace prehensile
