#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Kernel/Core/Contacts/OverlapWatch.h"
#include "Kernel/Core/Run/RunWarning.h"
#include "Kernel/Laws/Concepts/DomainLimit.h"

namespace pendular {

class Scene;
class SummaryRows;
struct BrokenLimit;

/// Overlaps beyond those that a law is made for; empty if there were none.
std::optional<RunWarning> overlapWarning(const OverlapWatch& overlaps, const OverlapLimit& limit);
inline constexpr const char* kindOfOverlapWarning = "overlap";

/// Bodies of a scene that a law is not made for, before anything has moved.
RunWarning warningOf(const BrokenLimit& broken);

/// A warning for each domain of a law that the scene has left.
/// @param withMeetingBridges looks for bridges that meet, too: 5 us for each
std::vector<RunWarning> domainWarnings(const Scene& scene, bool withMeetingBridges);

/// All warnings of the scene, as rows of its summary: those that its logger was given, and these.
void addWarningsTo(SummaryRows& rows, const Scene& scene, bool withMeetingBridges);

/// How many bridges of the scene are out of the domain of their law now.
std::size_t bridgesOutOfDomain(const Scene& scene);
/// Whether there may be any.
bool hasBrokenLimits(const Scene& scene);

}  // namespace pendular
