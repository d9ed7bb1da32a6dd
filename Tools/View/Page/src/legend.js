// The colours of a field, beside what they are shown in, and which values they have at their ends.
import { colourMap } from "./scene/colours.js";
import { make, number } from "./text.js";

/** A bar with the colours, and below it the lowest value, the unit and the highest one. */
export class Legend {
    constructor() {
        this.canvas = make("canvas", { class: "scale", width: 256, height: 1, "aria-hidden": "true" });
        [this.low, this.unit, this.high] = ["span", "span", "span"].map((tag) => make(tag));
        this.element = make("div", {}, this.canvas, make("div", { class: "legend" }, this.low, this.unit, this.high));
    }

    show(map, [lowest, highest], unit) {
        this.low.textContent = number(lowest);
        this.high.textContent = number(highest);
        this.unit.textContent = unit;
        this.canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(colourMap(map)), 256, 1), 0, 0);
    }
}

/** The lowest and the highest of some values, which may be NaN. */
export function rangeOf(values) {
    let lowest = Infinity, highest = -Infinity;
    for (const value of values) {
        if (value < lowest) lowest = value;
        if (value > highest) highest = value;
    }
    return lowest <= highest ? [lowest, highest] : [0, 1];
}

/** Two fields for the ends of the colours; `of(values)` gives those that hold. */
export class Range {
    constructor(onChange) {
        this.ends = [["lowest", "min"], ["highest", "max"]].map(([word, short]) => make("input", { type: "text", inputmode: "decimal", placeholder: `${short} (auto)`, "aria-label": `${word} of the colours`, change: () => { this.#take(); onChange(); } }));
        this.element = make("div", { class: "pair" }, ...this.ends);
    }

    /** Those that were given, else the lowest and the highest of these values. */
    of(values) {
        return this.fixed ?? rangeOf(values);
    }

    #take() {
        const values = this.ends.map((input) => input.value.trim() === "" ? NaN : Number(input.value));
        const isWrong = this.ends.some((input, k) => input.value.trim() !== "" && !Number.isFinite(values[k]));
        this.fixed = values.every(Number.isFinite) && values[0] < values[1] ? values : null;
        this.ends.forEach((input) => input.classList.toggle("wrong", isWrong));
    }
}
