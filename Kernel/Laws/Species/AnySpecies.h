#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Laws/Concepts/Setter.h"
#include "Kernel/Laws/Species/SpeciesOwner.h"

namespace pendular {

/// A field of a law, with the place of its value.
struct NamedField {
    std::string_view law, name, unit;
    Range range;
    double* value;
};

/// The values of three laws, whatever they are: fields by their names, laws by their types.
class AnyLaws {
public:
    virtual ~AnyLaws() = default;

    /// The name of the species type with these laws.
    [[nodiscard]] virtual std::string_view getName() const = 0;
    [[nodiscard]] virtual std::vector<NamedField> fields() = 0;

    /// Setters that compute fields from other values.
    [[nodiscard]] virtual std::vector<NamedSetter> derivedSetters() { return {}; }

    /// All that can be set by its name: what values it takes, their units and ranges. The fields first, then
    /// the derived ones.
    [[nodiscard]] virtual std::vector<NamedSetter> setters();
    /// Sets a field, or calls a setter, by its name, after the check that its table demands. Throws
    /// InputError, also if there is no such name: with the nearest ones; and where it takes another number of
    /// values.
    void set(std::string_view name, double value) { set(name, {&value, 1}); }
    void set(std::string_view name, std::initializer_list<double> values) {
        set(name, {values.begin(), values.size()});
    }
    void set(std::string_view name, std::span<const double> values);
    [[nodiscard]] bool has(std::string_view field);
    /// A field, or what a setter of one value has set.
    [[nodiscard]] double get(std::string_view name);
    /// The law of this type, for its own functions; null if there is none.
    template <class Law>
    [[nodiscard]] Law* find() {
        return static_cast<Law*>(const_cast<void*>(lawOf(typeid(Law))));
    }
    template <class Law>
    [[nodiscard]] const Law* find() const {
        return static_cast<const Law*>(lawOf(typeid(Law)));
    }

    /// A run goes on with the values that it began with, or to which they have been changed during the run.
    virtual void visitState(StateArchive& archive, bool changedInRun);

private:
    [[nodiscard]] virtual const void* lawOf(const std::type_info& law) const = 0;
    [[nodiscard]] NamedSetter setterOf(std::string_view name);
};

/// A species of a scene, whatever its type.
class AnySpecies : public AnyLaws {
public:
    [[nodiscard]] virtual int getIndex() const = 0;
    /// The handler that has it.
    [[nodiscard]] virtual const SpeciesOwner* getOwner() const = 0;
    [[nodiscard]] double getDensity() const { return densityPlace(); }
    /// kg/m^3, where it is kept
    [[nodiscard]] virtual const double& densityPlace() const = 0;
    /// @param density kg/m^3
    virtual void setDensity(double density) = 0;
    /// The setters of the laws, and that of the density.
    [[nodiscard]] std::vector<NamedSetter> setters() override;

    /// Derives what is unset and follows from other values, in a copy, and checks that. Throws InputError.
    virtual void complete() = 0;
    /// The law of this type in that copy; null if the species has none.
    template <class Law>
    [[nodiscard]] const Law* findComplete() const {
        return static_cast<const Law*>(completeLawOf(typeid(Law)));
    }

    void visitState(StateArchive& archive, bool changedInRun) override;

private:
    [[nodiscard]] virtual const void* completeLawOf(const std::type_info& law) const = 0;
};

}  // namespace pendular
