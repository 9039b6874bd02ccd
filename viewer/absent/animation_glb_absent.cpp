#include <stdexcept>

#include "viewer/animation_glb.h"

namespace prehensile::viewer {

std::string animation_glb(const Model&, const Film&) {
  throw std::runtime_error("this build writes no GLB files");
}

bool has_glb() { return false; }

}  // namespace prehensile::viewer
