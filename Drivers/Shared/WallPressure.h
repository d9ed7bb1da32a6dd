#pragma once

#include <numbers>

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

/// The pressure of the grains in a vertical cylinder on its wall, over depth, as a mean of several states;
/// and Janssen's law. Source: Janssen (1895), Zeitschrift des VDI 39, 1045: with p = K s for the pressures p
/// on the wall and s on a horizontal plane, and a friction mu of the wall that is mobilised everywhere,
/// ds/d(depth) = g rho - 2 mu p / R, so p = K g rho l (1 - exp(-depth / l)), l = R / (2 mu K).
class WallPressure {
public:
    static constexpr std::size_t count = 12;  // layers

    /// K, mu and l of all layers together, so that the law has no free number; it tests that they are
    /// constant.
    struct Law {
        double ratio, friction, length;  // -, -, m
        double specificWeight;           // N/m^3, of the bed
        double shareOfWall;              // of the weight, that the wall bears

        /// Pa, at a depth (m)
        [[nodiscard]] double pressure(double depth) const {
            return ratio * specificWeight * length * (1 - std::exp(-depth / length));
        }
    };

    explicit WallPressure(double siloRadius) : radius(siloRadius) {}

    /// Adds the state after the last step. @param wall number of the cylinder, about z; the floor is at z = 0
    void sample(Scene& scene, int wall) {
        scene.gather();  // on several ranks, which all call this
        if (samples++ == 0) height = 2 * scene.getCentreOfMass().z();  // of an even bed
        for (const ObservedContact& seen : scene.interactions()) {
            if (seen.wall != wall) continue;
            at(seen.point.z).normal -= dot(seen.force, seen.normal());
            at(seen.point.z).shear += seen.force.z;
        }
        for (GrainReference grain : scene.particleHandler)
            at(grain.getPosition().z()).weight += scene.getGravity().norm() * grain.getMass();
    }
    [[nodiscard]] bool isEmpty() const { return samples == 0; }

    [[nodiscard]] Law law() const {
        Layer all;
        double planes = 0, above = 0;  // N, sums of the forces on planes in the middle of layers
        for (std::size_t k = count; k-- > 0;) {
            const Layer& layer = layers[k];
            all.normal += layer.normal, all.shear += layer.shear, all.weight += layer.weight;
            planes += above + 0.5 * (layer.weight - layer.shear);
            above += layer.weight - layer.shear;
        }
        const double area = std::numbers::pi * radius * radius;
        Law found{(all.normal / ring()) / (planes / area), all.shear / all.normal, 0,
                  all.weight / static_cast<double>(samples) / (area * height), all.shear / all.weight};
        found.length = 0.5 * radius / (found.friction * found.ratio);
        return found;
    }
    /// A table from the top down: measured pressures, Janssen's, and that of a liquid with the same K.
    void write(const std::string& path) const {
        CsvFile table(path, "depth_m,wall_pressure_Pa,wall_shear_Pa,janssen_Pa,hydrostatic_Pa");
        const Law janssen = law();
        for (std::size_t k = count; k-- > 0;) {
            const double depth = height * (1 - (static_cast<double>(k) + 0.5) / count);
            const double area = ring() * static_cast<double>(samples);
            table.row(depth, layers[k].normal / area, layers[k].shear / area, janssen.pressure(depth),
                      janssen.ratio * janssen.specificWeight * depth);
        }
        table.close();
    }
    void visitState(StateArchive& archive) {
        archive.value("samples", samples);
        archive.finite("bedHeight", height);
        archive.column<double>("layers", layers);
        archive.require(layers.size() == count, "layers", "has another number of layers");
    }

private:
    struct Layer {
        double normal = 0, shear = 0, weight = 0;  // N, sums over the samples
    };
    Layer& at(double z) {
        return layers[static_cast<std::size_t>(std::clamp(z / height, 0.0, 0.999) * count)];
    }
    /// m^2, of the wall at a layer
    [[nodiscard]] double ring() const { return 2 * std::numbers::pi * radius * height / count; }

    double radius;  // m
    std::vector<Layer> layers = std::vector<Layer>(count);
    double height = 0;  // m
    std::uint64_t samples = 0;
};

}  // namespace pendular
