import { get, post } from "./api.js";
import { Charts } from "./charts.js";
import { stateLine, timeLeft } from "./runs.js";
import { bytes, make, number, tell } from "./text.js";
import { Viewer } from "./viewer.js";

/** The page of one run. Returns what ends it. */
export function showRun(page, id) {
    const viewer = new Viewer(id), charts = new Charts(id), speeds = new Map();
    const state = make("div"), facts = make("div", { class: "quiet" }), health = make("div"), log = make("pre", { tabindex: "0" }), rows = make("table"), buttons = make("div", { class: "buttons" });
    const logPart = make("details", {}, make("summary", {}, "What the run has printed"), log);
    page.replaceChildren(make("h2", {}, id),
        make("div", { class: "run" }, make("div", {}, viewer.element),
            make("div", {}, make("div", { class: "panel" }, state, facts, buttons, health), viewer.controls)),
        charts.element, make("details", {}, make("summary", {}, "Summary of the run"), rows), logPart);
    try {
        viewer.begin();
    } catch (problem) {
        tell(problem.message);
    }
    let isOver = false, before = "", buttonsFor = "";
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
        facts.textContent = [run.driver, run.time !== null ? `${number(run.time)} s of ${number(run.endTime)} s` : null, run.grains !== null ? `${run.grains} grains` : null, bytes(run.bytes)].filter(Boolean).join(", ");
        health.replaceChildren(...[run.reason, ...run.complaints, run.frameProblem].filter(Boolean).map((text) => make("div", { class: "failed" }, text)));
        rows.replaceChildren(...run.rows.map((cells) => make("tr", {}, ...cells.map((cell) => make("td", {}, cell)))));
        if (buttonsFor !== run.state) showButtons(run);
        buttonsFor = run.state;
    }
    function showButtons(run) {
        if (["running", "preparing", "waiting"].includes(run.state))
            return buttons.replaceChildren(make("button", { click: () => act("stop", { id }) }, "Stop"));
        buttons.replaceChildren(...(run.start ? resumeForm(run.start.options, (options) => act("resume", { id, options })) : []));
    }
    async function refresh() {
        if (isOver) return;
        try {
            const run = await get("run", { id });
            if (isOver) return;
            showState(run);
            log.textContent = run.log;
            logPart.hidden = run.log === "";
            viewer.setTimes(run.frames);
            await charts.refresh(run.tables);
        } catch (problem) {
            tell(problem.message);
        }
        if (!isOver) timer = setTimeout(refresh, 1000);
    }
    let timer = setTimeout(refresh, 0);
    window.pendular.viewer = viewer;
    return () => { isOver = true; clearTimeout(timer); viewer.end(); charts.end(); };
}

/** What may be changed where a run goes on: end, intervals, threads. */
function resumeForm(options, resume) {
    const changeable = { "--end-time-s": "end (s)", "--paraview-interval-s": "interval of pictures (s)", "--threads": "threads" };
    const inputs = Object.entries(changeable).map(([name, text]) => [name, make("input", { type: "text", size: 8, value: options[name] ?? "", "aria-label": text, placeholder: text })]);
    const button = make("button", { click: () => resume(Object.fromEntries(inputs.filter(([, input]) => input.value.trim() !== "").map(([name, input]) => [name, input.value.trim()]))) }, "Go on");
    return [...inputs.map(([, input]) => input), button];
}
