#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <map>

#include "Kernel/Features/SpeciesByName/SeveralSpeciesLaws.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Scene/Collisions.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/SpeciesValues.h"

namespace pendular::python {

namespace {

/// A number for each collision, by its name in Python: all arrays have the same shape.
class NumbersOfCollisions {
public:
    explicit NumbersOfCollisions(const py::dict& given) {
        for (const auto& [name, numbers] : given)
            arrays.emplace(py::str(name), py::reinterpret_borrow<py::object>(numbers).cast<Doubles>());
        for (const auto& [name, numbers] : arrays) columns.emplace(name, numbers.data());
    }
    [[nodiscard]] bool has(std::string_view name) const { return columns.contains(name); }
    /// What is not given stays as it is.
    void take(std::string_view name, std::size_t collision, double& value) const {
        if (const auto found = columns.find(name); found != columns.end()) value = found->second[collision];
    }
    /// By the names of the kernel. @param value of a column, for the collision
    template <class Value>
    [[nodiscard]] Values values(const Value& value) const {
        Values all;
        for (const auto& [name, numbers] : columns) all[camelCase(name)] = value(numbers);
        nameYoungModulus(all);
        return all;
    }

private:
    std::map<std::string, Doubles, std::less<>> arrays;
    std::map<std::string, const double*, std::less<>> columns;
};

Collision collisionOf(const NumbersOfCollisions& numbers, std::size_t k, bool keepsEnergies) {
    Collision made{.keepsEnergies = keepsEnergies};
    numbers.take("radius", k, made.radius1);
    made.radius2 = made.radius1;
    numbers.take("radius2", k, made.radius2);
    numbers.take("normal_velocity", k, made.normalVelocity);
    numbers.take("tangential_velocity", k, made.tangentialVelocity);
    numbers.take("spin1", k, made.spin1);
    numbers.take("spin2", k, made.spin2);
    numbers.take("steps_in_contact", k, made.stepsInContact);
    if (numbers.has("time_step")) numbers.take("time_step", k, made.timeStep.emplace());
    return made;
}

/// The materials of many collisions: species of one type, with values that are numbers.
class Materials {
public:
    Materials(const std::string& type, const py::dict& values) : name(typeNamed(type)), numbers(values) {
        // A name that is unknown is so in all collisions.
        SpeciesHandlerOf<> species;
        checkNames(*species.addByName(name), numbers.values([](const double*) { return 1.0; }));
    }

    [[nodiscard]] CollisionOutcome collide(const Collision& collision, std::size_t k) const {
        SpeciesHandlerOf<> species;
        setValues(*species.addByName(name), numbers.values([k](const double* all) { return all[k]; }));
        SeveralSpeciesLaws laws(species);
        return pendular::collide(laws, collision);
    }

private:
    std::string name;
    NumbersOfCollisions numbers;
};

/// "Collision [1, 3]", where arrays have several axes.
std::string nameOf(std::size_t number, const std::vector<py::ssize_t>& shape) {
    if (shape.empty()) return "The collision";
    std::vector<std::size_t> place(shape.size());
    for (std::size_t axis = shape.size(); axis-- > 0;) {
        const auto length = static_cast<std::size_t>(shape[axis]);
        place[axis] = number % length, number /= length;
    }
    return fmt::format("Collision {}", place);
}

std::string_view nameOf(CollisionEnd end) {
    switch (end) {
        case CollisionEnd::Parted:
            return "parted";
        case CollisionEnd::DrawnBack:
            return "drawn back";
        case CollisionEnd::Creeps:
            return "creeps";
    }
    return "";
}

struct OutcomeColumn {
    const char* name;
    double CollisionOutcome::*member;
};
constexpr std::array outcomeColumns{
    OutcomeColumn{"restitution", &CollisionOutcome::restitution},
    OutcomeColumn{"tangential_restitution", &CollisionOutcome::tangentialRestitution},
    OutcomeColumn{"normal_velocity_after_m_per_s", &CollisionOutcome::partingVelocity},
    OutcomeColumn{"tangential_velocity_after_m_per_s", &CollisionOutcome::tangentialVelocity},
    OutcomeColumn{"spin1_after_rad_per_s", &CollisionOutcome::spin1},
    OutcomeColumn{"spin2_after_rad_per_s", &CollisionOutcome::spin2},
    OutcomeColumn{"contact_time_s", &CollisionOutcome::contactTime},
    OutcomeColumn{"duration_s", &CollisionOutcome::duration},
    OutcomeColumn{"largest_overlap_m", &CollisionOutcome::largestOverlap},
    OutcomeColumn{"largest_normal_force_N", &CollisionOutcome::largestNormalForce},
    OutcomeColumn{"largest_attraction_N", &CollisionOutcome::largestAttraction},
    OutcomeColumn{"largest_tangential_force_N", &CollisionOutcome::largestTangentialForce},
    OutcomeColumn{"rupture_distance_m", &CollisionOutcome::ruptureDistance},
    OutcomeColumn{"energy_before_J", &CollisionOutcome::energyBefore},
    OutcomeColumn{"energy_lost_J", &CollisionOutcome::energyLost},
    OutcomeColumn{"time_step_s", &CollisionOutcome::timeStep},
};

py::dict columnsOf(const std::vector<CollisionOutcome>& outcomes, const std::vector<py::ssize_t>& shape,
                   bool withEnergies) {
    const auto column = [&]<class Number>(Number, const auto& of) {
        std::vector<Number> values;
        values.reserve(outcomes.size());
        for (const CollisionOutcome& one : outcomes) values.push_back(static_cast<Number>(of(one)));
        return arrayOf(std::move(values), shape);
    };
    py::dict made;
    made["parted"] =
        column(std::uint8_t{}, [](const CollisionOutcome& o) { return o.parted(); }).attr("astype")("bool");
    py::list ends;
    for (const CollisionOutcome& one : outcomes) ends.append(std::string(nameOf(one.end)));
    made["end"] = py::array(ends).attr("astype")("U10").attr("reshape")(shape);
    for (const OutcomeColumn& one : outcomeColumns)
        made[one.name] = column(double{}, [&](const CollisionOutcome& o) { return o.*one.member; });
    made["steps"] = column(std::int64_t{}, [](const CollisionOutcome& o) { return o.steps; });
    if (!withEnergies) return made;
    for (const EnergyLedger::Entry& entry : EnergyLedger::entries())
        made[py::str(std::string(entry.name) + "_J")] =
            column(double{}, [&](const CollisionOutcome& o) { return (*o.energies).*entry.member; });
    return made;
}

py::dict collisions(const std::string& species, const py::dict& numbers, const py::dict& values,
                    const std::vector<py::ssize_t>& shape, int threads, bool keepsEnergies) {
    const NumbersOfCollisions given(numbers);
    const Materials materials(species, values);
    std::size_t count = 1;
    for (const py::ssize_t length : shape) count *= static_cast<std::size_t>(length);
    const std::vector<CollisionOutcome> outcomes = withoutPython([&] {
        return collideMany(
            count, threads,
            [&](std::size_t k) { return materials.collide(collisionOf(given, k, keepsEnergies), k); },
            [&](std::size_t k) { return nameOf(k, shape); });
    });
    return columnsOf(outcomes, shape, keepsEnergies);
}

}  // namespace

void bindCollisions(py::module_& module) {
    module.def("_collisions", &collisions, py::arg("species"), py::arg("numbers"), py::arg("values"),
               py::arg("shape"), py::arg("threads"), py::arg("energies"));
    module.def("_processor_count", &processorCount);
}

}  // namespace pendular::python
