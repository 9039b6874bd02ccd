/// Random numbers of the problem sets.
#pragma once

#include "planner/baselines/random_stream.h"
