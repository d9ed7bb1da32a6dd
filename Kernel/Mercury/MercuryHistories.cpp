#include "Kernel/Mercury/MercuryHistories.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/MemoryColumns.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Laws/Friction/Friction.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"

namespace pendular {
namespace {

/// What is kept in both codes, of body 1 of the contact against body 2.
struct Springs {
    Vector<double> sliding, rolling;  // m; rolling: R* times the angle
    double torsion;                   // m, R* times the angle about the normal
};

/// MercuryDPM's springs are those of its first body P against the other one I, with its normal n from I to P:
/// the sliding spring is the tangential displacement; rolling moves by -L n x w h in a step h and torsion by
/// L (n.w) n h, with the relative spin w and the lever L (FrictionInteraction): n x rolling is L times the
/// angle. Here both are R* times the angle.
/// @param normal from body 1 to body 2; @param sign 1 where body 1 is P, -1 where it is I
Springs springsOf(const MercuryHistories::OfContact& one, const Vector<double>& normal, double sign,
                  RotationLever rolling, RotationLever torsion) {
    return {sign * one.sliding, -1 / static_cast<double>(rolling) * cross(normal, one.rolling),
            sign / static_cast<double>(torsion) * dot(one.torsion, normal)};
}

template <class Law>
std::vector<double> numbersOf(const typename Law::template History<double>& history) {
    std::vector<double> numbers(columnsOf<Law::template History>);
    putMemory(history, numbers.data());
    return numbers;
}

template <class Law>
std::vector<double> withRotation(const MercuryHistories::OfContact& one, const Vector<double>& normal,
                                 double sign) {
    const Springs springs = springsOf(one, normal, sign, Law::leverOfRolling, Law::leverOfTorsion);
    return numbersOf<Law>({{{springs.sliding}, 0}, {{springs.rolling}, springs.torsion}});
}

/// The numbers of the history of a friction law. Throws InputError for one that MercuryDPM has not.
std::vector<double> frictionNumbers(std::string_view law, const std::string& whose,
                                    const MercuryHistories::OfContact& one, const Vector<double>& normal,
                                    double sign) {
    const bool rotates = one.rolling != Vector<double>{0, 0, 0} || one.torsion != Vector<double>{0, 0, 0};
    if (law == Friction::name) return withRotation<Friction>(one, normal, sign);
    if (law == MindlinRollingTorsion::name) return withRotation<MindlinRollingTorsion>(one, normal, sign);
    if (!rotates && law == SlidingFriction::name)
        return numbersOf<SlidingFriction>({{sign * one.sliding}, 0});
    if (!rotates && law == Mindlin::name) return numbersOf<Mindlin>({sign * one.sliding});
    throw InputError(fmt::format(
        "{}: the restart file has springs of friction for it, which its friction law ({}) does not remember.",
        whose, law.empty() ? "none" : law));
}

auto keyOf(const ObservedContact& seen) {
    return seen.wall >= 0 ? std::tuple(seen.particle1, std::uint32_t{0}, static_cast<std::int32_t>(seen.wall))
                          : std::tuple(std::min(seen.particle1, seen.particle2),
                                       std::max(seen.particle1, seen.particle2), std::int32_t{-1});
}

}  // namespace

void MercuryHistories::add(const OfContact& contact) {
    const auto key = contact.wall >= 0
                         ? std::tuple(contact.first, std::uint32_t{0}, contact.wall)
                         : std::tuple(std::min(contact.first, contact.second),
                                      std::max(contact.first, contact.second), std::int32_t{-1});
    OfContact& one = waiting.try_emplace(key, contact).first->second;
    // The versions 2 and 3 have springs and flattenings apart.
    if (contact.flattening != 0) one.flattening = contact.flattening;
}

/// Contacts have their history from the kernel's restart file.
void MercuryHistories::begin(StepContext& /*step*/, bool isRestarted) {
    if (isRestarted) waiting.clear();
}

/// At the start of a run contacts are there when the first forces are found: these are found anew.
void MercuryHistories::afterForces(StepContext& step) {
    if (step.length > 0 || waiting.empty()) return;
    give(step);
    step.contacts.computeForces(step.grains(), 0, contactScheme(step).contacts);
}

void MercuryHistories::give(StepContext& step) {
    const ParticleStore& grains = step.grains();
    std::vector<std::pair<ObservedContact, OfContact>> found;
    step.contacts.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = step.contacts.observe(grains, bucket, contact);
        const auto one = waiting.find(keyOf(seen));
        if (one == waiting.end() || !seen.touching) return;
        const std::string whose =
            seen.wall >= 0 ? fmt::format("contact of particle {} and wall {}", seen.particle1, seen.wall)
                           : fmt::format("contact of particles {} and {}", seen.particle1, seen.particle2);
        const ContactLaws& laws = step.laws->ofPair(bucket.species1, bucket.species2);
        const OfContact& history = one->second;
        const Vector<double> none{0, 0, 0};
        if (history.sliding != none || history.rolling != none || history.torsion != none)
            step.contacts.setFrictionHistory(seen,
                                             frictionNumbers(laws.friction, whose, history, seen.normal(),
                                                             seen.particle1 == history.first ? 1 : -1));
        if (history.flattening != 0) {
            if (!laws.isPlastic)
                throw InputError(fmt::format(
                    "{}: the restart file has a flattening of {} m for it, and its law {} is not plastic.",
                    whose, history.flattening, laws.name));
            step.contacts.setNormalHistory(seen, {history.flattening});
        }
        waiting.erase(one);
    });
    // The file has the state after a step, and its contacts are those of that step.
    if (!waiting.empty())
        step.logger(LogLevel::Warn,
                    "{} contacts of the restart file with a history do not touch here, and begin without it.",
                    waiting.size());
    waiting.clear();
}

}  // namespace pendular
