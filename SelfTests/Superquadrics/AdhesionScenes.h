#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"

// Scenes in which superquadrics attract each other and walls.

namespace pendular::scenes {

/// The half lengths a, a, c (m) of the ellipsoids that are tried.
inline constexpr std::array<std::pair<double, double>, 2> ellipsoids{{{1e-3, 1.5e-3}, {1.5e-3, 1e-3}}};

/// A place of an ellipsoid: how it is turned so that it points upwards, its distance from the centre, and its
/// radius of curvature, Gauss' one.
struct Place {
    Eigen::Quaterniond orientation;
    double height, radius;  // m
};
/// A pole, where both radii are a^2 / c, and a point of the equator, where they are c^2 / a and a.
inline std::array<Place, 2> placesOf(double a, double c) {
    return {Place{Eigen::Quaterniond::Identity(), c, a * a / c},
            Place{turnedBy(0.5 * std::numbers::pi, {1, 0, 0}), a, std::sqrt(c * c / a * a)}};
}

/// A superquadric and a plane above it, apart by a gap (m): the force between them at the start.
/// @param height m, of its highest point above the centre
template <class S>
ObservedContact underPlane(const S& material, const Superquadric& shape,
                           const Eigen::Quaterniond& orientation, double height, double gap) {
    FewSuperquadrics<S> scene(material, {{shape, {0, 0, -height - gap}, {0, 0, 0}, {0, 0, 0}, orientation}},
                              1e-8);
    scene.addPlane({0, 0, 1}, {0, 0, 0});
    if constexpr (S::Adhesion::formsAtContact) scene.joinAtStart(1e-4);
    scene.initialise();
    const auto contacts = scene.interactions();
    EXPECT_EQ(contacts.size(), 1u);
    return contacts.at(0);
}

/// A tilted superquadric flies at a floor, which is a plane or two triangles, sticks for a while and leaves.
template <class S>
struct Bouncing : FewSuperquadrics<S> {
    Bouncing(const S& material, bool mesh)
        : FewSuperquadrics<S>(material,
                              {{{1e-3, 1.4e-3, 0.8e-3, 3, 3},
                                {0.1e-3, 0.2e-3, 1.25e-3},
                                {0.02, 0, -0.2},
                                {5, 0, 3},
                                turnedBy(0.5, {1, 2, 0})}},
                              1e-6) {
        if (!mesh) {
            this->addPlane({0, 0, -1}, {0, 0, 0});
            return;
        }
        constexpr double w = 5e-3;
        const Triangle one{{{-w, -w, 0}, {w, -w, 0}, {w, w, 0}}}, two{{{-w, -w, 0}, {w, w, 0}, {-w, w, 0}}};
        const std::vector<Triangle> triangles{one, two};
        TriangleWall floor;
        floor.setSpecies(this->speciesHandler.getObject(0));
        floor.set(triangles);
        this->wallHandler.copyAndAddObject(floor);
    }
};
/// Where the ball of its search touches is exact to some 1e-12 of the size, and so are paths.
template <class S>
void expectMeshAsPlane(const S& material) {
    Bouncing<S> plane(material, false), mesh(material, true);
    plane.initialise(), mesh.initialise();
    int apart = 0;
    for (int k = 0; k < 2500; ++k) {
        plane.step(), mesh.step();
        const auto expected = plane.interactions(), found = mesh.interactions();
        ASSERT_EQ(found.size(), expected.size()) << k;
        if (!expected.empty() && expected[0].separation > 0) ++apart;
    }
    EXPECT_GT(apart, 5);
    const Vec3D way = plane.body(0).getPosition() - mesh.body(0).getPosition();
    EXPECT_LT(way.norm(), 1e-9);
}

/// Steps until something attracts bodies that are apart.
template <class Scene>
int stepsToGap(Scene& scene) {
    for (int steps = 0; steps < 20000; steps += 10) {
        for (const ObservedContact& contact : scene.interactions())
            if (contact.separation > 0) return steps;
        for (int k = 0; k < 10; ++k) scene.step();
    }
    ADD_FAILURE() << "nothing attracts";
    return 20000;
}

}  // namespace pendular::scenes
