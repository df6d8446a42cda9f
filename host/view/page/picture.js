// The picture: what of it is seen, which frame that needs, drawing.
import {paint} from './colour.js';

// Pixels of a frame that is wanted at once; larger films are thinned or shown in part.
const mostPixels = 1 << 21;

export class Picture {
  /** `onChange`: another frame may be wanted. */
  constructor(canvas, onChange) {
    this.canvas = canvas;
    this.onChange = onChange;
    this.film = {width: 1, height: 1};
    this.tone = {exposure: 1, white: 1};
    this.isFitted = true;
    this.zoom = 1; // pixels of the screen for one of the film
    this.centre = {x: 0.5, y: 0.5}; // in the film, what lies in the middle of the canvas
    this.whole = this.part = null; // frames, each with `bitmap`
    this.keptFrame = null; // another one, to compare with
    this.split = 0.5; // so much of the canvas shows it, from the left
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  setFilm(width, height) {
    if (width === this.film.width && height === this.film.height) return;
    this.film = {width, height};
    this.keptFrame = null;
    this.fit();
  }

  resize() {
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    if (this.isFitted) this.fit();
    this.changed();
  }

  fit() {
    this.isFitted = true;
    this.zoom = Math.min(this.canvas.width / this.film.width, this.canvas.height / this.film.height);
    this.centre = {x: this.film.width / 2, y: this.film.height / 2};
    this.changed();
  }

  /** By a factor; the place at `at`, in pixels of the canvas, stays. */
  zoomBy(factor, at = {x: this.canvas.width / 2, y: this.canvas.height / 2}) {
    const before = this.toFilm(at);
    this.isFitted = false;
    this.zoom = Math.min(64, Math.max(0.02, this.zoom * factor));
    const after = this.toFilm(at);
    this.moveBy({x: before.x - after.x, y: before.y - after.y});
  }

  /** In pixels of the film. */
  moveBy(shift) {
    this.isFitted = false;
    const within = (x, end) => Math.min(end, Math.max(0, x));
    this.centre = {x: within(this.centre.x + shift.x, this.film.width), y: within(this.centre.y + shift.y, this.film.height)};
    this.changed();
  }

  changed() {
    this.draw();
    this.onChange();
  }

  toFilm(at) {
    return {x: this.centre.x + (at.x - this.canvas.width / 2) / this.zoom, y: this.centre.y + (at.y - this.canvas.height / 2) / this.zoom};
  }

  /** Place of a pointer in pixels of the canvas. */
  placeOf(event) {
    const box = this.canvas.getBoundingClientRect(), ratio = this.canvas.width / box.width;
    return {x: (event.clientX - box.left) * ratio, y: (event.clientY - box.top) * ratio};
  }

  /** Pixels of the film, each way, for one of what is seen. */
  get seenStep() {
    return Math.max(1, Math.floor(1 / this.zoom));
  }

  isTooLarge(step) {
    return Math.ceil(this.film.width / step) * Math.ceil(this.film.height / step) > mostPixels;
  }

  /** A frame of the whole film. */
  wantedWhole() {
    let step = this.seenStep;
    while (this.isTooLarge(step)) ++step;
    return {x: 0, y: 0, ...this.film, step};
  }

  /** The frame that shows best what is seen. */
  wanted() {
    if (!this.whole || !this.isTooLarge(this.seenStep)) return this.wantedWhole();
    const {width, height} = this.film;
    const from = this.toFilm({x: 0, y: 0}), to = this.toFilm({x: this.canvas.width, y: this.canvas.height});
    const x = Math.max(0, Math.floor(from.x)), y = Math.max(0, Math.floor(from.y));
    return {x, y, step: this.seenStep, width: Math.max(1, Math.min(width, Math.ceil(to.x)) - x), height: Math.max(1, Math.min(height, Math.ceil(to.y)) - y)};
  }

  /** Whether there is a frame of all that is as new as any. */
  get isWholeNew() {
    return this.whole !== null && this.part === null;
  }

  /** Or else the figures of the layer that is shown say nothing yet. */
  get isKnown() {
    return (this.part ?? this.whole)?.isKnown ?? true;
  }

  /** A frame of the same layer as the others takes the place of what it covers. To be drawn when its tone is set. */
  show(frame, isWhole) {
    frame.bitmap = document.createElement('canvas');
    frame.bitmap.width = frame.width;
    frame.bitmap.height = frame.height;
    if (isWhole) {
      this.whole = frame;
      // A part that is looked at is sharper than the whole picture about it.
      if (!this.isTooLarge(this.seenStep) || this.part?.render !== frame.render) this.part = null;
    } else {
      this.part = frame;
      if (this.whole?.render !== frame.render) this.whole = null;
    }
    frame.tone = null;
  }

  /** Frames of another layer are no use. */
  forget() {
    this.whole = this.part = null;
  }

  /** The whole picture as it is. */
  keep() {
    this.keptFrame = {...this.whole, bitmap: document.createElement('canvas'), tone: null};
    Object.assign(this.keptFrame.bitmap, {width: this.whole.width, height: this.whole.height});
  }

  setTone(tone) {
    if (tone.exposure !== this.tone.exposure || tone.white !== this.tone.white) this.tone = tone;
    this.draw();
  }

  paint(frame) {
    frame.tone = this.tone;
    frame.bitmap.getContext('2d').putImageData(paint(frame, this.tone), 0, 0);
  }

  draw() {
    const context = this.canvas.getContext('2d');
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.imageSmoothingEnabled = this.zoom < 2;
    context.setTransform(this.zoom, 0, 0, this.zoom, this.canvas.width / 2 - this.zoom * this.centre.x, this.canvas.height / 2 - this.zoom * this.centre.y);
    for (const frame of [this.whole, this.part]) this.drawFrame(context, frame);
    if (this.keptFrame) this.drawKept(context);
  }

  drawFrame(context, frame) {
    if (!frame) return;
    if (frame.tone !== this.tone) this.paint(frame);
    context.drawImage(frame.bitmap, frame.x, frame.y, frame.width * frame.step, frame.height * frame.step);
  }

  // Left of a line, over the other one.
  drawKept(context) {
    const transform = context.getTransform(), x = Math.round(this.split * this.canvas.width);
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.beginPath();
    context.rect(0, 0, x, this.canvas.height);
    context.clip();
    context.clearRect(0, 0, x, this.canvas.height);
    context.setTransform(transform);
    this.drawFrame(context, this.keptFrame);
    context.restore();
    if (x === 0 || x === this.canvas.width) return;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = '#fee838';
    context.fillRect(x - 1, 0, 2, this.canvas.height);
  }
}
