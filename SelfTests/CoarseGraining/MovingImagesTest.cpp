// Fields of scenes whose images move against each other: in shear, and in strain.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "BuildFolders.h"
#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Analysis/Output/BoxFields.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/CubicLattice.h"
#include "SelfTests/Scenes/ShearedCloud.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::movingImagesTest {
namespace {

using scenes::boxMaterial;
using scenes::ShearedCloud;
using support::contentOf;
using support::isOneSentence;
using support::refusal;
using support::rowsOf;
using Sum = FieldSums::Sum;
using V = Vector<double>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

/// Both: sheared, and strained along the gradient and the third axis.
enum class Motion { Sheared, Strained, Both };

/// Wet grains, of which many touch across faces that have slid by a part of the period, or have come nearer.
std::unique_ptr<ShearedCloud<Wet>> cloud(Motion motion, int gradient = 1) {
    const bool isSheared = motion != Motion::Strained;
    const int flow = gradient == 0 ? 1 : 0;
    auto scene =
        std::make_unique<ShearedCloud<Wet>>(isSheared ? std::optional(300.0) : std::nullopt, gradient);
    if (motion != Motion::Sheared)
        for (int axis = 0; axis < 3; ++axis)
            if (!isSheared || axis != flow) scene->setStrainRate(axis, axis == 2 ? 20 : -30);
    scene->setQuiet();
    return scene;
}

FieldGrid gridOver(const PeriodicBox& box, const std::string& coordinates, double spacing) {
    return {coordinates, box.lowest, box.lowest + box.length, spacing};
}

/// Sums at points that are 0.7 w apart: that of a Gauss errs from the integral by 2 exp(-2 pi^2 / 0.49),
/// 1e-17 of it (reference A6). The cut-off of 8 w leaves out e^-32, 1e-14, which the norm gives back.
FieldSums sumsOver(const GrainState& state, const std::string& coordinates, double width, int threads = 1) {
    const FieldGrid grid = gridOver(state.periodic, coordinates, 0.7 * width);
    FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, grid.dimensions(), width, 8 * width));
    sums.add(state, threads);
    return sums;
}

double integral(const FieldSums& sums, std::size_t sum) {
    double total = 0;
    for (std::size_t k = 0; k < sums.grid().size(); ++k) total += sums.ofAll(sum, k);
    return total * sums.grid().volume() / static_cast<double>(sums.grid().size());
}

// Over one period: the mass, and the mean stress of MeanStress.h, which sums over grains and contacts without
// any kernel or image.
TEST(FieldsOfMovingImages, haveTheMassAndTheMeanStressOfTheScene) {
    const std::array<std::size_t, 9> symmetric{0, 1, 2, 1, 3, 4, 2, 4, 5};
    for (const Motion motion : {Motion::Sheared, Motion::Strained, Motion::Both})
        for (const int gradient : {0, 1, 2}) {
            if (motion != Motion::Sheared && gradient > 0) continue;
            const auto scene = cloud(motion, gradient);
            scene->initialise();
            scene->step(1500);
            const MeanStress mean = meanStress(*scene);
            const Eigen::Matrix3d contact = mean.contact + mean.capillary + mean.viscous;
            GrainState state = stateOf(*scene);
            takeFlowAway(state);
            const double volume = state.periodic.length.x * state.periodic.length.y * state.periodic.length.z;
            for (const std::string coordinates : {"O", "X", "Y", "Z", "XY", "YZ", "XYZ"}) {
                const FieldSums sums = sumsOver(state, coordinates, 4e-3, 2);
                // Sums of some 5000 terms in another order, the largest of which are 1e-2 of the sum.
                EXPECT_NEAR(integral(sums, Sum::Mass) / scene->getTotalMass(), 1, 1e-12) << coordinates;
                V momentum{0, 0, 0};
                for (const GrainState::Grain& grain : state.grains) momentum += grain.mass * grain.velocity;
                const double j[] = {momentum.x, momentum.y, momentum.z};
                for (std::size_t a = 0; a < 3; ++a) {
                    EXPECT_NEAR(integral(sums, Sum::Momentum + a), j[a], 1e-12 * scene->getTotalMass());
                    for (std::size_t b = 0; b < 3; ++b) {
                        const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
                        const double stress = integral(sums, Sum::ContactStress + 3 * a + b) / volume;
                        EXPECT_NEAR(stress, contact(row, column), 1e-11 * contact.norm()) << coordinates;
                        const double kinetic = (integral(sums, Sum::Flux + symmetric[3 * a + b]) -
                                                j[a] * j[b] / scene->getTotalMass()) /
                                               volume;
                        EXPECT_NEAR(kinetic, mean.kinetic(row, column), 1e-11 * mean.kinetic.norm());
                    }
                }
            }
        }
}

