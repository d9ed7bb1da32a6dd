#include <array>

#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Scene/SuperquadricSimulation.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct ShapesInAndOut : SuperquadricSimulation<HertzianViscoelasticMindlinSpecies> {
    void setupInitialConditions() override {
        auto material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500);
        material->setEffectiveElasticModulusAndRestitutionCoefficient(3e5, 0.5);
        material->setEffectiveShearModulus(1e5);
        material->setSlidingFrictionCoefficient(0.4);
        // [snippet]
        SuperquadricGrain lens({1e-3, 1e-3, 0.5e-3, 2, 2});  // any size: the inlet scales it
        lens.setSpecies(material);
        lens.setVelocity({0, 0, -1});  // m/s
        Inlet inlet;
        inlet.setRegion(BoxRegion({-0.005, -0.005, 0.006}, {0.005, 0.005, 0.01}));  // m
        inlet.setSizes(evenSizes(1e-3, 1.4e-3));  // diameters of spheres of their volume, m
        inlet.setSuperquadric(lens);
        inlet.setMassFlow(0.02);  // kg/s
        inletHandler.copyAndAddObject(inlet);
        TriangleWall chute;  // from two triangles, or read() a file
        const Vector<double> a{-0.01, -0.01, 8e-3}, b{0.01, -0.01, -8e-3}, c{0.01, 0.01, -8e-3},
            d{-0.01, 0.01, 8e-3};
        chute.set(std::array<Triangle, 2>{Triangle{a, b, c}, Triangle{a, c, d}});
        chute.setSpecies(material);
        wallHandler.copyAndAddObject(chute);
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, -0.01});
        outletHandler.copyAndAddObject(outlet);
        const FieldGrid heights("Z", {-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}, 1e-3);
        addOutput(FieldOutput(heights, KernelShape::Gauss, 1e-3).withInterval(1e-3));
        setTimeStep(0.5 * stabilityLimit());  // that of the lenses to come
        // [end]
        setName("chute");
        setGravity({0, 0, -9.81});
        setTimeMax(0.04);
    }
};

TEST_F(HowDoI, ShapesInAndOut) {
    ShapesInAndOut scene;
    run(scene);
    EXPECT_GT(scene.outletHandler.removedNumber(), 10u);
    EXPECT_EQ(scene.inletHandler.countOf(0).number,
              scene.outletHandler.removedNumber() + scene.bodyHandler.getSize());
    EXPECT_TRUE(std::filesystem::exists("chute-coarse.csv"));
}

}  // namespace
