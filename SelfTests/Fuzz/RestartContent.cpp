#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Fuzz/EditedState.h"
#include "SelfTests/Fuzz/Target.h"
#include "SelfTests/Scenes/SettlingBox.h"

namespace pendular::fuzz {

namespace {

/// A scene with something in nearly every table: histories, torques, bridges, an account of the energy, a
/// mesh that turns and keeps its force, a periodic direction.
class Scene
    : public scenes::SettlingBox<Species<HertzianViscoelastic, MindlinRollingTorsion, LiquidBridgeBagheri>> {
public:
    Scene() : SettlingBox(1) {
        keepEnergyLedger();
        setPeriodic(0, -0.5, 0.5);
        TriangleWall paddle;
        paddle.setSpecies(speciesHandler.getObject(0));
        const double height = 5e-5;  // m: below the lowest grains
        paddle.set(
            std::vector<Triangle>{{{{0, 0, height}, {width, 0, height}, {0, width, 2 * height}}},
                                  {{{width, width, height}, {width, 0, height}, {0, width, 2 * height}}}});
        paddle.setAngularVelocity({0, 0, 5}, {0.5 * width, 0.5 * width, height});
        wallHandler.copyAndAddObject(paddle)->keepForces();
    }
    void visitState(StateArchive& archive) override { archive.value("stopped", stopped); }

private:
    bool stopped = false;
};

constexpr int stepsBefore = 400, stepsAfter = 12;

/// Written once; the scene that wrote it has contacts that touch, and bridges.
const EditedState& goodState(const std::filesystem::path& folder) {
    static const EditedState state = [&] {
        Scene scene;
        scene.initialise();
        for (int k = 0; k < stepsBefore; ++k) scene.step();
        const std::filesystem::path path = folder / "good.h5";
        scene.writeRestart(path);
        return EditedState(path);
    }();
    return state;
}

/// The scene goes on for some steps, through a new list of contacts, or ends with a RunError.
void goOnFrom(const std::filesystem::path& path) {
    Scene scene;
    scene.restartFrom(path);
    scene.initialise();
    try {
        for (int k = 0; k < stepsAfter; ++k) scene.step();
    } catch (const RunError&) {}
}

}  // namespace

/// A restart file with the right checksum and a content that was edited: the bytes say how (EditedState).
Target restartContent() {
    return {"RestartContent", [] { return EditedState::eachEdit(80, 9); },
            [](std::string_view bytes) {
                static const support::TestFolder folder = support::TestFolder::inMemory();
                EditedState state = goodState(folder.path());
                state.edit(bytes);
                const std::filesystem::path path = folder.path() / "edited.h5";
                state.write(path);
                sealRestartFile(path);
                try {
                    goOnFrom(path);
                    return true;
                } catch (const InputError&) {
                    return false;
                }
            }};
}

}  // namespace pendular::fuzz
