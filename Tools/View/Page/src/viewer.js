import { get, getFrame } from "./api.js";
import { Legend, Range, rangeOf } from "./legend.js";
import { colourMapNames } from "./scene/colours.js";
import { Scene } from "./scene/Scene.js";
import { fieldLabel, labelled, make, number, tell, Teller } from "./text.js";

const presets = { front: [0, 0], right: [Math.PI / 2, 0], behind: [Math.PI, 0], left: [-Math.PI / 2, 0], above: [0, Math.PI / 2], slanted: [-0.6, 0.35] };
const defaultField = "velocity_m_per_s";
const longestDrawing = 300;  // ms: what takes longer is drawn coarsely while the camera moves

/** A run in three dimensions with its controls: `element` is for the page, `controls` stands beside it. */
export class Viewer {
    fields = [];
    field = defaultField;
    wallField = "";
    shown = -1;
    times = [];
    follows = true;
    over = new AbortController();
    told = new Teller();

    constructor(id, { onLook = () => {} } = {}) {
        this.id = id;
        this.onLook = onLook;
        this.canvas = make("canvas", { class: "picture", tabindex: "0", role: "img", "aria-label": "The grains in three dimensions. Arrows turn, + and - come near, comma and point change the frame, blank plays, F follows, 1 to 6 are views, S saves the picture." });
        this.slider = make("input", { type: "range", min: 0, max: 0, value: 0, "aria-label": "Frame", input: () => this.ask(Number(this.slider.value)) });
        this.when = make("span", { class: "quiet" });
        this.playButton = make("button", { "aria-pressed": "false", click: () => this.play() }, "Play");
        this.followButton = make("button", { "aria-pressed": "true", click: () => this.follow() }, "Follow");
        this.element = make("div", { class: "viewer" }, this.canvas,
            make("div", { class: "time" }, this.playButton, this.slider, this.when, this.followButton));
        this.controls = this.#makeControls();
        this.#listen();
    }

    /** Called once the element is in the page. */
    begin() {
        this.scene = new Scene(this.canvas);
        this.#takeBackground();
        this.size = new ResizeObserver(() => this.redraw());
        this.size.observe(this.canvas);
        const { signal } = this.over;
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#takeBackground(), { signal });
    }

    /** Gives back listeners and the context, of which a browser has few. */
    end() {
        clearInterval(this.playing);
        clearTimeout(this.rests);
        this.isOver = true;
        this.over.abort();
        this.size?.disconnect();
        this.scene?.end();
    }

    /** The times of the frames (s), as they are known now, and when the restart file was written: a run without frames shows
     * that (its time is null). */
    setTimes(times, stateWritten) {
        const isNewState = times.length === 1 && times[0] === null && stateWritten !== this.stateWritten;
        const grew = times.length !== this.times.length || isNewState;
        this.stateWritten = stateWritten;
        this.times = times;
        this.slider.max = Math.max(times.length - 1, 0);
        if (this.shown >= times.length) this.shown = -1;
        if (times.length > 0 && (this.shown < 0 || (grew && this.follows))) this.ask(times.length - 1);
        else this.#sayTime();
    }

    /** Shows a frame, when those asked for before are through; of several the last. */
    async ask(frame) {
        this.wanted = frame;
        if (this.isBusy) return;
        this.isBusy = true;
        try {
            while (this.wanted !== null && !this.isOver) {
                const next = this.wanted;
                this.wanted = null;
                await this.#load(next);
            }
            this.told.clear();
        } catch (problem) {
            this.told.say(problem.message);
        } finally {
            this.isBusy = false;
        }
    }

    redraw() {
        if (this.isDue || !this.scene) return;
        this.isDue = true;
        requestAnimationFrame(() => {
            this.isDue = false;
            if (!this.isOver) this.scene.render({ isCoarse: this.isMoving });
        });
    }

    /** The camera has moved, and may do so again soon. */
    moved() {
        clearTimeout(this.rests);
        this.isMoving = this.drawing > longestDrawing;
        if (this.isMoving)
            this.rests = setTimeout(() => {
                this.isMoving = false;
                this.redraw();
            }, 300);
        this.redraw();
    }

    play() {
        clearInterval(this.playing);
        this.playing = this.playing ? null : setInterval(() => {
            if (!this.isBusy && this.times.length > 0) this.ask((this.shown + 1) % this.times.length);
        }, 100);
        if (this.playing && this.follows) this.follow();  // one of both chooses the frame
        this.playButton.textContent = this.playing ? "Pause" : "Play";
        this.playButton.setAttribute("aria-pressed", String(!!this.playing));
    }

    follow() {
        this.follows = !this.follows;
        this.followButton.setAttribute("aria-pressed", String(this.follows));
        if (this.follows && this.times.length > 0) this.ask(this.times.length - 1);
    }

