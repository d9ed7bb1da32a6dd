import { CategoryScale, Chart, Decimation, Legend, LinearScale, LineController, LineElement, PointElement, Tooltip } from "chart.js";
import { ProfileMap } from "./maps.js";
import { isProfile, Table } from "./table.js";
import { make, number, tell } from "./text.js";

Chart.register(CategoryScale, Decimation, Legend, LinearScale, LineController, LineElement, PointElement, Tooltip);

const palette = ["#2673d9", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#56b4e9", "#b3261e", "#7a52c7"];

/** The colours of the page, so that text can be read in light and dark. */
function takeColours() {
    const style = getComputedStyle(document.body);
    Chart.defaults.color = style.color;
    Chart.defaults.borderColor = style.getPropertyValue("--edge");
}

export function lineChart(canvas, { x, y, points = false }) {
    takeColours();
    return new Chart(canvas, {
        type: "line",
        data: { datasets: [] },
        options: {
            animation: false, parsing: false, normalized: true, maintainAspectRatio: false,
            interaction: { mode: "nearest", axis: "x", intersect: false },
            elements: { point: { radius: points ? 4 : 0 }, line: { borderWidth: 1.5 } },
            scales: { x: { type: "linear", title: { display: true, text: x } }, y: { title: { display: Boolean(y), text: y }, ticks: { callback: (v) => number(v, 3) } } },
            plugins: { decimation: { enabled: !points, algorithm: "min-max" }, legend: { labels: { boxWidth: 12 } } },
        },
    });
}

/** Whether the first column grows, as times do; a list of grains is no chart. */
function isChart({ columns, values }) {
    return columns.length > 1 && values[0].every((x, k) => k === 0 || x >= values[0][k - 1]);
}

/** A chart of a table with a box for each column; of fields along one direction, a map. */
export class TableChart {
    constructor(id, name) {
        this.table = new Table(id, name);
        this.canvas = make("canvas", { role: "img", "aria-label": `chart of ${name}` });
        this.boxes = make("div", { class: "columns", role: "group", "aria-label": `columns of ${name}` });
        this.parts = [make("div", { class: "chart" }, this.canvas), this.boxes];
        this.body = make("div", {}, ...this.parts);
        this.element = make("section", { class: "panel" }, make("h3", {}, name), this.body);
    }

    async refresh() {
        try {
            if (!(await this.table.grow())) return;
        } catch (problem) {
            return tell(problem.message);
        }
        const isMap = isProfile(this.table);
        this.element.hidden = !isMap && !isChart(this.table);
        if (this.element.hidden) return;
        if (isMap !== Boolean(this.map)) this.#become(isMap);
        if (isMap) return this.map.show(this.table);
        this.chart ??= this.#begin();
        this.#draw();
    }

    end() {
        this.chart?.destroy();
        this.isOver = true;
    }

    /** A map, or a chart: the first rows alone may tell of the other one. */
    #become(isMap) {
        this.chart?.destroy();
        this.chart = null;
        this.map = isMap ? new ProfileMap(this.table.name) : null;
        this.body.replaceChildren(...(isMap ? [this.map.element] : this.parts));
    }

    #begin() {
        const { columns } = this.table, unit = (name) => name.slice(name.lastIndexOf("_") + 1);
        this.shown = new Set(columns.map((_, k) => k).slice(1).filter((k) => unit(columns[k]) === unit(columns[1])).slice(0, 8));
        this.boxes.replaceChildren(...columns.slice(1).map((name, k) => make("label", {}, make("input", { type: "checkbox", checked: this.shown.has(k + 1), change: (event) => {
            if (event.target.checked) this.shown.add(k + 1);
            else this.shown.delete(k + 1);
            this.#draw();
        } }), name)));
        return lineChart(this.canvas, { x: columns[0] });
    }

    #draw() {
        if (this.isOver) return;
        const columns = [...this.shown].sort((a, b) => a - b);
        this.chart.data.datasets = columns.map((k) => line(this.table.columns[k], this.table.points(k), k - 1));
        this.chart.update("none");
    }
}

/** Charts of all tables of a run. */
export class Charts {
    charts = new Map();
    element = make("div", { class: "charts" });

    constructor(id) {
        this.id = id;
    }

    async refresh(names) {
        for (const name of names)
            if (!this.charts.has(name)) {
                this.charts.set(name, new TableChart(this.id, name));
                this.element.append(this.charts.get(name).element);
            }
        await Promise.all([...this.charts.values()].map((chart) => chart.refresh()));
    }

    end() {
        this.charts.forEach((chart) => chart.end());
    }
}

/** A line of a chart in the k-th colour. */
export function line(label, data, k) {
    const colour = palette[k % palette.length];
    return { label, data, borderColor: colour, backgroundColor: colour };
}
