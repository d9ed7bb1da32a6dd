/// Ellipsoids, or sharper superquadrics, fall on a floor: how densely they pack and how many neighbours they
/// have, over their aspect ratio.

#include "Drivers/EllipsoidPacking/EllipsoidBed.h"
#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Kernel/Foundation/Files/CsvFile.h"

using namespace pendular;

namespace {

struct Options {
    std::vector<double> aspects{0.5, 0.7, 0.85, 1, 1.2, 1.5, 2};
    EllipsoidBedOptions bed;
};

/// Before the first of them runs: a body must not be wider than half a period.
void check(const Options& o) {
    checkNumberOfGrains("EllipsoidPacking", o.bed.number);
    checkValue("EllipsoidPacking", "--exponent", o.bed.exponent, "",
               {Superquadric::smallestExponent, Superquadric::largestExponent});
    for (const double aspect : o.aspects) {
        checkValue("EllipsoidPacking", "--aspects", aspect, "", {0.1, 10});
        checkValue("EllipsoidPacking", "--width", o.bed.width, "diameters",
                   {2 * cellOfEllipsoids(o.bed, aspect) / o.bed.diameter, 1000});
    }
}

void run(const Options& o) {
    CsvFile table(
        o.bed.run.output + "/packing.csv",
        "aspect_ratio,exponent,grains_in_layer,solid_fraction,contacts_of_a_grain,largest_overlap_over_d,"
        "fallbacks,time_s,kinetic_energy_over_mgd");
    for (const double aspect : o.aspects) {
        EllipsoidBed bed(o.bed, aspect);
        bed.solve();
        const EllipsoidBed::Middle middle = bed.middle();
        table.row(aspect, o.bed.exponent, middle.grains, middle.solidFraction, middle.contacts,
                  middle.largestOverlap, bed.superquadricHandler.fallbacks(), bed.getTime(),
                  bed.restlessness());
        if (o.bed.run.quiet) continue;
        fmt::print("aspect ratio {:g}: solid fraction {:.4f}, {:.2f} contacts\n", aspect,
                   middle.solidFraction, middle.contacts);
        if (bed.continueSolve()) fmt::print("  not at rest yet: give a later --end-time-s\n");
    }
    table.close();
    if (!o.bed.run.quiet) fmt::print("Wrote {}/packing.csv\n", o.bed.run.output);
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "EllipsoidPacking",
        .description = "Ellipsoids fall on a floor: solid fraction and contacts over the aspect ratio.",
        .options = o.bed.run,
        .addOptions =
            [&](CLI::App& app) {
                app.option_defaults()->always_capture_default();
                app.add_option("--aspects", o.aspects,
                               "length along the axis over that across it, one run for each")
                    ->expected(1, 100);
                app.add_option("--exponent", o.bed.exponent,
                               "of the shape, from 2 (ellipsoids) to 8 (blocks with rounded edges)");
                addRunOptionsOfSeveral(app, o.bed.run, "packing.csv", "aspect-RATIO");
            },
        .numbers = {
            {"number", "", &o.bed.number, {1, 1e6}, "of grains in each bed"},
            {"diameter", "m", &o.bed.diameter, {1e-4, 0.1}, "of a sphere of a grain's volume"},
            {"width", "", &o.bed.width, {2.01, 1000}, "of the box, which repeats itself, over --diameter-m"},
            {"friction", "", &o.bed.friction, {0, 10}, "coefficient of friction of grains and floor"},
            {"stiffness", "", &o.bed.stiffness, {1e3, 1e8}, "of a contact, over weight / --diameter-m"},
            {"end-time", "s", &o.bed.endTime, positive, "end of each run, if the grains do not rest before"},
            {"seed", "", &o.bed.seed, {0, 1e9}, "of the sizes and directions with which grains fall"}}};
    return runDriver(driver, argc, argv, [&] {
        check(o);
        run(o);
    });
}
