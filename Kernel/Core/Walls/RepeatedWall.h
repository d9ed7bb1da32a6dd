#pragma once

#include <span>
#include <vector>

#include "Kernel/Core/Walls/Wall.h"
#include "Kernel/Core/Walls/WallImages.h"

namespace pendular {

/// A wall that a scene can repeat with its periods. A shape says where it is by the functions with `Own`,
/// which are those of Wall without images.
class RepeatedWall : public Wall {
public:
    /// Whether a scene can repeat it: a surface with ends, that grains may meet from both sides.
    [[nodiscard]] virtual bool canBeRepeated() const { return false; }
    /// It stands there again after each period, from now on.
    /// @param lengths m, of the periods; 0 along an axis without one
    virtual void repeat(const Vector<double>& lengths) { images.repeat(lengths); }
    /// A box along the axes of the scene around a surface with ends.
    [[nodiscard]] virtual SurroundingBox surroundings() const = 0;

    [[nodiscard]] bool isRepeated() const final { return images.areThere(); }
    [[nodiscard]] bool hasPart(std::uint32_t part) const final { return partOfShape(part) < partCount(); }
    [[nodiscard]] Vector<double> imageShift(std::uint32_t part, const Vector<double>& centre) const final {
        return isRepeated() ? images.shiftOf(part, centre, surroundings()) : Vector<double>{0, 0, 0};
    }
    [[nodiscard]] std::uint32_t partAfter(const Vector<double>& way, std::uint32_t part) const final {
        return isRepeated() ? images.partAfter(way, part) : part;
    }
    void listParts(const Vector<double>& centre, double reach, std::vector<std::uint32_t>& parts) const final;
    void findPoints(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                    std::span<WallPoint> points) const override;
    [[nodiscard]] bool isCrossed(const Vector<double>& from, const Vector<double>& to) const final;

    /// The part of the shape that a part is, which may be one of an image.
    [[nodiscard]] std::uint32_t partOfShape(std::uint32_t part) const {
        return isRepeated() ? WallImages::partOf(part) : part;
    }

protected:
    virtual void listOwn(const Vector<double>& centre, double reach,
                         std::vector<std::uint32_t>& parts) const = 0;
    virtual void findOwn(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                         std::span<WallPoint> points) const = 0;
    [[nodiscard]] virtual bool isOwnCrossed(const Vector<double>& from, const Vector<double>& to) const = 0;

private:
    /// The points of parts of one image.
    void findAtImage(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                     std::span<WallPoint> points) const;

    WallImages images;
};

}  // namespace pendular