    savePicture() {
        this.scene.render();
        this.canvas.toBlob((blob) => this.#save(blob, "png"));
    }

    /** All frames, as fast as they come, as a film of the browser's own kind. */
    async saveFilm() {
        if (!window.MediaRecorder) return tell("This browser cannot make films.");
        const pieces = [], recorder = new MediaRecorder(this.canvas.captureStream(30), { videoBitsPerSecond: 8e6 });
        recorder.addEventListener("dataavailable", (event) => pieces.push(event.data));
        recorder.addEventListener("stop", () => this.#save(new Blob(pieces, { type: recorder.mimeType }), recorder.mimeType.includes("mp4") ? "mp4" : "webm"));
        recorder.start();
        for (let frame = 0; frame < this.times.length && !this.isOver; ++frame) {
            await this.ask(frame);
            await new Promise((done) => setTimeout(done, 80));
        }
        recorder.stop();
    }

    preset(name) {
        this.scene.camera.from(...presets[name]);
        this.#looked();
    }

    reset() {
        this.scene.lookAtAll();
        this.#looked();
    }

    /** The frame, with the field that it has been asked for. */
    async #load(frame) {
        if (!this.scene) return;
        const { scene } = this, words = { id: this.id, frame, field: this.field, orRadius: 1, contacts: scene.look.contacts ? 1 : 0, bridges: scene.look.bridges ? 1 : 0, droplets: scene.look.droplets ? 1 : 0, wallField: this.wallField };
        if (this.origin) words.origin = this.origin.join(",");
        const next = await getFrame(words);
        const first = this.fields.length === 0;
        this.origin ??= next.origin;
        this.fields = next.fields;
        if (this.field === words.field) this.field = next.field;  // the wished one, if there is such a field; unless another is wished by now
        if (this.isOver) return;
        this.shown = frame;
        scene.show(next);
        if (first) this.#offerFields();
        if (first) scene.lookAtAll();
        this.#takeRange();
        const begin = performance.now();
        scene.render({ finish: true });
        this.drawing = performance.now() - begin;
        this.slider.value = frame;
        this.#sayTime();
        this.loads = (this.loads ?? 0) + 1;
    }

    #sayTime() {
        const time = this.times[this.shown];
        const what = time === null || time === undefined ? "state" : `${number(time)} s`;
        this.when.textContent = this.times.length === 0 ? "no frames" : `${what}, ${this.shown + 1} of ${this.times.length}`;
    }

