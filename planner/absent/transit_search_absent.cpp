#include "planner/arm/transit.h"

namespace prehensile {

std::vector<HandPose> search_transit(const TransitRoom& /*room*/,
                                     const HandPose& /*from*/, const HandPose& /*to*/,
                                     std::uint64_t /*seed*/) {
  return {};
}

}  // namespace prehensile
