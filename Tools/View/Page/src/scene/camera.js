import { mat4, vec3 } from "gl-matrix";
import { distanceToSee } from "./box.js";

/** A camera that turns about a point; z is up. */
export class Camera {
    turn = -0.6;  // rad, about z; 0: from -y
    tilt = 0.35;  // rad, above the plane
    distance = 1;  // m
    target = vec3.create();  // m
    fieldOfView = 0.6;  // rad
    size = 1;  // m, of what is looked at

    /** Looks at all of a box, from any direction, in a picture that is `aspect` times as wide as high. */
    lookAt(low, high, aspect) {
        this.target = vec3.scale(vec3.create(), vec3.add(vec3.create(), low, high), 0.5);
        this.size = Math.max(vec3.distance(low, high), 1e-12);
        this.distance = this.size * distanceToSee(this.fieldOfView, aspect);
    }

    from(turn, tilt) {
        this.turn = turn;
        this.tilt = tilt;
    }

    /** Unit vector from the target to the eye. */
    get back() {
        const c = Math.cos(this.tilt);
        return vec3.fromValues(Math.sin(this.turn) * c, -Math.cos(this.turn) * c, Math.sin(this.tilt));
    }

    get eye() {
        return vec3.scaleAndAdd(vec3.create(), this.target, this.back, this.distance);
    }

    get view() {
        const up = vec3.fromValues(-Math.sin(this.turn) * Math.sin(this.tilt), Math.cos(this.turn) * Math.sin(this.tilt), Math.cos(this.tilt));
        return mat4.lookAt(mat4.create(), this.eye, this.target, up);
    }

    projection(aspect) {
        const near = Math.max(this.distance - 2 * this.size, 0.02 * this.distance);
        return mat4.perspective(mat4.create(), this.fieldOfView, aspect, near, this.distance + 4 * this.size);
    }

    rotate(right, up) {
        this.turn -= right;
        this.tilt = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.tilt + up));
    }

    /** Shifts what is seen, by shares of the picture's height. */
    shift(right, up) {
        const view = this.view, scale = 2 * this.distance * Math.tan(this.fieldOfView / 2);
        for (let k = 0; k < 3; ++k)
            this.target[k] -= scale * (right * view[4 * k] + up * view[4 * k + 1]);
    }

    zoom(factor) {
        this.distance = Math.max(1e-4 * this.size, Math.min(50 * this.size, this.distance * factor));
    }

    /** The direction of the ray through a point of the picture: x and y from -1 to 1. */
    ray(x, y, aspect) {
        const view = this.view, t = Math.tan(this.fieldOfView / 2), ray = vec3.create();
        for (let k = 0; k < 3; ++k) ray[k] = -view[4 * k + 2] + x * aspect * t * view[4 * k] + y * t * view[4 * k + 1];
        return vec3.normalize(ray, ray);
    }
}
