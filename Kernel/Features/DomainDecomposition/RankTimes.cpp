#include "Kernel/Features/DomainDecomposition/RankTimes.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pendular {

static double secondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

static double meanOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void RankTimes::beginList(const Exchange& exchange) {
    listBegan = Clock::now();
    const double before = all.working;
    endSteps(exchange);
    workSinceList = all.working - before;
}

void RankTimes::endSteps(const Exchange& exchange) {
    all = sums(exchange);
    areSteps = false;
}

RankTimes::Sums RankTimes::sums(const Exchange& exchange) const {
    Sums now = all;
    if (!areSteps) return now;
    const double waited = exchange.waited() - waitedBefore;
    now.waiting += waited;
    now.working += secondsSince(stepsBegan) - waited;
    return now;
}

void RankTimes::endList(const Exchange& exchange) {
    all.listing += secondsSince(listBegan);
    steps = 0;
    waitedBefore = exchange.waited();
    areSteps = true;
    stepsBegan = Clock::now();
}

bool RankTimes::areImbalanced(Exchange& exchange, double ownLoad, double after) {
    constexpr double worthIt = 1000;  // grains and contacts of a rank
    constexpr double counted = 1.1, measured = 1.05;
    struct Work {
        double load, seconds, loadDone;
    };
    if (workSinceList > 0) loadDone += ownLoad * static_cast<double>(steps);
    work += std::exchange(workSinceList, 0);
    std::vector<double> loads, seconds, ofLoad;
    for (const Work& one : exchange.ofAll(Work{ownLoad, work, loadDone})) {
        loads.push_back(one.load);
        seconds.push_back(one.seconds);
        ofLoad.push_back(one.loadDone > 0 ? one.seconds / one.loadDone : 0);
    }
    if (!(meanOf(loads) > worthIt)) return false;
    const bool isNew = meanOf(seconds) >= after;
    if (isNew) takeSlowness(ofLoad);
    for (std::size_t rank = 0; rank < loads.size() && areMeasured(); ++rank) loads[rank] *= slowness[rank];
    return std::ranges::max(loads) > (isNew ? measured : counted) * meanOf(loads);
}

void RankTimes::takeSlowness(const std::vector<double>& timesOfLoad) {
    work = loadDone = 0;
    slowness.assign(timesOfLoad.size(), 1);
    const auto known = [](double time) { return time > 0; };
    const auto count = std::ranges::count_if(timesOfLoad, known);
    if (count == 0) return;
    const double mean =
        std::accumulate(timesOfLoad.begin(), timesOfLoad.end(), 0.0) / static_cast<double>(count);
    // A rank that has stood still for once shall not lose all of its grains.
    for (std::size_t rank = 0; rank < slowness.size(); ++rank)
        if (known(timesOfLoad[rank])) slowness[rank] = std::clamp(timesOfLoad[rank] / mean, 0.25, 4.0);
}

}  // namespace pendular
