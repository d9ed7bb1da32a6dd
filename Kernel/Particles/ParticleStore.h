#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "Kernel/LargePages.h"
#include "Kernel/Math/Vector.h"
#include "Kernel/State/StateArchive.h"

namespace pendular {

/// What every contact reads of a grain: one cache line.
struct alignas(64) TranslationRecord {
    Vector<double> position;  // m
    double radius;            // m
    Vector<double> velocity;  // m/s
    double inverseMass;       // 1/kg; 0: the grain is held in place
};
static_assert(sizeof(TranslationRecord) == 64);

/// What contacts with friction read of a grain besides, and its angular motion: one cache line.
struct alignas(64) RotationRecord {
    Vector<double> spin;                 // rad/s
    double inverseInertia;               // 1/(kg m^2), of a solid sphere
    Vector<double> angularAcceleration;  // rad/s^2, of the last step
    double unused = 0;
};
static_assert(sizeof(RotationRecord) == 64);

/// The accelerations of the step before the last, for integrators of higher order.
struct EarlierAcceleration {
    Vector<double> acceleration{0, 0, 0};         // m/s^2
    Vector<double> angularAcceleration{0, 0, 0};  // rad/s^2
};

/// Bytes of memory that vectors have taken.
template <class... Values>
std::size_t bytesOf(const std::vector<Values>&... columns) {
    return (... + (columns.capacity() * sizeof(Values)));
}

/// The grains of a scene, as columns. Their order is that of space, and changes when neighbours are searched
/// anew; the identity (the number in the order of adding) stays. Without spin there is no rotation column.
template <bool hasSpin>
class ParticleStore {
public:
    std::vector<TranslationRecord> translation;
    std::vector<RotationRecord> rotation;      // empty without spin
    std::vector<Vector<double>> acceleration;  // m/s^2, of the last step
    std::vector<EarlierAcceleration> earlier;  // empty unless the integrator needs it
    std::vector<std::uint16_t> species;
    std::vector<std::uint32_t> identity;  // of the grain at a place
    std::vector<std::uint32_t> place;     // of the grain with an identity

    [[nodiscard]] std::size_t size() const { return translation.size(); }
    /// Of memory that the grains take.
    [[nodiscard]] std::size_t bytes() const {
        return bytesOf(translation, rotation, acceleration, earlier, species, identity, place);
    }

    /// m; infinite without grains.
    [[nodiscard]] double smallestRadius() const {
        double smallest = infinity;
        for (const TranslationRecord& grain : translation) smallest = std::min(smallest, grain.radius);
        return smallest;
    }

    void reserve(std::size_t count) {
        reserveLarge(translation, count);
        if constexpr (hasSpin) reserveLarge(rotation, count);
        reserveLarge(acceleration, count);
        reserveLarge(species, count);
        reserveLarge(identity, count);
        reserveLarge(place, count);
    }

    /// Adds a grain; returns its identity.
    std::uint32_t add(const TranslationRecord& grain, const Vector<double>& spin,
                      std::uint16_t speciesIndex) {
        const auto number = static_cast<std::uint32_t>(size());
        translation.push_back(grain);
        acceleration.push_back({0, 0, 0});
        if (!earlier.empty()) earlier.push_back({});
        species.push_back(speciesIndex);
        identity.push_back(number);
        place.push_back(number);
        if constexpr (hasSpin)
            rotation.push_back({spin, 2.5 * grain.inverseMass / (grain.radius * grain.radius), {0, 0, 0}});
        return number;
    }

    /// Puts the grain at order[k] to place k, for all k.
    void reorder(const std::vector<std::uint32_t>& order) {
        permute(translation, order);
        permute(acceleration, order);
        permute(species, order);
        permute(identity, order);
        if constexpr (hasSpin) permute(rotation, order);
        if (!earlier.empty()) permute(earlier, order);
        for (std::size_t k = 0; k < identity.size(); ++k) place[identity[k]] = static_cast<std::uint32_t>(k);
    }

    void visitState(StateArchive& archive) {
        auto& [t, r, a, e, s, i, p] = *this;  // a member that is added has to be added here
        archive.column<double>("translation", t);
        archive.column<double>("rotation", r);
        archive.column<double>("acceleration", a);
        archive.column<double>("earlier", e);
        archive.column<std::uint16_t>("species", s);
        archive.column<std::uint32_t>("identity", i);
        archive.column<std::uint32_t>("place", p);
        requireWhole(archive);
    }

private:
    void requireWhole(const StateArchive& archive) const {
        constexpr std::string_view rows = "has another number of rows than particles/translation";
        const std::size_t count = size();
        archive.require(rotation.size() == (hasSpin ? count : 0), "rotation", rows);
        archive.require(acceleration.size() == count, "acceleration", rows);
        archive.require(earlier.empty() || earlier.size() == count, "earlier", rows);
        archive.require(species.size() == count, "species", rows);
        archive.require(identity.size() == count, "identity", rows);
        archive.require(place.size() == count, "place", rows);
        archive.requireFinite("translation", translation);
        archive.requireFinite("rotation", rotation);
        archive.requireFinite("acceleration", acceleration);
        archive.requireFinite("earlier", earlier);
        for (const TranslationRecord& grain : translation)
            archive.require(grain.radius > 0 && grain.inverseMass >= 0, "translation",
                            "has a radius or a mass that is not positive");
        for (std::size_t k = 0; k < count; ++k)
            archive.require(identity[k] < count && place[identity[k]] == k, "place",
                            "is not the inverse of particles/identity");
    }

    template <class Value>
    static void permute(std::vector<Value>& column, const std::vector<std::uint32_t>& order) {
        std::vector<Value> sorted;
        reserveLarge(sorted, column.size());
        sorted.resize(column.size());
        for (std::size_t k = 0; k < order.size(); ++k) sorted[k] = column[order[k]];
        column.swap(sorted);
    }
};

}  // namespace pendular
