/// Independent pieces of work on several cores.
#pragma once

#include <functional>

namespace prehensile::apps {

/// Threads to use: `asked`, or one per core of this machine if 0.
int number_of_jobs(int asked);

/// Calls work(i) for every i in [0, count), on `jobs` threads. The order is not fixed, so
/// each call may write to its own place only. An exception is thrown again here: that of
/// the smallest i that failed; later pieces of work may then be left out.
void for_each_index(int count, int jobs, const std::function<void(int)>& work);

}  // namespace prehensile::apps
