// Writes runs that the tests of `view` look at, by the kernel's own writers.
//
// ViewFrames picture FOLDER: a frame with grains, a bridge, a shape, a droplet and a mesh of known places
//
// ViewFrames hdf5 FOLDER: the same, but for the shape, as an HDF5 frame
//
// ViewFrames fields FOLDER: fields of one grain at two times, in one, two and three directions
//
// ViewFrames damaged FOLDER KIND: a frame as no run writes it: lines (contacts without ends), ends
// (a contact with four), identity (of nine numbers)
//
// ViewFrames outside FOLDER END: a run as a driver outside of the repository makes it, with a name and an
// output and no RunSummary; it ends, fails, is killed, or is warned of a density (ends, fails, killed,
// warned)
//
// ViewFrames lattice FOLDER N BRIDGES FRAMES: N grains in a lattice, with about so many bridges

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <string>
#include <utility>

#include "Kernel/Analysis/CoarseGraining/FieldFiles.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Scene/Simulation.h"

using namespace pendular;

namespace {

using Floats = std::vector<float>;
using Wholes = std::vector<std::int32_t>;
using Place = Vector<double>;

struct Bridge {
    std::size_t first, second;
    double volume;  // m^3
};

PolyData grainsOf(const std::vector<Place>& places, const Floats& radii, const Floats& values) {
    PolyData data;
    data.points = places;
    Floats velocity;
    Wholes identity;
    for (std::size_t k = 0; k < places.size(); ++k) {
        data.corners.push_back(static_cast<std::int32_t>(k));
        data.ends.push_back(static_cast<std::int32_t>(k + 1));
        identity.push_back(static_cast<std::int32_t>(100 + k));
        velocity.insert(velocity.end(), {0, 0, values[k]});
    }
    data.pointFields = {{"radius_m", 1, radii}, {"velocity_m_per_s", 3, velocity}, {"identity", 1, identity}};
    return data;
}

PolyData contactsOf(const PolyData& grains, const std::vector<Bridge>& bridges) {
    PolyData data;
    data.kind = PolyData::Cells::Lines;
    Floats volume, overlap, force;
    Wholes bridged, first, second, wall;
    for (const Bridge& bridge : bridges) {
        for (const std::size_t end : {bridge.first, bridge.second}) {
            data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
            data.points.push_back(grains.points[end]);
        }
        data.ends.push_back(static_cast<std::int32_t>(data.corners.size()));
        const double apart = norm(grains.points[bridge.first] - grains.points[bridge.second]);
        const PolyDataField& radii = grains.pointFields[0];
        overlap.push_back(static_cast<float>(radii.at(bridge.first) + radii.at(bridge.second) - apart));
        volume.push_back(static_cast<float>(bridge.volume)), bridged.push_back(1), wall.push_back(-1);
        first.push_back(static_cast<std::int32_t>(100 + bridge.first));
        second.push_back(static_cast<std::int32_t>(100 + bridge.second));
        force.insert(force.end(), {1e-4F, 0, 0});
    }
    data.cellFields = {{"force_N", 3, force},   {"overlap_m", 1, overlap},
                       {"bridged", 1, bridged}, {"bridge_volume_m3", 1, volume},
                       {"particle1", 1, first}, {"particle2", 1, second},
                       {"wall", 1, wall}};
    return data;
}

/// A cube about a place.
PolyData cube(const Place& at, double half, std::int32_t identity) {
    PolyData data;
    data.kind = PolyData::Cells::Polygons;
    for (int k = 0; k < 8; ++k)
        data.points.push_back(at + Place{k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half});
    Wholes identities;
    for (const auto& side :
         {Wholes{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        data.corners.insert(data.corners.end(), side.begin(), side.end());
        data.ends.push_back(static_cast<std::int32_t>(data.corners.size()));
        identities.push_back(identity);
    }
    data.cellFields = {{"identity", 1, identities}};
    return data;
}

/// Of two halves, the right one worn.
PolyData square(double half, double z) {
    PolyData data;
    data.kind = PolyData::Cells::Polygons;
    for (const double left : {-half, 0.0}) {
        for (const Place& corner :
             {Place{left, -half, z}, {left + half, -half, z}, {left + half, half, z}, {left, half, z}}) {
            data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
            data.points.push_back(corner);
        }
        data.ends.push_back(static_cast<std::int32_t>(data.corners.size()));
    }
    data.cellFields = {{"wall", 1, Wholes{0, 0}}, {"wear_depth_m", 1, std::vector<double>{0, 2e-6}}};
    return data;
}

void writeSummary(const std::string& name, std::size_t grains, double time) {
    CsvFile file(name + "-summary.csv", "quantity,value,unit");
    file.row("state", "at its end", ""), file.row("time", time, "s"), file.row("end time", time, "s");
    file.row("grains", grains, ""), file.row("kinetic energy", 0, "J"), file.row("largest speed", 1, "m/s");
    file.close();
}

/// Nine grains of 1 mm in a square in the plane y = 0, whose speeds are 0 to 8 m/s; a clump of two that
/// overlap, a grain that is a cube for ParaView; a bridge between the first two; a small grain hidden behind
/// the fifth; a droplet; a floor.
SceneFrame picture() {
    std::vector<Place> places;
    Floats radii, speeds;
    const auto add = [&](const Place& place, float radius, float speed) {
        places.push_back(place), radii.push_back(radius), speeds.push_back(speed);
    };
    for (int k = 0; k < 9; ++k)
        add({3e-3 * (k % 3 - 1), 0, 3e-3 * (k / 3 - 1)}, 1e-3F, static_cast<float>(k));
    add({0, 4e-3, 0}, 5e-4F, 8), add({6e-3, 0, 0}, 1e-3F, 2), add({6e-3, 0, 1.2e-3}, 1e-3F, 2);
    add({-6e-3, 0, 0}, 1.5e-3F, 6);
    SceneFrame frame;
    frame.grains = grainsOf(places, radii, speeds);
    frame.contacts = contactsOf(frame.grains, {{0, 1, 1e-10}});
    frame.walls = square(8e-3, -5e-3);
    frame.shapes = cube({-6e-3, 0, 0}, 8e-4, 112);
    frame.droplets.emplace();
    frame.droplets->points = {{1.5e-3, 0, 1.5e-3}};
    frame.droplets->corners = {0}, frame.droplets->ends = {1};
    frame.droplets->pointFields = {{"radius_m", 1, Floats{3e-4F}}};
    return frame;
}

void writePicture(const std::string& name) {
    const SceneFrame frame = picture();
    ParaViewFrames(name, -INFINITY).add(frame, 1);
    writeSummary(name, frame.grains.points.size(), 0);
}

void writeHdf5Picture(const std::string& name) {
    SceneFrame frame = picture();
    Hdf5Frames series(name, -INFINITY);
    for (frame.step = 0; frame.step < 2; ++frame.step) frame.time = 0.5 * frame.step, series.add(frame, 1);
    writeSummary(name, frame.grains.points.size(), 0.5);
}

/// A grain of 1 g in the middle of a box of 20 mm; after 0.1 s it goes up with 2 m/s. The kernel has a width
/// of 3 mm, and points are 2 mm apart.
void writeFields(const std::string& name) {
    const auto sumsOf = [](std::string_view coordinates, double speed) {
        const FieldGrid grid(coordinates, {0, 0, 0}, {0.02, 0.02, 0.02}, 2e-3);
        FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, grid.dimensions(), 3e-3));
        GrainState state;
        state.grains.push_back({{0.011, 0.009, 0.007}, {0, 0, speed}, 1e-3, 1e-3});
        sums.add(state);
        return sums;
    };
    ParaViewSeries plane(name + "-coarse", -INFINITY, ".vti");
    Hdf5Series space(name + "-space", -INFINITY);
    CsvFile table(name + "-line.csv", headerOf(sumsOf("Z", 0)));
    for (const std::uint64_t step : {0, 100}) {
        const double time = 1e-3 * static_cast<double>(step), speed = step > 0 ? 2 : 0;
        writeImage(plane.add("fields", time, step), sumsOf("XZ", speed), time);
        writeHdf5(space.fileOf(step), sumsOf("XYZ", speed), time, step);
        space.add(step, time);
        forEachRow(sumsOf("Z", speed), time, [&](const std::string& row) { table.row(row); });
    }
    plane.write(), table.close();
    writeSummary(name, 1, 0.1);
}

/// Two grains, and what would be read or written out of bounds if it were trusted.
void writeDamaged(const std::string& name, const std::string& kind) {
    ParaViewSeries series(name, -INFINITY);
    PolyData grains = grainsOf({{0, 0, 0}, {2e-3, 0, 0}, {4e-3, 0, 0}}, Floats(3, 1e-3F), Floats(3, 0));
    PolyData contacts = contactsOf(grains, {{0, 1, 1e-10}, {1, 2, 1e-10}, {0, 2, 1e-10}});
    if (kind == "lines") contacts.corners.clear(), contacts.ends.assign(3, 0);
    if (kind == "ends") contacts.ends = {0, 2, 6};
    if (kind == "identity") {
        Wholes nine(27);
        for (std::size_t k = 0; k < nine.size(); ++k) nine[k] = static_cast<std::int32_t>(k);
        grains.pointFields[2] = {"identity", 9, nine};
    }
    writePolyData(series.add("particles", 0, 0), grains);
    writePolyData(series.add("contacts", 0, 0), contacts);
    writePolyData(series.add("shapes", 0, 0), cube({0, 0, 0}, 8e-4, 26));
    series.write();
    writeSummary(name, 3, 0);
}

/// The frames differ in the speeds, so that each is recognised.
void writeLattice(const std::string& name, std::size_t count, std::size_t bridges, int frames) {
    const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
    std::vector<Place> places;
    for (std::size_t k = 0; k < count; ++k)
        places.push_back({2.05e-3 * static_cast<double>(k % side),
                          2.05e-3 * static_cast<double>(k / side % side),
                          2.05e-3 * static_cast<double>(k / side / side)});
    std::vector<Bridge> all;
    for (const std::size_t step : {std::size_t{1}, side, side * side, side + 1})
        for (std::size_t k = 0; k + step < count && all.size() < bridges; ++k)
            all.push_back({k, k + step, 2e-11});
    ParaViewSeries series(name, -INFINITY);
    for (int frame = 0; frame < frames; ++frame) {
        Floats speeds;
        for (std::size_t k = 0; k < count; ++k)
            speeds.push_back(static_cast<float>((k * 7919 + 13 * frame) % 1000));
        const PolyData grains = grainsOf(places, Floats(count, 1e-3F), speeds);
        writePolyData(series.add("particles", 0.01 * frame, frame), grains);
        if (bridges > 0) writePolyData(series.add("contacts", 0.01 * frame, frame), contactsOf(grains, all));
    }
    series.write();
    writeSummary(name, count, 0.01 * frames);
}

/// A grain that flies.
struct Outside : Simulation<LinearViscoelasticSpecies> {
    explicit Outside(std::string how) : end(std::move(how)) {
        LinearViscoelasticSpecies species;
        species.setDensity(end == "warned" ? 2.5 : 2500);
        species.setStiffness(300), species.setDissipation(1e-3);
        SphericalParticle grain(speciesHandler.copyAndAddObject(species));
        grain.setRadius(1e-3);
        grain.setVelocity({0.1, 0, 0});
        particleHandler.copyAndAddObject(grain);
        setTimeStep(1e-7), setTimeMax(1e-6);
    }
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() != 5) return;
        if (end == "fails") particleHandler.getObject(0).setVelocity({1e6, 0, 0});
        if (end == "killed") std::raise(SIGKILL);
    }
    std::string end;
};

int runOutside(const std::string& name, const std::string& end) {
    Outside scene(end);
    scene.setName(name);
    scene.addOutput(ParaViewOutput());
    try {
        scene.solve();
    } catch (const std::exception&) {
        return 1;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    const std::string name = argv[2] + std::string("/run");
    if (argv[1] == std::string("picture")) writePicture(name);
    else if (argv[1] == std::string("hdf5")) writeHdf5Picture(name);
    else if (argv[1] == std::string("fields")) writeFields(name);
    else if (argc == 4 && argv[1] == std::string("damaged")) writeDamaged(name, argv[3]);
    else if (argc == 4 && argv[1] == std::string("outside")) return runOutside(name, argv[3]);
    else if (argc == 6)
        writeLattice(name, std::strtoull(argv[3], nullptr, 10), std::strtoull(argv[4], nullptr, 10),
                     std::atoi(argv[5]));
    else return 2;
    return 0;
}
