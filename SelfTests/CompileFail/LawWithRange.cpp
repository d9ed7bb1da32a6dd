// expect: success
// The law of LawWithoutRange.cpp, complete: what fails there is the missing range() and nothing else.

#include <array>

#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Species/Species.h"

struct Glue {
    static constexpr std::string_view name = "Glue";
    static constexpr std::string_view summary = "constant attraction";
    static constexpr std::string_view domain = "everywhere";
    static constexpr bool acts = true;
    static constexpr bool formsAtContact = true;

    double strength = pendular::unset;  // N

    static constexpr auto fields() {
        return std::to_array<pendular::Field<Glue>>({{"strength", &Glue::strength, "N", pendular::positive,
                                                      pendular::Mixing::Geometric, "attraction", "test"}});
    }
    template <class T>
    struct Interaction {
        T strength;
        T width;
        [[nodiscard]] T force(T) const { return strength; }
        [[nodiscard]] T range() const { return width; }
    };
    [[nodiscard]] Interaction<double> prepare(const pendular::Bodies&) const { return {strength, 1e-6}; }
    [[nodiscard]] double range(const pendular::Bodies&) const { return 1e-6; }
};

pendular::Species<pendular::HertzianViscoelastic, pendular::NoFriction, Glue> species;
