// The page: two loops, one for the state and one for pictures, each of which waits until there is something new.
import {getFrame, getPixel, getState, stop} from './api.js';
import {drawChart} from './chart.js';
import {Comparison} from './comparison.js';
import {isFigure, scaleOf} from './colour.js';
import {Controls} from './controls.js';
import {Picture} from './picture.js';
import {followPointer} from './pointer.js';

const byId = id => document.getElementById(id);
const wait = milliseconds => new Promise(resolve => setTimeout(resolve, milliseconds));
// Between two states, and two looks at the pixel under the pointer.
const statePause = 250, pixelPause = 150;

let state = null;
let automatic = {exposure: 1, white: 1}; // of the last whole picture
let drawn = {}; // what the chart shows
let pending = null; // the frame that is waited for, to be given up where another one is wanted
let refusal = ''; // why the last change was not taken

let changes = 0; // of what is to be seen

const refuse = message => { refusal = message; showProblem(); };
const picture = new Picture(byId('picture'), () => { ++changes; pending?.abort(); });
const controls = new Controls(refuse);
const stopRender = () => stop().catch(error => refuse(error.message));
const comparison = new Comparison(picture, stopRender, refuse);

function tone() {
  const factor = 2 ** Number(byId('exposure').value);
  const white = byId('curve').value === 'linear' ? 1 : Math.max(1, automatic.white * factor);
  return {exposure: automatic.exposure * factor, white};
}

// Exposure and curve as they are now, in the picture, the legend and the link that saves.
function applyTone() {
  const now = tone(), layer = byId('layer').value;
  byId('exposure-text').textContent = `${Number(byId('exposure').value).toFixed(1)} stops`;
  byId('save-png').href = `image.png?${new URLSearchParams(now)}`;
  byId('legend').hidden = !isFigure(layer);
  if (isFigure(layer)) showLegend(scaleOf(layer, now.exposure, picture.isKnown));
  picture.setTone(now);
}

function showLegend({ramp, marks}) {
  const image = new ImageData(256, 1);
  for (let k = 0; k < 256; ++k) image.data.set([ramp[3 * k], ramp[3 * k + 1], ramp[3 * k + 2], 255], 4 * k);
  byId('legend-colours').getContext('2d').putImageData(image, 0, 0);
  byId('legend-marks').replaceChildren(...marks.map(mark => Object.assign(document.createElement('li'), {textContent: mark})));
}

function showProblem() {
  const text = state?.problem || refusal;
  if (byId('problem').textContent !== text) byId('problem').textContent = text;
  byId('problem').hidden = !text;
}

const timeText = seconds => seconds < 60 ? `${seconds.toFixed(1)} s` : `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, '0')}`;

function statusText() {
  const parts = [state.phase];
  if (state.passes > 0) parts.push(`${state.passes} ${state.passes === 1 ? 'pass' : 'passes'}`, timeText(state.seconds));
  if (state.relativeError !== null) parts.push(`error ${(100 * state.relativeError).toPrecision(3)} %`);
  if (state.secondsLeft !== null) parts.push(`${timeText(Math.max(0, state.secondsLeft))} left`);
  if (state.pathsPerSecond > 0) parts.push(`${(state.photonsPerSecond / 1e6).toPrecision(3)} M photons/s`);
  return parts.join(' · ');
}

function showLayers(layers) {
  const select = byId('layer'), chosen = select.value;
  if (select.options.length === layers.length) return;
  select.replaceChildren(...layers.map(layer => new Option(layer.replace('stderr', 'standard error').replace('_', ' '), layer)));
  if (layers.includes(chosen)) select.value = chosen;
}

function showPointerHelp() {
  byId('pointer-help').textContent = controls.dragsCamera
    ? 'Dragging and the wheel move the camera, with Shift the picture; two fingers zoom.'
    : 'Dragging moves the picture; the wheel and two fingers zoom.';
}

function showState() {
  const isRunning = !['stopped', 'done', 'failed', 'ended'].includes(state.phase);
  document.title = `${state.scene} · quasilux`;
  byId('scene').textContent = state.scene || 'quasilux';
  byId('status').textContent = statusText();
  // Readers say this when it changes; the numbers above change too often for that.
  if (byId('phase').textContent !== state.phase) byId('phase').textContent = state.phase;
  byId('stop').disabled = !isRunning;
  const progress = byId('progress');
  progress.hidden = state.secondsLeft === null || !isRunning;
  if (!progress.hidden) progress.value = state.seconds / Math.max(1e-9, state.seconds + Math.max(0, state.secondsLeft));
  byId('picture').setAttribute('aria-label', `${state.scene}, ${byId('layer').value || 'image'}, ${state.width} by ${state.height} pixels, ${state.phase}, ${state.passes} passes`);
  showProblem();
  showLayers(state.layers);
  controls.show(state);
  showPointerHelp();
  if (state.errors.length !== drawn.points || state.render !== drawn.render) drawChart(byId('chart'), state.errors);
  drawn = {points: state.errors.length, render: state.render};
  if (state.width > 0) picture.setFilm(state.width, state.height);
  comparison.show(state);
}

