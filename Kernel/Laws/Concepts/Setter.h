#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

/// A value that a setter takes.
struct SetterValue {
    std::string_view name, unit;
    Range range;
};

/// A setter of a law that computes fields from other values. A law that has some gives them in a function
/// setters(). The setter of a field is called as the field is, and has no entry.
template <class Law>
struct Setter {
    std::string_view name;  // of the function, without its "set": "restitutionCoefficient"
    std::vector<SetterValue> values;
    std::string_view gives;
    void (*set)(Law&, std::span<const double>);  // which checks the values as is said here
    double (*get)(const Law&) = nullptr;         // where the law can say it from its fields
};

/// The setters of a law; none where it has none.
template <class Law>
auto settersOf() {
    if constexpr (requires { Law::setters(); }) return Law::setters();
    else return std::vector<Setter<Law>>();
}

/// Those of the parts that a law is made of, as one list.
template <class Law, class... Parts>
std::vector<Setter<Law>> joinedSetters() {
    std::vector<Setter<Law>> all;
    const auto add = [&]<class Part>(const Part*) {
        if constexpr (requires { Part::setters(); })
            for (const Setter<Law>& setter : Part::setters()) all.push_back(setter);
    };
    (add(static_cast<const Parts*>(nullptr)), ...);
    return all;
}

/// A setter with the law whose fields it sets, whatever that is.
struct NamedSetter {
    std::string_view law, name;
    std::vector<SetterValue> values;
    std::string_view gives;  // empty: the field of this name
    std::function<void(std::span<const double>)> set;
    std::function<double()> get;  // empty: it cannot be read
};

/// The setters of the three laws of a species or of a pair that have no field of their own.
template <class Mixed>
std::vector<NamedSetter> namedSetters(Mixed& laws) {
    std::vector<NamedSetter> found;
    laws.forEachLaw([&]<class Law>(Law& law) {
        for (const auto& setter : settersOf<Law>()) {
            found.push_back({Law::name,
                             setter.name,
                             setter.values,
                             setter.gives,
                             [&law, set = setter.set](std::span<const double> values) { set(law, values); },
                             {}});
            if (setter.get) found.back().get = [&law, get = setter.get] { return get(law); };
        }
    });
    return found;
}

}  // namespace pendular
