#include "Kernel/Features/Insertion/DenseRefusals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Features/Insertion/DenseStart.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/ApartTexts.h"

namespace pendular {

void refuseTooDense(std::string_view what, const Amount& amount, double ofSample) {
    const double fraction =
        amount.kind() == Amount::Kind::SolidFraction ? std::min(amount.value(), ofSample) : ofSample;
    if (fraction <= densestRandomStart * (1 + roundOffOfLimits)) return;
    const auto [wanted, most] = apartTexts(fraction, densestRandomStart);
    throw InputError(fmt::format(
        "insert(): the {} would have a solid fraction of {} of the region; a random start reaches {}.", what,
        wanted, most));
}

void refuseLessDense(double fraction, double scale, int iterations) {
    const auto [wanted, reached] = apartTexts(fraction, fraction * std::pow(std::max(scale, 0.0), 3));
    throw InputError(fmt::format(
        "insert(): a solid fraction of {} of the region was not reached among its walls and grains, only {} "
        "after {} iterations; take a smaller amount, or a larger region.",
        wanted, reached, iterations));
}

}  // namespace pendular
