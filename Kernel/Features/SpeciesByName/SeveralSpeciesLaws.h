#pragma once

#include <string>
#include <vector>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Features/SpeciesByName/SeveralSpeciesHandler.h"

namespace pendular {

/// The laws of a scene whose species are of several types: each pair is asked, and computed, by the laws of
/// its own type. A contact has room for what the pair of the largest layout remembers.
class SeveralSpeciesLaws final : public ContactLaws {
public:
    /// Until the species are known, grains keep a spin.
    explicit SeveralSpeciesLaws(SeveralSpeciesHandler& speciesHandler);

    /// Throws InputError, with what to do, where the pair has no laws.
    [[nodiscard]] const ContactLaws& ofPair(int a, int b) const override;

    [[nodiscard]] std::size_t speciesCount() const override { return species.getSize(); }
    [[nodiscard]] const SpeciesOwner* owner() const override { return &species; }
    [[nodiscard]] double density(std::size_t k) const override { return species.getObject(k)->getDensity(); }
    void mixAll() override;
    [[nodiscard]] bool hasChanges() const override { return species.hasChanges(); }
    void visitState(StateArchive& archive, bool& changedInRun) override {
        species.visitState(archive, changedInRun);
    }
    [[nodiscard]] std::vector<SetValues> setValues() override { return species.setValues(); }
    [[nodiscard]] std::vector<FieldValue> fields(int a, int b) const override {
        return ofPair(a, b).fields(a, b);
    }

    /// Zero where the pair has no laws: only two species of which no grain can touch the other may have none.
    [[nodiscard]] double range(int a, int b, const Bodies& bodies) const override;
    [[nodiscard]] std::optional<std::string> objection(int a, int b, const Bodies& bodies) const override {
        return ofPair(a, b).objection(a, b, bodies);
    }
    [[nodiscard]] ContactStiffness stiffness(int a, int b, const Bodies& bodies, double mass) const override {
        return ofPair(a, b).stiffness(a, b, bodies, mass);
    }
    void stiffnesses(int a, int b, std::span<const PressedPair> contacts,
                     std::span<ContactStiffness> found) const override {
        ofPair(a, b).stiffnesses(a, b, contacts, found);
    }
    /// Zero where the pair has no laws, as the range.
    [[nodiscard]] double normalStiffness(int a, int b, const Bodies& bodies, double overlap) const override {
        const ContactLaws* const laws = find(a, b);
        return laws ? laws->normalStiffness(a, b, bodies, overlap) : 0;
    }
    /// None where the pair has no laws.
    [[nodiscard]] ContactSpot contactSpot(int a, int b, const Bodies& bodies, double overlap) const override {
        const ContactLaws* const laws = find(a, b);
        return laws ? laws->contactSpot(a, b, bodies, overlap) : ContactSpot{};
    }
    [[nodiscard]] double largestOverlap(int a, int b) const override {
        const ContactLaws* const laws = find(a, b);
        return laws ? laws->largestOverlapInRun : 0;
    }
    [[nodiscard]] std::vector<std::pair<std::string_view, DomainLimit>> brokenLimits(
        int a, int b, const Bodies& bodies) const override {
        return ofPair(a, b).brokenLimits(a, b, bodies);
    }

    void prepareAdhesion(int a, int b, const Bodies& bodies, double* interaction) const override {
        ofPair(a, b).prepareAdhesion(a, b, bodies, interaction);
    }
    [[nodiscard]] double adhesiveForce(int a, int b, const double* interaction,
                                       double separation) const override {
        return ofPair(a, b).adhesiveForce(a, b, interaction, separation);
    }
    void turn(int a, int b, double* history, const FrameRotation<double>& rotation) const override {
        ofPair(a, b).turn(a, b, history, rotation);
    }
    [[nodiscard]] double springLength(int a, int b, const double* history) const override {
        return ofPair(a, b).springLength(a, b, history);
    }

    /// Zero for a dry pair beside wet ones.
    [[nodiscard]] std::optional<double> bridgeVolume(int a, int b) const override;

    [[nodiscard]] std::optional<LiquidRules> liquidRules(int a, int b) const override {
        const ContactLaws* const laws = find(a, b);
        return laws ? laws->liquidRules(a, b) : std::nullopt;
    }

    [[nodiscard]] double filmContactGap(int a, int b) const override {
        const ContactLaws* const laws = find(a, b);
        return laws ? laws->filmContactGap(a, b) : 0;
    }
    [[nodiscard]] double filmContactGap(int a, int b, const Bodies& bodies, double films) const override {
        return ofPair(a, b).filmContactGap(a, b, bodies, films);
    }
    void meetFilms(int a, int b, double* interaction, double gap, double start) const override {
        ofPair(a, b).meetFilms(a, b, interaction, gap, start);
    }

    void prepareBridge(int a, int b, const Bodies& bodies, double volume,
                       double* interaction) const override {
        ofPair(a, b).prepareBridge(a, b, bodies, volume, interaction);
    }
    void takeBridgeState(int a, int b, double* interaction, const double* before) const override {
        ofPair(a, b).takeBridgeState(a, b, interaction, before);
    }
    void checkGap(int a, int b, double* interaction, double separation, double roundOff) const override {
        ofPair(a, b).checkGap(a, b, interaction, separation, roundOff);
    }
    [[nodiscard]] double adhesionEnergy(int a, int b, const double* interaction,
                                        double separation) const override {
        return ofPair(a, b).adhesionEnergy(a, b, interaction, separation);
    }
    [[nodiscard]] BridgeSurface bridgeSurface(int a, int b, const Bodies& bodies, double volume,
                                              double separation, bool solved) const override {
        return ofPair(a, b).bridgeSurface(a, b, bodies, volume, separation, solved);
    }

    void prepare(const std::vector<Bucket>& buckets) override;
    [[nodiscard]] const ContactLaws& ofBucket(std::size_t bucket) const override {
        return *ofBuckets[bucket];
    }
    bool compute(const ContactTask& task) const override;

private:
    [[nodiscard]] const ContactLaws* find(int a, int b) const;

    SeveralSpeciesHandler& species;
    std::string joinedName, joinedFriction;
    bool hasBridges = false;
    std::vector<ContactLaws*> distinct;         // those that a pair has
    std::vector<const ContactLaws*> ofPairs;    // of species a with all, then of the next; null: none
    std::vector<const ContactLaws*> ofBuckets;  // of each bucket
};

}  // namespace pendular
