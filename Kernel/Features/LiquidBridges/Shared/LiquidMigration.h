#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "Kernel/Features/LiquidBridges/BridgeSurface.h"
#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"
#include "Kernel/Laws/Concepts/JoinedName.h"
#include "Kernel/Laws/Concepts/LiquidRules.h"

namespace pendular {

/// The names of a bridge law whose liquid moves: LiquidBridgeBagheri becomes LiquidMigrationBagheri. A law
/// may say by a member `migratingName` what stands behind "LiquidMigration".
template <class Bridge>
struct MigrationNames {
    static constexpr std::string_view prefix = "LiquidMigration", bridgePrefix = "LiquidBridge";
    static constexpr std::string_view suffix = [] {
        if constexpr (requires { Bridge::migratingName; }) return Bridge::migratingName;
        else
            return Bridge::name.starts_with(bridgePrefix) ? Bridge::name.substr(bridgePrefix.size())
                                                          : Bridge::name;
    }();
    static constexpr std::string_view moves = "liquid that moves between films and bridges; ";

    static constexpr std::string_view name = JoinedName<prefix, suffix>::value;
    static constexpr std::string_view summary = JoinedName<moves, Bridge::summary>::value;
};

/// V* above which no bridge is accepted: the exact solutions (BridgeTable) go up to it.
inline constexpr double mostMigratingVolume = 0.5;
/// V* below which a bridge is prepared as one of this volume: the fits were made for no smaller ones.
inline constexpr double leastPreparedVolume = 1e-9;

/// What is wrong with the largest volume V_max of a bridge of this V*, if so.
std::optional<std::string> objectionToLargestVolume(std::string_view law, double volume,
                                                    const BridgeScales& scales);

/// Liquid that moves between films on the grains and bridges at their contacts, which have the force of the
/// law Bridge at the volume that each has at the moment. Kernel/Features/LiquidTransport/LiquidStep.h has the
/// model: that of LiquidMigrationWillet in Thornton et al., "Recent advances in MercuryDPM", section 5 (Mani,
/// Kadau, Or and Herrmann, Phys. Rev. Lett. 109 (2012) 248001).
///
/// What the law Bridge takes for the volume of all bridges is the largest one here, V_max: so its range is
/// the bound for the search, and its domain is checked at V_max. Each bridge is prepared by prepare(bodies,
/// volume), again when its volume changes, and ruptures at the rupture distance of the volume that it has.
template <class Bridge>
struct LiquidMigration : Bridge {
    static constexpr bool movesLiquid = true;
    static constexpr std::string_view name = MigrationNames<Bridge>::name;
    static constexpr std::string_view summary = MigrationNames<Bridge>::summary;

    double liquidBridgeVolumeMin = 0;    // V_min, m^3
    double distributionCoefficient = 1;  // c
    double wallLiquidVolume = 0;         // w, m^3
    double shareByRoom = 0;
    double shareWithDryContacts = 0;

    static constexpr auto fields() {
        using Law = LiquidMigration;
        constexpr std::string_view source = "Thornton et al., section 5; Mani et al. (2012)";
        constexpr auto ofBridge = [&] {
            constexpr auto table = Bridge::fields();
            std::array<Field<Law>, table.size()> own{};
            for (std::size_t k = 0; k < table.size(); ++k) {
                own[k] = table[k];
                if (own[k].name != "liquidBridgeVolume") continue;
                own[k].name = "liquidBridgeVolumeMax";
                own[k].meaning = "largest volume of a bridge; 0: none forms";
                own[k].source = source;
            }
            return own;
        }();
        constexpr auto added = std::to_array<Field<Law>>(
            {{"liquidBridgeVolumeMin", &Law::liquidBridgeVolumeMin, "m^3", notNegative, Mixing::Arithmetic,
              "two films form a bridge if they offer more than this together", source},
             {"distributionCoefficient", &Law::distributionCoefficient, "", fromZeroTo(1), Mixing::Arithmetic,
              "share of a ruptured bridge that is offered to the grains' other bridges; the rest goes to "
              "their "
              "films",
              source},
             {"wallLiquidVolume", &Law::wallLiquidVolume, "m^3", notNegative, Mixing::Largest,
              "volume that a wet wall offers to each bridge that forms at it; 0: walls are dry",
              "this project"},
             {"shareByRoom", &Law::shareByRoom, "", fromZeroTo(1), Mixing::Largest,
              "1: bridges are offered liquid in proportion to their room, V_max - V; 0: in equal parts",
              "Mani et al. (2013)"},
             {"shareWithDryContacts", &Law::shareWithDryContacts, "", fromZeroTo(1), Mixing::Largest,
              "1: touching contacts without a bridge are offered liquid, too; 0: bridges only",
              "this project"}});
        return joinedFields<Law>(ofBridge, added);
    }

