// Pictures of states: what is computed for them, and the program as a user runs it.
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "BuildFolders.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Dependency.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"
#include "Tools/Snapshot/Compose.h"

namespace pendular::snapshotTest {
namespace {

using namespace snapshot;
using support::contains;
using support::expectOneSentence;
using support::TestFolder;

const std::string tool = (folders::tools / "snapshot").string();

/// All points lie in the picture, clear of the legend, and touch its margins on two sides or more.
TEST(Camera, showsAllPoints) {
    support::Random random(5);
    for (int k = 0; k < 200; ++k) {
        const double share = k % 2 == 0 ? random.uniform(0.1, 0.45) : 0;  // of the legend
        const double size = std::exp(random.uniform(-20, 20));
        const Vector<double> shift = 10 * size * toVector(random.direction());
        std::vector<Vector<double>> points;
        for (int n = 0; n < 20; ++n)
            points.push_back(shift + size * random.uniform(0, 1) * toVector(random.direction()));
        const Camera camera = cameraOn(points, toVector(random.direction()), 640, 480, share);
        EXPECT_NEAR(dot(cross(camera.right, camera.up), camera.forward), -1, 1e-12);
        double left = 0, right = 0, top = 0, bottom = 0;
        for (const Vector<double>& p : points) {
            const Vector<double> d = p - camera.eye;
            const double depth = dot(d, camera.forward) * Camera::slope();
            EXPECT_GT(depth, 0);
            const double x = dot(d, camera.right) / depth / camera.aspect(), y = dot(d, camera.up) / depth;
            left = std::max(left, -x), right = std::max(right, x / (1 - 2 * share));
            bottom = std::max(bottom, -y), top = std::max(top, y);
        }
        for (const double side : {left, right, bottom, top}) EXPECT_LE(side, 0.95 + 1e-9);
        // The direction that decides the distance fills the picture on both sides.
        EXPECT_NEAR(std::max(std::min(left, right), std::min(bottom, top)), 0.95, 1e-9);
    }
}

/// A range of a few roundings has no round numbers: the ticks end.
TEST(Legend, ofARangeOfARoundingHasOneNumber) {
    for (const double value : {1e-3, -7.0, 1e300})
        EXPECT_EQ(ticks(value, std::nextafter(std::nextafter(value, 1e308), 1e308)).size(), 1u);
    EXPECT_EQ(ticks(0, 0).size(), 1u);
}

TEST(Legend, hasRoundNumbersInItsRange) {
    support::Random random(2);
    for (int k = 0; k < 1000; ++k) {
        const double width = std::exp(random.uniform(-30, 30)), lowest = width * random.uniform(-3, 3);
        const std::vector<double> found = ticks(lowest, lowest + width);
        EXPECT_GE(found.size(), 3u);
        EXPECT_LE(found.size(), 9u);
        for (const double tick : found) {
            EXPECT_GE(tick, lowest - 1e-9 * width);
            EXPECT_LE(tick, lowest + width * (1 + 1e-9));
        }
    }
    EXPECT_EQ(ticks(0, 0.4),
              (std::vector<double>{0, 0.05, 0.1, 0.05 * 3, 0.2, 0.25, 0.05 * 6, 0.05 * 7, 0.4}));
    EXPECT_EQ(ticks(2, 2), std::vector<double>{2});
    EXPECT_EQ(label("velocity_m_per_s"), "velocity (m/s)");
    EXPECT_EQ(label("bridge_volume_m3"), "bridge volume (m^3)");
    EXPECT_EQ(label("species"), "species");
}

/// Each number of a legend has its own text, which is that number to a thousandth of the step between them.
TEST(Legend, tellsItsNumbersApart) {
    support::Random random(3);
    for (int k = 0; k < 300; ++k) {
        const double width = std::exp(random.uniform(-30, 30));
        const double lowest = width * random.uniform(-1, 1) * std::exp(random.uniform(0, 12));
        const Scalar scalar{"radius_m", {}, false};
        const Legend legend = legendOf(scalar, {lowest, lowest + width}, View());
        const std::vector<double> numbers = ticks(lowest, lowest + width);
        ASSERT_EQ(legend.marks.size(), numbers.size());
        const double step = numbers[1] - numbers[0];
        std::set<std::string> texts;
        for (std::size_t n = 0; n < numbers.size(); ++n) {
            texts.insert(legend.marks[n].text);
            EXPECT_NEAR(std::stod(legend.marks[n].text), numbers[n], 1e-3 * step);
        }
        EXPECT_EQ(texts.size(), numbers.size()) << lowest << ' ' << width;
    }
}

/// What a legend shows lies in the picture, clear of what the camera shows, however narrow the picture is.
TEST(Legend, isWholeInAnyPicture) {
    Legend legend{"tangential velocity (m/s)", &colourMaps[0], {}};
    for (const char* text : {"-1.25e-05", "0.0015", "0"}) legend.marks.push_back({0.5, text, {}});
    for (const double aspect : {0.2, 0.5, 0.7, 1.0, 1.5, 3.0}) {
        const LegendPlace place = placeOf(legend, aspect);
        EXPECT_GE(place.left, aspect - place.strip);
        EXPECT_GE(place.strip, place.letters * widthOf(legend.title));
        for (const Legend::Mark& mark : legend.marks)
            EXPECT_LT(place.textLeft() + place.letters * widthOf(mark.text), aspect) << aspect << mark.text;
        EXPECT_LE(place.strip, aspect * (1 + 1e-12)) << "half of the picture is for the particles";
        EXPECT_GT(place.letters, 0.02 * std::min(aspect, 1.0));
    }
    // In a wide picture nothing is smaller than it was made.
    EXPECT_EQ(placeOf(legend, 3).letters, 0.07);
    EXPECT_EQ(placeOf(legend, 3).strip, 0.4 * 3);
}

/// The cylinder between two spheres holds the bridge's volume: the gap S + 2 R - sqrt(..) of the true spheres
/// integrated over its cross-section, to the share (b/r)^2 by which a sphere departs from its paraboloid.
TEST(Bridge, isDrawnWithItsVolume) {
    constexpr double r = 1e-3;
    for (const double separation : {0.0, 1e-5, 1e-4})
        for (const double volume : {1e-13, 1e-12, 1e-11}) {
            const double b = bridgeRadius(volume, separation, 0.5 * r);
            double sum = 0;
            constexpr int rings = 10000;
            for (int k = 0; k < rings; ++k) {
                const double rho = b * (k + 0.5) / rings;
                const double gap = separation + 2 * (r - std::sqrt(r * r - rho * rho));
                sum += 2 * std::numbers::pi * rho * gap * b / rings;
            }
            EXPECT_NEAR(sum / volume, 1, b * b / (r * r)) << separation << ' ' << volume;
            EXPECT_LE(b * b / (r * r), 0.1);
        }
}

TEST(WallEdges, areThoseOfACubeWithoutALid) {
    // Five squares, each as two triangles.
    const auto corner = [](int k) {
        return Vector<double>{double(k & 1), double(k >> 1 & 1), double(k >> 2 & 1)};
    };
    std::vector<Polygon> faces;
    for (const auto& f : {std::array{0, 1, 3, 2}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}) {
        faces.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
        faces.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
    }
    const auto edges = sharpEdges(faces, 1);
    EXPECT_EQ(edges.size(), 12u);
    for (const auto& [begin, end] : edges) EXPECT_EQ(norm(end - begin), 1);  // no diagonal
}

class Snapshot : public ::testing::Test {
protected:
    Snapshot() {
        scenes::SettlingBox<Species<HertzianViscoelastic, Mindlin>> scene(2);
        scene.setName(folder.name());
        scene.setTimeMax(600 * 0x1p-17);
        scene.setSaveCount(300);
        scene.addOutput(ParaViewOutput());
        if (Hdf5File::isAvailable()) scene.keepRestartFile();
        scene.solve();
    }
    support::ProgramResult draw(const std::string& options) const {
        return support::run(tool + " " + folder.name() + options + " --output " + picture.string());
    }
    static std::size_t count(const std::string& text, std::string_view part) {
        std::size_t found = 0;
        for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
        return found;
    }