// Each point against a sum over all images out to several periods, by the definition of the images.
TEST(FieldsOfMovingImages, areSumsOverAllImages) {
    for (const Motion motion : {Motion::Sheared, Motion::Strained, Motion::Both}) {
        const auto scene = cloud(motion);
        scene->initialise();
        scene->step(700);
        const GrainState state = stateOf(*scene);
        const PeriodicBox& box = state.periodic;
        const double w = 2e-3;
        const FieldGrid grid = gridOver(box, "XY", 0.25 * box.length.x);  // the kernel reaches over the faces
        FieldSums sums(grid, SmoothingKernel(KernelShape::Lucy, 2, w));
        sums.add(state);
        ASSERT_GE(grid.size(), 16u);
        for (std::size_t point = 0; point < grid.size(); ++point) {
            const std::size_t along = grid.counts()[1];
            const double x = grid.at(0, point / along), y = grid.at(1, point % along);
            double mass = 0, alongX = 0, alongY = 0;
            for (const GrainState::Grain& grain : state.grains)
                for (int i = -3; i <= 3; ++i)
                    for (int j = -3; j <= 3; ++j) {
                        const V next = box.isSheared() ? box.imageShift : V{0, box.length.y, 0};
                        const V shift = V{i * box.length.x, 0, 0} + static_cast<double>(j) * next;
                        const V place = grain.position + shift;
                        const V velocity = grain.velocity + static_cast<double>(j) * box.imageVelocity +
                                           V{box.strainRate.x * shift.x, box.strainRate.y * shift.y, 0};
                        const double r2 = (place.x - x) * (place.x - x) + (place.y - y) * (place.y - y);
                        const double phi =
                            sums.kernel().value(r2) / box.length.z;  // averaged over the period
                        mass += grain.mass * phi;
                        alongX += grain.mass * velocity.x * phi;
                        alongY += grain.mass * velocity.y * phi;
                    }
            EXPECT_NEAR(sums.ofAll(Sum::Mass, point) / mass, 1, 1e-13);
            EXPECT_NEAR(sums.ofAll(Sum::Momentum, point), alongX, 1e-13 * mass * 10);  // some m/s
            EXPECT_NEAR(sums.ofAll(Sum::Momentum + 1, point), alongY, 1e-13 * mass * 10);
        }
    }
}

/// A lattice of small grains that go along with the flow.
class Lattice : public Simulation<Species<HertzianViscoelastic>> {
public:
    static constexpr int edge = 10;
    static constexpr double spacing = 0x1p-10, rate = 50;  // m, 1/s

    explicit Lattice(Motion motion, int flow, int gradient) {
        const auto* species = speciesHandler.copyAndAddObject(boxMaterial<Species<HertzianViscoelastic>>(0));
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, edge * spacing);
        if (motion != Motion::Strained) setLeesEdwards(flow, gradient, rate);
        for (int k = 0; k < edge * edge * edge; ++k) {
            SphericalParticle grain;
            grain.setSpecies(species), grain.setRadius(0.3 * spacing);
            grain.setPosition(scenes::cellOfCube(k, edge, spacing));
            if (motion != Motion::Strained) grain.setVelocity(shearFlowAt(grain.getPosition()));
            particleHandler.copyAndAddObject(grain);
        }
        if (motion != Motion::Sheared) setStrainRate(gradient, rate);
        setTimeStep(0x1p-20), acceptUnstableTimeStep(), setQuiet();  // there is no contact
    }
};

