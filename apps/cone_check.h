/// Motion cones judged by instants, which know nothing of cones.
#pragma once

#include "primitives/motion_cone.h"

namespace prehensile::apps {

/// Random motions of the pusher, asked as instants. Motions within 1e-6 of an edge are
/// left out, and those whose instant has no unique answer are counted apart.
struct ConeCheck {
  int asked = 0;
  int inside = 0;         ///< of the nominal cone
  int not_unique = 0;     ///< no unique answer by the limit surface
  int closed_agrees = 0;  ///< of asked - not_unique: the same verdict as the cone
  int exact_asked = 0;    ///< by the exact solver with the real pads: the planar one, or
                          ///< the spatial one where the contact needs it
  int exact_agrees = 0;
  int robust_asked = 0;  ///< motions inside the robust cone, with members drawn anew
  int robust_sticks = 0;
};

struct ConeQuestion {
  const Model& model;
  Grasp grasp;
  int contact = 0;
  double place = 0.0;
  UncertaintyBox box;
  std::uint64_t seed = 1;
  int count = 2000;
};

ConeCheck check_cone(const ConeQuestion& question, const ConeMember& nominal,
                     const std::vector<ConeMember>& members);

/// A cone of space. Of a line pusher only motions are asked whose two next slices agree
/// about them; the limit surface is not asked, and the members of the robust cone have to
/// stick in space.
ConeCheck check_cone_in_space(const ConeQuestion& question, const MotionCone& cone);

}  // namespace prehensile::apps
