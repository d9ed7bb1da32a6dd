import "./style.css";
import { showCompare } from "./compare.js";
import { showRun } from "./run.js";
import { showRuns } from "./runs.js";
import { showStart } from "./start.js";
import { tell } from "./text.js";

window.pendular = {};  // for tests and for those who look behind the page

const page = document.getElementById("page");
let end = () => {};

/** Shows what the address says: #runs, #run=ID, #start, #compare=ID,ID. */
function show() {
    const [word, rest = ""] = location.hash.slice(1).split(/=(.*)/s);
    end();
    tell();
    if (word === "run") end = showRun(page, decodeURIComponent(rest));
    else if (word === "start") end = showStart(page);
    else if (word === "compare") end = showCompare(page, rest.split(",").map(decodeURIComponent));
    else end = showRuns(page);
    for (const link of document.querySelectorAll("nav a"))
        if (link.hash.slice(1) === (word || "runs")) link.setAttribute("aria-current", "page");
        else link.removeAttribute("aria-current");
}

// No link: the part of the address behind # says which page is shown.
document.getElementById("skip").addEventListener("click", () => page.focus());
addEventListener("hashchange", show);
show();
