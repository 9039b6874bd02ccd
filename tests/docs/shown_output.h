/// Whether what a program prints is what a page shows.
///
///   words     letter by letter; runs of blanks count as one
///   numbers   to a thousandth, or to one in the last digit shown
///   rests     of iterations: both below 1e-6 is enough
///   times     a number before `ms`, `us` or `min` is not compared, nor is the last
///   column
///             of a table whose head ends with `time us`
///   progress  lines of it come and go with the load: left out
///   ...       a line of three dots stands for any number of lines
#pragma once

#include <string>

namespace prehensile::testing {

/// What was printed, without lines of progress.
std::string without_progress(const std::string& printed);

/// The first difference; empty if there is none.
std::string difference(const std::string& shown, const std::string& printed);

}  // namespace prehensile::testing
