#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Mercury/MercuryFiles.h"
#include "Kernel/Scene/DomainBox.h"

// MercuryDPM's coarse graining in the code of a driver: CG<CGCoordinates::Z, CGFunctions::Gauss>(width, n) in
// a scene's cgHandler. Each hands over to FieldSums, without a file. As there, grains that are held count as
// a boundary: their mass is in no field, and a contact with one is that with a wall.

namespace pendular {

class Scene;

}  // namespace pendular

/// The directions that are resolved.
namespace CGCoordinates {

// clang-format off
struct O { static constexpr std::string_view name = "O"; };
struct X { static constexpr std::string_view name = "X"; };
struct Y { static constexpr std::string_view name = "Y"; };
struct Z { static constexpr std::string_view name = "Z"; };
struct XY { static constexpr std::string_view name = "XY"; };
struct XZ { static constexpr std::string_view name = "XZ"; };
struct YZ { static constexpr std::string_view name = "YZ"; };
struct XYZ { static constexpr std::string_view name = "XYZ"; };
struct R { static constexpr std::string_view name = "R"; };
struct RZ { static constexpr std::string_view name = "RZ"; };
// clang-format on

}  // namespace CGCoordinates

/// The functions that smooth.
namespace CGFunctions {

struct Gauss {
    static constexpr auto shape = pendular::KernelShape::Gauss;
};
struct Lucy {
    static constexpr auto shape = pendular::KernelShape::Lucy;
};
struct Heaviside {
    static constexpr auto shape = pendular::KernelShape::Heaviside;
};

}  // namespace CGFunctions

namespace CGFields {

struct StandardFields {};

}  // namespace CGFields

using Matrix3D = Eigen::Matrix3d;

namespace pendular {

/// The fields at a point; without a unit that of the sum over m^3.
struct CGPoint {
    struct Coordinates {
        Vec3D place;  // m; 0 along axes that are not resolved
        [[nodiscard]] double getX() const { return place.x(); }
        [[nodiscard]] double getY() const { return place.y(); }
        [[nodiscard]] double getZ() const { return place.z(); }
        // As Tools/port-from-mercury.sh makes of them.
        [[nodiscard]] double x() const { return place.x(); }
        [[nodiscard]] double y() const { return place.y(); }
        [[nodiscard]] double z() const { return place.z(); }
    };
    Coordinates coordinates;
    double number = 0, volume = 0, density = 0;  // density: kg/m^3
    Vec3D momentum = Vec3D::Zero(), force = Vec3D::Zero();
    Eigen::Matrix3d flux = Eigen::Matrix3d::Zero(), stress = Eigen::Matrix3d::Zero();

    [[nodiscard]] double getParticleNumber() const { return number; }
    [[nodiscard]] double getVolumeFraction() const { return volume; }
    [[nodiscard]] double getDensity() const { return density; }
    [[nodiscard]] const Vec3D& getMomentum() const { return momentum; }
    /// Pa: sum of m v v, whose part of the flow is not taken off.
    [[nodiscard]] const Eigen::Matrix3d& getMomentumFlux() const { return flux; }
    /// Pa, positive in compression.
    [[nodiscard]] const Eigen::Matrix3d& getContactStress() const { return stress; }
    /// N/m^3, of walls, of grains that are held, and of species that are not selected, on those that are.
    [[nodiscard]] const Vec3D& getInteractionForceDensity() const { return force; }
};

/// What a driver asks of one of its coarse grainings; CG<...> says of which directions, and how.
class MercuryCG {
public:
    virtual ~MercuryCG() = default;

    MercuryNoFile statFile{FileType::ONE_FILE};  // addOutput(FieldOutput()) writes files of fields

    /// m, of the function: the cut-off of Lucy and Heaviside, and a third of that of Gauss.
    void setWidth(double value) { width = value, last.reset(); }
    /// The variance of the function (m^2) is that of a sphere of this radius (m) in so many dimensions.
    void setRadius(double radius);
    /// m, the root of the mean of the squared distance from the middle.
    void setStandardDeviation(double deviation);
    [[nodiscard]] double getWidth() const { return width; }
    /// m, where the function ends.
    [[nodiscard]] const MercuryCG& getFunction() const { return *this; }
    [[nodiscard]] double getCutoff() const { return shape == KernelShape::Gauss ? 3 * width : width; }
    /// Points along each direction that is resolved.
    void setN(std::size_t points) { counts = {points, points, points}, last.reset(); }
    void setNX(std::size_t points) { counts[0] = points, last.reset(); }
    void setNY(std::size_t points) { counts[1] = points, last.reset(); }
    void setNZ(std::size_t points) { counts[2] = points, last.reset(); }
    /// Points in the middle of cells of this length (m).
    void setH(double spacing) { cell = spacing, last.reset(); }
    /// m, corners of the box; that of the scene where they are not set. One may be flat in a direction that
    /// is resolved: the point is then there.
    void setMin(const Vec3D& corner) { lowest = corner, last.reset(); }
    void setMax(const Vec3D& corner) { highest = corner, last.reset(); }
    /// s: a state outside of these times does not count.
    void setTimeMin(double time) { timeMin = time; }
    void setTimeMax(double time) { timeMax = time; }
    /// Only grains of this species count; all others are boundary.
    void selectSpecies(std::size_t number) { species = static_cast<int>(number), last.reset(); }

