import { CategoryScale, Chart, Decimation, Legend, LinearScale, LineController, LineElement, PointElement, Tooltip } from "chart.js";
import { get } from "./api.js";
import { isProfile, ProfileMap } from "./maps.js";
import { make, number, tell } from "./text.js";

Chart.register(CategoryScale, Decimation, Legend, LinearScale, LineController, LineElement, PointElement, Tooltip);

const palette = ["#2673d9", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#56b4e9", "#b3261e", "#7a52c7"];
const mostRows = 20000;  // that a chart keeps: beyond, every second one goes

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

/** A table of a run as it grows: columns as lists of numbers. */
export class Table {
    columns = [];
    values = [];
    next = 0;

    constructor(id, name) {
        this.id = id;
        this.name = name;
    }

    /** Takes the rows that have come; returns whether there are some. */
    async grow() {
        let grew = false;
        for (;;) {
            const { columns, rows, next, begins } = await get("table", { id: this.id, name: this.name, from: this.next });
            if (begins) [this.columns, this.values] = [columns, columns.map(() => [])];
            for (const row of rows) this.values.forEach((column, k) => column.push(row[k] ?? NaN));
            grew ||= rows.length > 0 || begins;
            this.next = next;
            this.#thin();
            if (rows.length === 0) return grew;
        }
    }

    points(column, x = 0) {
        const [xs, ys] = [this.values[x] ?? [], this.values[column] ?? []];
        return xs.map((value, k) => ({ x: value, y: ys[k] })).filter((p) => Number.isFinite(p.x) && Number.isFinite(p.y));
    }

    /** Of a table with places, whole times go. */
    #thin() {
        while ((this.values[0]?.length ?? 0) > (isProfile(this) ? 10 : 2) * mostRows) {
            let number = -1, before = NaN;
            const keeps = this.values[0].map((time) => {
                if (!isProfile(this) || time !== before) ++number;
                before = time;
                return number % 2 === 0;
            });
            if (keeps.every(Boolean)) return;
            this.values = this.values.map((column) => column.filter((_, k) => keeps[k]));
        }
    }
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
        this.body = make("div", {}, make("div", { class: "chart" }, this.canvas), this.boxes);
        this.element = make("section", { class: "panel" }, make("h3", {}, name), this.body);
    }

    async refresh() {
        try {
            if (!(await this.table.grow())) return;
        } catch (problem) {
            return tell(problem.message);
        }
        if (isProfile(this.table)) return this.#showMap();
        this.element.hidden = !isChart(this.table);
        if (this.element.hidden) return;
        this.chart ??= this.#begin();
        this.#draw();
    }

    end() {
        this.chart?.destroy();
        this.isOver = true;
    }

    #showMap() {
        if (!this.map) {
            this.chart?.destroy();
            this.map = new ProfileMap(this.table.name);
            this.body.replaceChildren(this.map.element);
        }
        this.map.show(this.table);
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
