// What the server answers (Tools/View/Api.h). Addresses are relative, so that a proxy may put the page into a folder.

const address = (path, words = {}) => `api/${path}?${new URLSearchParams(words)}`;

async function answer(response) {
    if (response.ok) return response;
    throw new Error((await response.text()).trim() || `The server has answered ${response.status}.`);
}

export const get = async (path, words) => (await answer(await fetch(address(path, words)))).json();

/** Asks for a change; the header tells the server that the page of its own asks. */
export async function post(path, wish) {
    const headers = { "Content-Type": "application/json", "X-Pendular": "1" };
    return (await answer(await fetch(`api/${path}`, { method: "POST", headers, body: JSON.stringify(wish) }))).json();
}

/** Columns of numbers (Tools/View/Columns.h): what their text tells, and each by its name as Float32Array. */
export async function getColumns(path, words) {
    const bytes = await (await answer(await fetch(address(path, words)))).arrayBuffer();
    const length = new DataView(bytes).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
    for (const { name, begin, count } of head.columns) head[name] = new Float32Array(bytes, 4 + length + begin, count);
    return head;
}

/** A frame (Tools/View/FramePack.h). */
export const getFrame = (words) => getColumns("frame", words);
