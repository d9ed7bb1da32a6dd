/// Rods fall on a floor: how densely they pack and how many neighbours they have, over their aspect ratio.

#include "Drivers/RodPacking/RodBed.h"
#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Kernel/Foundation/Files/CsvFile.h"

using namespace pendular;

namespace {

struct Options {
    std::vector<double> aspects{1, 1.4, 2, 3};
    RodBedOptions bed;
};

/// Before the first of them runs: a body must not be wider than half a period.
void check(const Options& o) {
    checkNumberOfGrains("RodPacking", o.bed.number);
    for (const double aspect : o.aspects) {
        checkValue("RodPacking", "--aspects", aspect, "", {1, 20});
        const double length = aspect / rodOf(aspect, o.bed.spacing).getDiameter();  // d
        checkValue("RodPacking", "--width", o.bed.width, "diameters", {2.5 * length, 1000});
    }
}

void run(const Options& o) {
    CsvFile table(
        o.bed.run.output + "/packing.csv",
        "aspect_ratio,spheres_of_a_rod,rod_diameter_m,rods_in_layer,solid_fraction,neighbours_of_a_rod,"
        "contacts_of_a_rod,order_to_vertical,time_s,kinetic_energy_over_mgd");
    for (const double aspect : o.aspects) {
        RodBed bed(o.bed, aspect);
        bed.solve();
        const RodBed::Layer layer = bed.middle();
        const RodBed::Means means = bed.meansOf(layer);
        const double fraction = bed.solidFraction(layer), motion = bed.restlessness();
        table.row(aspect, bed.spheresOfRod(), bed.rodDiameter(), means.rods, fraction, means.neighbours,
                  means.contacts, means.order, bed.getTime(), motion);
        if (o.bed.run.quiet) continue;
        fmt::print("aspect ratio {:g}: solid fraction {:.4f}, {:.2f} neighbours, order {:.3f}\n", aspect,
                   fraction, means.neighbours, means.order);
        if (bed.continueSolve()) fmt::print("  not at rest yet: give a later --end-time-s\n");
    }
    table.close();
    if (!o.bed.run.quiet) fmt::print("Wrote {}/packing.csv\n", o.bed.run.output);
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "RodPacking",
        .description =
            "Rods of spheres fall on a floor: solid fraction and neighbours over the aspect ratio.",
        .options = o.bed.run,
        .addOptions =
            [&](CLI::App& app) {
                app.option_defaults()->always_capture_default();
                app.add_option("--aspects", o.aspects, "length over diameter of the rods, one run for each")
                    ->expected(1, 100);
                addRunOptionsOfSeveral(app, o.bed.run, "packing.csv", "aspect-RATIO");
            },
        .numbers = {
            {"number", "", &o.bed.number, {1, 1e6}, "of rods in each bed"},
            {"diameter", "m", &o.bed.diameter, {1e-4, 0.1}, "of a sphere of a rod's volume"},
            {"width", "", &o.bed.width, {2.01, 1000}, "of the box, which repeats itself, over --diameter-m"},
            {"spacing", "", &o.bed.spacing, {0.05, 1}, "of the spheres of a rod, at most, over its diameter"},
            {"friction", "", &o.bed.friction, {0, 10}, "coefficient of friction of rods and floor"},
            {"stiffness", "", &o.bed.stiffness, {1e3, 1e8}, "of a contact, over weight / --diameter-m"},
            {"end-time", "s", &o.bed.endTime, positive, "end of each run, if the rods do not rest before"},
            {"seed", "", &o.bed.seed, {0, 1e9}, "of the places and directions from which rods fall"}}};
    return runDriver(driver, argc, argv, [&] {
        check(o);
        run(o);
    });
}
