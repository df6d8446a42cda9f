// What the program is asked. All addresses are relative: the token is in the page's own.

async function answerOf(response) {
  if (response.status === 204) return null;
  if (!response.ok) {
    const text = await response.text();
    let message = text;
    try { message = JSON.parse(text).error; } catch { /* no JSON: the text itself */ }
    throw new Error(message);
  }
  return response;
}

async function get(path, parameters, signal) {
  return answerOf(await fetch(`${path}?${new URLSearchParams(parameters)}`, {signal}));
}

async function post(path, body) {
  return answerOf(await fetch(path, {method: 'POST', headers: {'Content-Type': 'application/json'}, body: JSON.stringify(body)}));
}

/** Once it is newer than version `seen`, or after a while. */
export async function getState(seen) {
  return (await get('state', {seen})).json();
}

/** A picture newer than moment `wish.after`: its header's members and `halves`; null where there is none for a while. */
export async function getFrame(wish, signal) {
  const response = await get('frame', wish, signal);
  if (!response) return null;
  const frame = JSON.parse(response.headers.get('X-Frame'));
  frame.halves = new Uint16Array(await response.arrayBuffer());
  return frame;
}

export async function getPixel(x, y) {
  const response = await get('pixel', {x, y});
  return response && response.json();
}

export const stop = () => post('stop', {});
/** The number that these changes have in the state. */
export async function edit(edits) {
  return (await (await post('edit', edits)).json()).number;
}
