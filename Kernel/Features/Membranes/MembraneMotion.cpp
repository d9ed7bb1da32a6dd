#include "Kernel/Features/Membranes/MembraneMotion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {
namespace {

using MembraneStep = MembraneMotion::Step;
using Column = MembraneState::Column;

/// Calls function(number, membrane) for each.
template <class Function>
void forEachMembrane(const WallHandler& walls, Function&& function) {
    for (const auto& [number, wall] : walls.present())
        if (Membrane* const membrane = wall->membrane()) function(number, *membrane);
}

/// The force of a contact on a triangle.
struct TriangleForce {
    std::uint32_t grain;  // identity
    std::uint32_t part;   // which tells images apart
    std::uint32_t triangle;
    Vector<double> point;          // m, of the triangle
    Vector<double> force, couple;  // N, N m about the point
};

/// Puts the forces, and the accelerations that follow, into a state whose places and velocities are those of
/// now.
void takeForces(const Membrane& membrane, std::size_t number, const ContactSystem& contacts,
                const ParticleStore& grains, const Vector<double>& gravity, int threads,
                MembraneState& state) {
    const MembraneNet& net = membrane.getNet();
    const Vector<double> none{0, 0, 0};
    state.gravity = gravity;
    state.ofGrains = forcesOfGrains(membrane, static_cast<int>(number), contacts, grains, threads);
    state.elastic.assign(state.position.size(), none);
    state.ofPressure.assign(state.position.size(), none);
    net.addElasticForces(state.position, state.elastic, threads);
    net.addPressureForces(state.position, membrane.getPressure(), state.ofPressure);
    Column& acceleration = state.acceleration;  // first the force
    for (std::size_t v = 0; v < acceleration.size(); ++v)
        acceleration[v] = state.ofGrains[v] + state.elastic[v] + state.ofPressure[v];
    net.sumOverCopies(acceleration);
    for (std::size_t v = 0; v < acceleration.size(); ++v) {
        acceleration[v] = (1 / net.movedMasses()[v]) * acceleration[v];
        if (!membrane.getHeld()[v]) acceleration[v] += gravity - membrane.getDamping() * state.velocity[v];
    }
}

/// In a step h of velocity Verlet each force F did h/2 (F + F+) . (v + v+)/2, exactly.
MembraneWork workOf(const Membrane& membrane, const MembraneState& was, const MembraneState& is,
                    const MembraneStep& step) {
    const MembraneNet& net = membrane.getNet();
    MembraneWork work;
    const Vector<double> gravity = was.gravity + is.gravity;
    double elastic = 0, beyond = 0;  // J
    for (std::size_t v = 0; v < is.position.size(); ++v) {
        const Vector<double> way = (0.25 * step.length) * (was.velocity[v] + is.velocity[v]);
        const double byGrains = dot(was.ofGrains[v] + is.ofGrains[v], way),
                     bySprings = dot(was.elastic[v] + is.elastic[v], way),
                     byPressure = dot(was.ofPressure[v] + is.ofPressure[v], way);
        work.byGrains += byGrains;
        elastic += bySprings;
        work.byLoads += byPressure;
        if (membrane.getHeld()[v]) {
            work.byHolders -= byGrains + bySprings + byPressure;
            continue;
        }
        const double mass = net.masses()[v];
        const double byWeight = mass * dot(gravity, way);
        work.byLoads += byWeight;
        const double all = mass * dot(was.acceleration[v] + is.acceleration[v], way);
        work.damped += byGrains + bySprings + byPressure + byWeight - all;
        beyond += 0.5 * mass * (squaredNorm(is.velocity[v]) - squaredNorm(was.velocity[v])) - all;
    }
    const double stored = net.stretchingEnergy(is.position) + net.bendingEnergy(is.position) -
                          net.stretchingEnergy(was.position) - net.bendingEnergy(was.position);
    work.missing = stored + elastic + (step.scheme.takesMeanAcceleration() ? 0 : beyond);
    return work;
}

std::string_view kindOfMembrane(const Membrane& membrane) {
    return membrane.isOfHost() ? "whose vertices a host moves" : "a membrane";
}

void refuseCollapse(std::size_t number, const Membrane& membrane, const MembraneStep& step) {
    const int triangle = membrane.getNet().collapsed(membrane.state().position, step.threads);
    if (triangle < 0) return;
    const auto& [a, b, c] = membrane.getNet().triangles()[static_cast<std::size_t>(triangle)];
    const Vector<double> middle = (1.0 / 3) * (membrane.state().position[a] + membrane.state().position[b] +
                                               membrane.state().position[c]);
    throw RunError(fmt::format(
        "At time {:.6g} s triangle {} of wall {}, {}, at ({:.6g}, {:.6g}, {:.6g}) m has collapsed or "
        "folded onto its neighbour: {}.",
        step.time, triangle, number, kindOfMembrane(membrane), middle.x, middle.y, middle.z,
        membrane.isOfHost() ? "the host must keep its triangles open"
                            : "press it less, or take a finer or a thicker net, or more damping"));
}

void refuseSelfContact(std::size_t number, Membrane& membrane, const MembraneStep& step) {
    const auto found = membrane.findCrossing();
    if (!found) return;
    const auto& [a, b] = membrane.getNet().springs()[found->edge].ends;
    throw RunError(fmt::format(
        "At time {:.6g} s wall {}, {}, goes through itself at ({:.6g}, {:.6g}, {:.6g}) m, the edge "
        "between its vertices {} and {} through triangle {}: it does not touch itself, so keep its parts "
        "apart by tension, by grains between them, or by a lower pressure.",
        step.time, number, kindOfMembrane(membrane), found->place.x, found->place.y, found->place.z, a, b,
        found->triangle));
}

/// The force acts where the shape of a grain touches, and not straight below its centre.
void actAtShape(const GrainShapes& shapes, const ParticleStore& grains, std::uint32_t place,
                const Vector<double>& normal, double distance, TriangleForce& at) {
    const Vector<double> farthest = shapes.farthest(grains, place, normal);
    const Vector<double> point =
        grains.translation[place].position + farthest - (dot(farthest, normal) - distance) * normal;
    at.couple += cross(at.point - point, at.force);
    at.point = point;
}

}  // namespace

