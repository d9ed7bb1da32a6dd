#include "Kernel/Features/RigidBodies/ClumpTemplate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Features/RigidBodies/UnionOfSpheres.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Kernel/Foundation/Math/SymmetricMatrix.h"

namespace pendular {

PrincipalAxes principalAxes(const Eigen::Matrix3d& inertia) {
    const double size = inertia.cwiseAbs().maxCoeff();
    constexpr double roundOff = 1e-9;  // of what a user computes
    if (!inertia.allFinite() || (inertia - inertia.transpose()).cwiseAbs().maxCoeff() > roundOff * size)
        throw InputError("The inertia of a rigid body must be a finite symmetric matrix (kg m^2).");
    auto [moments, axes] = eigenSystem(inertia);
    if (!(moments[0] > 0) || moments[0] + moments[1] < (1 - roundOff) * moments[2])
        throw InputError(
            fmt::format("The principal moments of inertia of a rigid body are {:.6g}, {:.6g}, {:.6g} kg m^2; "
                        "they must be "
                        "positive, and the largest at most the sum of the others.",
                        moments[0], moments[1], moments[2]));
    if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
    return {moments, Eigen::Quaterniond(axes).normalized()};
}

ClumpTemplate::ClumpTemplate(std::vector<Ball> all)
    : spheres(std::move(all)), solid(unionOfSpheres(spheres)), isOwnUnion(true) {
    if (isSphere()) {  // exactly
        solid.volume = sphereMass(spheres[0].radius, 1);
        solid.centre = spheres[0].centre;
        solid.inertia =
            0.4 * solid.volume * spheres[0].radius * spheres[0].radius * Eigen::Matrix3d::Identity();
    }
    checkValue("ClumpTemplate", "volume", solid.volume, "m^3", positive);  // spheres may be too small for one
    finish(solid.centre);
}

ClumpTemplate::ClumpTemplate(std::vector<Ball> all, const MassProperties& of)
    : spheres(std::move(all)), solid(of) {
    static_cast<void>(unionOfSpheres(spheres, 1e-2));  // throws where they are no spheres
    checkValue("ClumpTemplate", "volume", solid.volume, "m^3", positive);
    for (const double part : solid.centre) checkValue("ClumpTemplate", "centre", part, "m", anyFinite);
    static_cast<void>(principalAxes(solid.inertia));
    finish(solid.centre);
}

ClumpTemplate::ClumpTemplate(std::vector<Ball> all, const BodyMass& mass)
    : spheres(std::move(all)), solid(unionOfSpheres(spheres, 1e-6)), given(mass) {
    checkValue("ClumpTemplate", "mass", mass.mass, "kg", positive);
    for (const double part : mass.centre) checkValue("ClumpTemplate", "centre", part, "m", anyFinite);
    static_cast<void>(principalAxes(mass.inertia));
    finish(mass.centre);
}

std::vector<Ball> readSpheres(const std::filesystem::path& path, double scale) {
    checkValue("readSpheres()", "scale", scale, "", positive);
    const InputFile file = loadTextFile("sphere file", path);
    std::vector<Ball> spheres;
    forEachRow(file, scale, [&](std::size_t line, const std::vector<double>& row) {
        if (row.size() != 4)
            file.refuse("line", line, fmt::format("{} numbers, and not the four x y z radius", row.size()));
        if (!(row[3] > 0)) file.refuse("line", line, "the radius is not positive");
        spheres.push_back({{row[0], row[1], row[2]}, row[3]});
    });
    if (spheres.empty()) file.refuse("has no spheres");
    return spheres;
}

void ClumpTemplate::finish(const Vec3D& centreOfMass) {
    exposed = exposedShares(spheres);
    for (Ball& ball : spheres) {
        ball.centre -= centreOfMass;
        reach = std::max(reach, ball.centre.norm() + ball.radius);
    }
}

double ClumpTemplate::getDiameter() const { return std::cbrt(6 / std::numbers::pi * solid.volume); }

BodyMass ClumpTemplate::massOf(double density, double scale) const {
    const double cube = scale * scale * scale;
    if (given) return {cube * given->mass, Vec3D::Zero(), cube * scale * scale * given->inertia};
    return {density * cube * solid.volume, Vec3D::Zero(), density * cube * scale * scale * solid.inertia};
}

void Clump::setScale(double scale) {
    checkValue("Clump", "scale", scale, "", positive);
    scaleValue = scale;
}

void Clump::setOrientation(const Eigen::Quaterniond& orientation) {
    checkValue("Clump", "length of the orientation", orientation.norm(), "", positive);
    orientationValue = orientation.normalized();
}

std::vector<SphericalParticle> Clump::getSpheres() const {
    std::vector<SphericalParticle> all;
    const Eigen::Matrix3d turn = orientationValue.toRotationMatrix();
    for (const Ball& ball : shapeValue.getSpheres()) {
        SphericalParticle sphere = like;
        const Vec3D arm = scaleValue * (turn * ball.centre);
        sphere.setRadius(scaleValue * ball.radius);
        sphere.setPosition(getPosition() + arm);
        sphere.setVelocity(getVelocity() + getAngularVelocity().cross(arm));
        all.push_back(sphere);
    }
    return all;
}

}  // namespace pendular
