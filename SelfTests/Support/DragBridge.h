#pragma once

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular::support {

/// What one contact remembers of a drag bridge.
template <class T>
struct DragBridgeInteraction {
    T reach;              // m
    T normal;             // kg/s
    T sliding, coupling;  // kg/s
    T rolling;            // kg/s
    T age;                // s, since it formed

    [[nodiscard]] T force(T) const { return T(0); }
    [[nodiscard]] T range() const { return reach; }
    template <class Law>
    [[nodiscard]] BridgeResistance<T> resist(const Law&, const BridgeMotion<T>& motion) {
        age = select(motion.forms, T(0), age) + motion.step;
        return {normal, sliding, coupling * motion.asymmetry, rolling};
    }
    template <class Law>
    void takeState(const Law&, const DragBridgeInteraction& before) {
        age = before.age;
    }
    void checkGap(double, double) {}
};

/// A bridge for tests, that only resists: with coefficients that do not depend on the gap, so that its
/// motions have closed forms. It acts on all bodies within its reach, and knows how long it has done so.
template <BridgeResists what>
struct DragBridge {
    static constexpr std::string_view name = "DragBridge";
    static constexpr std::string_view summary = "resists motion, for tests";
    static constexpr std::string_view domain = "tests";
    static constexpr bool acts = true;
    static constexpr bool formsAtContact = false;
    static constexpr BridgeResists resists = what;

    double reach = unset;     // m
    double normal = unset;    // kg/s
    double sliding = unset;   // kg/s
    double coupling = unset;  // kg/s
    double rolling = unset;   // kg/s

    static constexpr auto fields() {
        using L = DragBridge;
        constexpr auto field = [](std::string_view of, double L::*member, std::string_view unit) {
            return Field<L>{of, member, unit, notNegative, Mixing::Geometric, "for tests", "this project"};
        };
        return std::array{field("reach", &L::reach, "m"), field("normal", &L::normal, "kg/s"),
                          field("sliding", &L::sliding, "kg/s"), field("coupling", &L::coupling, "kg/s"),
                          field("rolling", &L::rolling, "kg/s")};
    }

    template <class T>
    using Interaction = DragBridgeInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies&) const {
        return {reach, normal, sliding, coupling, rolling, 0};
    }
    [[nodiscard]] BridgeResistance<double> largestResistance(const Bodies&) const {
        return {normal, sliding, coupling, rolling};
    }
    /// m
    [[nodiscard]] double range(const Bodies&) const { return reach; }
};

}  // namespace pendular::support