    #describe() {
        return this.fields.find(({ name }) => name === this.field.split(".")[0]);
    }

    /** By frame: of the values that are drawn, which may be a part of a vector. */
    #takeRange() {
        this.scene.look.range = this.range.of(this.scene.frame.value);
        this.legend.show(this.scene.look.map, this.scene.look.range, this.#describe()?.unit ?? "");
        const { wallValue, wallFields } = this.scene.frame;
        this.scene.look.wallRange = wallValue?.length > 0 ? rangeOf(wallValue) : null;
        this.wallLegend.element.hidden = !this.scene.look.wallRange;
        if (this.scene.look.wallRange) this.wallLegend.show(this.scene.look.map, this.scene.look.wallRange, wallFields.find(({ name }) => name === this.wallField).unit);
    }

    #offerFields() {
        const options = this.fields.flatMap((field) => {
            const one = new Option(fieldLabel(field), field.name);
            return field.components === 3 ? [one, ...["x", "y", "z"].map((axis) => new Option(`${fieldLabel(field)}, ${axis}`, `${field.name}.${axis}`))] : [one];
        });
        this.fieldSelect.replaceChildren(...options);
        this.fieldSelect.value = this.field;
        const ofWalls = this.scene.frame.wallFields.filter(({ name }) => name !== "wall");
        this.wallSelect.replaceChildren(new Option("one colour", ""), ...ofWalls.map((field) => new Option(fieldLabel(field), field.name)));
        this.wallChoice.hidden = ofWalls.length === 0;
    }

    #takeBackground() {
        const [r, g, b] = getComputedStyle(document.body).backgroundColor.match(/[\d.]+/g).map((part) => Number(part) / 255);
        this.scene.look.background = [r, g, b];
        this.redraw();
    }

    #makeControls() {
        const check = (name, isOn, reload) => make("input", { type: "checkbox", checked: isOn, change: (event) => {
            this.scene.look[name] = event.target.checked;
            if (reload && event.target.checked) this.ask(this.shown);
            else this.redraw();
        } });
        this.fieldSelect = make("select", { change: () => { this.field = this.fieldSelect.value; this.ask(this.shown); } });
        this.wallSelect = make("select", { change: () => { this.wallField = this.wallSelect.value; this.ask(this.shown); } });
        this.wallLegend = new Legend();
        this.wallLegend.element.hidden = true;
        this.wallChoice = make("div", { hidden: true }, labelled("Colour walls by", this.wallSelect), this.wallLegend.element);
        this.legend = new Legend();
        this.range = new Range(() => { this.#takeRange(); this.redraw(); });
        const map = make("select", { change: () => { this.scene.look.map = map.value; this.#takeRange(); this.redraw(); } }, ...colourMapNames.map((name) => new Option(name)));
        const axis = make("select", { "aria-label": "Axis of the cut" }, new Option("no cut", ""), ...["x", "y", "z"].map((a) => new Option(`cut across ${a}`, a)));
        const share = make("input", { type: "range", min: 0, max: 1, step: 0.005, value: 0.5, "aria-label": "Place of the cut" });
        const side = make("input", { type: "checkbox" });
        for (const input of [axis, share, side])
            input.addEventListener("input", () => { this.scene.look.clip = axis.value ? { axis: axis.value, share: Number(share.value), keepsHigh: side.checked } : null; this.redraw(); });
        this.picked = make("div", { "aria-live": "polite" });
        return make("div", { class: "panel controls" },
            labelled("Colour by", this.fieldSelect), this.legend.element, this.range.element, labelled("Colours", map),
            make("label", {}, check("grains", true), "grains"), make("label", {}, check("bridges", true, true), "bridges"),
            make("label", {}, check("contacts", false, true), "contacts by force"), make("label", {}, check("droplets", true, true), "droplets of sprays"), make("label", {}, check("walls", true), "walls"), this.wallChoice,
            axis, share, make("label", {}, side, "keep the other side"),
            make("div", { class: "buttons" }, ...Object.keys(presets).map((name) => make("button", { click: () => this.preset(name) }, name)), make("button", { click: () => this.reset() }, "all")),
            make("div", { class: "buttons" }, make("button", { click: () => this.savePicture() }, "Save picture"), make("button", { click: () => this.saveFilm() }, "Save film")),
            this.picked);
    }

    #looked() {
        this.moved();
        this.onLook(this.scene.camera);
    }

    #save(blob, ending) {
        const link = make("a", { href: URL.createObjectURL(blob), download: `${this.id.replaceAll("/", "-")}-${this.shown}.${ending}` });
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    }

    async showPicked(found) {
        if (!found) return this.picked.replaceChildren();
        try {
            const { fields } = await get("row", { id: this.id, frame: this.shown, of: `${found.kind}s`, row: found.row });
            const identity = fields.find(({ name }) => name === "identity")?.value[0];
            const title = found.kind === "grain" ? `Grain ${identity ?? `in row ${found.row}`}` : "Contact";
            const cells = fields.map((field) => [fieldLabel(field), field.value.map((part) => number(part, 6)).join(", ")]);
            const rows = cells.map((row) => make("tr", {}, ...row.map((cell) => make("td", {}, cell))));
            this.picked.replaceChildren(make("h3", {}, title), make("table", {}, ...rows));
        } catch (problem) {
            tell(problem.message);
        }
    }

    #listen() {
        const { canvas } = this, fingers = new Map();
        let start = null;
        canvas.addEventListener("pointerdown", (event) => {
            canvas.setPointerCapture(event.pointerId);
            fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
            start = fingers.size === 1 ? [event.offsetX, event.offsetY] : null;
        });
        canvas.addEventListener("pointermove", (event) => {
            const before = fingers.get(event.pointerId);
            if (!before) return;
            this.#drag(fingers, event, before);
            fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
        });
        canvas.addEventListener("pointerup", (event) => {
            fingers.delete(event.pointerId);
            if (start && Math.hypot(event.offsetX - start[0], event.offsetY - start[1]) < 4) this.showPicked(this.scene.pick(event.offsetX, event.offsetY));
        });
        canvas.addEventListener("pointercancel", (event) => fingers.delete(event.pointerId));
        canvas.addEventListener("contextmenu", (event) => event.preventDefault());
        canvas.addEventListener("wheel", (event) => {
            event.preventDefault();
            this.scene.camera.zoom(Math.exp(0.001 * event.deltaY));
            this.#looked();
        }, { passive: false });
        canvas.addEventListener("keydown", (event) => this.#key(event));
    }

    /** One finger or button turns, the right button or Shift shifts, two fingers come nearer. */
    #drag(fingers, event, before) {
        const { camera } = this.scene, dx = event.offsetX - before[0], dy = event.offsetY - before[1];
        if (fingers.size === 2) {
            const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
            const length = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
            camera.zoom(Math.max(length(before), 1) / Math.max(length([event.offsetX, event.offsetY]), 1));
        } else if (event.buttons & 2 || event.shiftKey) {
            camera.shift(dx / this.canvas.clientHeight, -dy / this.canvas.clientHeight);
        } else {
            camera.rotate(0.006 * dx, 0.006 * dy);
        }
        this.#looked();
    }

    #key(event) {
        const { camera } = this.scene;
        const keys = {
            ArrowLeft: () => camera.rotate(-0.1, 0), ArrowRight: () => camera.rotate(0.1, 0), ArrowUp: () => camera.rotate(0, 0.1), ArrowDown: () => camera.rotate(0, -0.1),
            "+": () => camera.zoom(0.9), "=": () => camera.zoom(0.9), "-": () => camera.zoom(1.1), " ": () => this.play(), f: () => this.follow(), s: () => this.savePicture(), r: () => this.reset(),
            ".": () => this.ask(Math.min(this.shown + 1, this.times.length - 1)), ",": () => this.ask(Math.max(this.shown - 1, 0)),
        };
        Object.keys(presets).forEach((name, k) => { keys[String(k + 1)] = () => this.preset(name); });
        if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        keys[event.key]();
        this.#looked();
    }
}
