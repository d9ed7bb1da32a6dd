#pragma once

#include <memory>

#include "Kernel/Core/Contacts/ContactKernel.h"
#include "Kernel/Laws/Species/AdhesionEnergy.h"
#include "Kernel/Laws/Species/SpeciesHandler.h"
#include "Kernel/Laws/Species/TimeStepAdvice.h"

namespace pendular {

/// The layout of what contacts of a species remember.
template <class S>
inline constexpr ContactLayout layoutOf{
    .history = columnsOf<S::Friction::template History>,
    .normalHistory = columnsOf<NormalHistoryOf<typename S::Normal>::template type>,
    .interaction = columnsOf<S::Adhesion::template Interaction>,
    .liquid = MovesLiquid<typename S::Adhesion> ? ContactMemory::liquidNumbers : 0,
    .named = 0,
    .hasTorque = S::hasTorque,
    .hasContactTorque = S::hasContactTorque};

/// The laws of one species type, for a scene. All that is compiled again for a species is in here.
template <class S>
class SpeciesLaws : public ContactLaws {
public:
    explicit SpeciesLaws(SpeciesHandler<S>& speciesHandler) : species(speciesHandler) {
        layout = layoutOf<S>;
        name = S::name;
        friction = S::Friction::name;
        if constexpr (Adhesion::acts) formsAtContact = Adhesion::formsAtContact;
        actsApart = Adhesion::acts && !formsAtContact;
        resistsMotion = bridgeResists<Adhesion> != BridgeResists::Nothing;
        hasLargestCapillaryNumber = HasLargestCapillaryNumber<Adhesion>;
        breaks = formsAtContact || resistsMotion;
        isPlastic = HasNormalHistory<typename S::Normal>;
        keepsForce = KeepsForce<typename S::Friction>;
        overlapLimit = pendular::overlapLimit<typename S::Mixed>();
        largestOverlapInRun = pendular::largestOverlapInRun<typename S::Mixed>();
        overlapAdvice = pendular::overlapAdvice<typename S::Mixed>();
    }

    [[nodiscard]] std::size_t speciesCount() const override { return species.getSize(); }
    [[nodiscard]] const SpeciesOwner* owner() const override { return &species; }
    [[nodiscard]] double density(std::size_t k) const override { return species.getObject(k)->getDensity(); }
    void mixAll() override { species.mixAll(); }
    [[nodiscard]] bool hasChanges() const override { return species.hasChanges(); }
    void visitState(StateArchive& archive, bool& changedInRun) override {
        species.visitState(archive, changedInRun);
    }
    [[nodiscard]] std::vector<SetValues> setValues() override { return species.setValues(); }
    [[nodiscard]] std::vector<FieldValue> fields(int a, int b) const override {
        std::vector<FieldValue> found;
        of(a, b).forEachLaw([&]<class Law>(const Law& law) {
            for (const auto& field : Law::fields())
                found.push_back({Law::name, field.name, field.unit, law.*field.member});
        });
        return found;
    }

    [[nodiscard]] double range(int a, int b, const Bodies& bodies) const override {
        return of(a, b).range(bodies);
    }
    [[nodiscard]] std::optional<std::string> objection(int a, int b, const Bodies& bodies) const override {
        return of(a, b).objection(bodies);
    }
    [[nodiscard]] ContactStiffness stiffness(int a, int b, const Bodies& bodies, double mass) const override {
        return contactStiffness(of(a, b), bodies, mass);
    }
    void stiffnesses(int a, int b, std::span<const PressedPair> contacts,
                     std::span<ContactStiffness> found) const override {
        const StiffnessOf<typename S::Mixed> stiffness(of(a, b));
        for (std::size_t k = 0; k < contacts.size(); ++k) found[k] = stiffness(contacts[k]);
    }
    [[nodiscard]] double normalStiffness(int a, int b, const Bodies& bodies, double overlap) const override {
        using Normal = typename S::Mixed::Normal;
        const Contact<double> contact{overlap, bodies.effectiveRadius(), 1};  // no spring knows the mass
        return Normal::stiffness(static_cast<const Normal&>(of(a, b)).prepare(), contact);
    }
    [[nodiscard]] ContactSpot contactSpot(int a, int b, const Bodies& bodies, double overlap) const override {
        return pendular::contactSpot(of(a, b), bodies, overlap);
    }
    [[nodiscard]] std::vector<std::pair<std::string_view, DomainLimit>> brokenLimits(
        int a, int b, const Bodies& bodies) const override {
        std::vector<std::pair<std::string_view, DomainLimit>> found;
        forEachBrokenLimit(of(a, b), bodies, [&](std::string_view law, const DomainLimit& limit) {
            found.emplace_back(law, limit);
        });
        return found;
    }

