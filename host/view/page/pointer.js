// Mouse, fingers and keys on the picture.

const keyStep = 40; // pixels of the screen
const radiansPerPixel = 0.006, doublingsPerPixel = 0.002;

const middleOf = pointers => ({x: (pointers[0].x + pointers[1].x) / 2, y: (pointers[0].y + pointers[1].y) / 2});
const distanceOf = pointers => Math.hypot(pointers[0].x - pointers[1].x, pointers[0].y - pointers[1].y);

/** `onPoint(place)`: the pointer is there, in pixels of the film. */
export function followPointer(picture, controls, onPoint) {
  const {canvas} = picture, pointers = new Map();

  const drag = (shift, isPan) => {
    if (controls.dragsCamera && !isPan)
      controls.moveCamera({yaw: -radiansPerPixel * shift.x, pitch: radiansPerPixel * shift.y});
    else
      picture.moveBy({x: -shift.x / picture.zoom, y: -shift.y / picture.zoom});
  };

  // Two fingers zoom about their middle and move.
  const pinch = (before, after) => {
    const from = middleOf(before), to = middleOf(after);
    picture.moveBy({x: (from.x - to.x) / picture.zoom, y: (from.y - to.y) / picture.zoom});
    picture.zoomBy(distanceOf(after) / Math.max(1, distanceOf(before)), to);
  };

  canvas.addEventListener('pointerdown', event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, picture.placeOf(event));
  });
  canvas.addEventListener('pointermove', event => {
    const place = picture.placeOf(event), before = [...pointers.values()];
    const last = pointers.get(event.pointerId);
    if (last) {
      pointers.set(event.pointerId, place);
      if (before.length === 2) pinch(before, [...pointers.values()]);
      else drag({x: place.x - last.x, y: place.y - last.y}, event.shiftKey || event.buttons === 4);
    }
    onPoint(picture.toFilm(place));
  });
  for (const name of ['pointerup', 'pointercancel'])
    canvas.addEventListener(name, event => {
      pointers.delete(event.pointerId);
      controls.endMove();
    });
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    if (controls.dragsCamera && !event.shiftKey && !event.ctrlKey)
      controls.moveCamera({nearer: -doublingsPerPixel * event.deltaY});
    else
      picture.zoomBy(2 ** (-(event.deltaY || event.deltaX) / 300), picture.placeOf(event));
  }, {passive: false});
  canvas.addEventListener('dblclick', () => picture.fit());

  const step = () => keyStep / picture.zoom;
  const keys = {
    ArrowLeft: () => picture.moveBy({x: -step(), y: 0}),
    ArrowRight: () => picture.moveBy({x: step(), y: 0}),
    ArrowUp: () => picture.moveBy({x: 0, y: -step()}),
    ArrowDown: () => picture.moveBy({x: 0, y: step()}),
    '+': () => picture.zoomBy(1.5),
    '=': () => picture.zoomBy(1.5),
    '-': () => picture.zoomBy(1 / 1.5),
    0: () => picture.fit(),
    1: () => picture.zoomBy(1 / picture.zoom),
  };
  canvas.addEventListener('keydown', event => {
    const action = keys[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
    onPoint(picture.toFilm({x: canvas.width / 2, y: canvas.height / 2}));
  });
}
