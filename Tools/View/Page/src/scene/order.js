/**
 * Places of things by their distance along a direction, nearest first: what is hidden is then found hidden early, which
 * takes half of the time in software. By counting, in 65536 steps.
 * @param rows x, y, z at the beginning of each row of `stride` numbers
 * @param back unit vector towards the eye
 */
export function frontToBack(rows, stride, back) {
    const count = rows.length / stride, key = new Float32Array(count);
    let lowest = Infinity, highest = -Infinity;
    for (let i = 0; i < count; ++i) {
        const k = -(back[0] * rows[stride * i] + back[1] * rows[stride * i + 1] + back[2] * rows[stride * i + 2]);
        key[i] = k;
        if (k < lowest) lowest = k;
        if (k > highest) highest = k;
    }
    const scale = 65535 / (highest - lowest || 1), begins = new Uint32Array(65537);
    for (let i = 0; i < count; ++i) begins[1 + Math.floor((key[i] - lowest) * scale)]++;
    for (let k = 0; k < 65536; ++k) begins[k + 1] += begins[k];
    const order = new Uint32Array(count);
    for (let i = 0; i < count; ++i) order[begins[Math.floor((key[i] - lowest) * scale)]++] = i;
    return order;
}

/** The rows in an order. */
export function arranged(rows, stride, order) {
    const result = new Float32Array(rows.length);
    for (let i = 0, to = 0; i < order.length; ++i)
        for (let from = stride * order[i], end = from + stride; from < end;) result[to++] = rows[from++];
    return result;
}
