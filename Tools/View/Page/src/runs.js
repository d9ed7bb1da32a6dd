import { get, getFrame, post } from "./api.js";
import { Scene } from "./scene/Scene.js";
import { bytes, duration, make, number, tell, Teller } from "./text.js";

const words = { preparing: "makes its first grains", running: "running", ended: "at its end", stopped: "stopped", failed: "failed", silent: "silent", waiting: "waits" };
const mostGrains = 200000;  // of a run whose picture is drawn here

/** Pictures of runs, drawn one after another by one scene, and kept until the run has changed. */
class Pictures {
    kept = new Map();  // by id: {changed, data}
    queue = [];

    constructor() {
        this.canvas = make("canvas", { "aria-hidden": "true" });
        Object.assign(this.canvas.style, { position: "fixed", left: "-1000px", width: "300px", height: "130px" });
        document.body.append(this.canvas);
    }

    end() {
        this.isOver = true;
        this.queue = [];
        this.scene?.end();
        this.canvas.remove();
    }

    /** The picture as it is known; a newer one comes with the next list. */
    of(run) {
        const known = this.kept.get(run.id);
        const isNew = !known || (known.changed !== run.changed && Date.now() - known.drawn > 10000);
        if (isNew && run.grains > 0 && run.grains <= mostGrains && !this.queue.some(({ id }) => id === run.id)) {
            this.queue.push(run);
            this.#work();
        }
        return known?.data;
    }

    async #work() {
        if (this.isBusy) return;
        this.isBusy = true;
        while (this.queue.length > 0) {
            const run = this.queue[0], entry = { changed: run.changed, drawn: Date.now(), data: null };
            try {
                const { frames } = await get("run", { id: run.id });
                if (frames.length > 0) entry.data = await this.#draw(run.id, frames.length - 1);
            } catch {
                entry.data = null;  // a run without a frame that can be read has no picture
            }
            this.kept.set(run.id, entry);
            this.queue.shift();
        }
        this.isBusy = false;
    }

    async #draw(id, frame) {
        const content = await getFrame({ id, frame, field: "" });
        if (this.isOver) return null;
        this.scene ??= new Scene(this.canvas);
        this.scene.show(content);
        const { value } = content;
        this.scene.look.range = [value.reduce((a, b) => Math.min(a, b), Infinity), value.reduce((a, b) => Math.max(a, b), -Infinity)];
        this.scene.lookAtAll();
        this.scene.render({ finish: true });
        return this.canvas.toDataURL("image/png");
    }
}

/** The page with all runs. Returns what ends it. */
export function showRuns(page) {
    const list = make("ul", { class: "runs" }), chosen = new Set(), speeds = new Map(), pictures = new Pictures(), told = new Teller();
    const root = make("span", { class: "quiet" });
    const compare = make("button", { disabled: true, click: () => { location.hash = `compare=${[...chosen].map(encodeURIComponent).join(",")}`; } }, "Compare the chosen");
    page.replaceChildren(make("h2", {}, "Runs"), root, make("div", { class: "buttons" }, compare), list);
    const choose = (id, isChosen) => {
        if (isChosen) chosen.add(id);
        else chosen.delete(id);
        compare.disabled = chosen.size < 2;
    };
    const act = async (path, wish) => {
        try {
            await post(path, wish);
            tell();
        } catch (problem) {
            tell(problem.message);
        }
        await update();
    };
    const cards = new Map();  // by id: {text, element}; only what has changed is made anew, so that the focus stays
    let isOver = false, timer = 0;
    async function update() {
        try {
            const answer = await get("runs");
            if (isOver) return;
            root.textContent = answer.runs.length > 0 ? `in ${answer.root}` : `There are no runs in ${answer.root} yet.`;
            showCards(answer.runs.map((run) => ({ run, left: timeLeft(speeds, run), picture: pictures.of(run) })));
            told.clear();
        } catch (problem) {
            told.say(problem.message);
        }
    }
    function showCards(items) {
        const focus = document.activeElement?.getAttribute("data-key");
        for (const item of items) {
            const text = JSON.stringify(item), { id } = item.run;
            if (cards.get(id)?.text !== text) cards.set(id, { text, element: card(item, { chosen, choose, act }) });
        }
        const elements = items.map(({ run }) => cards.get(run.id).element);
        if (elements.length !== list.children.length || elements.some((element, k) => element !== list.children[k])) list.replaceChildren(...elements);
        if (focus && document.activeElement?.getAttribute("data-key") !== focus) list.querySelector(`[data-key="${CSS.escape(focus)}"]`)?.focus();
    }
    async function refresh() {  // the next question comes after the answer
        await update();
        if (!isOver) timer = setTimeout(refresh, 2000);
    }
    refresh();
    return () => { isOver = true; clearTimeout(timer); pictures.end(); };
}

/** s on the clock, from how far the run came since it was first seen; null: not known. */
export function timeLeft(speeds, run) {
    const now = Date.now() / 1000, first = speeds.get(run.id);
    if (!["running", "preparing"].includes(run.state) || run.time === null) return speeds.delete(run.id), null;
    if (!first || run.time < first.time) return speeds.set(run.id, { time: run.time, now }), null;
    const speed = (run.time - first.time) / Math.max(now - first.now, 1e-9);
    return speed > 0 ? Math.round((run.endTime - run.time) / speed) : null;
}

export function stateLine(run, left) {
    const isUnwell = run.healthy === false && run.state !== "failed" ? ", not well" : "";
    return make("div", {}, make("span", { class: `state ${run.state}` }, words[run.state] ?? run.state), isUnwell,
        left !== null && left !== undefined ? `, ${duration(left)} left` : "");
}

/** Driver, time, grains and size in one line. */
export function factsOf({ driver, time, endTime, grains, bytes: size }) {
    const facts = [driver, time !== null ? `${number(time)} s of ${number(endTime)} s` : null, grains !== null ? `${grains} grains` : null, bytes(size)];
    return facts.filter(Boolean).join(", ");
}

function card({ run, left, picture }, { chosen, choose, act }) {
    const isActive = ["running", "preparing", "waiting"].includes(run.state);
    const hasTime = run.time !== null && run.endTime !== null && run.endTime > 0 && run.endTime < 1e300;
    const box = make("input", { type: "checkbox", checked: chosen.has(run.id), "aria-label": `choose ${run.id}`, "data-key": `choose ${run.id}`, change: (event) => choose(run.id, event.target.checked) });
    return make("li", { class: "panel" },
        make("h3", {}, box, make("a", { href: `#run=${encodeURIComponent(run.id)}`, "data-key": `show ${run.id}` }, run.id)),
        picture ? make("img", { src: picture, alt: `The grains of ${run.id}, coloured by radius` }) : make("div", { class: "none" }),
        stateLine(run, left),
        run.reason ? make("div", { class: "failed" }, run.reason) : null,
        hasTime ? make("progress", { max: 1, value: Math.min(run.time / run.endTime, 1), "aria-label": "time over the end time" }) : null,
        make("div", { class: "quiet" }, factsOf(run)),
        make("div", { class: "buttons" },
            isActive ? make("button", { click: () => act("stop", { id: run.id }), "aria-label": `stop ${run.id}`, "data-key": `act ${run.id}` }, "Stop") : null,
            !isActive && run.driver ? make("button", { click: () => act("resume", { id: run.id, options: {} }), "aria-label": `go on with ${run.id}`, "data-key": `act ${run.id}` }, "Go on") : null));
}
