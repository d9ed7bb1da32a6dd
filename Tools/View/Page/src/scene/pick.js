import { vec3 } from "gl-matrix";

/** The distance along a ray to a ball, if it is met. */
function toBall(offset, ray, radius) {
    const along = vec3.dot(offset, ray), q = along * along - vec3.dot(offset, offset) + radius * radius;
    return q > 0 && along > 0 ? along - Math.sqrt(q) : Infinity;
}

/** What a ray meets first: {kind: "grain", row} or {kind: "contact", row}, or null. */
export function pick({ eye, ray, grains, rods, isHidden }) {
    let best = { distance: Infinity, found: null };
    const offset = vec3.create(), place = vec3.create();
    const take = (distance, kind, row) => {
        if (distance < best.distance) best = { distance, found: { kind, row } };
    };
    for (let i = 0; grains && i < grains.length / 4; ++i) {
        vec3.set(place, grains[4 * i], grains[4 * i + 1], grains[4 * i + 2]);
        if (!isHidden(place)) take(toBall(vec3.subtract(offset, place, eye), ray, Math.abs(grains[4 * i + 3])), "grain", i);
    }
    for (let i = 0; rods && i < rods.length / 8; ++i) take(toRod(rods, i, eye, ray), "contact", i);
    return best.found;
}

/** By the nearest points of two lines (Ericson, Real-Time Collision Detection, 5.1.9); rods are thin. */
function toRod(rods, i, eye, ray) {
    const a = rods.subarray(8 * i, 8 * i + 3), b = rods.subarray(8 * i + 4, 8 * i + 7), radius = rods[8 * i + 3];
    const axis = vec3.subtract(vec3.create(), b, a), from = vec3.subtract(vec3.create(), eye, a);
    const bb = vec3.dot(axis, axis), ab = vec3.dot(ray, axis), c = vec3.dot(ray, from), f = vec3.dot(axis, from);
    const share = Math.max(0, Math.min(1, (f - ab * c) / Math.max(bb - ab * ab, 1e-12 * bb)));
    const point = vec3.scaleAndAdd(vec3.create(), a, axis, share);
    return toBall(vec3.subtract(vec3.create(), point, eye), ray, radius);
}
