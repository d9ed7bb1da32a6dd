import { get } from "./api.js";
import { line, lineChart } from "./charts.js";
import { Table } from "./table.js";
import { make, tell } from "./text.js";
import { Viewer } from "./viewer.js";

/** Runs beside each other: pictures of two or three with one camera, what differs in their options, a table of all in one
 * chart, and, of a study, a column over an option. Returns what ends it. */
export function showCompare(page, ids) {
    const viewers = ids.length <= 3 ? ids.map((id) => new Viewer(id, { onLook: (camera) => share(camera) })) : [];
    const share = (camera) => viewers.forEach((other) => {
        if (other.scene.camera === camera) return;
        other.scene.camera.from(camera.turn, camera.tilt);
        other.scene.camera.distance = (camera.distance / camera.size) * other.scene.camera.size;
        other.moved();
    });
    const differences = make("table"), chart = new ComparedTables(ids);
    page.replaceChildren(make("h2", {}, "Compare"),
        make("div", { class: "beside" }, ...viewers.map((viewer) => make("section", { class: "panel" }, make("h3", {}, viewer.id), viewer.element, make("details", {}, make("summary", {}, "What is shown"), viewer.controls)))),
        make("h3", {}, "What differs"), differences, chart.element);
    let isOver = false, timer = 0;
    viewers.forEach((viewer) => viewer.begin());
    async function refresh() {
        try {
            const runs = await Promise.all(ids.map((id) => get("run", { id })));
            if (isOver) return;
            showDifferences(differences, runs);
            viewers.forEach((viewer, k) => viewer.setTimes(runs[k].frames, runs[k].stateWritten));
            await chart.refresh(runs);
        } catch (problem) {
            tell(problem.message);
        }
        if (!isOver) timer = setTimeout(refresh, 2000);
    }
    refresh();
    return () => { isOver = true; clearTimeout(timer); viewers.forEach((viewer) => viewer.end()); chart.end(); };
}

/** Options of the start, where both have them; else the rows of the summary that tell of the scene. */
function showDifferences(table, runs) {
    const ofScene = /^(species|grains|time step|gravity|walls|end time)/;
    const facts = runs.map(({ start, rows }) => {
        if (start) return new Map(Object.entries({ driver: start.driver, ...start.options }));
        return new Map(rows.filter(([name]) => ofScene.test(name)).map(([name, value, unit]) => [name, `${value} ${unit}`]));
    });
    const names = [...new Set(facts.flatMap((fact) => [...fact.keys()]))].filter((name) => new Set(facts.map((fact) => fact.get(name))).size > 1);
    const head = make("tr", {}, make("th", { scope: "col" }, "option"), ...runs.map(({ id }) => make("th", { scope: "col" }, id)));
    table.replaceChildren(head, ...names.map((name) => make("tr", {}, make("th", { scope: "row" }, name), ...facts.map((fact) => make("td", {}, fact.get(name) ?? "default")))));
}

class ComparedTables {
    tables = new Map();

    constructor(ids) {
        this.ids = ids;
        [this.table, this.column, this.option] = ["table", "column", "option"].map((word) => make("select", { "aria-label": word, change: () => this.#draw() }));
        [this.canvas, this.studyCanvas] = ["tables of the runs", "last values over the option"].map((text) => make("canvas", { role: "img", "aria-label": text }));
        this.element = make("section", { class: "panel" }, make("h3", {}, "Tables"), make("div", { class: "buttons" }, this.table, this.column),
            make("div", { class: "chart" }, this.canvas), make("h3", {}, "Mean of the last half over an option"), this.option, make("div", { class: "chart" }, this.studyCanvas));
    }

    async refresh(runs) {
        this.runs = runs;
        const common = runs[0].tables.filter((name) => runs.every(({ tables }) => tables.includes(name)));
        keepChoice(this.table, common);
        const options = new Set(runs.flatMap(({ start }) => Object.keys(start?.options ?? {})));
        const isNumber = (name) => runs.every(({ start }) => Number.isFinite(Number(start?.options[name])));
        keepChoice(this.option, [...options].filter(isNumber));
        for (const name of common)
            if (!this.tables.has(name)) this.tables.set(name, this.ids.map((id) => new Table(id, name)));
        if (this.table.value) await Promise.all(this.tables.get(this.table.value).map((table) => table.grow()));
        this.#draw();
    }

    end() {
        this.chart?.destroy();
        this.study?.destroy();
    }

    #draw() {
        const tables = this.tables.get(this.table.value);
        if (!tables || tables[0].columns.length < 2) return;
        keepChoice(this.column, tables[0].columns.slice(1));
        const column = this.column.selectedIndex + 1;
        this.chart ??= lineChart(this.canvas, { x: tables[0].columns[0] });
        this.chart.data.datasets = tables.map((table, k) => line(this.ids[k], table.points(column), k));
        this.chart.update("none");
        if (this.option.value) this.#drawStudy(tables, column);
    }

    #drawStudy(tables, column) {
        this.study ??= lineChart(this.studyCanvas, { x: this.option.value, points: true });
        const points = tables.map((table, k) => ({ x: Number(this.runs[k].start.options[this.option.value]), y: meanOfLastHalf(table.points(column)) }));
        this.study.options.scales.x.title.text = this.option.value;
        const shown = points.filter(({ y }) => Number.isFinite(y)).sort((a, b) => a.x - b.x);
        this.study.data.datasets = [line(this.column.value, shown, 0)];
        this.study.update("none");
    }
}

function meanOfLastHalf(points) {
    const half = points.slice(Math.floor(points.length / 2));
    return half.reduce((sum, { y }) => sum + y, 0) / half.length;
}

function keepChoice(select, names) {
    const before = select.value;
    if ([...select.options].map(({ value }) => value).join("\n") === names.join("\n")) return;
    select.replaceChildren(...names.map((name) => new Option(name)));
    if (names.includes(before)) select.value = before;
}
