// Fields of coarse graining as maps: of two directions from images and HDF5 files, and of one direction over time from
// a table.
import { getColumns } from "./api.js";
import { Legend, Range } from "./legend.js";
import { colourMap, colourMapNames } from "./scene/colours.js";
import { fieldLabel, labelled, make, number, Teller } from "./text.js";

const highest = 420;  // CSS pixels of a map

/** The outer ends of points that are the middles of cells. */
function endsOf(places) {
    const half = places.length > 1 ? (places[places.length - 1] - places[0]) / (places.length - 1) / 2 : 0;
    return [places[0] - half, places[places.length - 1] + half];
}

/** Numbers at points as a picture, with axes, a legend, and the number at the place that is pointed at. */
export class HeatMap {
    constructor(name) {
        this.canvas = make("canvas", { class: "map", width: 1, height: 1, tabindex: "0", role: "img", "aria-label": `map of ${name}. Arrows move the mark whose value is read out.` });
        [this.top, this.upName, this.bottom, this.left, this.acrossName, this.right] = Array.from({ length: 6 }, () => make("span"));
        this.bottomLine = make("div", { class: "across" }, this.left, this.acrossName, this.right);
        this.said = make("div", { class: "quiet", "aria-live": "polite" });
        this.legend = new Legend();
        this.range = new Range(() => this.draw());
        this.colours = make("select", { "aria-label": `colours of ${name}`, change: () => this.draw() }, ...colourMapNames.map((map) => new Option(map)));
        this.element = make("div", {}, make("div", { class: "plot" },
            make("div", { class: "up" }, this.top, this.upName, this.bottom), this.canvas,
            make("span"), this.bottomLine),
        this.legend.element, this.range.element, this.colours, this.said);
        this.#listen();
    }

    /**
     * @param content values, those of the lowest row first, NaN where there is nothing; across and up: {label, places};
     * unit; isSpace: both axes are lengths
     */
    show(content) {
        this.content = content;
        this.mark = null;
        this.said.textContent = "";
        this.draw();
    }

    draw() {
        if (!this.content) return;
        const { values, across, up, unit, isSpace } = this.content, [wide, high] = [across.places.length, up.places.length];
        const range = this.range.of(values), [lowest, top] = range, map = colourMap(this.colours.value);
        const pixels = new ImageData(wide, high);
        for (let row = 0; row < high; ++row)
            for (let column = 0; column < wide; ++column) {
                const value = values[row * wide + column], at = 4 * ((high - 1 - row) * wide + column);
                if (!Number.isFinite(value)) continue;  // nothing is drawn
                const share = top > lowest ? Math.max(0, Math.min(1, (value - lowest) / (top - lowest))) : 0.5;
                pixels.data.set(map.subarray(4 * Math.round(255 * share), 4 * Math.round(255 * share) + 4), at);
            }
        [this.canvas.width, this.canvas.height] = [wide, high];
        this.canvas.getContext("2d").putImageData(pixels, 0, 0);
        this.#shape(isSpace ? endsOf(across.places).concat(endsOf(up.places)) : [0, 2, 0, 1]);
        this.legend.show(this.colours.value, range, unit);
        this.#sayAxis(across, isSpace, this.left, this.acrossName, this.right);
        this.#sayAxis(up, true, this.bottom, this.upName, this.top);
    }

    /** As wide and high as what is shown, and not higher than the page. */
    #shape([left, right, bottom, top]) {
        const ratio = (right - left) / (top - bottom), aspect = Number.isFinite(ratio) && ratio > 0 ? Math.max(0.2, Math.min(8, ratio)) : 2;
        this.canvas.style.aspectRatio = String(aspect);
        this.canvas.style.width = this.bottomLine.style.width = `min(100%, ${Math.round(highest * aspect)}px)`;
    }

    #sayAxis({ label, places }, isSpace, low, name, high) {
        const ends = isSpace ? endsOf(places) : [places[0], places[places.length - 1]];
        [low.textContent, name.textContent, high.textContent] = [number(ends[0]), label, number(ends[1])];
    }

    #listen() {
        const { canvas } = this;
        canvas.addEventListener("pointermove", (event) => {
            const share = [event.offsetX / canvas.clientWidth, 1 - event.offsetY / canvas.clientHeight];
            if (this.content) this.say(Math.floor(share[0] * this.content.across.places.length), Math.floor(share[1] * this.content.up.places.length));
        });
        const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
        canvas.addEventListener("keydown", (event) => {
            if (!steps[event.key] || !this.content) return;
            event.preventDefault();
            const [column, row] = this.mark ?? [-1, 0];
            this.say(column + steps[event.key][0], row + steps[event.key][1]);
        });
    }

    /** Says the value at a point. */
    say(column, row) {
        const { values, across, up, unit } = this.content, inside = (k, count) => Math.max(0, Math.min(count - 1, k));
        this.mark = [inside(column, across.places.length), inside(row, up.places.length)];
        const value = values[this.mark[1] * across.places.length + this.mark[0]];
        const places = [across, up].map(({ label, places }, k) => `${label} ${number(places[this.mark[k]])}`).join(", ");
        this.said.textContent = `${places}: ${Number.isFinite(value) ? `${number(value, 5)} ${unit}` : "no grains"}`;
    }
}

const axisLabel = ({ name }) => `${name} (m)`;