    /// The fields at a point (x the slowest) as of the last step, or the mean over time. The sums are made
    /// once for all points of a state. Throws InputError where there is no such point, or no state in the
    /// times that were set.
    [[nodiscard]] CGPoint getPoint(std::size_t point) const;
    [[nodiscard]] std::vector<CGPoint> getPoints() const;
    /// The mean over all points.
    [[nodiscard]] CGPoint evaluateAverage() const;
    /// Of the radii of all grains that count, wherever they are: their number, mean (m) and variance (m^2),
    /// then the third to fifth moment about the mean over that power of the standard deviation.
    [[nodiscard]] std::array<double, 6> getStandardisedParticleSizeMomenta() const;

    /// Called where output of the scene is due.
    void sample(const Scene& of);

protected:
    MercuryCG(std::string_view ofCoordinates, KernelShape ofFunction, bool isMean)
        : coordinates(ofCoordinates), shape(ofFunction), averages(isMean) {}
    MercuryCG(const MercuryCG&) = default;
    MercuryCG& operator=(const MercuryCG&) = default;

private:
    friend class MercuryCGHandler;

    [[nodiscard]] FieldSums emptySums(const Scene& of) const;
    [[nodiscard]] bool isInTime(const Scene& of) const;
    [[nodiscard]] const Scene& sceneInTime() const;
    [[nodiscard]] const FieldSums& sumsNow() const;
    [[nodiscard]] int dimensions() const;

    std::string_view coordinates;
    KernelShape shape;
    bool averages;
    double width = 1;  // m
    std::array<std::size_t, 3> counts{1, 1, 1};
    std::optional<double> cell;            // m
    std::optional<Vec3D> lowest, highest;  // m
    double timeMin = -std::numeric_limits<double>::infinity(),
           timeMax = std::numeric_limits<double>::infinity();  // s
    int species = -1;                                          // all
    const Scene* scene = nullptr;
    std::optional<FieldSums> mean;
    /// The sums that were asked for last, and of which state they are.
    struct Last {
        std::size_t step;
        std::uint64_t state;
        FieldSums sums;
    };
    mutable std::optional<Last> last;
};

/// The fields of the last step. @param ofWidth m; @param points along each direction that is resolved
template <class Coordinates, class Function = CGFunctions::Lucy, class Fields = CGFields::StandardFields>
class CG : public MercuryCG {
public:
    CG() : CG(false) {}
    CG(double ofWidth, std::size_t points) : CG(false) { setWidth(ofWidth), setN(points); }

protected:
    explicit CG(bool isMean) : MercuryCG(Coordinates::name, Function::shape, isMean) {
        static_assert(std::same_as<Fields, CGFields::StandardFields>,
                      "the fields of a CG are CGFields::StandardFields here");
    }
};

/// Their mean over the states at which output of the scene is due.
template <class Coordinates, class Function = CGFunctions::Lucy, class Fields = CGFields::StandardFields>
class TimeAveragedCG : public CG<Coordinates, Function, Fields> {
public:
    TimeAveragedCG() : CG<Coordinates, Function, Fields>(true) {}
    TimeAveragedCG(double ofWidth, std::size_t points) : TimeAveragedCG() {
        this->setWidth(ofWidth), this->setN(points);
    }
};

/// The coarse grainings of a MercuryScene.
class MercuryCGHandler {
public:
    explicit MercuryCGHandler(const Scene& of) : scene(&of) {}
    MercuryCGHandler(const MercuryCGHandler&) = delete;

    /// Adds a copy; the pointer stays valid.
    template <std::derived_from<MercuryCG> One>
    One* copyAndAddObject(const One& coarseGraining) {
        auto copy = std::make_unique<One>(coarseGraining);
        One* const added = copy.get();
        static_cast<MercuryCG*>(added)->scene = scene;
        all.push_back(std::move(copy));
        return added;
    }
    [[nodiscard]] std::size_t getNumberOfObjects() const { return all.size(); }
    [[nodiscard]] std::size_t getSize() const { return all.size(); }
    /// Throw InputError if there is none.
    [[nodiscard]] MercuryCG* getObject(std::size_t number) const;
    [[nodiscard]] MercuryCG* getLastObject() const;
    /// A loop over pointers: for (auto cg : cgHandler).
    class Iterator {
    public:
        explicit Iterator(std::vector<std::unique_ptr<MercuryCG>>::const_iterator position) : at(position) {}
        MercuryCG* operator*() const { return at->get(); }
        Iterator& operator++() { return ++at, *this; }
        friend bool operator==(const Iterator&, const Iterator&) = default;

    private:
        std::vector<std::unique_ptr<MercuryCG>>::const_iterator at;
    };
    [[nodiscard]] Iterator begin() const { return Iterator(all.begin()); }
    [[nodiscard]] Iterator end() const { return Iterator(all.end()); }
    void sample() {
        for (const auto& one : all) one->sample(*scene);
    }
    /// Of how many a file was asked for.
    [[nodiscard]] std::size_t countOfFiles() const {
        std::size_t count = 0;
        for (const auto& one : all) count += one->statFile.isWritten() ? 1 : 0;
        return count;
    }

private:
    const Scene* scene;
    std::vector<std::unique_ptr<MercuryCG>> all;
};

}  // namespace pendular
