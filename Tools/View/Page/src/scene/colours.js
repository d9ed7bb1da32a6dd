// Colour maps as 256 colours, and the names of kinds. As Tools/Snapshot/Colours.h has them.

const knots = {
    viridis: ["440154", "48287c", "3e4a89", "31688e", "26828e", "1f9e89", "35b779", "6dcd59", "b4de2c", "fde725"],
    coolwarm: ["3b4cc0", "6788ee", "9abbff", "c9d7f0", "edd1c2", "f7a889", "e26952", "b40426"],
    grey: ["202020", "e0e0e0"],
};

const parts = (hex) => [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16));

/** 256 colours, four bytes each. */
export function colourMap(name) {
    const list = knots[name].map(parts), bytes = new Uint8Array(1024);
    for (let k = 0; k < 256; ++k) {
        const place = (k / 255) * (list.length - 1), before = Math.min(Math.floor(place), list.length - 2);
        for (let c = 0; c < 3; ++c)
            bytes[4 * k + c] = Math.round(list[before][c] + (list[before + 1][c] - list[before][c]) * (place - before));
        bytes[4 * k + 3] = 255;
    }
    return bytes;
}

export const colourMapNames = Object.keys(knots);
