/// Results as OMPL's benchmark logs, which `ompl_benchmark_statistics` reads.
#pragma once

#include <string>

#include "benchmarks/suite/results.h"

namespace prehensile::suite {

/// The log of one family: an experiment of OMPL. Columns of text have no place in it.
std::string ompl_log(const Results& results, int family);

}  // namespace prehensile::suite
