/// Motions and forces of the contact modes of a prism's section. Internal to
/// prism_instant.cpp.
///
/// Everything is in units of the size of the section, the sheet rate and a force F0; the
/// freedoms are (v_z, v_u, roll rate, jaw rate).
#pragma once

#include "mechanics/linear_program.h"
#include "mechanics/prism_section.h"

namespace prehensile::prism {

inline constexpr int kFreedoms = 4;
inline constexpr int kContacts = 3;
inline constexpr int kMostPoints = 2 * kContacts;
inline constexpr int kMostEdges = 2 * kMostPoints;  ///< of friction cones
inline constexpr double kSameMotion = 1e-9;
inline constexpr double kSameForce = 1e-9;

using Freedoms = std::array<double, kFreedoms>;

/// Two bits per contact: which edges of its friction cones may carry load, as in
/// cross_section_modes.h.
using Modes = unsigned;
inline constexpr Modes kAllModes = (1U << (2 * kContacts)) - 1U;
inline unsigned bits_of(Modes modes, int contact) {
  return (modes >> (2 * contact)) & 3U;
}

/// A touching point: rates of the object against its contact as rows over the freedoms.
struct PointRows {
  int contact = 0;
  Vec2 place = Vec2::Zero();
  Vec2 direction = Vec2::Zero();  ///< the normal
  Freedoms normal{}, tangential{};
};

/// Motions that turn one way only, or not at all, or either way: the points that stay.
struct Turning {
  enum class Way { kNone, kPlus, kMinus, kAny };
  Way way = Way::kAny;
  int count = 0;
  std::array<PointRows, kMostPoints> point;
};

/// One case where nothing is flat, else three; the first is the one that does not turn.
struct Turnings {
  int count = 0;
  std::array<Turning, 3> each;
};
Turnings turnings_of(const PrismContacts& contacts, JawMode mode, double length);

struct MotionSet {
  int count = 0;  ///< none, one, or two of a continuum
  std::array<Freedoms, 2> member{};
};
MotionSet motions_of(const Turning& turning, double sheet_rate, Modes modes);

bool same_motion(const Freedoms& a, const Freedoms& b);
double dot(const Freedoms& a, const Freedoms& b);

/// Forces over the edges of the friction cones at the touching points, each of unit
/// length: sum_j load_j edge_j = demand, loads >= 0.
struct Balance {
  std::array<double, kContacts> mu;
  Freedoms demand;  ///< minus gravity and grip
};

/// The edge of point `p` with the tangential force at sign x mu x normal.
Freedoms edge_of(const PointRows& point, double mu, double sign);

struct ForceProgram {
  LinearProgram program{0};
  std::array<int, kMostEdges> column{};  ///< 2 x point + (0: plus edge, 1: minus edge)
};
ForceProgram force_program(const Turning& turning, const Balance& balance, Modes modes,
                           const Freedoms& demand);

/// Resultants in units of F0, places in metres.
SectionForces forces_of(const Turning& turning, const Balance& balance,
                        const ForceProgram& force, const LinearProgram::Point& load);

struct ForceRange {
  bool solved = false;
  bool unique = false;
  bool wedges = false;
  SectionForces least, greatest, middle;
};
ForceRange force_range(const Turning& turning, const Balance& balance, Modes modes);

}  // namespace prehensile::prism