// Everywhere, also at the faces: the velocity of the flow, and the kinetic stress rho (rate w)^2 that a Gauss
// of the width w makes of it (reference A6, identity 5). On a lattice, whose sums are integrals where its
// spacing is 0.7 w or less, that is exact.
TEST(FieldsOfMovingImages, ofAUniformFlowAreItsClosedForm) {
    for (const Motion motion : {Motion::Sheared, Motion::Strained, Motion::Both})
        for (const auto& [flow, gradient] : {std::pair{0, 1}, std::pair{2, 0}, std::pair{1, 2}}) {
            Lattice scene(motion, flow, gradient);
            scene.initialise();
            scene.step(3000);  // 1.4 of a spacing along the flow, or 15 % longer
            const GrainState state = stateOf(scene);
            const PeriodicBox& box = state.periodic;
            const double length[] = {box.length.x, box.length.y, box.length.z};
            const auto g = static_cast<std::size_t>(gradient);
            const double w = std::max(Lattice::spacing, length[g] / Lattice::edge) / 0.7;
            const double density = scene.getTotalMass() / (length[0] * length[1] * length[2]);
            std::array<double, 3> slopes{};  // 1/s, of each part of the velocity along the gradient
            if (motion != Motion::Strained)  // of the step's own speed, where the length along it has grown
                slopes[static_cast<std::size_t>(flow)] = (&box.imageVelocity.x)[flow] / length[g];
            if (motion != Motion::Sheared) slopes[g] = (&box.strainRate.x)[gradient];
            for (const std::string& coordinates : {std::string(1, "XYZ"[g]), std::string("XYZ")}) {
                const FieldGrid grid = gridOver(box, coordinates, 0.2501 * length[g]);
                FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, grid.dimensions(), w, 8 * w));
                sums.add(state);
                const std::size_t diagonal[] = {0, 3, 5};
                for (std::size_t k = 0; k < grid.size(); ++k) {
                    const auto& n = grid.counts();
                    const std::size_t places[] = {k / (n[1] * n[2]), k / n[2] % n[1], k % n[2]};
                    const double off = grid.at(g, places[g]) - 0.5 * (grid.low(g) + grid.high(g));
                    const double rho = sums.ofAll(Sum::Mass, k);
                    EXPECT_NEAR(rho / density, 1, 1e-12);
                    for (std::size_t along = 0; along < 3; ++along) {
                        const double slope = slopes[along];
                        if (slope == 0) continue;
                        const double j = sums.ofAll(Sum::Momentum + along, k);
                        const double flux = sums.ofAll(Sum::Flux + diagonal[along], k);
                        EXPECT_NEAR(j / rho, slope * off, 1e-12 * slope * length[g]);
                        // The flux is a difference of squares that are up to (length / w)^2 = 50 times as
                        // large; the cut-off takes away 64 e^-32 of the second moment.
                        EXPECT_NEAR((flux - j * j / rho) / (rho * slope * slope * w * w), 1, 1e-10);
                    }
                }
            }
        }
}

