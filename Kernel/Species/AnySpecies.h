#pragma once

#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "Kernel/Species/Field.h"
#include "Kernel/State/StateArchive.h"

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

    /// Of the species type with these laws.
    [[nodiscard]] virtual std::string_view getName() const = 0;
    [[nodiscard]] virtual std::vector<NamedField> fields() = 0;

    /// Sets a field by its name, after the check that its table demands. Throws InputError, also if there is
    /// no such field: with the nearest names.
    virtual void set(std::string_view field, double value);
    [[nodiscard]] bool has(std::string_view field);
    [[nodiscard]] virtual double get(std::string_view field);
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
    [[nodiscard]] NamedField fieldOf(std::string_view name);
};

/// A species of a scene, whatever its type.
class AnySpecies : public AnyLaws {
public:
    [[nodiscard]] virtual int getIndex() const = 0;
    [[nodiscard]] double getDensity() const { return densityPlace(); }
    /// kg/m^3, where it is kept
    [[nodiscard]] virtual const double& densityPlace() const = 0;
    /// @param density kg/m^3
    virtual void setDensity(double density) = 0;
    /// The same as setDensity() for the field "density".
    void set(std::string_view field, double value) override;
    [[nodiscard]] double get(std::string_view field) override;

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
