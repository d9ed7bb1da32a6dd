"""The page's JavaScript, without a browser and without npm: its syntax, and that each name that a file takes from another
one is given there."""
import pathlib
import re
import shutil
import subprocess

import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2] / "Tools/View/Page/src"
FILES = sorted(SOURCE.rglob("*.js"))


@pytest.mark.skipif(not shutil.which("node"), reason="node is not installed")
def test_all_files_can_be_read():
    for file in FILES:
        done = subprocess.run(["node", "--input-type=module", "--check"], input=file.read_text(), capture_output=True, text=True)
        assert done.returncode == 0, (file, done.stderr)


def test_what_is_taken_is_given():
    assert len(FILES) > 10
    for file in FILES:
        for names, other in re.findall(r'import \{([^}]*)\} from "(\.[^"]*)"', file.read_text()):
            given = set(re.findall(r"export (?:async )?(?:function|const|class) (\w+)", (file.parent / other).read_text()))
            assert {name.strip() for name in names.split(",")} <= given, (file, other)


TABLES = """
import assert from "node:assert";
const { isProfile, Table } = await import(process.argv[1]);
const count = 300, most = 60000, head = ["time_s", "z_m", "density_kg_per_m3"];
const rows = (length, row) => Array.from({ length }, (_, k) => row(k));
const isMap = (list, columns = head) => isProfile({ columns, values: columns.map((_, k) => list.map((row) => row[k])) });
const profile = rows(count, (k) => [Math.floor(k / 20), k % 20, k]);

// Times that each have the same places: a map, also while the rows of the last time come. (One row may be anything.)
for (let length = 2; length <= count; ++length) assert(isMap(profile.slice(0, length)), length);
for (const list of [[], profile.slice(0, 1)]) assert(!isMap(list));
assert(isMap(profile.map(([t, z]) => [t, z / 20, NaN])));
// Twice as many places, half of which have no rows, as after two runs with other grids; with more than that it is no map.
assert(isMap(profile.map(([t, z]) => [t, z + (t < 7.5 ? 0 : 20), 1])));
assert(!isMap(profile.map(([t, z]) => [t, z + 20 * (t % 3), 1])));
// Paths: of a grain that falls, that rests, that rests and had a row twice; of two that fall.
for (const path of [(k) => [k, -k * k, 1], (k) => [k, 0, 1], (k) => [Math.max(k - 1, 0), Math.min(k, 1), 1], (k) => [Math.floor(k / 2), -k, 1]])
    assert(!isMap(rows(count, path)));
assert(!isMap(profile, ["time_s", "z_m"]) && !isMap(profile, ["time_s", "x_m", "y_m"]) && !isMap(profile, ["z_m", "time_s", "a"]));

// What a table keeps as it grows, in pieces that end within a time.
async function grown(all, piece) {
    globalThis.fetch = async (address) => {
        const from = Number(new URLSearchParams(address.split("?")[1]).get("from")), some = all.slice(from, from + piece);
        return { ok: true, json: async () => ({ columns: head, rows: some, next: from + some.length, begins: from === 0 && some.length > 0 }) };
    };
    const table = new Table("run", "table.csv");
    assert(await table.grow());
    return table;
}
const path = await grown(rows(most, (k) => [k, -k * k, 1]), 7001);
assert(!isProfile(path) && path.values[0].length <= 40000 && path.values[0].every((t, k) => k === 0 || t > path.values[0][k - 1]));
const long = await grown(rows(5 * most, (k) => [Math.floor(k / 20), k % 20, 1]), 7001), perTime = new Map();
for (const time of long.values[0]) perTime.set(time, (perTime.get(time) ?? 0) + 1);
assert(isProfile(long) && long.values[0].length <= 200000 && [...perTime.values()].every((number) => number === 20));
assert(perTime.has(5 * most / 20 - 1));
"""


@pytest.mark.skipif(not shutil.which("node"), reason="node is not installed")
def test_which_tables_are_maps():
    """A path of a grain has columns as a profile has, but times x places would be the square of its rows."""
    done = subprocess.run(["node", "--input-type=module", "--eval", TABLES, (SOURCE / "table.js").as_uri()], capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, done.stderr


CAMERA = """
import assert from "node:assert";
const { boxOf, distanceToSee } = await import(process.argv[1]);
const particles = { low: [-1, 0, -2], high: [1, 0, 0], grains: [-1, 0, -2, 0.1, 1, 0, 0, -0.3] };  // negative: a surface is drawn

// The wall reaches above all particles: a drum that is a quarter full.
const drum = { ...particles, walls: [-3, -1, -3, 3, 1, -3, 0, 0, 3] };
assert.deepEqual(boxOf(drum, true), [[-3, -1, -3], [3, 1, 3]]);
// Of particles of different sizes the largest counts.
assert.deepEqual(boxOf(drum, false), [[-1.3, -0.3, -2.3], [1.3, 0.3, 0.3]]);
assert.deepEqual(boxOf({ ...drum, grains: [], low: [0, 0, 0], high: [0, 0, 0] }, false), [[-3, -1, -3], [3, 1, 3]]);
assert.deepEqual(boxOf({ low: [0, 0, 0], high: [0, 0, 0], grains: [], walls: [] }, true), [[-1, -1, -1], [1, 1, 1]]);

// A ball of diameter 1 at that distance: half of the angle under which it is seen is less than that of the picture's
// height, and of its width, and not much less.
for (const fieldOfView of [0.3, 0.6, 1.2])
    for (const aspect of [0.3, 0.5, 1, 1.5, 3]) {
        const seen = Math.asin(0.5 / distanceToSee(fieldOfView, aspect)), across = Math.atan(Math.tan(fieldOfView / 2) * aspect);
        assert(seen < fieldOfView / 2 && seen < across && seen > 0.9 * Math.min(fieldOfView / 2, across), `${fieldOfView} ${aspect}`);
    }
"""


@pytest.mark.skipif(not shutil.which("node"), reason="node is not installed")
def test_the_camera_shows_all():
    """All particles and walls, in pictures that are wide or narrow."""
    done = subprocess.run(["node", "--input-type=module", "--eval", CAMERA, (SOURCE / "scene/box.js").as_uri()], capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, done.stderr
