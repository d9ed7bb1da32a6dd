// What a camera has to show.

/** The corners of the box around all particles of a frame, and around its walls where they are shown. */
export function boxOf({ low, high, walls, grains }, withWalls) {
    let lowest = [Infinity, Infinity, Infinity], highest = [-Infinity, -Infinity, -Infinity];
    if (grains.length > 0) {
        let radius = 0;
        for (let i = 3; i < grains.length; i += 4) radius = Math.max(radius, Math.abs(grains[i]));
        [lowest, highest] = [low.map((x) => x - radius), high.map((x) => x + radius)];
    }
    for (let i = 0; (withWalls || grains.length === 0) && i < walls.length; ++i) {
        lowest[i % 3] = Math.min(lowest[i % 3], walls[i]);
        highest[i % 3] = Math.max(highest[i % 3], walls[i]);
    }
    return lowest[0] <= highest[0] ? [lowest, highest] : [[-1, -1, -1], [1, 1, 1]];
}

/**
 * The distance, over the diameter of a ball, from which a camera sees all of the ball with a small margin: the angle of
 * the narrower side of the picture counts. `fieldOfView`: rad, of the picture's height.
 */
export function distanceToSee(fieldOfView, aspect) {
    const half = Math.atan(Math.tan(fieldOfView / 2) * Math.min(aspect > 0 ? aspect : 1, 1));
    return 1.035 * 0.5 / Math.sin(half);
}