    void prepareAdhesion([[maybe_unused]] int a, [[maybe_unused]] int b,
                         [[maybe_unused]] const Bodies& bodies, [[maybe_unused]] double* to) const override {
        if constexpr (Adhesion::acts) putMemory(static_cast<const Adhesion&>(of(a, b)).prepare(bodies), to);
    }
    [[nodiscard]] double adhesiveForce(int /*a*/, int /*b*/, [[maybe_unused]] const double* from,
                                       [[maybe_unused]] double separation) const override {
        if constexpr (Adhesion::acts)
            return memoryFrom<Interaction<double>>(from).force(separationFor<Adhesion>(-separation));
        else return 0;
    }
    void turn(int /*a*/, int /*b*/, [[maybe_unused]] double* numbers,
              [[maybe_unused]] const FrameRotation<double>& rotation) const override {
        if constexpr (S::Friction::acts) {
            auto history = memoryFrom<History<double>>(numbers);
            history.turn(rotation);
            putMemory(history, numbers);
        }
    }
    [[nodiscard]] double springLength(int /*a*/, int /*b*/,
                                      [[maybe_unused]] const double* numbers) const override {
        if constexpr (S::Friction::acts) return norm(memoryFrom<History<double>>(numbers).slidingSpring());
        else return 0;
    }

    [[nodiscard]] std::optional<double> bridgeVolume([[maybe_unused]] int a,
                                                     [[maybe_unused]] int b) const override {
        if constexpr (requires(typename S::Mixed laws) { laws.liquidBridgeVolume; })
            return of(a, b).liquidBridgeVolume;
        else return {};
    }

    [[nodiscard]] std::optional<LiquidRules> liquidRules([[maybe_unused]] int a,
                                                         [[maybe_unused]] int b) const override {
        if constexpr (MovesLiquid<Adhesion>) return of(a, b).liquidRules();
        else return {};
    }

    [[nodiscard]] double filmContactGap([[maybe_unused]] int a, [[maybe_unused]] int b) const override {
        if constexpr (HasFilmContactGap<Adhesion>) return of(a, b).filmContactGap;
        else return 0;
    }
    [[nodiscard]] double filmContactGap([[maybe_unused]] int a, [[maybe_unused]] int b,
                                        [[maybe_unused]] const Bodies& bodies,
                                        [[maybe_unused]] double films) const override {
        if constexpr (requires(const Adhesion law) { law.filmContact(bodies, films); })
            return of(a, b).filmContact(bodies, films);
        else return 0;
    }
    void meetFilms(int /*a*/, int /*b*/, [[maybe_unused]] double* numbers, [[maybe_unused]] double gap,
                   [[maybe_unused]] double start) const override {
        if constexpr (requires(Interaction<double> bridge) { bridge.meet(gap, start); }) {
            auto bridge = memoryFrom<Interaction<double>>(numbers);
            bridge.meet(gap, start);
            putMemory(bridge, numbers);
        }
    }

    void prepareBridge([[maybe_unused]] int a, [[maybe_unused]] int b, [[maybe_unused]] const Bodies& bodies,
                       [[maybe_unused]] double volume, [[maybe_unused]] double* to) const override {
        if constexpr (MovesLiquid<Adhesion>)
            putMemory(static_cast<const Adhesion&>(of(a, b)).prepare(bodies, volume), to);
    }
    void takeBridgeState([[maybe_unused]] int a, [[maybe_unused]] int b, [[maybe_unused]] double* to,
                         [[maybe_unused]] const double* before) const override {
        if constexpr (bridgeResists<Adhesion> != BridgeResists::Nothing) {
            auto bridge = memoryFrom<Interaction<double>>(to);
            bridge.takeState(static_cast<const Adhesion&>(of(a, b)), memoryFrom<Interaction<double>>(before));
            putMemory(bridge, to);
        }
    }
    void checkGap(int /*a*/, int /*b*/, [[maybe_unused]] double* numbers, [[maybe_unused]] double separation,
                  [[maybe_unused]] double roundOff) const override {
        if constexpr (bridgeResists<Adhesion> != BridgeResists::Nothing) {
            auto bridge = memoryFrom<Interaction<double>>(numbers);
            bridge.checkGap(separation, roundOff);
            putMemory(bridge, numbers);
        }
    }
    [[nodiscard]] double adhesionEnergy(int /*a*/, int /*b*/, [[maybe_unused]] const double* from,
                                        [[maybe_unused]] double separation) const override {
        if constexpr (MovesLiquid<Adhesion>)
            return adhesionEnergyOf(memoryFrom<Interaction<double>>(from), separation);
        else return 0;
    }
    [[nodiscard]] BridgeSurface bridgeSurface([[maybe_unused]] int a, [[maybe_unused]] int b,
                                              [[maybe_unused]] const Bodies& bodies,
                                              [[maybe_unused]] double volume,
                                              [[maybe_unused]] double separation,
                                              [[maybe_unused]] bool solved) const override {
        if constexpr (MovesLiquid<Adhesion>) {
            const Adhesion& law = of(a, b);
            const BridgeLiquid bridge{bodies, volume, law.contactAngle, law.surfaceTension};
            return solved ? solveBridgeSurface(bridge, separation)
                          : BridgeSurface{.area = bridgeArea(bridge, separation)};
        } else return {};
    }

