#include <fmt/format.h>

#include "Kernel/Features/Bonds/BondPart.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

/// The part of the scene, which has one from its first material on.
BondPart& bondsToBe(PythonScene& scene) {
    if (!scene.bonds) scene.bonds = &scene.scene().addPart<BondPart>();
    return *scene.bonds;
}

const BondPart& bondsOf(const PythonScene& scene) {
    if (scene.bonds) return *scene.bonds;
    throw InputError("This scene has no bonds; add_bond_material() says what they are to be made of.");
}

using Stiffness = std::function<BondStiffness(const BondSection&, double)>;

/// A function of Python: the length (m) gives four stiffnesses.
Stiffness stiffnessBy(PythonScene& scene, py::function function) {
    return [kept = scene.keep(std::move(function)), &scene](const BondSection&, double length) {
        return scene.ask([&] {
            const Doubles k = arrayOrNone<Doubles>((*kept)(length));
            if (!k || k.size() != 4) {
                throw InputError(
                    "The function stiffness of a bond material must return four numbers: normal, shear "
                    "(N/m), bending and twist (N m/rad).");
            }
            return BondStiffness{k.data()[0], k.data()[1], k.data()[2], k.data()[3]};
        });
    };
}

Stiffness stiffnessOf(PythonScene& scene, std::optional<double> young, std::optional<double> shear,
                      std::optional<double> shearShare, std::optional<double> normalPerArea,
                      std::optional<double> shearPerArea, std::optional<py::function> function) {
    const bool isBeam = young && shear, isParallel = normalPerArea && shearPerArea;
    const bool hasHalf =
        young.has_value() != shear.has_value() || normalPerArea.has_value() != shearPerArea.has_value();
    if (hasHalf || isBeam + isParallel + function.has_value() != 1)
        throw InputError(
            "add_bond_material() takes young_modulus and shear_modulus (Pa) of a beam, or normal_stiffness "
            "and shear_stiffness (Pa/m) of a parallel bond, or a function stiffness.");
    if (shearShare && !isBeam)
        throw InputError(
            "add_bond_material(): shear_share is of a beam, with young_modulus and shear_modulus (Pa); leave "
            "it out.");
    if (function) return stiffnessBy(scene, std::move(*function));
    constexpr std::string_view owner = "bond material";
    if (isParallel) {
        checkValue(owner, "normal_stiffness", *normalPerArea, "Pa/m", positive);
        checkValue(owner, "shear_stiffness", *shearPerArea, "Pa/m", notNegative);
        return [=](const BondSection& s, double) { return parallelBond(*normalPerArea, *shearPerArea, s); };
    }
    checkValue(owner, "young_modulus", *young, "Pa", positive);
    checkValue(owner, "shear_modulus", *shear, "Pa", positive);
    const double share = shearShare.value_or(0.9);
    if (!(share > 0))
        throw InputError(
            fmt::format("bond material: shear_share = {:g}; it must be greater than 0, or infinite.", share));
    return [=](const BondSection& s, double length) { return beamBond(*young, *shear, share, s, length); };
}

std::size_t addMaterial(PythonScene& scene, double radius, std::optional<double> young,
                        std::optional<double> shear, std::optional<double> shearShare,
                        std::optional<double> normalPerArea, std::optional<double> shearPerArea,
                        std::optional<py::function> stiffness, double tensileStrength, double shearStrength,
                        double momentShare, bool atEnds, double damping) {
    const BondMaterial material{
        radius,
        stiffnessOf(scene, young, shear, shearShare, normalPerArea, shearPerArea, std::move(stiffness)),
        {tensileStrength, shearStrength, momentShare, atEnds},
        damping};
    return bondsToBe(scene).addMaterial(material);
}