    void setLiquidBridgeVolume(double) =
        delete;  // a bridge has a volume of its own: setLiquidBridgeVolumeMax
    void setLiquidBridgeVolumeMax(double value) {
        setField(*this, &LiquidMigration::liquidBridgeVolume, value);
    }
    void setContactAngle(double value) { setField(*this, &LiquidMigration::contactAngle, value); }
    void setSurfaceTension(double value) { setField(*this, &LiquidMigration::surfaceTension, value); }
    void setLiquidBridgeVolumeMin(double value) {
        setField(*this, &LiquidMigration::liquidBridgeVolumeMin, value);
    }
    void setDistributionCoefficient(double value) {
        setField(*this, &LiquidMigration::distributionCoefficient, value);
    }
    void setWallLiquidVolume(double value) { setField(*this, &LiquidMigration::wallLiquidVolume, value); }
    void setShareByRoom(bool value) { shareByRoom = value ? 1 : 0; }
    void setShareWithDryContacts(bool value) { shareWithDryContacts = value ? 1 : 0; }
    [[nodiscard]] double getLiquidBridgeVolumeMax() const { return this->liquidBridgeVolume; }
    [[nodiscard]] double getLiquidBridgeVolumeMin() const { return liquidBridgeVolumeMin; }
    [[nodiscard]] double getDistributionCoefficient() const { return distributionCoefficient; }
    [[nodiscard]] double getWallLiquidVolume() const { return wallLiquidVolume; }

    [[nodiscard]] LiquidRules liquidRules() const {
        return {.largest = this->liquidBridgeVolume,
                .least = liquidBridgeVolumeMin,
                .share = distributionCoefficient,
                .wallDose = wallLiquidVolume,
                .byRoom = shareByRoom > 0,
                .toDry = shareWithDryContacts > 0};
    }

    /// The limits of the law, and the largest volume for which the bridges of three grains in mutual touch do
    /// not meet: that of equal spheres of the same R.
    [[nodiscard]] std::vector<DomainLimit> domainLimits(const Bodies& bodies) const {
        std::vector<DomainLimit> limits = Bridge::domainLimits(bodies);
        if (this->liquidBridgeVolume > 0 && std::isfinite(bodies.radius1 + bodies.radius2))
            limits.push_back({"V_max/R^3 (above which bridges of three touching grains meet)",
                              this->scales(bodies).volume,
                              fromZeroTo(volumeWhereBridgesMeet(this->contactAngle))});
        return limits;
    }

    /// A contact without liquid.
    [[nodiscard]] auto prepare(const Bodies& bodies) const { return prepare(bodies, 0); }
    /// A bridge of this volume (m^3).
    [[nodiscard]] auto prepare(const Bodies& bodies, double volume) const {
        Bridge bridge = *this;
        bridge.liquidBridgeVolume = volume;
        if (volume == 0) return bridge.prepare(bodies);
        const double radius = 2 * bodies.effectiveRadius();
        bridge.liquidBridgeVolume = std::max(volume, leastPreparedVolume * radius * radius * radius);
        return bridge.prepare(bodies);
    }
    /// Why a bridge of the largest volume, or of a smaller one down to V* = 1e-6, cannot be between these
    /// bodies, if so.
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const {
        if (this->liquidBridgeVolume == 0) return std::nullopt;
        if (auto found = objectionToLargestVolume(name, this->liquidBridgeVolume, this->scales(bodies)))
            return found;
        Bridge bridge = *this;
        do {
            if (auto found = bridge.objection(bodies)) return found;
            bridge.liquidBridgeVolume *= 0.1;
        } while (bridge.scales(bodies).volume > 1e-6);
        return std::nullopt;
    }
};

}  // namespace pendular