    TestFolder folder;
    std::filesystem::path picture = folder.path() / "picture.png", scene = folder.path() / "picture.pov";
};

/// A run that could not go on may leave such grains.
TEST(SnapshotOfALastState, leavesOutGrainsThatAreNowhere) {
    Frame frame;
    frame.grains.points = {{0, 0, 0}, {NAN, 0, 0}, {1, 0, 0}};
    EXPECT_TRUE(isInside(frame.grains.points[0], {}));
    EXPECT_FALSE(isInside(frame.grains.points[1], {}));
    Span span;
    for (const double value : {2.0, 4.0}) span.take(value);
    EXPECT_EQ(span.share(NAN), 0);
    EXPECT_EQ(span.share(3), 0.5);
}

/// There is no number that its ends could show.
TEST(SnapshotWithoutGrains, hasNoLegend) {
    Frame frame;
    frame.grains.pointFields = {{"radius_m", 1, std::vector<double>()}};
    EXPECT_FALSE(compose(frame, View(), Span()).legend);
    EXPECT_TRUE(compose(frame, View(), Span{1, 2}).legend) << "a range that is asked for";
}

TEST_F(Snapshot, hasASphereForEachGrainAndAColourForEachSpecies) {
    ASSERT_EQ(draw(".pvd --field species --scene-only").exitCode, 0);
    const std::string text = support::contentOf(scene);
    EXPECT_EQ(count(text, "\nsphere {"), 32u);
    const auto sphereOf = [&](unsigned code) {
        const Colour c = fromBytes(namedColours[code]);
        return fmt::format("pigment {{ srgb <{:.3f},{:.3f},{:.3f}> }} finish {{ Grain }}", c.red, c.green,
                           c.blue);
    };
    std::size_t large = 0;
    for (int z = 0; z < 2; ++z)
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) large += (x + 2 * y + z) % 3 == 0 ? 1 : 0;
    EXPECT_EQ(count(text, sphereOf(1)), large);
    EXPECT_EQ(count(text, sphereOf(0)), 32 - large);
    EXPECT_EQ(count(text, "\"species\""), 1u);
}

TEST_F(Snapshot, showsTheBoxThatIsAskedFor) {
    ASSERT_EQ(draw(".pvd --field none --box-m 0 1 0 1 0 0.003 --scene-only").exitCode, 0);
    const PolyData last = readPolyData(folder.name() + "-particles-000000600.vtp");
    const auto low = static_cast<std::size_t>(std::count_if(
        last.points.begin(), last.points.end(), [](const Vector<double>& p) { return p.z <= 0.003; }));
    EXPECT_GT(low, 0u);
    EXPECT_LT(low, 32u);
    EXPECT_EQ(count(support::contentOf(scene), "\nsphere {"), low);
}

TEST_F(Snapshot, drawsAllFramesOfASeries) {
    ASSERT_EQ(draw(".pvd --all --caption time --scene-only").exitCode, 0);
    for (const int k : {0, 1, 2}) {
        const std::string text = support::contentOf(folder.path() / fmt::format("picture-{:04}.pov", k));
        EXPECT_TRUE(contains(text, fmt::format("\"t = {:.4g} s\"", 300 * k * 0x1p-17)));
    }
    ASSERT_EQ(draw(".pvd --time-s 0.0022 --caption time --scene-only").exitCode, 0);
    EXPECT_TRUE(contains(support::contentOf(scene), fmt::format("\"t = {:.4g} s\"", 300 * 0x1p-17)));
}

TEST_F(Snapshot, isAPicture) {
    if (support::isMissing(support::run("povray --version").exitCode != 127, "povray"))
        GTEST_SKIP() << support::without("povray", "that a picture is drawn");
    const auto result = draw(".pvd --field velocity_m_per_s --width 120 --height 90");
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const std::string bytes = support::contentOf(picture);
    EXPECT_TRUE(bytes.starts_with("\x89PNG"));
    EXPECT_GT(bytes.size(), 2000u);
    EXPECT_FALSE(std::filesystem::exists(scene));
}

/// POV-Ray would read them as the end of a name, or as a command of its own; and links are not written
/// through.
TEST_F(Snapshot, isNamedWithAnyCharacters) {
    if (support::isMissing(support::run("povray --version").exitCode != 127, "povray"))
        GTEST_SKIP() << support::without("povray", "that a picture is drawn");
    const auto drawAs = [&](const std::string& name) {
        return support::run(tool + " " + folder.name() +
                            ".pvd --field none --width 40 --height 30 --output '" +
                            (folder.path() / name).string() + "'");
    };
    const std::filesystem::path victim = folder.path() / "victim";
    std::ofstream(victim) << "precious";
    for (const char* name :
         {"x;y.png", "a b.png", "+Oz.png", "-D.png", "$(touch z).png", "[a].png", "ä.png"}) {
        const std::filesystem::path target = folder.path() / name;
        const std::filesystem::path log = std::filesystem::path(target).replace_extension(".pov.log");
        for (const std::filesystem::path& link : {target, log}) std::filesystem::create_symlink(victim, link);
        const auto result = drawAs(name);
        ASSERT_EQ(result.exitCode, 0) << name << ": " << result.output;
        EXPECT_FALSE(std::filesystem::is_symlink(target));
        EXPECT_TRUE(support::contentOf(target).starts_with("\x89PNG")) << name;
        std::filesystem::remove(log);
    }
    EXPECT_EQ(support::contentOf(victim), "precious");
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".snapshot")) << entry.path();
    for (const char* name : {"", "..", "pictures/"}) expectOneSentence(drawAs(name), "name = '");
}

