import { get, post } from "./api.js";
import { Charts } from "./charts.js";
import { FieldMap } from "./maps.js";
import { factsOf, stateLine, timeLeft } from "./runs.js";
import { make, tell, Teller } from "./text.js";
import { Viewer } from "./viewer.js";

/** The page of one run. Returns what ends it. */
export function showRun(page, id) {
    const viewer = new Viewer(id), charts = new Charts(id), speeds = new Map(), maps = new Map();
    const state = make("div"), facts = make("div", { class: "quiet" }), health = make("div"), rows = make("table");
    const mapPart = make("div", { class: "charts" }), log = make("pre", { tabindex: "0" }), buttons = make("div", { class: "buttons" });
    const logPart = make("details", {}, make("summary", {}, "What the run has printed"), log);
    page.replaceChildren(make("h2", {}, id),
        make("div", { class: "run" }, make("div", {}, viewer.element),
            make("div", {}, make("div", { class: "panel" }, state, facts, buttons, health), viewer.controls)),
        mapPart, charts.element, make("details", {}, make("summary", {}, "Summary of the run"), rows), logPart);
    try {
        viewer.begin();
    } catch (problem) {
        tell(problem.message);
    }
    const told = new Teller();
    let isOver = false, before = "", buttonsFor = "", known = null;  // the driver's options
    const act = async (path, wish) => {
        try {
            await post(path, wish);
            tell();
        } catch (problem) {
            tell(problem.message);
        }
    };
    function showState(run) {
        const now = JSON.stringify([run.state, run.reason, run.time, run.bytes, run.complaints, run.rows.length]);
        if (now === before) return;
        before = now;
        state.replaceChildren(stateLine(run, timeLeft(speeds, run)));
        facts.textContent = factsOf(run);
        health.replaceChildren(...[run.reason, ...run.complaints, run.frameProblem].filter(Boolean).map((text) => make("div", { class: "failed" }, text)));
        rows.replaceChildren(...run.rows.map((cells) => make("tr", {}, ...cells.map((cell) => make("td", {}, cell)))));
        if (buttonsFor !== run.state) showButtons(run);
        buttonsFor = run.state;
    }
    function showButtons(run) {
        if (["running", "preparing", "waiting"].includes(run.state))
            return buttons.replaceChildren(make("button", { click: () => act("stop", { id }) }, "Stop"));
        buttons.replaceChildren(...(run.start ? resumeForm(run.start, known, (options) => act("resume", { id, options })) : []));
    }
    function askOptions(driver) {
        known = new Set();
        optionsOf(driver).then((names) => { known = names, before = buttonsFor = ""; }).catch((problem) => tell(problem.message));
    }
    async function showMaps(series) {
        for (const { name } of series)
            if (!maps.has(name)) {
                maps.set(name, new FieldMap(id, name));
                mapPart.append(maps.get(name).element);
            }
        await Promise.all(series.map(({ name, times }) => maps.get(name).setTimes(times)));
    }
    async function refresh() {
        if (isOver) return;
        try {
            const run = await get("run", { id });
            if (isOver) return;
            if (run.start && !known) askOptions(run.start.driver);
            showState(run);
            log.textContent = run.log;
            logPart.hidden = run.log === "";
            viewer.setTimes(run.frames, run.stateWritten);
            await showMaps(run.maps);
            await charts.refresh(run.tables);
            told.clear();
        } catch (problem) {
            told.say(problem.message);
        }
        if (!isOver) timer = setTimeout(refresh, 1000);
    }
    let timer = setTimeout(refresh, 0);
    Object.assign(window.pendular, { viewer, maps, charts });
    return () => { isOver = true; clearTimeout(timer); viewer.end(); charts.end(); };
}

/** The names of a driver's options; none where it is not built here. */
async function optionsOf(driver) {
    const described = (await get("drivers")).find((one) => one.driver === driver);
    return new Set((described?.options ?? []).map(({ name }) => name));
}

/** What may be changed where a run goes on, if its driver has it: end, intervals, threads. */
function resumeForm({ options }, known, resume) {
    const changeable = { "--end-time-s": "end (s)", "--paraview-interval-s": "interval of pictures (s)", "--threads": "threads" };
    const inputs = Object.entries(changeable).filter(([name]) => known.has(name)).map(([name, text]) => {
        return [name, make("input", { type: "text", size: 8, value: options[name] ?? "", "aria-label": text, placeholder: text })];
    });
    const given = () => inputs.map(([name, input]) => [name, input.value.trim()]).filter(([, value]) => value !== "");
    const button = make("button", { click: () => resume(Object.fromEntries(given())) }, "Go on");
    return [...inputs.map(([, input]) => input), button];
}