// A frame knows how its images move, so that fields of it are those of the run.
TEST(FieldsOfMovingImages, areThoseOfFrames) {
    for (const Motion motion : {Motion::Sheared, Motion::Strained, Motion::Both}) {
        const support::TestFolder folder;
        const auto scene = cloud(motion);
        const std::string name = (folder.path() / "run").string();
        const double step = scene->getTimeStep();
        scene->setName(name);
        scene->setTimeMax(800 * step);
        scene->addOutput(ParaViewOutput().withInterval(800 * step).withDoubles());
        const Vec3D high = Vec3D::Constant(8 * 2.1e-3);
        scene->addOutput(
            FieldOutput(FieldGrid("Y", {0, 0, 0}, toVector(high), 2.1e-3), KernelShape::Gauss, 2e-3)
                .withInterval(800 * step)
                .againstFlow());
        scene->solve();
        std::optional<PeriodicBox> box;
        for (const ParaViewEntry& entry : readParaViewSeries(name + ".pvd"))
            if (entry.kind == "particles") box = boxOf(readPolyData(entry.file));
        ASSERT_TRUE(box);
        const PeriodicBox& now = scene->getPeriodicBox();
        EXPECT_EQ(box->length, now.length);
        EXPECT_EQ(box->imageShift, now.imageShift);
        EXPECT_EQ(box->imageVelocity, now.imageVelocity);
        EXPECT_EQ(box->strainRate, now.strainRate);
        EXPECT_TRUE(box->imagesMove);
        const auto ofRun = rowsOf(contentOf(name + "-coarse.csv"));
        const auto made = support::run(
            (folders::tools / "coarse-grain").string() + " " + name +
            ".pvd --coordinates Y --width-m 2e-3 --spacing-m 2.1e-3 --against-flow --each-frame --box-m "
            "0 0.0168 0 0.0168 0 0.0168");
        ASSERT_EQ(made.exitCode, 0);
        support::expectOneSentence(
            support::run(fmt::format("({} {}.pvd --width-m 2e-3 --periodic-m 0.0168 0.0168 0.0168 2>&1 "
                                     ">/dev/null)",
                                     (folders::tools / "coarse-grain").string(), name)),
            "would put them to rest");
        const auto ofFrames = rowsOf(made.output);
        ASSERT_EQ(ofRun.size(), 16u);
        ASSERT_EQ(ofFrames.size(), 16u);
        for (std::size_t k = 0; k < 16; ++k)
            for (const auto& [column, text] : ofRun[k]) {
                if (text.empty()) continue;
                const double value = std::stod(text);
                double scale = std::abs(value);  // of a tensor, its pressure
                for (const auto& [other, number] : ofRun[k])
                    if (other.substr(0, 12) == column.substr(0, 12) && !number.empty())
                        scale = std::max(scale, std::abs(std::stod(number)));
                EXPECT_NEAR(std::stod(ofFrames[k].at(column)), value, 1e-10 * scale) << column;
            }
    }
}

TEST(FieldsOfMovingImages, haveTheSameBitsForAnyThreads) {
    std::string contents[2];
    for (const int threads : {1, 3}) {
        const support::TestFolder folder;
        const auto scene = cloud(Motion::Sheared);
        scene->setName((folder.path() / "run").string());
        scene->setTimeMax(300 * scene->getTimeStep());
        scene->setNumberOfThreads(threads);
        scene->addOutput(
            FieldOutput(FieldGrid("Y", {0, 0, 0}, {0.0168, 0.0168, 0.0168}, 1e-3), KernelShape::Gauss, 2e-3)
                .withInterval(100 * scene->getTimeStep()));
        scene->solve();
        contents[threads / 2] = contentOf(folder.path() / "run-coarse.csv");
    }
    EXPECT_GT(contents[0].size(), 1000u);
    EXPECT_EQ(contents[0], contents[1]);
}

TEST(FieldsOfMovingImages, areRefusedAroundAnAxis) {
    const auto scene = cloud(Motion::Strained);
    scene->setTimeMax(scene->getTimeStep());
    const FieldGrid around("RZ", {0, 0, 0}, {0.0168, 0.0168, 0.0168}, 1e-3);
    const std::string sentence = refusal([&] {
        scene->addOutput(FieldOutput(around, KernelShape::Gauss, 2e-3).withInterval(1));
        scene->solve();
    });
    EXPECT_TRUE(isOneSentence(sentence)) << sentence;
    EXPECT_NE(sentence.find("around an axis"), sentence.npos) << sentence;
}

}  // namespace
}  // namespace pendular::movingImagesTest
