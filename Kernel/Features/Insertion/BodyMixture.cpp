#include "Kernel/Features/Insertion/BodyMixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Features/Insertion/Insertion.h"
#include "Kernel/Features/RigidBodies/BodyHandler.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

namespace {

constexpr std::uint32_t purposeOfKinds = 0x125A000;

/// m, of the spheres of a template.
double leastRadius(const ClumpTemplate& shape) {
    return std::ranges::min(shape.getSpheres(), {}, &Ball::radius).radius;
}
double mostRadius(const ClumpTemplate& shape) {
    return std::ranges::max(shape.getSpheres(), {}, &Ball::radius).radius;
}

}  // namespace

double densityOf(const ParticleHandler& particles, int species) {
    return particles.massOf(1, species) / sphereMass(1, 1);
}

Eigen::Quaterniond evenTurn(double a, double b, double c) {
    const double low = std::sqrt(1 - a), high = std::sqrt(a);
    const double first = 2 * std::numbers::pi * b, second = 2 * std::numbers::pi * c;
    return {high * std::cos(second), low * std::sin(first), low * std::cos(first), high * std::sin(second)};
}

int BodyKind::species() const {
    return std::visit([](const auto& one) { return one.getSpeciesIndex(); }, like);
}
Vector<double> BodyKind::velocity() const {
    return std::visit([](const auto& one) { return toVector(one.getVelocity()); }, like);
}
double BodyKind::film() const { return grain() ? grain()->getLiquidVolume() : 0; }

std::string_view BodyKind::word() const { return grain() ? "grain" : clump() ? "clump" : "superquadric"; }
Eigen::Quaterniond BodyKind::orientation() const {
    if (grain()) return Eigen::Quaterniond::Identity();
    return clump() ? Eigen::Quaterniond(clump()->getOrientation()) : shaped()->getOrientation();
}

double BodyKind::density(double ofSpecies) const {
    if (!clump()) return ofSpecies;
    const ClumpTemplate& shape = clump()->getTemplate();
    return shape.massOf(ofSpecies, 1).mass / shape.getVolume();
}

std::vector<Ball> placedBalls(std::span<const Ball> balls, double scale, const Vector<double>& place,
                              const Eigen::Quaterniond& turn) {
    const Eigen::Matrix3d matrix = turn.normalized().toRotationMatrix();
    std::vector<Ball> all;
    for (const Ball& ball : balls)
        all.push_back({toEigen(place) + scale * (matrix * ball.centre), scale * ball.radius});
    return all;
}

double BodyKind::scale(double radius) const {
    if (grain()) return radius / grain()->getRadius();
    const double own = clump() ? clump()->getTemplate().getDiameter()
                               : std::cbrt(6 / std::numbers::pi * shaped()->getShape().volume());
    return 2 / own * radius;
}
double BodyKind::smallestSphere(double radius) const {
    if (clump()) return scale(radius) * leastRadius(clump()->getTemplate());
    return reach(radius);
}
double BodyKind::largestSphere(double radius) const {
    if (clump()) return scale(radius) * mostRadius(clump()->getTemplate());
    return reach(radius);
}
double BodyKind::reach(double radius) const {
    if (grain()) return radius;
    return scale(radius) *
           (clump() ? clump()->getTemplate().getReach() : shaped()->getShape().boundingRadius());
}

std::vector<Ball> BodyKind::spheres(double radius, const Vector<double>& place,
                                    const Eigen::Quaterniond& turn) const {
    if (!clump()) return {{toEigen(place), reach(radius)}};
    return placedBalls(clump()->getTemplate().getSpheres(), scale(radius), place, turn);
}

/// Sizes are compared by their range and their moments.
void BodyKind::compareSetUp(StateArchive& archive) const {
    archive.same("kind", word());
    archive.same("species", species());
    archive.sameRecord<double>("velocity", velocity(), "m/s");
    archive.sameRecord<double>(
        "spin", std::visit([](const auto& one) { return toVector(one.getAngularVelocity()); }, like),
        "rad/s");
    archive.same("film", film(), "m^3");
    const Eigen::Quaterniond turn = orientation();
    archive.sameRecord<double>("orientation", std::array{turn.w(), turn.x(), turn.y(), turn.z()});
    archive.same("smallest", sizes.smallest(), "m");
    archive.same("largest", sizes.largest(), "m");
    archive.same("meanDiameter", sizes.moment(1), "m");
    archive.same("meanSquare", sizes.moment(2), "m^2");
    archive.same("meanVolume", sizes.moment(3), "m^3");
    if (clump()) {
        const ClumpTemplate& shape = clump()->getTemplate();
        std::vector<double> spheres;
        for (const Ball& ball : shape.getSpheres())
            spheres.insert(spheres.end(), {ball.centre.x(), ball.centre.y(), ball.centre.z(), ball.radius});
        archive.same<double>("spheres", std::span<const double>(spheres), "m");
        archive.same("volume", shape.getVolume(), "m^3");
        const BodyMass mass = shape.massOf(1, 1);
        archive.same("massOverDensity", mass.mass, "m^3");
    } else if (shaped()) {
        const Superquadric& own = shaped()->getShape();
        archive.sameRecord<double>("halfLengths", Vector<double>{own.a, own.b, own.c}, "m");
        archive.same("n1", own.n1);
        archive.same("n2", own.n2);
    } else {
        const HeldAxes held = grain()->getHeldAxes();
        archive.same("held", fmt::format("{:d}{:d}{:d}{:d}{:d}{:d}", held.x, held.y, held.z, held.aboutX,
                                         held.aboutY, held.aboutZ));
    }
}