/** A series of files with fields: a map of the chosen field, part, slice and time. */
export class FieldMap {
    field = "density_kg_per_m3";
    normal = "";
    slice = "";
    shown = -1;
    times = [];
    turn = 0;  // of what is asked for

    constructor(id, name) {
        Object.assign(this, { id, name, map: new HeatMap(name), told: new Teller() });
        this.fieldSelect = make("select", { change: () => { this.field = this.fieldSelect.value; this.#load(); } });
        this.normalSelect = make("select", { change: () => { [this.normal, this.slice] = [this.normalSelect.value, ""]; this.#load(); } });
        this.sliceSlider = make("input", { type: "range", min: 0, max: 0, "aria-label": `slice of ${name}`, input: () => { this.slice = this.sliceSlider.value; this.#load(); } });
        this.timeSlider = make("input", { type: "range", min: 0, max: 0, "aria-label": `time of ${name}`, input: () => { this.shown = Number(this.timeSlider.value); this.#load(); } });
        this.when = make("span", { class: "quiet" });
        this.slicing = make("div", {}, labelled("Looked along", this.normalSelect), this.sliceSlider);
        this.element = make("section", { class: "panel controls" }, make("h3", {}, name), labelled("Field", this.fieldSelect), this.map.element,
            this.slicing, make("div", { class: "time" }, this.timeSlider, this.when));
    }

    /** The times (s) that there are now; the last one is followed where it was shown. What has failed is tried again. */
    async setTimes(times) {
        const isLast = this.shown < 0 || this.shown === this.times.length - 1, grew = times.length !== this.times.length;
        this.times = times;
        this.timeSlider.max = times.length - 1;
        if (!grew && !this.hasFailed) return;
        if (isLast || this.shown >= times.length) this.shown = times.length - 1;
        await this.#load();
    }

    async #load() {
        const turn = ++this.turn;
        try {
            const frame = this.shown, words = { id: this.id, name: this.name, frame, field: this.field, normal: this.normal, slice: this.slice };
            const content = await getColumns("map", words);
            if (turn !== this.turn) return;  // something else has been asked for since
            this.#offer(content);
            const field = content.fields.find(({ name }) => name === content.field.split(".")[0]);
            this.map.show({ values: content.value, unit: field.unit, isSpace: true, across: this.#axis(content.across), up: this.#axis(content.up) });
            this.timeSlider.value = frame;
            this.when.textContent = `${number(this.times[frame])} s, ${frame + 1} of ${this.times.length}`;
            this.loads = (this.loads ?? 0) + 1;
            this.hasFailed = false;
            this.told.clear();
        } catch (problem) {
            if (turn !== this.turn) return;
            this.hasFailed = true;
            this.told.say(problem.message);
        }
    }

    #axis(axis) {
        return { label: axisLabel(axis), places: axis.places.map((place) => place ?? 0) };
    }

    #offer({ fields, field, across, up, normal, slice }) {
        if (this.fieldSelect.options.length === 0) {
            const letters = ["x", "y", "z"], names = [across, up, normal].sort((a, b) => a.number - b.number).map(({ name }) => name);
            const parts = { 3: letters.map((letter, k) => [letter, names[k]]), 9: letters.flatMap((a, j) => letters.map((b, k) => [a + b, `${names[j]} ${names[k]}`])) };
            this.fieldSelect.replaceChildren(...fields.flatMap((one) => {
                const whole = { 3: ", length", 9: ", mean of the diagonal" }[one.components] ?? "";
                return [new Option(fieldLabel(one) + whole, one.name), ...(parts[one.components] ?? []).map(([part, text]) => new Option(`${fieldLabel(one)}, ${text}`, `${one.name}.${part}`))];
            }));
        }
        this.fieldSelect.value = this.field = field;
        const axes = [across, up, normal].sort((a, b) => a.number - b.number);
        this.slicing.hidden = normal.places.length < 2;
        this.normalSelect.replaceChildren(...axes.map(({ name, number: axis }) => new Option(name, axis)));
        this.normalSelect.value = normal.number;
        this.sliceSlider.max = normal.places.length - 1;
        this.sliceSlider.value = slice;
    }
}

/** A table of fields along one direction as a map of a column: time across, place up. */
export class ProfileMap {
    constructor(name) {
        this.map = new HeatMap(name);
        this.select = make("select", { change: () => this.draw() });
        this.element = make("div", { class: "controls" }, labelled("Column", this.select), this.map.element);
    }

    show(table) {
        this.table = table;
        if (this.select.options.length === 0) this.select.replaceChildren(...table.columns.slice(2).map((name, k) => new Option(name, k + 2)));
        this.draw();
    }

    draw() {
        const { columns, values } = this.table, [times, places] = [0, 1].map((k) => [...new Set(values[k])].sort((a, b) => a - b));
        const column = Number(this.select.value), numberOf = (list) => new Map(list.map((value, k) => [value, k]));
        const [columnOf, rowOf] = [numberOf(times), numberOf(places)], map = new Float32Array(times.length * places.length).fill(NaN);
        values[column].forEach((value, k) => { map[rowOf.get(values[1][k]) * times.length + columnOf.get(values[0][k])] = value; });
        this.map.show({ values: map, unit: "", isSpace: false, across: { label: "time (s)", places: times }, up: { label: `${columns[1].slice(0, 1)} (m)`, places } });
    }
}
