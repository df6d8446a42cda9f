// The estimated error against time, both logarithmic.

const box = {left: 44, right: 292, top: 8, bottom: 126};
const svg = 'http://www.w3.org/2000/svg';

function add(chart, name, attributes, text) {
  const element = document.createElementNS(svg, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  chart.append(element);
}

const percent = x => `${+(100 * x).toPrecision(2)} %`;

/** `errors`: pairs of seconds and relative error. */
export function drawChart(chart, errors) {
  chart.replaceChildren();
  add(chart, 'path', {class: 'axis', d: `M${box.left} ${box.top}V${box.bottom}H${box.right}`});
  const points = errors.filter(([seconds, error]) => seconds > 0 && error > 0);
  if (points.length === 0) {
    add(chart, 'text', {x: 150, y: 70, 'text-anchor': 'middle'}, 'not known yet');
    chart.setAttribute('aria-label', 'Estimated relative error against time: not known yet');
    return;
  }
  const range = k => [Math.min(...points.map(p => p[k])), Math.max(...points.map(p => p[k]))];
  const [firstSecond, lastSecond] = range(0), [least, most] = range(1);
  const place = (x, low, high) => high > low ? Math.log(x / low) / Math.log(high / low) : 0.5;
  const x = s => box.left + place(s, firstSecond, lastSecond) * (box.right - box.left);
  const y = e => box.bottom - place(e, least, most) * (box.bottom - box.top);
  add(chart, 'path', {class: 'curve', d: 'M' + points.map(([s, e]) => `${x(s).toFixed(1)} ${y(e).toFixed(1)}`).join('L')});
  if (points.length === 1) add(chart, 'circle', {class: 'curve', cx: x(lastSecond), cy: y(least), r: 2});
  add(chart, 'text', {x: box.left - 4, y: box.top + 8, 'text-anchor': 'end'}, percent(most));
  add(chart, 'text', {x: box.left - 4, y: box.bottom, 'text-anchor': 'end'}, percent(least));
  add(chart, 'text', {x: box.left, y: box.bottom + 16}, `${firstSecond.toPrecision(2)} s`);
  add(chart, 'text', {x: box.right, y: box.bottom + 16, 'text-anchor': 'end'}, `${Math.round(lastSecond)} s`);
  const [seconds, error] = points[points.length - 1];
  chart.setAttribute('aria-label', `Estimated relative error against time: ${percent(error)} after ${Math.round(seconds)} seconds`);
}
