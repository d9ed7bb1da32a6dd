#pragma once

#include <map>
#include <string>
#include <vector>

#include "SelfTests/Fuzz/RandomScenes/Making.h"
#include "SelfTests/Support/UnlistedTouches.h"

namespace pendular::fuzz {

/// Looks at a scene in its steps, and tells what must hold and does not: everything is a number, energy and
/// liquid are accounted for, momentum stays where nothing outside acts, grains stay in a closed box, held
/// ones where they are, and bodies that touch are listed.
class Watch {
public:
    /// @param isRight no value of the scene is wrong
    Watch(const Making& of, bool isRight) : making(of), right(isRight) {}

    /// Before the first step.
    void begin();
    /// After a step.
    void look();
    /// After a step, before something is changed.
    void lookAtList();
    /// "energy ledger: ..."; the first of each kind.
    [[nodiscard]] const std::vector<std::string>& faults() const { return found; }

private:
    /// The sums by which round-off is measured.
    struct Sizes {
        double momentum = 0, angularMomentum = 0;  // sum of m |v|; of m |x| |v| + I |w|
        double force = 0, torque = 0;              // N, N m: of |F|, |F| |x| of all contacts
        double speed = 0, energy = 0;              // m/s, of the fastest; J, of |entries of the ledger|
        void raiseTo(const Sizes& other);
    };

    void lookAtNumbers();
    void lookAtMomentum();
    void lookAtEnergy();
    void lookAtLiquid();
    void lookAtPlaces();
    void lookAtHeld();
    [[nodiscard]] Sizes sizesNow() const;
    [[nodiscard]] Vector<double> angularMomentumNow() const;
    /// 2^-53 times the steps so far.
    [[nodiscard]] double roundOff() const;
    void tell(std::string_view kind, const std::string& what);

    const Making& making;
    bool right;
    bool hasBegun = false;
    Vector<double> firstMomentum{0, 0, 0}, firstAngularMomentum{0, 0, 0};
    std::map<std::uint32_t, Vec3D> heldAt;  // m, of grains that are held and do not move
    Sizes largest;
    std::size_t firstStep = 0;
    std::vector<std::string> found;
    support::UnlistedTouches unlisted;
};

}  // namespace pendular::fuzz
