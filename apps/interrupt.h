/// How a user stops a long command.
#pragma once

#include <atomic>

namespace prehensile::apps {

/// From now on the first Ctrl-C (SIGINT) or SIGTERM sets what this returns, for work that
/// ends with what it has; a second one ends the program.
const std::atomic<bool>& stop_on_signals();

}  // namespace prehensile::apps
