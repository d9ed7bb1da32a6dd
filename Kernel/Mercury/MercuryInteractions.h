#pragma once

#include <iterator>
#include <memory>
#include <vector>

#include "Kernel/Contacts/ObservedContact.h"
#include "Kernel/Math/EigenConversion.h"
#include "Kernel/Mercury/MercuryFiles.h"
#include "Kernel/Particles/SphericalParticle.h"
#include "Kernel/Simulation/Scene.h"

namespace pendular {

/// A contact of the last step by MercuryDPM's names, for reading: interaction->getOverlap(). P is the first
/// grain, I the second one or the wall. Also "none", which is false.
class MercuryInteraction {
public:
    MercuryInteraction() = default;
    explicit MercuryInteraction(const ObservedContact& of) : contact(of), exists(true) {}

    [[nodiscard]] const MercuryInteraction* operator->() const { return this; }
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
    ObservedContact contact{};
    bool exists = false;
};

/// The contacts of a scene in the last step, in the order of identities: for (auto i : interactionHandler).
/// Each loop and each call takes them anew.
class MercuryInteractionHandler {
public:
    MercuryInteractionHandler(const Scene& ofScene, std::shared_ptr<MercurySettings> ofFiles)
        : scene(&ofScene), settings(std::move(ofFiles)) {}
    MercuryInteractionHandler(const MercuryInteractionHandler&) = delete;

    class Iterator {
    public:
        explicit Iterator(std::vector<ObservedContact> contacts)
            : all(std::make_shared<std::vector<ObservedContact>>(std::move(contacts))) {}
        MercuryInteraction operator*() const { return MercuryInteraction((*all)[at]); }
        Iterator& operator++() { return ++at, *this; }
        friend bool operator==(const Iterator& here, std::default_sentinel_t) {
            return here.at == here.all->size();
        }

    private:
        std::shared_ptr<std::vector<ObservedContact>> all;
        std::size_t at = 0;
    };
    [[nodiscard]] Iterator begin() const { return Iterator(scene->interactions()); }
    [[nodiscard]] static std::default_sentinel_t end() { return {}; }

    [[nodiscard]] std::size_t getNumberOfObjects() const { return scene->interactions().size(); }
    [[nodiscard]] std::size_t getSize() const { return getNumberOfObjects(); }
    /// Throw InputError where there is none.
    [[nodiscard]] MercuryInteraction getObject(std::size_t number) const;
    [[nodiscard]] MercuryInteraction getLastObject() const;
    /// The contact of two grains; false where they have none. (MercuryDPM would make one.)
    [[nodiscard]] MercuryInteraction getInteraction(const GrainReference& one,
                                                    const GrainReference& other) const;

    /// Files for ParaView, of grains, contacts and walls together: addOutput(ParaViewOutput()).
    void setWriteVTK(bool write = true) { settings->picturesOfContacts = write; }
    void setWriteVTK(FileType type) { setWriteVTK(type != FileType::NO_FILE); }

    /// The contact of a grain with a wall, at the part of it that it overlaps most; false where it has none.
    [[nodiscard]] MercuryInteraction getInteraction(const GrainReference& grain, const Wall* wall) const;

private:
    const Scene* scene;
    std::shared_ptr<MercurySettings> settings;
};

}  // namespace pendular
