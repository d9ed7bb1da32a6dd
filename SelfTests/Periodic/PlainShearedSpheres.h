#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"
#include "SelfTests/Support/Random.h"

namespace pendular::support {

/// Soft spheres in homogeneous shear, written as plainly as it goes and without the kernel, to compare it
/// with: every pair is looked at when the list is made, forces are added one by one, images are found by
/// division. Spheres of diameter 1 and density 1 in a cube, flow along x with gradient 1 along y (Lees and
/// Edwards (1972), J. Phys. C 5, 1921), linear springs with dashpots, velocity Verlet with the dashpot at the
/// end of the step.
class PlainShearedSpheres {
public:
    PlainShearedSpheres(double stiffness, double restitution, int edge, double solidFraction, double steps)
        : k(stiffness), length(edge * std::cbrt(std::numbers::pi / 6 / solidFraction)) {
        // e = exp(-b t) with the time of contact t = pi / sqrt(k / mu - b^2).
        const double logarithm = -std::log(restitution), frequency = std::sqrt(k / reduced);
        const double b = frequency * logarithm / std::hypot(std::numbers::pi, logarithm);
        dashpot = 2 * reduced * b;
        step = std::numbers::pi / std::sqrt(frequency * frequency - b * b) / steps;
        Random random(11);
        Vector<double> mean{0, 0, 0};
        for (int n = 0; n < edge * edge * edge; ++n) {
            const double spacing = length / edge;
            position.push_back(
                spacing * Vector<double>{n % edge + 0.5, n / edge % edge + 0.5, n / (edge * edge) + 0.5});
            const auto shaken = random.inCube(0.8);
            velocity.push_back({shaken.x() + flow(position.back()), shaken.y(), shaken.z()});
            mean += velocity.back();
        }
        for (auto& v : velocity) v = v - (1.0 / static_cast<double>(velocity.size())) * mean;
        acceleration.assign(velocity.size(), {0, 0, 0});
    }

    void advance(double strain) {
        for (const double end = time + strain; time < end;) advanceByStep();
    }
    [[nodiscard]] double getTimeStep() const { return step; }
    /// The pressure of contacts and motion over density x diameter^2 x rate^2, and the shear stress against
    /// the flow.
    [[nodiscard]] double pressure() const { return pressureSum / (3 * length * length * length); }
    [[nodiscard]] double shearStress() const { return -shearSum / (length * length * length); }

private:
    static constexpr double mass = std::numbers::pi / 6, reduced = mass / 2, skin = 0.25;

    [[nodiscard]] double flow(const Vector<double>& place) const { return place.y - 0.5 * length; }
    /// From b to a, to its nearest image; and by how much that image moves along x.
    std::array<double, 4> between(std::size_t a, std::size_t b) const {
        Vector<double> d = position[a] - position[b];
        const double faces = std::nearbyint(d.y / length);
        d.y -= faces * length;
        d.x -= faces * std::fmod(time * length, length);
        d.x -= length * std::nearbyint(d.x / length);
        d.z -= length * std::nearbyint(d.z / length);
        return {d.x, d.y, d.z, faces * length};
    }
    void list() {
        const double offset = std::fmod(time * length, length);
        for (std::size_t a = 0; a < position.size(); ++a) {
            const double faces = std::floor(position[a].y / length);
            position[a].y -= faces * length;
            position[a].x -= faces * offset;
            velocity[a].x -= faces * length;
            position[a].x -= length * std::floor(position[a].x / length);
            position[a].z -= length * std::floor(position[a].z / length);
        }
        pairs.clear();
        for (std::size_t a = 0; a < position.size(); ++a)
            for (std::size_t b = a + 1; b < position.size(); ++b) {
                const auto [x, y, z, moves] = between(a, b);
                if (x * x + y * y + z * z < (1 + skin) * (1 + skin)) pairs.push_back({a, b});
            }
    }
    void advanceByStep() {
        double fastest = 0;
        for (std::size_t a = 0; a < position.size(); ++a) {
            const Vector<double> own = velocity[a] - Vector<double>{flow(position[a]), 0, 0};
            fastest = std::max(fastest, squaredNorm(own));
            velocity[a] += (0.5 * step) * acceleration[a];
            position[a] += step * velocity[a];
        }
        time += step;
        approach += step * (2 * std::sqrt(fastest) + 1 + skin);  // and the difference of the flow over a pair
        if (!(approach < skin)) list(), approach = 0;

        pressureSum = shearSum = 0;
        acceleration.assign(velocity.size(), {0, 0, 0});
        for (const auto& [a, b] : pairs) {
            const auto [x, y, z, moves] = between(a, b);
            const double distance = std::sqrt(x * x + y * y + z * z);
            if (!(distance < 1)) continue;
            const Vector<double> normal = (1 / distance) * Vector<double>{x, y, z};
            const double apart = dot(velocity[a] - velocity[b] - Vector<double>{moves, 0, 0}, normal);
            const double spring = k * (1 - distance);
            // v = v_half + step / (2 mu) (spring - dashpot v), as if the pair were alone
            const double force = spring - dashpot * (apart + 0.5 * step / reduced * spring) /
                                              (1 + 0.5 * step / reduced * dashpot);
            acceleration[a] += (force / mass) * normal;
            acceleration[b] += (-force / mass) * normal;
            pressureSum += force * distance;
            shearSum += force * normal.x * y;
        }
        for (std::size_t a = 0; a < position.size(); ++a) {
            velocity[a] += (0.5 * step) * acceleration[a];
            const Vector<double> own = velocity[a] - Vector<double>{flow(position[a]), 0, 0};
            pressureSum += mass * squaredNorm(own);
            shearSum += mass * own.x * own.y;
        }
    }

    double k, length, dashpot = 0, step = 0, time = 0, approach = 1, pressureSum = 0, shearSum = 0;
    std::vector<Vector<double>> position, velocity, acceleration;
    std::vector<std::array<std::size_t, 2>> pairs;
};

}  // namespace pendular::support
