#pragma once

#include <functional>
#include <initializer_list>
#include <vector>

#include "Kernel/Scene/BridgeLaws.h"
#include "SelfTests/Restart/ChildRun.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"

namespace pendular::wet {

template <class S>
S boxMaterial(int kind) {
    S species = scenes::boxMaterial<S>(kind);
    species.setLiquidBridgeVolumeMax(kind == 0 ? 2e-12 : 6e-12);
    species.setLiquidBridgeVolumeMin(1e-14);
    species.setDistributionCoefficient(0.8);
    species.setContactAngle(kind == 0 ? 0.1 : 0.3);
    species.setSurfaceTension(0.07);
    if (kind == 1) species.setWallLiquidVolume(1e-13);
    return species;
}

/// The settling box, with films.
template <class S>
class WetBox : public scenes::SettlingBox<S> {
public:
    explicit WetBox(int layers, int threads = 1) : scenes::SettlingBox<S>(layers) {
        for (int kind : {0, 1})
            *this->speciesHandler.getObject(static_cast<std::size_t>(kind)) = boxMaterial<S>(kind);
        for (auto&& grain : this->particleHandler) grain.setLiquidVolume(1e-12 + 1e-15 * grain.getId());
        this->setNumberOfThreads(threads);
        this->setQuiet();
    }
};

template <class Scene>
void runTo(Scene& scene, std::size_t steps) {
    while (scene.getNumberOfTimeSteps() < steps) scene.step();
}

/// Runs Box(3, threads) to the step `end`, with restarts at the steps `middles`; and from one step to another
/// with 1, 2, 3 and 8 threads: the states are the same.
template <class Box>
void expectSameBits(const std::filesystem::path& folder, std::initializer_list<std::size_t> middles,
                    std::size_t end, std::size_t threadsFrom, std::size_t threadsTo) {
    const auto file = [&](const std::string& name) { return folder / (name + ".h5"); };
    {
        Box whole(3);
        whole.initialise();
        for (const std::size_t middle : middles) {
            runTo(whole, middle);
            whole.writeRestart(file(std::to_string(middle)));
        }
        runTo(whole, end);
        whole.writeRestart(file("whole"));
    }
    for (const std::size_t middle : middles) {
        Box restarted(3);
        restarted.restartFrom(file(std::to_string(middle)));
        restarted.initialise();
        EXPECT_EQ(restarted.liquidLedger().unaccounted(), 0);
        restarted.writeRestart(file("again"));
        support::expectSameState(file(std::to_string(middle)), file("again"));
        runTo(restarted, end);
        restarted.writeRestart(file("again"));
        support::expectSameState(file("whole"), file("again"));
    }
    // Few steps with several threads: on a busy machine they spend their time waiting for each other.
    Box one(3);
    one.initialise();
    runTo(one, threadsFrom);
    one.writeRestart(file("start"));
    runTo(one, threadsTo);
    one.writeRestart(file("one"));
    EXPECT_GT(one.liquidLedger().bridges, 0);
    for (const int count : {2, 3, 8}) {
        Box box(3, count);
        box.restartFrom(file("start"));
        box.initialise();
        runTo(box, threadsTo);
        box.writeRestart(file("threads"));
        support::expectSameState(file("one"), file("threads"));
    }
}

/// Grains in a row along x that touch, and are so heavy that no bridge moves them; each but the first is
/// taken to a gap in two steps. Lengths are in r, volumes in r^3.
template <class Law = LiquidMigrationWillett>
class HeavyRow : public scenes::HookedGrains<Species<LinearViscoelastic, NoFriction, Law>> {
public:
    using Material = Species<LinearViscoelastic, NoFriction, Law>;
    using Base = scenes::HookedGrains<Material>;
    static constexpr double r = 1e-3;               // m
    static constexpr double surfaceTension = 0.07;  // N/m
    static constexpr double unitTime = 10;          // s: r over the flux of the tests

    /// @param films of the grains; @param gaps to the next ones, as far as they are apart; @param length of a
    /// step, s
    HeavyRow(const std::vector<double>& films, const std::vector<double>& gaps, double length,
             const std::function<void(HeavyRow&)>& setUp = {})
        : Base(material(), {}, length) {
        double x = 0;
        for (const double film : films) {
            SphericalParticle added = this->grain(r, {x, 0, 0});
            added.setLiquidVolume(film * r * r * r);
            this->particleHandler.copyAndAddObject(added);
            x += 2 * r * (1 - 1e-6);
        }
        this->setQuiet();
        this->hook = [](Base& scene) {
            for (auto&& moved : scene.particleHandler)
                moved.setVelocity(static_cast<HeavyRow&>(scene).speeds[moved.getId()]);
        };
        speeds.assign(films.size(), Vec3D::Zero());
        if (setUp) setUp(*this);
        this->initialise();
        double shift = 0;
        for (std::size_t k = 1; k < films.size(); ++k) {
            if (k <= gaps.size()) shift += gaps[k - 1] * r + 2e-6 * r;
            speeds[k] = {shift / (2 * length), 0, 0};
        }
        if (!gaps.empty()) advance(2);
        speeds.assign(films.size(), Vec3D::Zero());
    }
    void advance(int count = 1) {
        for (int k = 0; k < count; ++k, ++steps) this->step();
    }
    /// The grains from k + 1 on are taken away, until the bridge between k and k + 1 has ruptured, and what
    /// this changes acts.
    void rupture(std::size_t k) {
        for (std::size_t moved = k + 1; moved < speeds.size(); ++moved)
            speeds[moved] = {0.1 * r / this->getTimeStep(), 0, 0};
        while (bridge(k) > 0) advance();
        speeds.assign(speeds.size(), Vec3D::Zero());
        advance();
    }
    [[nodiscard]] double time() const { return this->getTime() / unitTime; }
    [[nodiscard]] double film(std::size_t k) {
        return this->particleHandler.getObject(k).getLiquidVolume() / (r * r * r);
    }
    /// Between k and k + 1.
    [[nodiscard]] double bridge(std::size_t k) const {
        const auto seen = contact(k);
        return seen ? seen->bridgeVolume / (r * r * r) : 0;
    }
    /// N, attraction
    [[nodiscard]] double force(std::size_t k) const {
        const auto seen = contact(k);
        return seen ? seen->adhesiveForce : 0;
    }
    [[nodiscard]] double gap(std::size_t k) const { return contact(k)->separation / r; }

    static Material material() {
        Material species;
        species.setDensity(1e12);
        species.setStiffness(100);
        species.setDissipation(0);
        species.setLiquidBridgeVolumeMax(0.4 * r * r * r);
        species.setContactAngle(0);
        species.setSurfaceTension(surfaceTension);
        return species;
    }

    int steps = 0;

private:
    [[nodiscard]] std::optional<ObservedContact> contact(std::size_t k) const {
        for (const ObservedContact& seen : this->interactions())
            if (seen.particle1 == k) return seen;
        return {};
    }
    std::vector<Vec3D> speeds;
};

}  // namespace pendular::wet
