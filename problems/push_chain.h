/// Random sequences of sticking pushes: where one ends is a goal that can be reached.
#pragma once

#include "mechanics/model.h"
#include "problems/random_regrasps.h"
#include "problems/random_stream.h"

namespace prehensile {

struct ChainRange {
  int least = 1;  ///< pushes in the pad plane, 1..most
  int most = 5;
  bool two_pushers = false;  ///< not all of them by the same pusher
  bool rolls = false;        ///< a roll by a random angle comes last
};

/// The pads hold gravity over the default margin, the finger axis at p_OF [m], in the
/// attitude of every contact.
bool held_by_all(const Model& model, const Vec2& p_OF);

/// Draws pushes from the start of the model's scene, each of 5 to 40 mm; where the last
/// one ends becomes the goal of `problem`, its tolerances as they are. Pushes by lines
/// stick with the exact pads over the default margin; those by points are followed by the
/// exact mechanics. False if too few were found.
bool append_chain(const Model& model, const ChainRange& range, RandomStream& random,
                  RandomRegrasp& problem);

}  // namespace prehensile
