// Walls that forces move, as the bound of the step takes them.
#include <algorithm>
#include <cmath>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Features/AdaptiveTimeStep/ContactBound.h"
#include "Kernel/Features/AdaptiveTimeStep/UnitSums.h"

namespace pendular {
namespace {

/// Adds up numbers of all ranks that are multiples of a unit: whatever their order.
void addUp(std::vector<double>& numbers, const AllRanks& ranks) {
    if (!ranks.areSeveral()) return;
    const std::vector<double> all = ranks.gather(numbers);
    for (double& number : numbers) number = 0;
    for (std::size_t k = 0; k < all.size(); ++k) numbers[k % numbers.size()] += all[k];
}
void addUp(ContactBounds::BodyMatrix& matrix, const AllRanks& ranks) {
    std::vector<double> numbers(matrix.begin(), matrix.end());
    addUp(numbers, ranks);
    std::ranges::copy(numbers, matrix.begin());
}

}  // namespace

void ContactBounds::findMovedWalls(const WallHandler& walls) {
    movedWalls.clear();
    for (const PresentWall& present : walls.present()) {
        const Wall& wall = *present.object;
        if (!hasMass(wall)) continue;
        MovedWall& moved = movedWalls.emplace_back(MovedWall{.number = static_cast<int>(present.number)});
        if (const Membrane* const membrane = wall.membrane()) moved.vertices = PressedVertices(*membrane);
        else moved.motions = WallMotions(wall);
        moved.block.ownDashpot = 0;
    }
}

bool ContactBounds::isMoved(int wall) const {
    return std::ranges::find(movedWalls, wall, &MovedWall::number) != movedWalls.end();
}

void ContactBounds::takeSide(const Wall& wall, int number, std::uint32_t part, const Vector<double>& position,
                             const Vector<double>& fromGrain, Term& term) {
    const auto moved = std::ranges::find(movedWalls, number, &MovedWall::number);
    if (moved == movedWalls.end()) return;
    const Vector<double> point = position + fromGrain - wall.imageShift(part, position);
    WallSide side{.wall = static_cast<std::uint32_t>(moved - movedWalls.begin()), .arm = point};
    if (const Membrane* const membrane = moved->vertices.membrane) {
        side.triangle = membrane->partOfShape(part);
        side.weights = membrane->weightsAt(side.triangle, point).share;
    } else {
        side.arm -= moved->motions.centre;
    }
    term.side = static_cast<std::uint32_t>(wallSides.size());
    wallSides.push_back(side);
}

/// The load of a wall is the sum of what its contacts give it in all directions together.
void ContactBounds::chooseWeightsOfWalls(const ParticleStore& grains, const AllRanks& ranks) {
    double largest = 0;
    for (const Term& term : terms) {
        if (term.side == none) continue;
        WallSide& side = wallSides[term.side];
        const MovedWall& wall = movedWalls[side.wall];
        const ContactStiffness& s = term.stiffness;
        const double radius = term.pair.bodies.effectiveRadius();
        SpringAndDashpot all;
        if (const Membrane* const membrane = wall.vertices.membrane) {
            const auto& corners = membrane->getNet().triangles()[side.triangle];
            double mobility = 0;
            for (std::size_t c = 0; c < 3; ++c)
                mobility = std::max(mobility, wall.vertices.mobility[corners[c]]);
            all = mobility * larger(s.normal, s.sliding);
        } else {
            const double along = [&] {
                double sum = 0;
                for (const double slip : wall.motions.along(term.normal, side.arm)) sum += slip * slip;
                return sum;
            }();
            all = along * s.normal + std::max(0.0, wall.motions.mobility(side.arm) - along) * s.sliding +
                  radius * radius * wall.motions.turningMobility() * (s.rolling + s.torsion);
        }
        side.spring = all.spring, side.dashpot = all.dashpot;
        largest = std::max(largest, side.spring);
    }
    const double unit = unitOf(ranks.largest(largest));
    for (const Term& term : terms) {
        if (term.side == none || term.first >= grains.ownSize()) continue;
        const WallSide& side = wallSides[term.side];
        MovedWall& wall = movedWalls[side.wall];
        if (!wall.vertices.membrane) {
            wall.load += inUnits(side.spring, unit);
            continue;
        }
        const auto& corners = wall.vertices.membrane->getNet().triangles()[side.triangle];
        for (std::size_t c = 0; c < 3; ++c)
            wall.vertices.loads[corners[c]] += inUnits(side.weights[c] * side.spring, unit);
    }
    for (MovedWall& wall : movedWalls) {
        std::vector<double> loadsOfWall{wall.load};
        if (wall.vertices.membrane) loadsOfWall = wall.vertices.loads;
        addUp(loadsOfWall, ranks);
        if (!wall.vertices.membrane) {
            wall.load = loadsOfWall[0];
            continue;
        }
        wall.vertices.loads = loadsOfWall;
        wall.vertices.membrane->getNet().sumOverCopies(wall.vertices.loads);
        wall.load = *std::ranges::max_element(wall.vertices.loads);
    }
    for (WallSide& side : wallSides) {
        const MovedWall& wall = movedWalls[side.wall];
        side.load = wall.load;
        if (const Membrane* const membrane = wall.vertices.membrane) {
            const auto& corners = membrane->getNet().triangles()[side.triangle];
            side.load = 0;
            for (std::size_t c = 0; c < 3; ++c)
                side.load += std::max(side.weights[c], 0.0) * wall.vertices.loads[corners[c]];
        }
        if (!(side.spring > 0)) side.load = 0;
    }
}

double ContactBounds::largestLoadOfWalls() const {
    double largest = 0;
    for (const MovedWall& wall : movedWalls) largest = std::max(largest, wall.load);
    return largest;
}

double ContactBounds::weightAtWall(const Term& term) const {
    if (term.side == none) return 0;
    if (term.isFixed) return wallSides[term.side].load > 0 || wallSides[term.side].dashpot > 0 ? infinity : 0;
    const double own = loads[moverAt(term.first)], ofWall = wallSides[term.side].load;
    if (!(ofWall > 0)) return wallSides[term.side].dashpot > 0 ? 1 : 0;
    return own > 0 ? ofWall / own : 1;
}

void ContactBounds::addToWall(const Term& term) {
    const double t = weightAtWall(term);
    if (!(t > 0) || (!(term.gap < 0) && !term.drags)) return;
    const WallSide& side = wallSides[term.side];
    MovedWall& wall = movedWalls[side.wall];
    note(term, wall.block);
    wall.block.ownDashpot = 0, wall.block.neighbours = infinity;  // of the masses of the grains alone
    const ContactStiffness& s = term.stiffness;
    const double share = 1 + 1 / t;
    if (wall.vertices.membrane) return addToVertices(side, s, share);
    const WallMotions& motions = wall.motions;
    const auto addSlip = [&](BodyMatrix& to, double along, double across, double unit) {
        for (const Vector<double>& axis : axesOfSpace)
            addSquare(to, share * across, motions.along(axis, side.arm), unit);
        addSquare(to, share * (along - across), motions.along(term.normal, side.arm), unit);
    };
    const double radius = term.pair.bodies.effectiveRadius(), turn = share * radius * radius;
    const auto addTurn = [&](BodyMatrix& to, double along, double across, double unit) {
        for (const Vector<double>& axis : axesOfSpace)
            addSquare(to, turn * across, motions.about(axis), unit);
        addSquare(to, turn * (along - across), motions.about(term.normal), unit);
    };
    addSlip(wall.block.spring, s.normal.spring, s.sliding.spring, springUnit);
    addSlip(wall.block.friction, 0, s.sliding.spring, springUnit);
    addSlip(wall.block.dashpot, s.normal.dashpot, s.sliding.dashpot, dashpotUnit);
    for (BodyMatrix* const to : {&wall.block.spring, &wall.block.friction})
        addTurn(*to, s.torsion.spring, s.rolling.spring, springUnit);
    addTurn(wall.block.dashpot, s.torsion.dashpot, s.rolling.dashpot, dashpotUnit);
    wall.block.relaxation = std::min(wall.block.relaxation, s.shortestRelaxation());
}

void ContactBounds::addToVertices(const WallSide& side, const ContactStiffness& stiffness, double share) {
    PressedVertices& of = movedWalls[side.wall].vertices;
    const auto& corners = of.membrane->getNet().triangles()[side.triangle];
    const SpringAndDashpot stiffest = larger(stiffness.normal, stiffness.sliding);
    for (std::size_t c = 0; c < 3; ++c) {
        const double moved = share * std::max(side.weights[c], 0.0) * of.mobility[corners[c]];
        of.springs[corners[c]] += inUnits(moved * stiffest.spring, springUnit);
        of.dashpots[corners[c]] += inUnits(moved * stiffest.dashpot, dashpotUnit);
    }
}

void ContactBounds::takeLeastOfWalls(const ParticleStore& grains, const Integrator& integrator,
                                     const AllRanks& ranks, ContactBound& found) {
    for (std::size_t w = 0; w < movedWalls.size(); ++w) {
        MovedWall& wall = movedWalls[w];
        OfBody& block = wall.block;
        double grain = infinity;  // the first that touches it
        for (const Term& term : terms)
            if (term.side != none && wallSides[term.side].wall == w && term.gap < 0)
                grain = std::min(grain, static_cast<double>(grains.identity[term.first]));
        grain = ranks.smallest(grain);
        block.contacts = ranks.sum(block.contacts);
        block.overlap = ranks.largest(block.overlap);
        block.relaxation = ranks.smallest(block.relaxation);
        double step = infinity;
        if (const Membrane* const membrane = wall.vertices.membrane) {
            addUp(wall.vertices.springs, ranks);
            addUp(wall.vertices.dashpots, ranks);
            membrane->getNet().sumOverCopies(wall.vertices.springs);
            membrane->getNet().sumOverCopies(wall.vertices.dashpots);
            SpringAndDashpot most;
            for (std::size_t v = 0; v < wall.vertices.springs.size(); ++v)
                most = larger(most, {wall.vertices.springs[v], wall.vertices.dashpots[v]});
            step = SignChange(integrator)
                       .limit(most + SpringAndDashpot{membrane->squaredFrequency(), membrane->getDamping()});
        } else if (block.contacts > 0) {
            for (BodyMatrix* const matrix : {&block.spring, &block.dashpot, &block.friction})
                addUp(*matrix, ranks);
            step = stepOf(block, integrator, true);
        }
        if (!(step < found.step)) continue;
        found.step = step;
        found.wall = wall.number;
        found.grain = grain < infinity ? static_cast<std::uint32_t>(grain) : 0;
        found.contactsOfGrain = block.contacts;
        found.overlapOfGrain = block.overlap;
    }
}

}  // namespace pendular
