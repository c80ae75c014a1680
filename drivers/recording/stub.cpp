#include "drivers/recording/log_line.h"
#include "drivers/recording/measurement_json.h"
