// expect: a text of MercuryScene's logger has one . for each value
// A % is missing: a value would not be shown.

#include "Kernel/MercuryScene.h"

void tell() {
    logger(INFO, "% grains of % kg", 3, 0.5);
    logger(INFO, "% grains of kg", 3, 0.5);
}
