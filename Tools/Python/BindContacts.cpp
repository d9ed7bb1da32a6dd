#include <fmt/format.h>

#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

py::dict contacts(const PythonScene& scene) {
    scene.requireRows("contacts()");
    std::vector<PolyDataField> fields;
    {
        const PythonScene::WithoutPython others(scene);
        const Scene& of = scene.scene();
        of.warnOfUnlistedContacts();
        fields = contactFields(of.contacts(), of.particleHandler.store(), of.laws(), true,
                               of.getNumberOfThreads());
    }
    py::dict made;
    for (PolyDataField& field : fields) made[py::str(field.name)] = arrayOf(std::move(field));
    return made;
}

/// As arrays have it: -1 at a wall.
std::int64_t partnerOf(std::uint32_t particle2, std::uint32_t none) {
    return particle2 == none ? std::int64_t{-1} : std::int64_t{particle2};
}

/// The contacts of one grain, which are a few: without a look at all others.
py::dict contactsOf(const PythonScene& scene, std::size_t identity) {
    const std::vector<ObservedContact> seen = scene.scene().interactionsOf(identity);
    const auto column = [&](auto&& of) {
        std::vector<std::decay_t<decltype(of(seen.front()))>> values;
        for (const ObservedContact& one : seen) values.push_back(of(one));
        return arrayOf(std::move(values));
    };
    py::dict made;
    made["particle1"] = column([](const ObservedContact& c) { return std::int64_t{c.particle1}; });
    made["particle2"] =
        column([](const ObservedContact& c) { return partnerOf(c.particle2, ObservedContact::none); });
    made["wall"] = column([](const ObservedContact& c) { return static_cast<std::int64_t>(c.wall); });
    made["force_N"] = column([](const ObservedContact& c) { return c.force; });
    made["normal_force_N"] = column([](const ObservedContact& c) { return c.normalForce; });
    made["adhesive_force_N"] = column([](const ObservedContact& c) { return c.adhesiveForce; });
    made["tangential_force_N"] = column([](const ObservedContact& c) { return norm(c.tangentialForce()); });
    made["overlap_m"] = column([](const ObservedContact& c) { return c.overlap(); });
    made["contact_point_m"] = column([](const ObservedContact& c) { return c.point; });
    made["bridged"] = column([](const ObservedContact& c) { return std::int64_t{c.bridged}; });
    made["bridge_volume_m3"] = column([](const ObservedContact& c) { return c.bridgeVolume; });
    return made;
}

void requireListening(const PythonScene& scene) {
    if (!scene.scene().contacts().events().isListening())
        throw InputError("The scene does not listen to contacts; call listen_to_contacts() before.");
}

py::dict takeEvents(PythonScene& scene) {
    if (scene.events.empty()) requireListening(scene);
    const std::size_t count = scene.events.size();
    std::vector<double> time(count);
    std::vector<std::int64_t> first(count), second(count), wall(count), kind(count);
    for (std::size_t k = 0; k < count; ++k) {
        const auto& [when, event] = scene.events[k];
        time[k] = when, first[k] = event.particle1;
        second[k] = partnerOf(event.particle2, ContactEvent::none);
        wall[k] = event.wall, kind[k] = static_cast<std::int64_t>(event.kind);
    }
    scene.events.clear();
    py::dict made;
    made["time_s"] = arrayOf(std::move(time));
    made["particle1"] = arrayOf(std::move(first)), made["particle2"] = arrayOf(std::move(second));
    made["wall"] = arrayOf(std::move(wall)), made["kind"] = arrayOf(std::move(kind));
    return made;
}

ContactColumnReference& columnNamed(PythonScene& scene, const std::string& name) {
    const auto found = scene.contactColumns.find(name);
    if (found != scene.contactColumns.end()) return found->second;
    std::vector<std::string_view> names;
    for (const auto& [known, column] : scene.contactColumns) names.push_back(known);
    if (names.empty())
        throw InputError("Contacts have no columns of their own; add one with add_contact_column().");
    unknownName("column of contacts", name, names);
}

void setContactColumn(PythonScene& scene, const std::string& name, const ArrayLike& values) {
    ContactColumnReference& column = columnNamed(scene, name);
    scene.requireRows("set_contact_column()");
    const std::vector<ObservedContact> seen = scene.scene().ownInteractions();
    const PerGrain rows(values, name, 1, static_cast<py::ssize_t>(seen.size()));
    for (std::size_t k = 0; k < seen.size(); ++k) column[seen[k]] = rows.number(static_cast<py::ssize_t>(k));
}

}  // namespace

void bindContacts(SceneClass& scene) {
    scene
        .def("contacts", &contacts,
             "Columns of all contacts that have a force, in the order of identities, as of the last step, "
             "by the names that they have in the HDF5 files: particle1, particle2 (-1 at a wall), wall (-1 "
             "between grains), force_N (on particle1, N x 3), normal_force_N, adhesive_force_N, overlap_m, "
             "contact_point_m, ...")
        .def("contacts_of", &contactsOf, py::arg("identity"),
             "The contacts of one grain, by its identity, as contacts() has them: particle1, particle2, "
             "wall, force_N (on particle1), normal_force_N, adhesive_force_N, tangential_force_N, "
             "overlap_m, contact_point_m, bridged and bridge_volume_m3. Raises InputError where there is no "
             "such grain.")
        .def(
            "listen_to_contacts", [](PythonScene& s, bool listen) { s.scene().listenToContacts(listen); },
            py::arg("listen") = true, comment("Scene::listenToContacts", "listen: or no more."))
        .def("take_events", &takeEvents,
             "Columns of the contact events since they were last taken: time_s, particle1, particle2 (-1 at "
             "a wall), wall (-1 between grains), kind (0: a touch begins, 1: it ends, 2: a bridge forms, 3: "
             "it ruptures). After listen_to_contacts().")
        .def(
            "event_counts",
            [](const PythonScene& s) {
                requireListening(s);
                const ContactEventCounts counts = s.scene().contactEventCounts();
                py::dict made;
                made["touches_begun"] = counts.touchesBegun, made["touches_ended"] = counts.touchesEnded;
                made["bridges_formed"] = counts.bridgesFormed,
                made["bridges_ruptured"] = counts.bridgesRuptured;
                return made;
            },
            comment("ContactEventCounts",
                    "touches_begun, touches_ended, bridges_formed and bridges_ruptured."))
        .def(
            "add_contact_column",
            [](PythonScene& s, const std::string& name, const std::string& unit, double initial) {
                s.contactColumns.insert_or_assign(name, s.scene().addContactColumn(name, unit, initial));
            },
            py::arg("name"), py::arg("unit") = "", py::arg("initial") = 0.0,
            comment("Scene::addContactColumn", "name, unit: words; initial: its first value."))
        .def("set_contact_column", &setContactColumn, py::arg("name"), py::arg("values"),
             "Sets what add_contact_column() keeps under this name. values: one number, or one for each row "
             "of contacts(), which has it as NAME_UNIT.");
}

}  // namespace pendular::python
