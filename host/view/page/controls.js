// What the page changes of the render: camera, method, lamps. Each change is sent with all others, so that none is lost.
import {edit} from './api.js';

const byId = id => document.getElementById(id);
const methods = ['variant', 'bdd', 'quasiSpecular', 'direct', 'map'];
const sliders = ['yaw', 'pitch', 'nearer'];
// Between two changes of a drag: a render is to show something before the next one.
const pause = 400;
// Without a move for so long, the camera stays where it is.
const rest = 1200;

export class Controls {
  /** `onProblem(message)`: a change was refused. */
  constructor(onProblem) {
    this.onProblem = onProblem;
    this.camera = {yaw: 0, pitch: 0, nearer: 0, right: 0, up: 0};
    this.lampNames = '';
    this.timer = this.rest = null;
    this.isDraft = false;
    this.lastSent = 0;
    for (const name of methods) byId(name).addEventListener('change', () => this.send());
    for (const name of sliders)
      byId(name).addEventListener('input', event => this.moveCamera({[name]: Number(event.target.value) - this.camera[name]}));
    byId('camera-reset').addEventListener('click', () => {
      for (const key of Object.keys(this.camera)) this.camera[key] = 0;
      this.moveCamera({});
    });
    byId('again').addEventListener('click', () => this.send());
  }

  /** Whether dragging is to turn the camera. */
  get dragsCamera() {
    return !byId('camera-controls').hidden && byId('drag-camera').checked;
  }

  /** Adds to what has been moved so far. Pictures on the way are drafts, until endMove(). */
  moveCamera(change) {
    for (const [key, value] of Object.entries(change)) this.camera[key] += value;
    for (const name of sliders) byId(name).value = this.camera[name];
    this.isDraft = true;
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.endMove(), rest);
    this.send();
  }

  endMove() {
    clearTimeout(this.rest);
    if (!this.isDraft) return;
    this.isDraft = false;
    this.send();
  }

  send() {
    if (this.timer) return;
    this.timer = setTimeout(() => {
      this.timer = null;
      this.lastSent = Date.now();
      edit(this.edits()).catch(error => this.onProblem(error.message));
    }, Math.max(0, this.lastSent + pause - Date.now()));
  }

  edits() {
    const edits = {camera: this.camera, isDraft: this.isDraft, lamps: [...document.querySelectorAll('#lamps input')].map(input => 2 ** Number(input.value))};
    edits.lamps = edits.lamps.map(factor => factor <= 2 ** -8 ? 0 : factor);
    for (const name of methods) {
      const text = byId(name).value.trim();
      edits[name] = text === '' ? null : name === 'bdd' ? Number(text) : text;
    }
    return edits;
  }

  /** What the program says can be changed. */
  show(state) {
    for (const element of document.querySelectorAll('.editable')) element.hidden = !state.isEditable;
    if (!state.hasCamera) byId('camera-controls').hidden = true;
    if (state.lamps.length === 0) byId('lamp-controls').hidden = true;
    const names = JSON.stringify(state.lamps);
    if (names !== this.lampNames) this.showLamps(state.lamps);
    this.lampNames = names;
    const settings = Object.entries(state.settings ?? {}).map(([key, value]) => `${key} ${value}`);
    byId('settings').textContent = settings.length ? `Now: ${settings.join(', ')}` : '';
  }

  // A slider for each, in doublings; its left end switches the lamp off.
  showLamps(lamps) {
    byId('lamps').replaceChildren(...lamps.map((lamp, k) => {
      const label = document.createElement('label'), output = document.createElement('output'), input = document.createElement('input');
      Object.assign(input, {id: `lamp-${k}`, type: 'range', min: -8, max: 8, step: 0.5, value: 0});
      const tell = () => { output.textContent = Number(input.value) === -8 ? 'off' : `× ${+(2 ** Number(input.value)).toPrecision(3)}`; };
      input.addEventListener('input', () => { tell(); this.send(); });
      tell();
      label.htmlFor = input.id; // or else it would be that of the output
      label.append(`${lamp.id} (${lamp.kind}) `, output, input);
      return label;
    }));
  }
}
