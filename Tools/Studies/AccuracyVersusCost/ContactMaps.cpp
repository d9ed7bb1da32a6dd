#include "Tools/Studies/AccuracyVersusCost/ContactMaps.h"

#include "Tools/Studies/AccuracyVersusCost/AttractionMap.h"
#include "Tools/Studies/AccuracyVersusCost/ImpactSpeedMap.h"
#include "Tools/Studies/AccuracyVersusCost/RestitutionMap.h"
#include "Tools/Studies/AccuracyVersusCost/SlidingOnsetMap.h"

namespace pendular {

void mapContacts(const ContactMapOptions& options) {
    checkValue("accuracy-versus-cost", "map-offsets", options.offsets, "", {1, 1e6});
    std::error_code problem;
    std::filesystem::create_directories(options.folder, problem);
    if (problem)
        throw InputError(fmt::format("accuracy-versus-cost: cannot make the folder {}: {}.",
                                     options.folder.string(), problem.message()));
    mapRestitution(options.folder / "restitution.csv", options.offsets);
    mapAttraction(options.folder / "normal-force.csv", options.folder / "attraction.csv");
    mapSlidingOnset(options.folder / "sliding-onset.csv");
    mapImpactSpeed(options.folder / "impact-speed.csv");
}

}  // namespace pendular
