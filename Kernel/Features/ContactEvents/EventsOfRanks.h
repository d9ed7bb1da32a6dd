#pragma once

#include <vector>

#include "Kernel/Features/ContactEvents/ContactEvents.h"

namespace pendular {

/// The contact events of the last step, and how many there have been, of all ranks; all of them call these
/// together.
std::vector<ContactEvent> eventsOfAll(const ContactEvents& own, const AllRanks& ranks);
ContactEventCounts countsOfAll(const ContactEvents& own, const AllRanks& ranks);

}  // namespace pendular
