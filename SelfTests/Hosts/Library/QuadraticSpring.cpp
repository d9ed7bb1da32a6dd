// A library of species that a program loads at run time: a normal law of its own, with two friction laws.

#include <array>
#include <cmath>

#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "Kernel/Laws/Friction/Mindlin.h"

namespace {

using namespace pendular;

/// F = c d^2, without a dashpot: a cone pressed into a plane.
struct QuadraticSpring {
    static constexpr std::string_view name = "QuadraticSpring";
    static constexpr std::string_view summary = "a force that grows with the square of the overlap";
    static constexpr std::string_view domain = "any overlap";

    double coefficient = unset;  // c, N/m^2

    static constexpr auto fields() {
        return std::to_array<Field<QuadraticSpring>>(
            {{"coefficient", &QuadraticSpring::coefficient, "N/m^2", positive, Mixing::Harmonic,
              "c of F = c d^2", "this library"}});
    }
    static std::vector<Setter<QuadraticSpring>> setters() {
        return {{"forceAtOverlap",
                 {{"force", "N", positive}, {"overlap", "m", positive}},
                 "coefficient",
                 [](QuadraticSpring& law, std::span<const double> v) {
                     checkValue(name, "force", v[0], "N", positive);
                     checkValue(name, "overlap", v[1], "m", positive);
                     law.coefficient = v[0] / (v[1] * v[1]);
                 }}};
    }

    struct Prepared {
        double coefficient;
    };
    [[nodiscard]] Prepared prepare() const { return {coefficient}; }
    template <class T>
    static NormalForce<T> force(const Prepared& p, const Contact<T>& contact) {
        return {p.coefficient * contact.overlap * contact.overlap, T(0)};
    }
    static double elasticEnergy(const Prepared& p, const Contact<double>& contact) {
        return p.coefficient * std::pow(contact.overlap, 3) / 3;
    }
    static double stiffness(const Prepared& p, const Contact<double>& contact) {
        return 2 * p.coefficient * contact.overlap;
    }
    static constexpr double elasticExponent = 2;
    static constexpr double dampingExponent = 0;
    [[nodiscard]] double range(const Bodies&) const { return 0; }
};

const RegisteredSpecies<Species<QuadraticSpring>> smooth;
const RegisteredSpecies<Species<QuadraticSpring, Mindlin>> rough;

}  // namespace
