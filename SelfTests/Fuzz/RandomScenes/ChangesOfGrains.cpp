// What hooks do to grains in the run.
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

/// One to three times in the run, something to some grain.
template <class Prepare>
void changeSome(Making& making, Prepare&& prepare) {
    for (int k = making.draw.whole(1, 3); k > 0; --k) {
        const auto change = prepare();
        const double which = making.draw.even(0, 1);
        making.before(making.someStep(), [&making, change, which] {
            if (auto grain = making.someGrain(which)) change(*grain);
        });
    }
}

/// A smaller one may come to the scene's step.
void expectSmaller(Making& making, double share) {
    for (AnySpecies* const material : making.materials) {
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setRadius(share * making.scales.radius);
        making.grainsToCome.push_back(grain);
    }
}

void addRadius(Making& making) {
    expectSmaller(making, making.scales.touching ? 0.9 : 0.09);
    changeSome(making, [&] {
        const double factor = making.draw.give("factor", making.draw.even(0.93, 1.005));
        return [factor](GrainReference& grain) { grain.setRadius(factor * grain.getRadius()); };
    });
}

void addSpeciesOfGrain(Making& making) {
    changeSome(making, [&] {
        AnySpecies* const material = making.anyMaterial();
        return [material](GrainReference& grain) { grain.setSpecies(material); };
    });
}

void addVelocity(Making& making) {
    changeSome(making, [&] {
        const Vec3D velocity =
            making.draw.give("velocity", Vec3D(making.scales.speed * making.draw.inCube(1)));
        const Vec3D spin =
            making.draw.give("spin", Vec3D(making.draw.inCube(making.scales.speed / making.scales.radius)));
        return [velocity, spin](GrainReference& grain) {
            if (grain.isFixed()) return;  // it would go through walls
            grain.setVelocity(velocity), grain.setAngularVelocity(spin);
        };
    });
}

/// Moves a grain by a part of its radius that it may overlap its neighbours by.
void addPosition(Making& making) {
    changeSome(making, [&] {
        const Vec3D shift = making.draw.give("shift", Vec3D(making.draw.inCube(0.01 * making.scales.radius)));
        return [shift](GrainReference& grain) { grain.setPosition(grain.getPosition() + shift); };
    });
}

void addHold(Making& making) {
    changeSome(making, [&] { return [](GrainReference& grain) { grain.fixParticle(!grain.isFixed()); }; });
}

void addRemove(Making& making) {
    for (int k = making.draw.whole(1, 4); k > 0; --k) {
        const double which = making.draw.even(0, 1);
        making.before(making.someStep(), [&making, which] {
            if (const auto grain = making.someGrain(which))
                making.scene.particleHandler.removeObject(grain->getId());
        });
    }
}

/// Above all others, where there is room.
void addAdd(Making& making) {
    const int count = making.draw.whole(1, 3);
    for (int k = 0; k < count; ++k) {
        SphericalParticle grain;
        grain.setSpecies(making.anyMaterial());
        grain.setRadius(making.draw.give("radius", making.draw.even(0.5, 0.95) * making.scales.radius));
        const Vec3D place(making.lowest.x() + (k + 0.5) * making.scales.cell,
                          making.lowest.y() + 0.5 * making.scales.cell,
                          making.top + 1.5 * making.scales.cell);
        grain.setPosition(making.draw.give("position", place));
        grain.setVelocity(making.draw.give("velocity", Vec3D(making.scales.speed * making.draw.inCube(1))));
        if (making.has("moving liquid") && making.draw.oneIn(2))
            grain.setLiquidVolume(making.draw.give("film", 0.5 * making.scales.liquid()));
        making.grainsToCome.push_back(grain);
        making.before(making.someStep(), [&making, grain] {
            for (const GrainReference other : making.scene.particleHandler)
                if ((other.getPosition() - grain.getPosition()).norm() <
                    other.getRadius() + grain.getRadius())
                    return;
            making.scene.particleHandler.copyAndAddObject(grain);
        });
    }
}

}  // namespace

std::vector<Feature> changeOfGrainFeatures() {
    constexpr unsigned both = momentum | angularMomentum;
    const auto change = [&](std::string name, double share, auto add) {
        return Feature{.name = std::move(name),
                       .share = share,
                       .add = add,
                       .loses = both,
                       .kinds = {"change", "change of grains"}};
    };
    std::vector<Feature> table{
        change("Radius", 0.08, addRadius),    change("SpeciesOfGrain", 0.08, addSpeciesOfGrain),
        change("Velocity", 0.1, addVelocity), change("Position", 0.06, addPosition),
        change("Hold", 0.08, addHold),        change("Remove", 0.12, addRemove),
        change("Add", 0.12, addAdd),
    };
    table.back().kinds.insert(table.back().kinds.end(), {"room", "comes in the run"});
    return table;
}

}  // namespace pendular::fuzz