    void prepare(const std::vector<Bucket>& buckets) override {
        prepared.clear();
        for (const Bucket& bucket : buckets)
            if (species.hasMixture(bucket.species1, bucket.species2))
                prepared.emplace_back(of(bucket.species1, bucket.species2));
            else prepared.emplace_back();  // of other laws: never computed here
    }
    bool compute(const ContactTask& task) const override {
        // Values, not references to the task: the kernel's stores could change that, for all the compiler
        // knows.
        const TranslationRecord* const translation = task.translation;
        const RotationRecord* const rotation = task.rotation;
        const ContactBlock* const blocks = task.store.blocks.data();
        const HeldInContacts* const held = task.held;
        if (task.store.buckets[task.bucket].wall >= 0) {
            const WallPointColumns* const points = task.store.wallPoints.data();
            const std::size_t first = task.store.firstWallBlock();
            const Vector<double> spin = task.wallSpin;
            return computeBlocks(task, [=](std::size_t b) {
                return WallGeometry<S>(translation, rotation, blocks[b], points[b - first], spin, held);
            });
        }
        const PeriodicBox& box = task.box;
        if (box.any())
            return computeBlocks(task, [=, &box](std::size_t b) {
                return PairGeometry<S, true>(translation, rotation, blocks[b], box, held);
            });
        return computeBlocks(task, [=, &box](std::size_t b) {
            return PairGeometry<S, false>(translation, rotation, blocks[b], box, held);
        });
    }

protected:
    const typename S::Mixed& of(int a, int b) const { return species.mixture(a, b); }

    /// @param geometryOf (block) its geometry
    template <class GeometryOf>
    bool computeBlocks(const ContactTask& task, const GeometryOf& geometryOf) const {
        const std::uint32_t* const slots = task.store.slots.data();
        const double* const gaps = task.store.gaps.data();
        const double unlisted = task.unlisted;
        const bool asksAhead = task.asksAhead;
        using Geometry = decltype(geometryOf(task.begin));
        ContactKernel<S> kernel(prepared[task.bucket], task.step, task.timing,
                                task.overlaps->part(overlapLimit.largest), task.store, task.acceleration,
                                task.totals, task.withSamples);
        kernel.springsAhead = task.springsAhead;
        kernel.unlisted = unlisted;
        kernel.longest = task.longest;
        bool all = true;
        for (std::size_t b = task.begin, end = task.end; b < end; ++b)
            if (slots[b] != ContactStore::asleep || unlisted > gaps[b]) {
                if (asksAhead) prefetchFrom<Geometry>(task, b);
                all &= kernel.computeBlock(b, geometryOf);
            }
        *task.overlaps = kernel.overlaps;
        if constexpr (HasLargestCapillaryNumber<Adhesion>) *task.capillaryNumbers = kernel.capillaryNumbers;
        return all;
    }

private:
    static_assert(std::max({layoutOf<S>.history, layoutOf<S>.normalHistory, layoutOf<S>.interaction}) <=
                  std::tuple_size_v<ContactNumbers>);

    using Adhesion = typename S::Adhesion;
    template <class T>
    using History = typename S::Friction::template History<T>;
    template <class T>
    using Interaction = typename Adhesion::template Interaction<T>;

    // Data that the kernel would wait for is asked for so many blocks before: what gave most in a bed that
    // the cache does not hold, where 1 and 2 blocks take 1.28 times as long (the README). To ask costs 4 to
    // 12 % where the cache has it all.
    static constexpr std::size_t blocksAheadForBodies = 4, blocksAheadForMemory = 6;

    template <class Geometry>
    [[gnu::always_inline]] static void prefetchFrom(const ContactTask& task, std::size_t block) {
        const std::size_t bodies = block + blocksAheadForBodies, memory = block + blocksAheadForMemory;
        if (bodies < task.end) {
            const ContactBlock& ahead = task.store.blocks[bodies];
            Geometry::prefetchBodies(task.translation, task.rotation, ahead);
            if (task.totals.totals != nullptr) {
                prefetchTotals(task.totals.totals, ahead.first);
                if constexpr (requires(Geometry g) { g.radius2; })
                    prefetchTotals(task.totals.totals, ahead.second);
            }
        }
        if (memory < task.end && task.store.slots[memory] != ContactStore::asleep) {
            task.store.memory.prefetchBlock(task.store.slots[memory]);
            if (task.withSamples) [[unlikely]]
                task.store.memory.prefetchSamples(task.store.slots[memory]);
        }
    }

    [[gnu::always_inline]] static void prefetchTotals(const ForceTotal* totals,
                                                      const std::array<std::uint32_t, Pack::lanes>& grains) {
        for (const std::uint32_t grain : grains) prefetch<true>(totals + grain, sizeof(ForceTotal));
    }

    SpeciesHandler<S>& species;
    std::vector<PreparedLaws<S>> prepared;  // of each bucket
};

/// The laws of the species of a handler. Those of popular species are compiled into the library.
template <class S>
std::unique_ptr<ContactLaws> makeSpeciesLaws(SpeciesHandler<S>& speciesHandler) {
    return std::make_unique<SpeciesLaws<S>>(speciesHandler);
}

}  // namespace pendular
