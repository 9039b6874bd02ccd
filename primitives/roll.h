/// Rolling (paper section VII-C): a support under a round object moves along the closing
/// direction and turns the object about its long axis between the jaws.
///
/// The roll is solved in the cross-section of the object (mechanics/cross_section.h) with
/// u = n of the contact. The section looks the same at every moment of the push, so one
/// instant decides the whole push and its end is exact.
///
/// Sign of psi: by the right hand about +x or +y of O, the axis of the cylinder,
/// whichever side is supported. A support that moves along +z turns the object about +t
/// of its contact, so psi grows by travel / radius where t points along that axis and
/// falls by as much on the opposite side.
#pragma once

#include <string_view>
#include <vector>

#include "primitives/transition.h"

namespace prehensile {

/// Whether a contact may roll the object at a grasp, judged before any force is known.
struct RollSection {
  bool possible = false;
  std::string_view reason;       ///< static text; empty if possible
  double weight = kNan;          ///< [N] gravity on the support, along -n
  double psi_per_travel = kNan;  ///< [rad/m] +-1 / radius
};

/// Refuses: an object that is not round; a contact that is no line along a long side;
/// pads off the object; a centre of mass off the object's axis (above 1e-6 of the
/// radius); and gravity along that axis (above 1e-6 of the pads' friction capacity),
/// because an object that rolls slips at both pads, and sliding pads resist no force
/// across their slip, so any such weight would make it creep.
RollSection roll_section(const Model& model, int contact, const Grasp& grasp) noexcept;

/// Applies a roll: kCompleted; kLeftGuard if the support slides under the object or drags
/// it along with the jaws; kAmbiguous, kFalls, kJammed by the instant; kRefused as above,
/// or where pads and support are too short to keep the object from tilting or yawing.
Transition apply_roll(const Model& model, const Grasp& start, const Roll& roll,
                      const TransitionOptions& options,
                      std::vector<Sample>* trace) noexcept;

}  // namespace prehensile
