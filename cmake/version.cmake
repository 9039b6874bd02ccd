# Writes the source of apps/version.h, anew only where it changed: the version of the project and,
# in a checkout, the commit that is built. Run by the build with -DSOURCE, -DVERSION, -DOUTPUT.
execute_process(
  COMMAND git describe --always --dirty=-modified --abbrev=12 --exclude=*
  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
  RESULT_VARIABLE failed ERROR_QUIET)
set(text ${VERSION})
# A source tree without its history may lie inside another project's checkout.
if(NOT failed AND EXISTS ${SOURCE}/.git)
  string(APPEND text " (${commit})")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[#include "apps/version.h"

namespace prehensile::apps {

const char* version() { return "@text@"; }

}  // namespace prehensile::apps
]] @ONLY)
