#include "Kernel/Scene/LastState.h"

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/GrainMasses.h"
#include "Kernel/Foundation/Files/CsvFile.h"

namespace pendular {

void writeGrains(const std::filesystem::path& path, const ParticleStore& grains, const ContactLaws& laws,
                 std::string_view remark) {
    CsvFile file(path,
                 "identity,species,radius_m,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,spin_x_rad_per_s,"
                 "spin_y_rad_per_s,spin_z_rad_per_s,force_x_N,force_y_N,force_z_N,mass_kg,fixed");
    file.comment(remark);
    const GrainMasses masses(grains, laws);
    for (const std::uint32_t place : grains.place) {
        const auto& [x, radius, v, inverseMass] = grains.translation[place];
        const Vector<double> spin = grains.hasSpin ? grains.rotation[place].spin : Vector<double>{0, 0, 0},
                             force = forceOn(grains, masses, place);
        file.row(grains.identity[place], grains.species[place], radius, x.x, x.y, x.z, v.x, v.y, v.z, spin.x,
                 spin.y, spin.z, force.x, force.y, force.z, masses(place), inverseMass > 0 ? 0 : 1);
    }
    file.close();
}

void writeContacts(const std::filesystem::path& path, const ContactSystem& contacts,
                   const ParticleStore& grains, std::string_view remark) {
    CsvFile file(path,
                 "particle1,particle2,wall,separation_m,normal_force_N,adhesive_force_N,bridged,"
                 "tangential_force_N,x_m,y_m,z_m");
    file.comment(remark);
    contacts.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = contacts.observe(grains, bucket, contact);
        const std::int64_t other = bucket.wall < 0 ? std::int64_t{seen.particle2} : -1;
        file.row(seen.particle1, other, seen.wall, seen.separation, seen.normalForce, seen.adhesiveForce,
                 seen.bridged ? 1 : 0, norm(seen.tangentialForce()), seen.point.x, seen.point.y,
                 seen.point.z);
    });
    file.close();
}

}  // namespace pendular
