#include "Kernel/Features/MovingWalls/PlaneDrive.h"

#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

void PlaneDrive::visitState(StateArchive& archive) {
    auto kind = static_cast<std::uint32_t>(asked.kind);
    archive.value("kind", kind);
    archive.require(kind <= static_cast<std::uint32_t>(PlaneDriveSettings::Kind::Servo), "kind",
                    "is none that there is");
    asked.kind = static_cast<PlaneDriveSettings::Kind>(kind);
    archive.finite("load", asked.load);
    archive.finite("mass", asked.mass);
    archive.require(!isPiston() || asked.mass > 0, "mass", "is not positive");
    archive.finite("time", asked.time);
    archive.finite("largestSpeed", asked.largestSpeed);
    archive.require(!isServo() || (asked.time > 0 && asked.largestSpeed > 0), "time",
                    "or the largest speed is not positive");
    archive.finite("velocity", velocity);
    archive.finite("earlier", earlier);
    servo.visitState(archive);
    archive.value("steps", steps);
    archive.value("touches", touches);
    archive.finite("travelled", travelled);
    archive.finite("farthest", farthest);
    archive.value("mostTouches", mostTouches);
}

}  // namespace pendular
