/// Random numbers of the problem sets.
#pragma once

#include "planner/random_stream.h"
