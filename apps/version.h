/// Which program this is.
#pragma once

namespace prehensile::apps {

/// The version of the project and, where it was built from a checkout, the commit in
/// brackets: "0.1.0 (1a2b3c4d5e6f)", with "-modified" where the sources differ from it.
/// Results name it, so that they can be made again.
const char* version();

}  // namespace prehensile::apps
