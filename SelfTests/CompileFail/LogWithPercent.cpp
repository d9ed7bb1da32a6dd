// expect: a log text has a .. for each value
// MercuryDPM's form, which would show no value. With {} in place of % it compiles.

#include "Kernel/Foundation/Base/Logger.h"

void tell(const pendular::Logger& logger) {
    logger(pendular::LogLevel::Info, "{} grains", 3);
    logger(pendular::LogLevel::Info, "% grains", 3);
}
