import { vec3 } from "gl-matrix";
import { boxOf } from "./box.js";
import { Camera } from "./camera.js";
import { colourMap } from "./colours.js";
import { arranged, frontToBack } from "./order.js";
import { pick } from "./pick.js";
import * as shaders from "./shaders.js";

/** Draws a frame into a canvas by WebGL2. Throws Error where the browser has none. */
export class Scene {
    camera = new Camera();
    look = { map: "viridis", range: [0, 1], grains: true, bridges: true, contacts: false, droplets: true, walls: true, wallRange: null, clip: null, background: [1, 1, 1] };
    frame = null;

    constructor(canvas) {
        this.canvas = canvas;
        const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, preserveDrawingBuffer: true });
        if (!gl) throw new Error("This browser cannot draw in 3D (WebGL2).");
        this.gl = gl;
        this.columns = Math.min(4096, gl.getParameter(gl.MAX_TEXTURE_SIZE));
        const conservative = !!gl.getExtension("EXT_conservative_depth");
        this.programs = Object.fromEntries(["balls", "rods", "triangles"].map((name) => [name, this.#link(shaders[name].vertex, shaders[name].fragment(conservative))]));
        this.textures = Object.fromEntries(["colours", "grains", "values", "bridges", "contacts", "droplets"].map((name) => [name, this.#texture()]));
        this.rectangles = { array: gl.createVertexArray(), buffer: gl.createBuffer(), count: 0 };
        this.surfaces = { walls: this.#surface(), shapes: this.#surface() };
    }

    /** Takes a frame as getFrame() gives it. */
    show(frame) {
        this.frame = frame;
        this.sortedFor = null;
        frame.contactRods = frame.contacts ? rodsOfContacts(frame) : new Float32Array();
        this.#fill(this.textures.contacts, frame.contactRods, 4);
        if (frame.droplets) this.#fill(this.textures.droplets, frame.droplets, 4);
        this.#upload(this.surfaces.walls, withValues(frame.walls, frame.wallValue), frame.walls.length / 3);
        this.#upload(this.surfaces.shapes, frame.shapes, frame.shapes.length / 4);
    }

    /** Gives its memory and its context back; nothing can be drawn any more. */
    end() {
        this.frame = null;
        this.gl.getExtension("WEBGL_lose_context")?.loseContext();
    }

    lookAtAll() {
        if (this.frame) this.camera.lookAt(...boxOf(this.frame, this.look.walls), this.#aspect());
    }

    /**
     * Draws; with `finish` it waits until the picture is there. `isCoarse`: half as fine, and without bridges and contacts,
     * for what takes long while the camera moves.
     */
    render({ finish = false, isCoarse = false } = {}) {
        const { gl, canvas, look } = this, scale = Math.min(devicePixelRatio || 1, 2) * (isCoarse ? 0.5 : 1);
        const width = Math.max(1, Math.round(canvas.clientWidth * scale)), height = Math.max(1, Math.round(canvas.clientHeight * scale));
        if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
        gl.viewport(0, 0, width, height);
        gl.clearColor(...look.background, 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        if (this.frame) this.#draw(isCoarse);
        if (finish) gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    }

    /** What is drawn at a point of the canvas (in CSS pixels). */
    pick(x, y) {
        const { canvas, camera, look, frame } = this;
        if (!frame) return null;
        const ray = camera.ray((2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight, this.#aspect());
        const clip = this.#clip();
        return pick({
            eye: camera.eye, ray, grains: look.grains ? frame.grains : null, rods: look.contacts ? frame.contactRods : null,
            isHidden: (p) => clip[0] * p[0] + clip[1] * p[1] + clip[2] * p[2] > clip[3],
        });
    }

    /** The colour of a pixel, from the top left, as three bytes. */
    pixel(x, y) {
        const bytes = new Uint8Array(4), { gl } = this;
        gl.readPixels(x, this.canvas.height - 1 - y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        return [...bytes.slice(0, 3)];
    }

    /** Where a point (m, from the frame's origin) is in the canvas: pixels from the top left. */
    project(point) {
        const p = vec3.transformMat4(vec3.create(), vec3.transformMat4(vec3.create(), point, this.camera.view), this.camera.projection(this.#aspect()));
        return [(0.5 + 0.5 * p[0]) * this.canvas.width, (0.5 - 0.5 * p[1]) * this.canvas.height];
    }

    #draw(isCoarse) {
        const { gl, look, frame } = this;
        this.#sort();
        this.#fillColours();
        gl.enable(gl.DEPTH_TEST);
        if (look.grains) {
            this.#pull("balls", this.textures.grains, frame.grains.length / 4, { isWater: 0 });
            this.#triangles(this.surfaces.shapes, true, 1);
        }
        if (look.droplets && frame.droplets) this.#pull("balls", this.textures.droplets, frame.droplets.length / 4, { isWater: 1 });
        if (look.bridges && frame.bridges && !isCoarse) this.#pull("rods", this.textures.bridges, frame.bridges.length / 8, { hasColours: 0 });
        if (look.contacts && frame.contacts && !isCoarse)
            this.#pull("rods", this.textures.contacts, frame.contactRods.length / 8, { hasColours: 1 }, [0, frame.largestForce]);
        if (look.walls) this.#drawWalls();
    }

    /** They let through, and so they come last and hide nothing. */
    #drawWalls() {
        const { gl } = this;
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
        gl.depthMask(false);
        this.#triangles(this.surfaces.walls, false, this.look.wallRange ? 0.85 : 0.22, this.look.wallRange);
        gl.depthMask(true);
        gl.disable(gl.BLEND);
    }

    /** Grains and bridges, nearest first, anew where the eye has turned far. Surfaces know the rows as they came. */
    #sort() {
        const { frame, camera } = this, back = camera.back;
        if (this.sortedFor && vec3.dot(this.sortedFor, back) > 0.9) return;
        this.sortedFor = back;
        const keeps = frame.shapes.length > 0, order = keeps ? null : frontToBack(frame.grains, 4, back);
        this.#fill(this.textures.grains, keeps ? frame.grains : arranged(frame.grains, 4, order), 4);
        this.#fill(this.textures.values, keeps ? frame.value : arranged(frame.value, 1, order), 1);
        if (frame.bridges) this.#fill(this.textures.bridges, arranged(frame.bridges, 8, frontToBack(frame.bridges, 8, back)), 4);
    }

    #clip() {
        const { clip } = this.look, { frame } = this;
        if (!clip || !frame) return [0, 0, 0, 1];
        const axis = "xyz".indexOf(clip.axis), normal = [0, 0, 0], sign = clip.keepsHigh ? -1 : 1;
        normal[axis] = sign;
        return [...normal, sign * (frame.low[axis] + clip.share * (frame.high[axis] - frame.low[axis]))];
    }

    #aspect() {
        return this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1);
    }

    #use(name, numbers, range = this.look.range) {
        const { gl } = this, { program, places } = this.programs[name];
        gl.useProgram(program);
        gl.uniformMatrix4fv(places.view, false, this.camera.view);
        gl.uniformMatrix4fv(places.projection, false, this.camera.projection(this.#aspect()));
        gl.uniform4fv(places.clip, this.#clip());
        gl.uniform1i(places.columns, this.columns);
        gl.uniform2fv(places.range, range);
        [["colours", this.textures.colours], ["numbers", numbers], ["values", this.textures.values]].forEach(([sampler, texture], unit) => {
            if (!places[sampler]) return;
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, texture);
            gl.uniform1i(places[sampler], unit);
        });
        return places;
    }

    #pull(name, numbers, count, flags = {}, range = this.look.range) {
        if (count === 0) return;
        const { gl } = this, places = this.#use(name, numbers, range);
        for (const [flag, value] of Object.entries(flags)) gl.uniform1i(places[flag], value);
        this.#haveRectangles(count);
        gl.drawElements(gl.TRIANGLES, 6 * count, gl.UNSIGNED_INT, 0);
    }

    /** Indices of two triangles on four corners each: what has no index computes two of the corners twice. */
    #haveRectangles(count) {
        const { gl, rectangles } = this;
        gl.bindVertexArray(rectangles.array);
        if (count <= rectangles.count) return;
        rectangles.count = count;
        const indices = new Uint32Array(6 * count);
        for (let k = 0, at = 0, first = 0; k < count; ++k, first += 4)
            for (const corner of [0, 1, 2, 2, 1, 3]) indices[at++] = first + corner;
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, rectangles.buffer);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    }

    #triangles(surface, areGrains, opacity, valueRange = null) {
        if (surface.corners === 0) return;
        const { gl } = this, places = this.#use("triangles", this.textures.grains, valueRange ?? this.look.range);
        gl.uniform1i(places.hasValues, valueRange ? 1 : 0);
        gl.uniform1i(places.areGrains, areGrains ? 1 : 0);
        gl.uniform1f(places.opacity, opacity);
        gl.uniform1f(places.middle, this.camera.distance);
        gl.bindVertexArray(surface.array);
        gl.drawArrays(gl.TRIANGLES, 0, surface.corners);
    }

    #fillColours() {
        if (this.shownMap === this.look.map) return;
        const { gl } = this;
        this.shownMap = this.look.map;
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, this.textures.colours);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colourMap(this.look.map));
    }

    #compile(type, text) {
        const { gl } = this, shader = gl.createShader(type);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
        return shader;
    }

    #link(vertex, fragment) {
        const { gl } = this, program = gl.createProgram(), places = {};
        gl.attachShader(program, this.#compile(gl.VERTEX_SHADER, vertex));
        gl.attachShader(program, this.#compile(gl.FRAGMENT_SHADER, fragment));
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
        for (let k = 0; k < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++k) {
            const { name } = gl.getActiveUniform(program, k);
            places[name] = gl.getUniformLocation(program, name);
        }
        return { program, places };
    }

    #texture() {
        const { gl } = this, texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
        for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
        return texture;
    }

    #surface() {
        const { gl } = this, array = gl.createVertexArray(), buffer = gl.createBuffer();
        gl.bindVertexArray(array);
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 16, 0);
        return { array, buffer, corners: 0 };
    }

    #upload(surface, numbers, corners) {
        const { gl } = this;
        surface.corners = corners;
        gl.bindBuffer(gl.ARRAY_BUFFER, surface.buffer);
        gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
    }

    /** Numbers into a texture, `parts` (1 or 4) to a pixel; whole rows of pixels and then the rest. */
    #fill(texture, numbers, parts) {
        const { gl, columns } = this, pixels = numbers.length / parts, rows = Math.floor(pixels / columns), rest = pixels - rows * columns;
        const [inside, form] = parts === 4 ? [gl.RGBA32F, gl.RGBA] : [gl.R32F, gl.RED];
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, inside, columns, rows + 1, 0, form, gl.FLOAT, null);
        if (rows > 0) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, columns, rows, form, gl.FLOAT, numbers, 0);
        if (rest > 0) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, rows, rest, 1, form, gl.FLOAT, numbers, rows * columns * parts);
    }
}

/** Triangles' corners with a fourth number, that of their triangle. */
function withValues(walls, values) {
    const result = new Float32Array((walls.length / 3) * 4);
    for (let i = 0; i < walls.length / 3; ++i) {
        result.set(walls.subarray(3 * i, 3 * i + 3), 4 * i);
        result[4 * i + 3] = values?.[Math.floor(i / 3)] ?? 0;
    }
    return result;
}

/** Contacts as rods whose cross-section grows with the force. */
function rodsOfContacts(frame) {
    const { contacts, grains } = frame, rods = new Float32Array(contacts.length);
    let largest = 0, smallest = Infinity;
    for (let i = 3; i < contacts.length; i += 8) largest = Math.max(largest, contacts[i]);
    for (let i = 3; i < grains.length; i += 4) smallest = Math.min(smallest, Math.abs(grains[i]));
    frame.largestForce = largest;
    for (let i = 0; i < contacts.length; i += 8) {
        rods.set(contacts.subarray(i, i + 8), i);
        rods[i + 3] = 0.6 * smallest * Math.sqrt(contacts[i + 3] / (largest || 1)) + 1e-3 * smallest;
        rods[i + 7] = contacts[i + 3];
    }
    return rods;
}