async function followState() {
  let seen = 0, render = 0;
  for (;;) {
    try {
      state = await getState(seen);
      if (state.render !== render) refusal = '';
      render = state.render;
      seen = state.version;
      showState();
      if (state.phase === 'ended') return;
    } catch {
      byId('status').textContent = 'the program does not answer';
      await wait(1000);
    }
    await wait(statePause);
  }
}

const isWhole = frame => frame.x === 0 && frame.y === 0 && frame.width * frame.step >= picture.film.width && frame.height * frame.step >= picture.film.height;

function showFrame(frame) {
  if (frame.layer !== byId('layer').value) return;
  if (isWhole(frame) && frame.layer === 'image') automatic = {exposure: frame.exposure, white: frame.white};
  picture.show(frame, isWhole(frame));
  applyTone();
  const {passes, render, step} = frame;
  Object.assign(document.body.dataset, {passes, render, step});
  lookAtPixel();
}

// Until the finger does: the server keeps each request that was given up for a while.
async function rest() {
  for (let seen = -1; seen !== changes;) {
    seen = changes;
    await wait(60);
  }
}

async function followPicture() {
  let last = '', moment = 0;
  for (;;) {
    if (!state?.width || document.hidden) {
      await wait(100);
      continue;
    }
    const wish = {layer: byId('layer').value || 'image', ...picture.wanted()};
    const text = JSON.stringify(wish);
    pending = new AbortController();
    try {
      const frame = await getFrame({...wish, after: text === last ? moment : 0}, pending.signal);
      if (frame) {
        [last, moment] = [text, frame.moment];
        showFrame(frame);
      }
    } catch (error) {
      if (error.name === 'AbortError') await rest();
      else await wait(1000);
    }
  }
}

const cell = (text, attributes = {}) => Object.assign(document.createElement('td'), {textContent: text, ...attributes});
const figure = x => x === 0 ? '0' : Math.abs(x) >= 1e4 || Math.abs(x) < 1e-3 ? x.toExponential(2) : x.toPrecision(4);

function showPixel(pixel) {
  const rows = [['value', pixel.value], ['± error', pixel.stderr]];
  if (pixel.bias) rows.push(['bias', pixel.bias], ['± error', pixel.biasStderr]);
  for (const [name, value] of Object.entries(pixel.components)) rows.push([name.replace('_', ' '), value]);
  byId('pixel').tBodies[0].replaceChildren(...rows.map(([name, values]) => {
    const row = document.createElement('tr'), head = document.createElement('th');
    head.scope = 'row';
    head.textContent = name;
    row.append(head, ...values ? values.map(value => cell(figure(value))) : [cell('unknown', {colSpan: 3})]);
    return row;
  }));
}

const placeOfPixel = () => [byId('pixel-x').value || 0, byId('pixel-y').value || 0];
const dimOtherPixel = () => byId('pixel').classList.toggle('waiting', String(placeOfPixel()) !== byId('pixel').dataset.place);
let isLooking = false;
/** The one of the two fields, soon; its errors are known between passes. Until then the table is of another one, or of earlier, and is dimmed. */
async function lookAtPixel() {
  if (isLooking) return;
  isLooking = true;
  await wait(pixelPause);
  for (let isShown = false; !isShown;) {
    const place = placeOfPixel();
    const isThere = () => String(placeOfPixel()) === String(place);
    dimOtherPixel();
    let isRefused = false;
    const pixel = await getPixel(...place).catch(() => { isRefused = true; }); // such as one that is not there: the table stays
    if (pixel) {
      showPixel(pixel);
      byId('pixel').dataset.place = place;
    }
    isShown = (pixel || isRefused) && isThere();
  }
  dimOtherPixel();
  isLooking = false;
}

function pointAt({x, y}) {
  if (x < 0 || y < 0 || x >= picture.film.width || y >= picture.film.height) return;
  byId('pixel-x').value = Math.floor(x);
  byId('pixel-y').value = Math.floor(y);
  lookAtPixel();
}

byId('layer').addEventListener('change', () => {
  picture.forget();
  comparison.forget(); // that would be of another layer
  pending?.abort();
  applyTone();
});
byId('exposure').addEventListener('input', applyTone);
byId('curve').addEventListener('change', applyTone);
byId('stop').addEventListener('click', stopRender);
byId('drag-camera').addEventListener('change', showPointerHelp);
for (const id of ['pixel-x', 'pixel-y']) byId(id).addEventListener('input', lookAtPixel);
followPointer(picture, controls, pointAt);
drawChart(byId('chart'), []);
followState();
followPicture();
