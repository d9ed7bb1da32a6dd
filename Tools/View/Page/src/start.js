import { get, post } from "./api.js";
import { make, tell } from "./text.js";

/** The page with a form for each driver. Returns what ends it. */
export function showStart(page) {
    const form = make("form", {}), choice = make("select", { id: "driver" }), text = make("p");
    page.replaceChildren(make("h2", {}, "Start a run"), make("label", { for: "driver" }, "Driver "), choice, text, form);
    get("drivers").then((drivers) => {
        choice.replaceChildren(...drivers.map(({ driver }) => new Option(driver)));
        const show = () => {
            const driver = drivers[choice.selectedIndex];
            text.textContent = driver ? driver.description : "No driver has been built.";
            if (driver) new Form(form, driver);
        };
        choice.addEventListener("change", show);
        show();
    }).catch((problem) => tell(problem.message));
    return () => {};
}

/** What the server refuses, said here at once: the sentence, or nothing. */
export function objectionTo(option, value) {
    if (value === "" || option.type === "flag" || option.type === "text") return "";
    const words = option.several ? value.split(/[\s,]+/).filter(Boolean) : [value];
    for (const word of words) {
        const number = Number(word);
        if (!Number.isFinite(number)) return `${word} is no number`;
        if (option.type !== "number" && !/^[+-]?\d+$/.test(word)) return `${word} is no whole number`;
        if (option.type === "count" && number < 0) return `${word} is below 0`;
        if (option.range && !contains(option.range, number)) return `it must be ${rangeText(option.range)}`;
    }
    return "";
}

function contains({ lowest, highest, lowestIncluded, highestIncluded }, value) {
    return (lowest === null || (lowestIncluded ? value >= lowest : value > lowest)) && (highest === null || (highestIncluded ? value <= highest : value < highest));
}

function rangeText({ lowest, highest, lowestIncluded, highestIncluded }) {
    const low = lowest === null ? "" : `${lowestIncluded ? "at least" : "above"} ${lowest}`;
    const high = highest === null ? "" : `${highestIncluded ? "at most" : "below"} ${highest}`;
    return [low, high].filter(Boolean).join(" and ") || "finite";
}

class Form {
    constructor(form, description) {
        this.driver = description.driver;
        this.options = description.options.filter(({ name, path }) => !path && !["--resume", "--wall-time", "--quiet"].includes(name));
        this.inputs = new Map(this.options.map((option) => [option.name, this.#input(option)]));
        this.name = make("input", { type: "text", placeholder: `${this.driver}-1, -2, ...` });
        this.studies = [1, 2].map((k) => this.#studied(k));
        const study = make("details", {}, make("summary", {}, "A study: a run for each value of an option, or for each pair of two"),
            ...this.studies.map((pair) => make("div", { class: "pair" }, ...pair)));
        form.replaceChildren(
            make("div", { class: "form" }, make("label", {}, "Name of the folder", this.name), ...this.options.map((option) => this.#labelled(option))),
            study, make("div", { class: "buttons" }, make("button", { type: "submit" }, "Start")));
        form.onsubmit = (event) => {
            event.preventDefault();
            this.start();
        };
    }

    /** The k-th option of a study and its values. */
    #studied(k) {
        const names = this.options.map(({ name }) => new Option(name));
        const values = { type: "text", placeholder: "values, with blanks between", "aria-label": `values of option ${k} of the study` };
        return [make("select", { "aria-label": `option ${k} of the study` }, new Option("no study", ""), ...names), make("input", values)];
    }

    #input(option) {
        const id = `option${option.name}`;
        if (option.type === "flag") return make("input", { type: "checkbox", id });
        if (option.choices.length > 0) return make("select", { id }, new Option(`${option.default || "default"}`, ""), ...option.choices.map((word) => new Option(word)));
        const input = make("input", { type: "text", id, placeholder: option.default || "none", inputmode: option.type === "text" ? "text" : "decimal", "aria-describedby": `${id}-text` });
        const check = () => {
            const wrong = objectionTo(option, input.value.trim());
            input.setCustomValidity(wrong);
            input.classList.toggle("wrong", wrong !== "");
        };
        for (const event of ["input", "change"]) input.addEventListener(event, check);
        return input;
    }

    #labelled(option) {
        const input = this.inputs.get(option.name), range = option.range ? `; ${rangeText(option.range)}` : "", unit = option.unit ? ` (${option.unit})` : "";
        return make("label", { for: input.id }, `${option.name.slice(2)}${unit}`, input, make("small", { id: `${input.id}-text` }, option.text + range));
    }

    /** Texts of the options that were given. */
    given() {
        const options = {};
        for (const [name, input] of this.inputs) {
            if (input.type === "checkbox") {
                if (input.checked) options[name] = "true";
            } else if (input.value.trim() !== "") {
                options[name] = input.value.trim();
            }
        }
        return options;
    }

    /** The options of each run, and what is added to its name. */
    runs() {
        let all = [{ options: this.given(), ending: "" }];
        for (const [{ value: name }, values] of this.studies) {
            if (!name) continue;
            const added = (value) => `-${name.slice(2)}=${value}`.replaceAll(/[^\w.=-]/g, "_");
            const words = values.value.split(/\s+/).filter(Boolean);
            all = all.flatMap(({ options, ending }) => words.map((value) => ({ options: { ...options, [name]: value }, ending: ending + added(value) })));
        }
        return all;
    }

    /** Before the first run of a study begins: all of them, and that the names of their folders differ. */
    async #check(wishes) {
        const names = wishes.map(({ name }) => name), again = names.find((name, k) => names.indexOf(name) !== k);
        if (again !== undefined) throw new Error(`The study has two runs of the name ${again}; give each value once.`);
        for (const wish of wishes) await post("check", wish);
    }

    async start() {
        try {
            const runs = this.runs(), ids = [], base = this.name.value.trim();
            if (runs.length === 0) throw new Error("The study has no values.");
            const wishes = runs.map(({ options, ending }) => ({ driver: this.driver, name: ending ? `${base || this.driver}${ending}` : base, options }));
            if (wishes.length > 1) await this.#check(wishes);
            for (const wish of wishes) ids.push((await post("start", wish)).id);
            tell();
            location.hash = ids.length === 1 ? `run=${encodeURIComponent(ids[0])}` : `compare=${ids.map(encodeURIComponent).join(",")}`;
        } catch (problem) {
            tell(problem.message);
        }
    }
}
