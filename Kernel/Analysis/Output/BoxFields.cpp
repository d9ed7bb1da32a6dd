#include "Kernel/Analysis/Output/BoxFields.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

struct BoxField {
    const char* name;
    Vector<double> PeriodicBox::*member;
};
constexpr std::array<BoxField, 2> placeFields{
    {{"period_lowest_m", &PeriodicBox::lowest}, {"period_length_m", &PeriodicBox::length}}};
constexpr std::array<BoxField, 4> motionFields{{{"image_gradient_per_m", &PeriodicBox::across},
                                                {"image_shift_m", &PeriodicBox::imageShift},
                                                {"image_velocity_m_per_s", &PeriodicBox::imageVelocity},
                                                {"image_strain_rate_per_s", &PeriodicBox::strainRate}}};

bool take(const PolyData& frame, const BoxField& field, PeriodicBox& box) {
    const PolyDataField* found = frame.wholeField(field.name);
    if (!found) return false;
    Vector<double> read{0, 0, 0};
    if (found->size() == 3) read = {found->at(0), found->at(1), found->at(2)};
    if (found->size() != 3 || !std::isfinite(squaredNorm(read)))
        throw InputError(fmt::format("A frame has a field {} that is not three numbers.", field.name));
    box.*field.member = read;
    return true;
}

}  // namespace

std::vector<PolyDataField> boxFields(const PeriodicBox& box) {
    std::vector<PolyDataField> fields;
    const auto add = [&](const BoxField& field) {
        const Vector<double>& v = box.*field.member;
        fields.push_back({field.name, 3, std::vector<double>{v.x, v.y, v.z}});
    };
    if (!box.any()) return fields;
    for (const BoxField& field : placeFields) add(field);
    if (!box.imagesMove) return fields;
    for (const BoxField& field : motionFields) add(field);
    return fields;
}

std::optional<PeriodicBox> boxOf(const PolyData& frame) {
    PeriodicBox box;
    if (!take(frame, placeFields[0], box) || !take(frame, placeFields[1], box)) return std::nullopt;
    for (const BoxField& field : motionFields) box.imagesMove |= take(frame, field, box);
    const Vector<double>&length = box.length, &across = box.across;
    // One gradient at most, along which the images are a period apart.
    const auto isAlong = [](double gradient, double period, double shift) {
        return gradient == 0 || (period > 0 && std::abs(gradient * period - 1) < 1e-9 && shift == period);
    };
    if (!(length.x >= 0 && length.y >= 0 && length.z >= 0) ||
        !isAlong(across.x, length.x, box.imageShift.x) || !isAlong(across.y, length.y, box.imageShift.y) ||
        !isAlong(across.z, length.z, box.imageShift.z) ||
        (across.x > 0) + (across.y > 0) + (across.z > 0) > 1)
        throw InputError("A frame has periods that do not fit each other.");
    return box;
}

}  // namespace pendular
