#pragma once

#include <iterator>
#include <memory>
#include <vector>

#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Mercury/MercuryBonds.h"
#include "Kernel/Mercury/MercuryFiles.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

/// A contact of the last step by MercuryDPM's names, for reading: interaction->getOverlap(). P is the first
/// grain, I the second one or the wall. Also "none", which is false.
class MercuryInteraction {
public:
    MercuryInteraction() = default;
    MercuryInteraction(const ObservedContact& of, MercuryBonds& ofScene)
        : contact(of),
          exists(true),
          pair{of.particle1, of.particle2, static_cast<std::int32_t>(of.wall)},
          bonds(&ofScene) {}
    /// Of a pair that has no contact yet, as before the first step.
    MercuryInteraction(const MercuryBonds::Pair& of, MercuryBonds& ofScene) : pair(of), bonds(&ofScene) {}

    [[nodiscard]] const MercuryInteraction* operator->() const { return this; }

    /// Joins its bodies, which have the adhesion law Bonded and overlap when the next step begins: with the
    /// force of their species, or with the one that acts now; unbond() lets them go.
    void bond() const { ask(-1); }
    void bondInPlace() const { ask(getAbsoluteNormalForce()); }
    void unbond() const { ask(0); }

    explicit operator bool() const { return exists; }

    /// The identities of the grains; of a wall, I is its number.
    [[nodiscard]] std::uint32_t getP() const { return contact.particle1; }
    [[nodiscard]] std::uint32_t getI() const {
        return isWithWall() ? static_cast<std::uint32_t>(contact.wall) : contact.particle2;
    }
    [[nodiscard]] bool isWithWall() const { return contact.wall >= 0; }
    [[nodiscard]] double getOverlap() const { return contact.overlap(); }  // m; negative of a gap
    /// m, of the centres; at a wall from the centre to the surface.
    [[nodiscard]] double getDistance() const { return norm(contact.shift); }
    /// Unit, from I to P.
    [[nodiscard]] Vec3D getNormal() const { return toEigen(-contact.normal()); }
    [[nodiscard]] Vec3D getContactPoint() const { return toEigen(contact.point); }                 // m
    [[nodiscard]] Vec3D getForce() const { return toEigen(contact.force); }                        // N, on P
    [[nodiscard]] Vec3D getTangentialForce() const { return toEigen(contact.tangentialForce()); }  // N, on P
    /// N: the size of the force along the normal, adhesion included.
    [[nodiscard]] double getAbsoluteNormalForce() const {
        return std::abs(dot(contact.force, contact.normal()));
    }
    [[nodiscard]] double getLiquidBridgeVolume() const { return contact.bridgeVolume; }  // m^3
    /// What the kernel says of it.
    [[nodiscard]] const ObservedContact& observed() const { return contact; }

private:
    void ask(double force) const {
        if (bonds) bonds->ask(pair, force);
    }

    ObservedContact contact{};
    bool exists = false;
    MercuryBonds::Pair pair{};
    MercuryBonds* bonds = nullptr;
};

/// The contacts of a scene in the last step, in the order of identities: for (auto i : interactionHandler).
/// Each loop and each call takes them anew.
class MercuryInteractionHandler {
public:
    MercuryInteractionHandler(const Scene& ofScene, std::shared_ptr<MercurySettings> ofFiles,
                              MercuryBonds& ofBonds)
        : scene(&ofScene), settings(std::move(ofFiles)), bonds(&ofBonds) {}
    MercuryInteractionHandler(const MercuryInteractionHandler&) = delete;

    class Iterator {
    public:
        Iterator(std::vector<ObservedContact> contacts, MercuryBonds& ofScene)
            : all(std::make_shared<std::vector<ObservedContact>>(std::move(contacts))), bonds(&ofScene) {}
        MercuryInteraction operator*() const { return {(*all)[at], *bonds}; }
        Iterator& operator++() { return ++at, *this; }
        friend bool operator==(const Iterator& here, std::default_sentinel_t) {
            return here.at == here.all->size();
        }

    private:
        std::shared_ptr<std::vector<ObservedContact>> all;
        MercuryBonds* bonds;
        std::size_t at = 0;
    };
    [[nodiscard]] Iterator begin() const { return {scene->interactions(), *bonds}; }
    [[nodiscard]] static std::default_sentinel_t end() { return {}; }

    [[nodiscard]] std::size_t getNumberOfObjects() const { return scene->interactions().size(); }
    [[nodiscard]] std::size_t getSize() const { return getNumberOfObjects(); }
    /// Throw InputError where there is none.
    [[nodiscard]] MercuryInteraction getObject(std::size_t number) const;
    [[nodiscard]] MercuryInteraction getLastObject() const;
    /// The contact of two grains; false where they have none, but they may be bonded. (MercuryDPM would make
    /// one, with the time that it takes.)
    MercuryInteraction getInteraction(const GrainReference& one, const GrainReference& other,
                                      double time = 0) const;

    /// Files for ParaView, of grains, contacts and walls together: addOutput(ParaViewOutput()).
    void setWriteVTK(bool write = true) { settings->picturesOfContacts = write; }
    void setWriteVTK(FileType type) { setWriteVTK(type != FileType::NO_FILE); }

    /// The contact of a grain with a wall, at the part of it that it overlaps most; false where it has none.
    MercuryInteraction getInteraction(const GrainReference& grain, const Wall* wall, double time = 0) const;

private:
    const Scene* scene;
    std::shared_ptr<MercurySettings> settings;
    MercuryBonds* bonds;
};

}  // namespace pendular