Column forcesOfGrains(const Membrane& membrane, int wall, const ContactSystem& contacts,
                      const ParticleStore& grains, int threads) {
    constexpr std::size_t worthAThread = 512;
    const ContactStore& store = contacts.store();
    const ContactLayout& layout = store.memory.getLayout();
    const GrainShapes* const shapes = contacts.laws().shapes();
    std::vector<TriangleForce> found;
    for (const Bucket& bucket : store.buckets) {
        if (bucket.wall != wall) continue;
        for (std::size_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c) {
            if (!store.acts(c)) continue;
            const std::size_t block = c / Pack::lanes, lane = c % Pack::lanes, slot = store.slotOf(c);
            const std::uint32_t place = store.firstOf(c);
            const TranslationRecord& grain = grains.translation[place];
            const WallPointColumns& columns = store.wallPoints[block - store.firstWallBlock()];
            const Vector<double> normal{columns.normal[0].lane[lane], columns.normal[1].lane[lane],
                                        columns.normal[2].lane[lane]};
            const double distance = columns.distance.lane[lane];
            const Vector<double> force = -store.forceOf(c);
            const std::uint32_t part = store.secondOf(c);
            TriangleForce at{grains.identity[place],
                             part,
                             membrane.partOfShape(part),
                             grain.position + distance * normal,
                             force,
                             {0, 0, 0}};
            // The grain's own lever ends half the overlap below its surface (WallContacts.h).
            if (layout.hasTorque)
                at.couple =
                    (grain.radius - store.memory.records[slot].halfOverlap - distance) * cross(normal, force);
            if (layout.hasContactTorque) at.couple -= store.memory.torques[slot].torque;
            if (shapes) actAtShape(*shapes, grains, place, normal, distance, at);
            at.point = at.point - membrane.imageShift(part, grain.position);
            found.push_back(at);
        }
    }
    found = contacts.ranks().gather(found);  // each moves the whole net
    std::sort(found.begin(), found.end(), [](const TriangleForce& a, const TriangleForce& b) {
        return std::tie(a.grain, a.part) < std::tie(b.grain, b.part);
    });
    std::vector<std::array<Vector<double>, 3>> shares(found.size());  // N, of the corners
    inParts(
        found.size(), threads,
        [&](int, std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k)
                shares[k] = membrane.weightsAt(found[k].triangle, found[k].point)
                                .forces(found[k].force, found[k].couple);
        },
        worthAThread);
    Column forces(membrane.getNet().vertices().size(), {0, 0, 0});
    for (std::size_t k = 0; k < found.size(); ++k) {
        const auto& corners = membrane.getNet().triangles()[found[k].triangle];
        for (std::size_t corner = 0; corner < 3; ++corner) forces[corners[corner]] += shares[k][corner];
    }
    return forces;
}

