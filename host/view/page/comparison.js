// Two pictures side by side: one that is kept, and the one that goes on, such as by another method.
import {getFrame} from './api.js';

const byId = id => document.getElementById(id);
const methodOf = settings => `${settings.variant}, BDD ${settings.bdd}, split ${settings.quasiSpecular}, ${settings.direct}, map ${settings.map}`;
const percent = error => error === null ? 'error not known yet' : `error ${(100 * error).toPrecision(3)} %`;
const textOf = state => `${methodOf(state.settings)}; ${state.passes} passes, ${state.seconds.toFixed(1)} s, ${percent(state.relativeError)}`;

export class Comparison {
  /** `stop()`: the render that goes on is to end. `onProblem(message)`: the picture could not be kept. */
  constructor(picture, stop, onProblem) {
    this.picture = picture;
    this.stop = stop;
    this.onProblem = onProblem;
    this.kept = null; // the frame that is kept, which says what it is of
    this.isKeeping = false;
    this.state = null;
    byId('keep').addEventListener('click', () => this.keep());
    byId('forget').addEventListener('click', () => this.forget());
    byId('split').addEventListener('input', () => this.setSplit());
  }

  async keep() {
    if (!this.state || this.isKeeping) return;
    this.setKeeping(true);
    try {
      if (await this.makeWholeNew()) this.keepWhole();
    } catch (error) {
      this.onProblem(error.message);
    }
    this.setKeeping(false);
  }

  setKeeping(isKeeping) {
    this.isKeeping = isKeeping;
    byId('keep').classList.toggle('waiting', isKeeping);
  }

  /** Where a part of the film is looked at, the whole picture about it is older. False where another layer is shown meanwhile. */
  async makeWholeNew() {
    if (this.picture.isWholeNew) return true;
    const layer = byId('layer').value;
    let frame = null; // in a long pass there is none for a while
    while (!frame) frame = await getFrame({layer, ...this.picture.wantedWhole(), after: 0});
    if (layer !== byId('layer').value) return false;
    this.picture.show(frame, true);
    return true;
  }

  keepWhole() {
    this.picture.keep();
    this.kept = this.picture.keptFrame;
    byId('comparison').hidden = false;
    byId('kept').textContent = `Left: ${textOf(this.kept)}`;
    this.setSplit();
  }

  forget() {
    this.kept = null;
    this.picture.keptFrame = null;
    byId('comparison').hidden = true;
    this.picture.draw();
  }

  setSplit() {
    this.picture.split = Number(byId('split').value) / 100;
    this.picture.draw();
  }

  /** The render that goes on ends when it has taken the time of the kept one, if that is wanted. */
  show(state) {
    this.state = state;
    if (!this.kept) return;
    if (!this.picture.keptFrame) this.forget(); // of another size
    if (!this.kept) return;
    byId('now').textContent = `Right: ${textOf(state)}`;
    const isAnother = state.render !== this.kept.render && state.phase === 'rendering';
    if (isAnother && byId('equal-time').checked && state.seconds >= this.kept.seconds) this.stop();
  }
}
