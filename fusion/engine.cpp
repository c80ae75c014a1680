#include "fusion/engine.h"
#include "fusion/ring.h"
#include "fusion/uwb/solve.h"