void MembraneMotion::renewForces(const WallHandler& walls, const ContactSystem& contacts,
                                 const ParticleStore& grains, const Vector<double>& gravity, int threads) {
    forEachMembrane(walls, [&](std::size_t number, Membrane& membrane) {
        if (!membrane.hasOldForces()) return;
        MembraneState now = membrane.state();
        takeForces(membrane, number, contacts, grains, gravity, threads, now);
        if (now.earlier.empty()) now.earlier = now.acceleration;
        membrane.finish(std::move(now));
    });
}

void MembraneMotion::begin(const WallHandler& walls, const MembraneStep& step) {
    before.clear();
    forEachMembrane(walls, [&](std::size_t number, Membrane& membrane) {
        MembraneState next = membrane.state();
        before.emplace_back(number, next);
        const Integrator& s = step.scheme;
        const double h = step.length;
        double farthest2 = 0;
        bool isFinite = true;
        for (std::size_t v = 0; v < next.position.size(); ++v) {
            Vector<double> shift = h * next.velocity[v];
            if (!membrane.getHeld()[v]) {
                const Vector<double>&a = next.acceleration[v], &e = next.earlier[v];
                shift += (h * h) * (s.position0 * a + s.position1 * e);
                next.velocity[v] += h * (s.velocity0 * a + s.velocity1 * e);
            }
            next.position[v] += shift;
            const double moved2 = squaredNorm(shift);
            farthest2 = std::max(farthest2, moved2);
            isFinite = isFinite && std::isfinite(moved2);
        }
        if (!isFinite)
            throw RunError(
                fmt::format("At time {:.6g} s the place of a vertex of wall {}, {}, is not finite: take a "
                            "smaller time step, or a smaller pressure.",
                            step.time, number, kindOfMembrane(membrane)));
        for (const MembraneNet::Copy& copy : membrane.getNet().copies()) {
            next.position[copy.vertex] = next.position[copy.of] + copy.shift;
            next.velocity[copy.vertex] = next.velocity[copy.of];
        }
        const double farthest = std::sqrt(farthest2);
        if (farthest > step.smallestRadius)
            throw RunError(fmt::format(
                "At time {:.6g} s a vertex of wall {}, {}, moves {:.4g} m in a step of {:.4g} s, more than "
                "the smallest radius, {:.4g} m: {}.",
                step.time, number, kindOfMembrane(membrane), farthest, step.length, step.smallestRadius,
                membrane.isOfHost() ? "take a smaller time step, or let the host move it slower"
                                    : "take a smaller time step, a smaller pressure or more damping"));
        membrane.goOn(std::move(next), farthest, step.threads);
        refuseCollapse(number, membrane, step);
        refuseSelfContact(number, membrane, step);
    });
}

void MembraneMotion::finish(const WallHandler& walls, const ContactSystem& contacts,
                            const ParticleStore& grains, const MembraneStep& step, bool keepsWork) const {
    std::size_t k = 0;
    forEachMembrane(walls, [&](std::size_t number, Membrane& membrane) {
        MembraneState end = membrane.state();
        takeForces(membrane, number, contacts, grains, step.gravity, step.threads, end);
        if (step.length == 0) {
            end.earlier = end.acceleration;  // there is no step before the first
            return membrane.finish(std::move(end));
        }
        const MembraneState& was = before[k++].second;
        const Integrator& s = step.scheme;
        for (std::size_t v = 0; v < end.position.size(); ++v) {
            if (!membrane.getHeld()[v])
                end.velocity[v] +=
                    (s.corrector * step.length) *
                    (end.acceleration[v] - s.now * was.acceleration[v] + s.earlier * was.earlier[v]);
            end.earlier[v] = was.acceleration[v];
        }
        for (std::size_t v = 0; v < end.impulse.size(); ++v)
            end.impulse[v] += 0.5 * step.length * (was.ofGrains[v] + end.ofGrains[v]);
        if (keepsWork) membrane.work = workOf(membrane, was, end, step);
        membrane.finish(std::move(end));
    });
}

void MembraneMotion::takeBack(const WallHandler& walls) const {
    for (const auto& [number, state] : before)
        if (Membrane* const membrane = walls.getObject(number).membrane()) membrane->goOn(state, 0);
}

}  // namespace pendular
