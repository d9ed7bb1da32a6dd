// Words, numbers and elements of the page.

/** 1.234e-5 and 0.0123 as a person reads them. */
export function number(value, digits = 4) {
    if (value === null || value === undefined || !Number.isFinite(value)) return "-";
    const size = Math.abs(value);
    if (size !== 0 && (size >= 1e5 || size < 1e-3)) return value.toExponential(digits - 1).replace(/\.?0+e/, "e");
    return String(Number(value.toPrecision(digits)));
}

export function bytes(count) {
    const units = ["B", "kB", "MB", "GB", "TB"];
    let k = 0;
    for (; count >= 1000 && k < units.length - 1; ++k) count /= 1000;
    return `${count.toPrecision(3).replace(/\.0+$/, "")} ${units[k]}`;
}

/** "2 min 5 s" */
export function duration(seconds) {
    if (!Number.isFinite(seconds)) return "-";
    const s = Math.round(seconds);
    if (s < 60) return `${s} s`;
    if (s < 3600) return `${Math.floor(s / 60)} min ${s % 60} s`;
    return `${Math.floor(s / 3600)} h ${Math.floor((s % 3600) / 60)} min`;
}

/** The quantity "granular_temperature" in the unit "m^2/s^2": "granular temperature (m^2/s^2)". */
export function fieldLabel({ quantity, unit }) {
    return quantity.replaceAll("_", " ") + (unit ? ` (${unit})` : "");
}

/** An element: make("a", {href: "#"}, "text", other). Attributes that are functions are listeners. */
export function make(tag, attributes = {}, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === "function") element.addEventListener(name, value);
        else if (value === true) element.setAttribute(name, "");
        else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
    }
    element.append(...children.filter((child) => child !== null && child !== undefined));
    return element;
}

export function labelled(text, input, ...more) {
    return make("label", {}, `${text} `, input, ...more);
}

/** Of something that is done again and again: takes its own sentence away when it has worked, and no other. */
export class Teller {
    said = "";

    say(text) {
        tell(this.said = text);
    }

    clear() {
        if (this.said && document.getElementById("told").textContent === this.said) tell();
        this.said = "";
    }
}

/** Says something at the top of the page; nothing: takes it away. */
export function tell(text = "") {
    const told = document.getElementById("told");
    if (told.textContent !== text) told.textContent = text;
}
