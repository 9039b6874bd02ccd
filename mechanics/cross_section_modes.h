/// The two polyhedra of a mode combination in the cross-section: the motions that it
/// allows and the forces that it allows. Internal to cross_section.cpp.
///
/// Everything is in units of the radius, the sheet rate and a force F0.
#pragma once

#include "mechanics/cross_section.h"
#include "mechanics/linear_program.h"

namespace prehensile::section {

inline constexpr int kFreedoms = 4;  ///< v_z, v_u, roll rate, jaw rate
inline constexpr int kContacts = 3;
inline constexpr int kEdges = 2 * kContacts;  ///< edges of the friction cones
inline constexpr double kSameMotion = 1e-9;
inline constexpr double kSameForce = 1e-9;

using Freedoms = std::array<double, kFreedoms>;

bool same_motion(const Freedoms& a, const Freedoms& b);

/// Mode combination: two bits per contact say which edges of its friction cone may carry
/// load, the edge with the tangential force at +mu x normal (bit 0) and at -mu (bit 1).
/// No edge is an open contact, both are sticking, one alone is slipping against that
/// edge.
using Modes = unsigned;
inline constexpr Modes kAllModes = (1U << kEdges) - 1U;

/// Motions that a mode combination allows: none, one, or two of a continuum.
struct MotionSet {
  int count = 0;
  std::array<Freedoms, 2> member{};
};
using MotionTable = std::array<MotionSet, kAllModes + 1>;

/// The motions of all mode combinations. In these units they depend on nothing but the
/// jaw mode and the direction of the sheet, so they are worked out once.
const MotionTable& motion_table(JawMode mode, double sheet_rate);

/// What a contact does in a motion.
ContactMode mode_of(JawMode jaw_mode, int contact, const Freedoms& v, double sheet_rate);

/// The balance of forces over the edges of the friction cones, each of unit length:
/// sum_j load_j edge_j = demand, loads >= 0.
struct Balance {
  std::array<Freedoms, kEdges> edge;
  std::array<double, kEdges> normal;      ///< normal force per unit load
  std::array<double, kEdges> tangential;  ///< tangential force per unit load
  Freedoms demand;                        ///< minus gravity and grip
};
Balance balance_of(const CrossSectionModel& model, const CrossSectionDrive& drive,
                   double unit_force);

/// Programme over the loads of the allowed edges only; `column` names their edges.
struct ForceProgram {
  LinearProgram program{0};
  std::array<int, kEdges> column{};
};
ForceProgram force_program(const Balance& balance, Modes modes, const Freedoms& demand);

CrossSectionForces forces_of(const Balance& balance, const ForceProgram& force,
                             const LinearProgram::Point& load);

/// All forces at one motion: a polytope, given by its extremes at the sheet. The balance
/// leaves no freedom beyond the two components there.
struct ForceRange {
  bool solved = false;
  bool unique = false;
  double sheet_low = 0.0;
  double sheet_high = 0.0;    ///< may be infinite
  CrossSectionForces middle;  ///< mean of the extreme solutions, or the finite one
};
ForceRange force_range(const Balance& balance, Modes modes);

}  // namespace prehensile::section
