#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "Kernel/Analysis/CoarseGraining/FieldGrid.h"
#include "Kernel/Analysis/CoarseGraining/GrainState.h"
#include "Kernel/Analysis/CoarseGraining/SmoothingKernel.h"
#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

class SharedQuestion;

/// Which grains have fields of their own, beside those of all grains.
class GrainGroups {
public:
    static GrainGroups none() { return {}; }
    static GrainGroups bySpecies(std::size_t species);
    /// Groups between diameters (m): below the first, between, from the last on. Throws InputError unless
    /// they are positive and increase.
    static GrainGroups bySize(std::vector<double> diameters);

    [[nodiscard]] std::size_t size() const { return names.size(); }
    [[nodiscard]] const std::string& nameOf(std::size_t group) const { return names[group]; }
    /// 0 for species beyond those given.
    [[nodiscard]] std::uint32_t of(const GrainState::Grain& grain) const {
        return names.size() == 1 ? 0 : amongSeveral(grain);
    }

private:
    [[nodiscard]] std::uint32_t amongSeveral(const GrainState::Grain& grain) const;

    std::vector<std::string> names{""};
    std::vector<double> edges;  // m, diameters
    bool species = false;
};

/// Sums over grains and contacts at the points of a grid, from which all fields follow; and their means over
/// time: sums are averaged, quotients are taken of the averages. Sources: Goldhirsch, Granul. Matter 12
/// (2010) 239; with boundaries Weinhart, Thornton, Luding and Bokhove, Granul. Matter 14 (2012) 289; of one
/// kind of grains among others Tunuguntla, Thornton and Weinhart, Comput. Part. Mech. 3 (2016) 349.
///
/// With phi of the kernel, grains i with mass m, velocity v and volume V, and contacts with the force f on
/// grain i and b from grain j, or the contact point at a wall, to grain i:
///   mass      sum m phi_i                contact stress  sum f b psi, psi the mean of phi over the branch
///   momentum  sum m v phi_i              traction        sum f phi(r - contact point), at walls
///   flux      sum m v v phi_i            fabric          sum n n (V_i phi_i + V_j phi_j), without walls
/// Stress is positive in compression. A rigid body is a grain at its centre of mass, to which its branches go
/// from the contact points: only so what holds the body together is in the stress, and momentum is balanced.
/// The adhesive stress, which has six parts, is then the symmetric part. A contact of two groups is divided
/// at the contact point. Where the images of a scene move against each other (shear, strain) each has its own
/// velocity.
class FieldSums {
public:
    /// The sums, each by its first place.
    enum Sum : std::size_t {
        Number = 0,
        Volume = 1,
        Mass = 2,
        Momentum = 3,         // 3
        Flux = 6,             // 6: xx xy xz yy yz zz
        Fabric = 12,          // 6; from here on only with contacts
        Contacts = 18,        // of a grain, touching
        Liquid = 19,          // of its film, and half of its bridges
        ContactStress = 20,   // 9: xx xy xz yx ... zz
        AdhesiveStress = 29,  // 6, the part of the contact stress that bridges and adhesion have
        Traction = 35,        // 3
        count = 38
    };
    static constexpr std::size_t countWithoutContacts = Fabric;

    /// The kernel must have the dimensions of the grid.
    FieldSums(FieldGrid grid, SmoothingKernel kernel, GrainGroups groups = GrainGroups::none(),
              FieldContent content = FieldContent::All);

    /// A state at one time; all have the same weight. The sums do not depend on the number of threads. Throws
    /// InputError for coordinates around an axis where images move.
    /// @param ask called now and then, on this thread; where it throws, the sums are of no use any more
    void add(const GrainState& state, int threads = 1, const std::function<void()>& ask = {});
    static void refuseMovingImages(const FieldGrid& grid, const PeriodicBox& periodic);
    [[nodiscard]] std::size_t states() const { return added; }

    /// The mean of a sum over the states, as a density, 1/m^3 times its unit: of a group, or of all.
    /// Throws InputError for a sum of contacts that were left out.
    /// @param point of the grid, x the slowest
    [[nodiscard]] double of(std::size_t sum, std::size_t group, std::size_t point) const;
    [[nodiscard]] double ofAll(std::size_t sum, std::size_t point) const;

    [[nodiscard]] const FieldGrid& grid() const { return points; }
    [[nodiscard]] const SmoothingKernel& kernel() const { return weight; }
    [[nodiscard]] const GrainGroups& groups() const { return kinds; }
    [[nodiscard]] bool hasContacts() const { return stored == count; }
    void clear();
    /// All numbers, for a restart file.
    [[nodiscard]] std::vector<double> numbers() const;
    /// Throws InputError where there are as many numbers as another grid or other groups have.
    void setNumbers(const std::vector<double>& numbers, std::size_t states);

private:
    /// The points within the cut-off, where one axis is resolved: behind those of all groups before.
    struct Near {
        std::uint32_t begin, end;
    };
    struct PointItem {
        std::array<double, 3> at;  // m
        std::uint32_t group;
        Near near{0, 0};
        std::array<double, 20> values;
    };
    /// A straight line from `from` over `branch`, both in the resolved directions only.
    struct LineItem {
        std::array<double, 3> from, branch;  // m
        double length;                       // m, of the branch
        std::uint32_t group;
        std::array<double, 15> values;
    };
    /// A straight line along the only axis that is resolved, and what it carries: f b, of each number of
    /// `left` with each of `right`.
    struct AxisLine {
        double from, way;                   // m
        std::array<double, 3> left, right;  // N; m
        Near near;
    };
    /// What a part of a state adds; kept, because memory that is new each time takes longer than to fill it.
    struct Items {
        std::vector<PointItem> grains, tractions;
        std::vector<LineItem> lines;
        std::vector<PointItem> nodes;                 // of lines around an axis: 15 values
        std::vector<AxisLine> along;                  // in place of lines where one axis is resolved
        std::vector<std::array<double, 6>> adhesive;  // N m, of these lines, where any has it
        std::vector<std::uint32_t> order;             // of grains, then of lines, by their first points
        bool isAdhesive = false;

