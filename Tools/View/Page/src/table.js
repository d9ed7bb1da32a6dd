// Tables of a run as they grow, and which of them are maps.
import { get } from "./api.js";

const mostRows = 20000;  // that a chart keeps: beyond, every second one goes

/**
 * Whether a table is of fields along one direction: most times have the same places behind them. The last one may have a part
 * of them. Else, as for the path of a grain, it is a chart.
 */
export function isProfile({ columns, values }) {
    const isPlace = (name) => /^[xyzr]_m$/.test(name);
    if (columns.length < 3 || columns[0] !== "time_s" || !isPlace(columns[1]) || isPlace(columns[2])) return false;
    const [times, places] = [0, 1].map((k) => new Set(values[k]).size), rows = values[0].length;
    return rows > 1 && rows > 2 * (times - 1) && times * places <= 2 * rows;
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

    /** Of a table with places, whole times go; the last one, of which more may come, stays. */
    #thin() {
        while ((this.values[0]?.length ?? 0) > 2 * mostRows) {
            const isMap = isProfile(this), times = this.values[0], last = times[times.length - 1];
            if (isMap && times.length <= 10 * mostRows) return;
            let number = -1, before = NaN;
            const keeps = times.map((time) => {
                if (!isMap || time !== before) ++number;
                before = time;
                return number % 2 === 0 || (isMap && time === last);
            });
            if (keeps.every(Boolean)) return;
            this.values = this.values.map((column) => column.filter((_, k) => keeps[k]));
        }
    }
}
