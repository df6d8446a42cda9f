// Two pictures side by side: one that is kept, and the one that goes on, such as by another method.

const byId = id => document.getElementById(id);
const methodOf = settings => `${settings.variant}, BDD ${settings.bdd}, split ${settings.quasiSpecular}, ${settings.direct}, map ${settings.map}`;
const percent = error => error === null ? 'error not known yet' : `error ${(100 * error).toPrecision(3)} %`;
const textOf = state => `${methodOf(state.settings)}; ${state.passes} passes, ${state.seconds.toFixed(1)} s, ${percent(state.relativeError)}`;

export class Comparison {
  /** `stop()`: the render that goes on is to end. */
  constructor(picture, stop) {
    this.picture = picture;
    this.stop = stop;
    this.kept = null; // the state that the kept picture was of
    this.state = null;
    byId('keep').addEventListener('click', () => this.keep());
    byId('forget').addEventListener('click', () => this.forget());
    byId('split').addEventListener('input', () => this.setSplit());
  }

  keep() {
    if (!this.state || !this.picture.keep()) return;
    this.kept = this.state;
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