        void clear();
    };
    struct alignas(64) Eight {
        std::array<double, Pack::lanes> points;
    };
    /// The part of the sums that one thread makes, and where they go: a part of the outermost resolved axis,
    /// or of the blocks where there is but one.
    struct Slab {
        std::size_t begin, end;
        Eight* sums;
        SharedQuestion& question;
    };
    /// Into how many shares grains and contacts are divided, whatever the number of threads: fewer where
    /// there are many points along one axis.
    static constexpr std::size_t shares = 32;
    /// Up to so many sums (64 kB) each share has its own, and always where one axis is resolved.
    static constexpr std::size_t fewSums = 1024;

    void gatherContactsOfGrains(const GrainState& state, int threads);
    void addByShares(const GrainState& state, int threads, std::size_t sharesOfAll, SharedQuestion& question);
    void addBySlabs(const GrainState& state, int threads, SharedQuestion& question);
    void makeItems(const GrainState& state, std::size_t share, std::size_t sharesOfAll, Items& items,
                   SharedQuestion& question) const;
    void addGrain(const GrainState& state, std::size_t number, Items& items) const;
    void addGrainAt(const Vector<double>& position, Vector<double> velocity, const GrainState::Grain& grain,
                    std::size_t number, Items& items) const;
    void addContact(const GrainState& state, std::size_t number, Items& items) const;
    void addTraction(const GrainState& state, const Vector<double>& point, const Vector<double>& force,
                     std::uint32_t group, Items& items) const;
    void addLine(const GrainState& state, const Vector<double>& end, const Vector<double>& branch,
                 std::size_t number, std::uint32_t group, Items& items) const;
    void addAxisLine(const Vector<double>& from, const Vector<double>& branch, double share,
                     const Vector<double>& force, const std::array<double, 6>& adhesive, std::uint32_t group,
                     Items& items) const;
    void findAlone(const PeriodicBox& periodic);
    /// Whether a straight line between two places is seen alone.
    [[nodiscard]] bool isAlone(const Vector<double>& one, const Vector<double>& other) const;
    struct Range {
        std::size_t begin, end;
    };
    [[nodiscard]] Range pointsNear(double low, double high, std::size_t axis) const;
    [[nodiscard]] Near nearAlong(double low, double high, std::uint32_t group) const;
    template <class Item>
    void sortByPoints(const std::vector<Item>& items, std::vector<std::uint32_t>& order) const;
    template <std::size_t first, std::size_t size, class Item, class Weights, class Carry>
    void spreadSorted(const std::vector<Item>& items, const std::vector<std::uint32_t>& order,
                      const Slab& slab, Weights&& weights, Carry&& carry) const;
    void spreadAlongAxis(Items& items, const Slab& slab) const;
    [[nodiscard]] bool isAlongAxis() const { return points.dimensions() == 1 && !points.isCylindrical(); }
    void addRoundLine(const Vector<double>& end, const Vector<double>& branch,
                      const std::array<double, 15>& values, std::uint32_t group, Items& items) const;
    void spread(const Items& items, const Slab& slab) const;
    [[nodiscard]] std::size_t slabLength() const;
    template <class Use>
    void forImages(const PeriodicBox& periodic, const Vector<double>& low, const Vector<double>& high,
                   Use&& use) const;
    template <class Use>
    void forImagesAlongAxes(const PeriodicBox& periodic, const Vector<double>& low,
                            const Vector<double>& high, const Vector<double>& slid, Use&& use) const;
    template <class Use>
    void forImagesAlong(std::size_t axis, double period, double low, double high, Use&& use) const;
    template <std::size_t first, std::size_t size>
    void spread(const std::array<double, 3>& at, std::uint32_t group, const double* values,
                const Slab& slab) const;
    template <std::size_t first, std::size_t size>
    void spread(const LineItem& line, const Slab& slab) const;
    template <std::size_t size, class Phi>
    void overPoints(const std::array<double, 3>& low, const std::array<double, 3>& high, std::size_t first,
                    std::uint32_t group, const double* values, const Slab& slab, Phi&& phi) const;

    FieldGrid points;
    SmoothingKernel weight;
    GrainGroups kinds;
    std::size_t stored;                             // sums of a point
    std::array<std::size_t, 3> order{0, 1, 2};      // of axes: the last one is stored in blocks of eight
    std::size_t blocks = 1;                         // of a row
    std::array<std::vector<double>, 3> places;      // m, of the points along each of `order`
    std::array<double, 3> perLength{};              // 1/m, of points along each axis
    std::array<double, 3> aloneLow{}, aloneHigh{};  // m, of a state: see findAlone()
    std::vector<Eight> sums;                        // of a group, row, block: each sum
    std::vector<Eight> ofGrains;                    // fabric over its volume, contacts, liquid
    std::vector<Items> items;                       // of shares, or of threads
    std::vector<std::vector<Eight>> sumsOfShares;
    std::size_t added = 0;
};

}  // namespace pendular
