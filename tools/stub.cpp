#include "tools/command.h"
