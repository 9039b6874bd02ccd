/// Whether SVG from a file may stand on a page.
#pragma once

#include <string>
#include <string_view>

namespace prehensile::plot {

/// The first thing in a chart that a chart of this software does not have: an element,
/// an attribute or a value outside the few that charts use, so no script, no style, no
/// reference to anything outside, and no markup that is not well formed. Empty: none.
std::string fault_of_chart(std::string_view svg);

}  // namespace prehensile::plot