void BodyKind::addTo(const InsertionScene& scene, double radius, const Vector<double>& place,
                     const Eigen::Quaterniond& turn, const Vector<double>& flow) const {
    const auto put = [&](auto& one) {
        one.setPosition(toEigen(place));
        one.setVelocity(toEigen(velocity() + flow));
    };
    if (grain()) {
        SphericalParticle copy = *grain();
        copy.setRadius(radius);
        put(copy);
        scene.particles.copyAndAddObject(copy);
    } else if (clump()) {
        Clump copy = *clump();
        copy.setScale(scale(radius));
        copy.setOrientation(turn);
        put(copy);
        scene.bodies.copyAndAddObject(copy);
    } else {
        SuperquadricGrain copy = shaped()->scaled(scale(radius));
        copy.setOrientation(turn);
        put(copy);
        scene.shapes->add(copy);
    }
}

void requireShapes(const BodyMixture& mixture, GrainShapes* shapes, std::string_view who) {
    for (const BodyKind& kind : mixture)
        if (kind.shaped()) {
            if (!shapes)
                throw InputError(fmt::format(
                    "{}: superquadrics are to come; derive the scene from SuperquadricSimulation.", who));
            shapes->expect(kind.shaped()->getShape());
        }
}

BodyMixture::BodyMixture(SizeBasis what) : basis(what) {
    if (basis != SizeBasis::Number && basis != SizeBasis::Volume)
        throw InputError(fmt::format(
            "BodyMixture: shares of the {} are asked for; take SizeBasis::Number or SizeBasis::Volume.",
            nameOf(basis)));
}

void BodyMixture::add(const SphericalParticle& like, const SizeDistribution& sizes, double share) {
    add(BodyKind{like, sizes, share});
}
void BodyMixture::add(const Clump& like, const SizeDistribution& sizes, double share) {
    add(BodyKind{like, sizes, share});
}
void BodyMixture::add(const SuperquadricGrain& like, const SizeDistribution& sizes, double share) {
    add(BodyKind{like, sizes, share});
}
void BodyMixture::add(BodyKind kind) {
    checkValue("BodyMixture", "share", kind.share, "", positive);
    if (basis == SizeBasis::Volume) kind.share /= kind.sizes.moment(3);
    kinds.push_back(std::move(kind));
}

bool BodyMixture::hasBodies() const {
    return std::ranges::any_of(kinds, [](const BodyKind& kind) { return kind.grain() == nullptr; });
}

double BodyMixture::shareOf(std::size_t number) const {
    double sum = 0;
    for (const BodyKind& kind : kinds) sum += kind.share;
    return kinds[number].share / sum;
}

std::size_t BodyMixture::draw(const CountedRandom& random, std::uint64_t identity) const {
    if (kinds.size() == 1) return 0;
    double left = random.uniform(identity, purposeOfKinds);
    for (std::size_t k = 0; k + 1 < kinds.size(); ++k)
        if ((left -= shareOf(k)) < 0) return k;
    return kinds.size() - 1;
}

double BodyMixture::meanMass(const ParticleHandler& particles) const {
    if (kinds.size() == 1)
        return kinds[0].density(densityOf(particles, kinds[0].species())) * std::numbers::pi / 6 *
               kinds[0].sizes.moment(3);
    double sum = 0;
    for (std::size_t k = 0; k < kinds.size(); ++k)
        sum += shareOf(k) * kinds[k].density(densityOf(particles, kinds[k].species())) * std::numbers::pi /
               6 * kinds[k].sizes.moment(3);
    return sum;
}

std::vector<std::size_t> BodyMixture::counts(std::size_t bodies) const {
    std::vector<std::size_t> numbers;
    std::vector<double> rests;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        const double own = shareOf(k) * static_cast<double>(bodies);
        numbers.push_back(static_cast<std::size_t>(own * (1 + 1e-12)));
        rests.push_back(own - static_cast<double>(numbers.back()));
    }
    const auto missing = [&] { return std::reduce(numbers.begin(), numbers.end()) < bodies; };
    while (missing()) {
        const auto most = static_cast<std::size_t>(std::ranges::max_element(rests) - rests.begin());
        ++numbers[most];
        rests[most] -= 1;
    }
    return numbers;
}

}  // namespace pendular