void bond(PythonScene& scene, const ArrayLike& first, const ArrayLike& second, std::size_t material,
          double length) {
    static_cast<void>(bondsOf(scene));
    const std::vector<std::uint32_t> a = identitiesOf(first, "first"), b = identitiesOf(second, "second");
    if (a.size() != b.size())
        throw InputError(fmt::format("bond() joins first[k] and second[k]; they have {} and {} identities.",
                                     a.size(), b.size()));
    for (const auto* const identities : {&a, &b})  // all or none
        for (const std::uint32_t identity : *identities)
            static_cast<void>(scene.scene().particleHandler.getObject(identity));
    for (std::size_t k = 0; k < a.size(); ++k) scene.bonds->join(a[k], b[k], material, length);
}

py::dict bonds(const PythonScene& scene) {
    std::vector<std::int64_t> first, second, material;
    std::vector<double> length;
    std::vector<Vector<double>> force, torque1, torque2;
    for (const BondPart::Bond& bond : bondsOf(scene).all()) {
        const BondLoad load = bond.elastic + bond.damping;
        first.push_back(bond.first), second.push_back(bond.second), material.push_back(bond.material);
        length.push_back(bond.length), force.push_back(load.force);
        torque1.push_back(load.torque1), torque2.push_back(load.torque2);
    }
    py::dict made;
    made["particle1"] = arrayOf(std::move(first)), made["particle2"] = arrayOf(std::move(second));
    made["material"] = arrayOf(std::move(material)), made["length_m"] = arrayOf(std::move(length));
    made["force_N"] = arrayOf(std::move(force));
    made["torque1_Nm"] = arrayOf(std::move(torque1)), made["torque2_Nm"] = arrayOf(std::move(torque2));
    return made;
}

Doubles orientation(const PythonScene& scene, std::uint32_t identity) {
    const Quaternion q = bondsOf(scene).orientationOf(identity);
    Doubles made(4);
    double* const to = made.mutable_data();
    to[0] = q.real, to[1] = q.imaginary.x, to[2] = q.imaginary.y, to[3] = q.imaginary.z;
    return made;
}

}  // namespace

void bindBonds(SceneClass& scene) {
    scene
        .def("add_bond_material", &addMaterial, py::arg("radius"), py::kw_only(),
             py::arg("young_modulus") = py::none(), py::arg("shear_modulus") = py::none(),
             py::arg("shear_share") = py::none(), py::arg("normal_stiffness") = py::none(),
             py::arg("shear_stiffness") = py::none(), py::arg("stiffness") = py::none(),
             py::arg("tensile_strength") = infinity, py::arg("shear_strength") = infinity,
             py::arg("moment_share") = 1.0, py::arg("at_ends") = true, py::arg("damping") = 0.0,
             "What bonds are made of; returns its number for bond(). At set-up the first one.\n\n"
             "radius: m, of the round section. Its stiffness is that of Timoshenko's beam (young_modulus "
             "and shear_modulus, Pa; shear_share: 0.9 without it, infinite for Euler's), or of a parallel "
             "bond of "
             "Potyondy and Cundall (normal_stiffness and shear_stiffness, Pa/m), or stiffness(length) "
             "returns the normal, shear (N/m), bending and twist (N m/rad) one. It breaks at "
             "tensile_strength or shear_strength (Pa) at the rim; moment_share (0 to 1): how much moments "
             "count; at_ends: the larger bending moment of its ends counts, else that in its middle. "
             "damping: of the critical one. Raises InputError.")
        .def("bond", &bond, py::arg("first"), py::arg("second"), py::arg("material"), py::arg("length") = 0.0,
             comment("BondPart::join",
                     "first, second: N identities each, of which first[k] is joined with second[k]. "
                     "material: the number that add_bond_material() has returned. length: m, at rest; 0: "
                     "the distance at which they are."))
        .def("bonds", &bonds,
             "Columns of all bonds that hold: particle1, particle2, material, length_m (at rest); of the "
             "last step force_N (on particle2), torque1_Nm (on particle1) and torque2_Nm.")
        .def_property_readonly(
            "broken_bonds", [](const PythonScene& s) { return bondsOf(s).broken(); },
            "How many bonds have broken.")
        .def("bonded_orientation", &orientation, py::arg("identity"),
             comment("BondPart::orientationOf", "identity: of the grain. A quaternion w, x, y, z."));
}

}  // namespace pendular::python