/// The table that a run leaves that could not go on.
TEST_F(Snapshot, drawsATableOfGrains) {
    const std::filesystem::path table = folder.path() / "table.csv";
    const auto drawTable = [&](std::string_view rows) {
        std::ofstream(table) << "identity,species,radius_m,x_m,y_m,z_m\n# a remark\n" << rows;
        return support::run(tool + " " + table.string() + " --field identity --scene-only --output " +
                            picture.string());
    };
    ASSERT_EQ(drawTable("0,0,1e-3,0,0,0\n1,1,2e-3,5e-3,0,0\n").exitCode, 0);
    EXPECT_EQ(count(support::contentOf(scene), "\nsphere {"), 2u);
    expectOneSentence(drawTable("0,0,1e-3,0,0\n"), "line 3: a number is missing");
    expectOneSentence(drawTable("0,0,large,0,0,0\n"), "'large' is no number of a column");
    expectOneSentence(drawTable(""), "has no column radius_m with numbers");
}

/// The restart file of the run's end has the grains of its last frame, by places of the store for identities.
TEST_F(Snapshot, drawsTheGrainsOfARestartFile) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: no restart files.";
    ASSERT_EQ(draw("-restart.h5 --field velocity_m_per_s.z --caption time --scene-only").exitCode, 0);
    const std::string text = support::contentOf(scene);
    EXPECT_EQ(count(text, "\nsphere {"), 32u);
    EXPECT_TRUE(contains(text, fmt::format("\"t = {:.4g} s\"", 600 * 0x1p-17)));
    const auto sorted = [](const PolyData& grains) {
        std::vector<std::array<double, 5>> rows;
        for (std::size_t k = 0; k < grains.points.size(); ++k) {
            const Vector<double>& p = grains.points[k];
            rows.push_back({p.x, p.y, p.z, static_cast<float>(grains.pointField("radius_m")->at(k)),
                            static_cast<float>(grains.pointField("velocity_m_per_s")->at(3 * k + 2))});
        }
        std::sort(rows.begin(), rows.end());
        return rows;
    };
    EXPECT_EQ(sorted(readRestartState(folder.name() + "-restart.h5").grains),
              sorted(readPolyData(folder.name() + "-particles-000000600.vtp")));
    std::filesystem::resize_file(folder.name() + "-restart.h5", 5000);
    expectOneSentence(draw("-restart.h5 --scene-only"), "-restart.h5");
}

TEST_F(Snapshot, refusesInOneSentence) {
    expectOneSentence(draw(".pvd --field idenity"), "there are radius_m, mass_kg, velocity_m_per_s");
    expectOneSentence(draw(".pvd --colours jet"), "it may be viridis, coolwarm or grey");
    expectOneSentence(draw(".pvd --width 0"), "width = 0 pixels");
    expectOneSentence(draw(".pvd --view 0 0 0"), "length of the view's direction = 0");
    expectOneSentence(draw(".pvd --box-m 5 6 5 6 5 6"), "nothing of");
    expectOneSentence(draw("-walls-000000600.vtp"), "there is no field 'radius_m'");
    expectOneSentence(draw("-absent.vtp"), "run-absent.vtp");
    const auto without =
        support::run("PATH=/nowhere " + tool + " " + folder.name() + ".pvd --output " + picture.string());
    expectOneSentence(without, "POV-Ray is not installed (Debian package povray)");
}

}  // namespace
}  // namespace pendular::snapshotTest
