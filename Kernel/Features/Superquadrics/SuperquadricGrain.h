#pragma once

#include "Kernel/Features/Superquadrics/ShapedGrain.h"
#include "Kernel/Features/Superquadrics/Superquadric.h"

namespace pendular {

/// A superquadric as a driver describes it, before it is added to a scene.
class SuperquadricGrain : public ShapedGrain {
public:
    /// Half lengths in m, exponents from 2 to 8. Throws InputError for others.
    explicit SuperquadricGrain(const Superquadric& of) : ShapedGrain("SuperquadricGrain"), shapeValue(of) {
        shapeValue.check("SuperquadricGrain");
        setRadiusAround(shapeValue.boundingRadius());
    }
    /// The same with all lengths times a factor.
    [[nodiscard]] SuperquadricGrain scaled(double factor) const {
        SuperquadricGrain copy(*this);
        for (const auto length : {&Superquadric::a, &Superquadric::b, &Superquadric::c})
            copy.shapeValue.*length *= factor;
        copy.setRadiusAround(copy.shapeValue.boundingRadius());
        return copy;
    }

    [[nodiscard]] const Superquadric& getShape() const { return shapeValue; }

private:
    Superquadric shapeValue;
};

}  // namespace pendular
