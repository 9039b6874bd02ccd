/// Work without an end, for the tests that ask for one move or one search.
#pragma once

#include <cstdint>
#include <limits>

namespace prehensile::testing {

inline constexpr std::int64_t kNoBudget = std::numeric_limits<std::int64_t>::max();

}  // namespace prehensile::testing
