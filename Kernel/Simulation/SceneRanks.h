#pragma once

namespace pendular {

/// Throws InputError: counts of events and the accounts of liquid are those of each rank, and nothing adds
/// them up yet where grains are gathered.
[[noreturn]] void refuseToGather();

}  // namespace pendular
