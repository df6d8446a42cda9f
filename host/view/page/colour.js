// From linear values, in half precision, to what a screen shows.

/** The value of each of the 65536 halves. */
const valueOfHalf = Float32Array.from({length: 65536}, (_, bits) => {
  const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return exponent ? sign * 2 ** (exponent - 15) * (1 + fraction / 1024) : sign * 2 ** -24 * fraction;
});

const srgbSteps = 4096;
/** IEC 61966-2-1, of 0 … 1. */
const srgb = Uint8ClampedArray.from({length: srgbSteps + 1}, (_, k) => {
  const x = k / srgbSteps;
  return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
});
const encoded = x => srgb[x > 0 ? x < 1 ? x * srgbSteps + 0.5 | 0 : srgbSteps : 0];

const rgbOf = hex => [1, 3, 5].map(k => parseInt(hex.slice(k, k + 2), 16));

/** 256 colours through these. */
function ramp(hexes) {
  const stops = hexes.map(rgbOf), table = new Uint8ClampedArray(3 * 256);
  for (let k = 0; k < 256; ++k) {
    const at = k / 255 * (stops.length - 1), low = Math.min(Math.floor(at), stops.length - 2);
    for (let c = 0; c < 3; ++c) table[3 * k + c] = stops[low][c] + (at - low) * (stops[low + 1][c] - stops[low][c]);
  }
  return table;
}

// Cividis (Nunez et al. 2018) is made for readers who see red and green alike; so are blue and orange about white.
const sequential = ramp(['#00224e', '#123570', '#3b496c', '#575d6d', '#707173', '#8a8678', '#a59c74', '#c3b369', '#e1cc55', '#fee838']);
const diverging = ramp(['#08306b', '#4292c6', '#f7f7f7', '#f0872f', '#7f2704']);

const percent = x => `${+(100 * x).toPrecision(2)} %`;

const unknown = {ramp: ramp(['#808080', '#808080']), place: () => 0, marks: ['unknown until two passes are done']};

/** How figures become colours: `place` of a figure on the ramp, 0 … 1; `marks` below it. */
export function scaleOf(layer, exposure, isKnown) {
  if (!isKnown) return unknown;
  if (layer === 'bias') {
    const most = 0.2;
    return {ramp: diverging, place: v => 0.5 + 0.5 * v / most, marks: [-most, -most / 2, 0, most / 2, most].map(percent)};
  }
  const [low, high] = layer === 'stderr' ? [0.001 / exposure, 1 / exposure] : [0.001, 1];
  const place = v => v > 0 ? Math.log(v / low) / Math.log(high / low) : 0;
  const marks = [0, 1, 2, 3].map(k => low * (high / low) ** (k / 3));
  return {ramp: sequential, place, marks: marks.map(x => layer === 'stderr' ? x.toPrecision(2) : percent(x))};
}

export const isFigure = layer => ['stderr', 'bias', 'relative_error'].includes(layer);

/** Extended curve of Reinhard et al. 2002, equation 4, on the luminance; `white` = 1 is plain clamping. */
function paintColours(frame, {exposure, white}, pixels) {
  const {halves} = frame, factor = exposure / frame.scale, over = 1 / (white * white);
  for (let from = 0, to = 0; from < halves.length; from += 3, to += 4) {
    const r = factor * valueOfHalf[halves[from]], g = factor * valueOfHalf[halves[from + 1]], b = factor * valueOfHalf[halves[from + 2]];
    const x = Math.max(0, 0.2126 * r + 0.7152 * g + 0.0722 * b), compression = (1 + x * over) / (1 + x);
    pixels[to] = encoded(compression * r);
    pixels[to + 1] = encoded(compression * g);
    pixels[to + 2] = encoded(compression * b);
    pixels[to + 3] = 255;
  }
}

function paintFigures(frame, tone, pixels) {
  const {halves} = frame, scale = scaleOf(frame.layer, tone.exposure, frame.isKnown), factor = 1 / frame.scale;
  for (let from = 0, to = 0; from < halves.length; ++from, to += 4) {
    const at = 3 * Math.min(255, Math.max(0, Math.round(255 * scale.place(factor * valueOfHalf[halves[from]]))));
    for (let c = 0; c < 3; ++c) pixels[to + c] = scale.ramp[at + c];
    pixels[to + 3] = 255;
  }
}

/** RGBA of a frame with a tone curve. */
export function paint(frame, tone) {
  const image = new ImageData(frame.width, frame.height);
  (frame.channels === 1 ? paintFigures : paintColours)(frame, tone, image.data);
  return image;
}
