// What the page changes of the render: camera, method, lamps. Each change is sent with all others, so that none is lost.
import {edit} from './api.js';

const byId = id => document.getElementById(id);
const methods = ['variant', 'bdd', 'quasiSpecular', 'direct', 'map'];
const sliders = ['yaw', 'pitch', 'nearer'];
// Between two changes of a drag: a render is to show something before the next one.
const pause = 400;
// Without a move for so long, the camera stays where it is.
const rest = 1200;
// The left end of a lamp's slider.
const lampOff = -8;

const clamp = (x, [least, most]) => Math.min(most, Math.max(least, x));
const factorOf = doublings => doublings <= lampOff ? 0 : 2 ** doublings;
const doublingsOf = factor => factor > 0 ? Math.log2(factor) : lampOff;
const factorText = factor => factor === 0 ? 'off' : `× ${+factor.toPrecision(3)}`;

export class Controls {
  /** `onProblem(message)`: a change was refused. */
  constructor(onProblem) {
    this.onProblem = onProblem;
    this.camera = {yaw: 0, pitch: 0, nearer: 0, right: 0, up: 0};
    this.limits = {}; // of these
    this.lamps = []; // factors
    this.lampNames = '';
    this.timer = this.rest = null;
    this.isDraft = this.isTyping = false;
    this.lastSent = 0;
    this.unanswered = 0; // changes on their way
    this.number = -1; // of the changes that the controls show
    for (const name of methods) this.followMethod(byId(name));
    for (const name of sliders)
      byId(name).addEventListener('input', event => this.moveCamera({[name]: Number(event.target.value) - this.camera[name]}));
    byId('camera-reset').addEventListener('click', () => {
      for (const key of Object.keys(this.camera)) this.camera[key] = 0;
      this.moveCamera({});
    });
    byId('again').addEventListener('click', () => this.send());
  }

  followMethod(field) {
    field.addEventListener('input', () => { this.isTyping = true; });
    field.addEventListener('blur', () => { this.isTyping = false; });
    field.addEventListener('change', () => {
      this.isTyping = false;
      this.send();
    });
  }

  /** Whether dragging is to turn the camera. */
  get dragsCamera() {
    return !byId('camera-controls').hidden && byId('drag-camera').checked;
  }

  /** Adds to what has been moved so far. Pictures on the way are drafts, until endMove(). */
  moveCamera(change) {
    const {camera} = this;
    for (const [key, value] of Object.entries(change)) camera[key] += value;
    camera.yaw -= 2 * Math.PI * Math.round(camera.yaw / (2 * Math.PI));
    for (const [key, limits] of Object.entries(this.limits)) camera[key] = clamp(camera[key], limits);
    this.showCamera();
    this.isDraft = true;
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.endMove(), rest);
    this.send();
  }

  showCamera() {
    for (const name of sliders) byId(name).value = this.camera[name];
  }

  endMove() {
    clearTimeout(this.rest);
    if (!this.isDraft) return;
    this.isDraft = false;
    this.send();
  }

  send() {
    if (this.timer) return;
    this.timer = setTimeout(() => this.sendNow(), Math.max(0, this.lastSent + pause - Date.now()));
  }

  async sendNow() {
    this.timer = null;
    this.lastSent = Date.now();
    ++this.unanswered;
    try {
      const number = await edit(this.edits());
      this.number = Math.max(this.number, number);
    } catch (error) {
      this.onProblem(error.message);
    }
    --this.unanswered;
  }

  edits() {
    const edits = {camera: this.camera, isDraft: this.isDraft, lamps: this.lamps};
    for (const name of methods) {
      const text = byId(name).value.trim();
      edits[name] = text === '' ? null : name === 'bdd' ? Number(text) : text;
    }
    return edits;
  }

  /** What the program says can be changed, and how it is changed: by this page before it was loaded again, or another one. */
  show(state) {
    for (const element of document.querySelectorAll('.editable')) element.hidden = !state.isEditable;
    if (!state.cameraLimits) byId('camera-controls').hidden = true;
    this.setLimits(state.cameraLimits ?? {});
    if (state.lamps.length === 0) byId('lamp-controls').hidden = true;
    const names = JSON.stringify(state.lamps);
    if (names !== this.lampNames) this.makeLamps(state.lamps, state.edits?.lamps ?? []);
    this.lampNames = names;
    const isBusy = this.isDraft || this.isTyping || this.timer || this.unanswered > 0;
    if (state.edits && state.edits.number > this.number && !isBusy) this.take(state.edits);
    const settings = Object.entries(state.settings ?? {}).map(([key, value]) => `${key} ${value}`);
    byId('settings').textContent = settings.length ? `Now: ${settings.join(', ')}` : '';
  }

  // The slider of the pitch ends where the camera does; that of nearer, a wheel goes beyond.
  setLimits(limits) {
    this.limits = limits;
    if (limits.pitch) Object.assign(byId('pitch'), {min: Math.floor(100 * limits.pitch[0]) / 100, max: Math.ceil(100 * limits.pitch[1]) / 100});
  }

  take(edits) {
    this.number = edits.number;
    this.camera = edits.camera;
    this.showCamera();
    for (const name of methods) byId(name).value = edits[name] ?? '';
    this.takeLamps(edits.lamps);
  }

  // A slider for each, in doublings; its left end switches the lamp off.
  makeLamps(lamps, factors) {
    byId('lamps').replaceChildren(...lamps.map((lamp, k) => {
      const label = document.createElement('label'), output = document.createElement('output'), input = document.createElement('input');
      Object.assign(input, {id: `lamp-${k}`, type: 'range', min: lampOff, max: 8, step: 0.5});
      input.addEventListener('input', () => {
        this.lamps[k] = factorOf(Number(input.value));
        output.textContent = factorText(this.lamps[k]);
        this.send();
      });
      label.htmlFor = input.id; // or else it would be that of the output
      label.append(`${lamp.id} (${lamp.kind}) `, output, input);
      return label;
    }));
    this.takeLamps(factors);
  }

  // Those that are missing are as in the scene.
  takeLamps(factors) {
    this.lamps = [...byId('lamps').children].map((label, k) => {
      const factor = factors[k] ?? 1;
      label.querySelector('input').value = doublingsOf(factor);
      label.querySelector('output').textContent = factorText(factor);
      return factor;
    });
  }
}
