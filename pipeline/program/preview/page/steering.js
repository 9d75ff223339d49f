// Mouse, touch and keys. Every act is a function of the viewer's.

const clickLimit = 5;  // pixels that a pointer may move and still click

export function steer(canvas, act) {
  const pointers = new Map();
  let moved = 0, distance = 0;

  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };

  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (pointers.size === 1) moved = 0;
    if (pointers.size === 2) distance = spread();
  });
  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (!before || !act.ready()) return;
    const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    moved += Math.hypot(dx, dy);
    if (pointers.size === 2) {
      const now = spread();
      if (now > 0 && distance > 0) act.zoom(distance / now);
      distance = now;
      return;
    }
    if (moved > clickLimit) act.turn(dx, dy, event.shiftKey);
  });
  const release = (event) => {
    const single = pointers.size === 1;
    if (!pointers.delete(event.pointerId) || event.type === 'pointercancel') return;
    if (single && moved <= clickLimit && act.ready()) act.probe(event.offsetX, event.offsetY);
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    if (act.ready()) act.zoom(Math.exp(event.deltaY * (event.deltaMode ? 0.05 : 0.0015)));
  }, { passive: false });

  const keys = {
    ' ': act.togglePlay, l: act.toggleLoop, Home: () => act.seekEnds(false), End: () => act.seekEnds(true),
    ArrowLeft: (event) => (event.shiftKey ? act.stepSecond(-1) : act.step(-1)),
    ArrowRight: (event) => (event.shiftKey ? act.stepSecond(1) : act.step(1)),
    '[': () => act.faster(-1), ']': () => act.faster(1), '+': () => act.zoom(0.8), '=': () => act.zoom(0.8),
    '-': () => act.zoom(1.25), 0: act.goHome, c: () => act.copy(false), k: () => act.copy(true), s: act.save,
    p: act.togglePanel, d: act.togglePlots, '?': act.toggleHelp, Escape: act.escape,
  };
  window.addEventListener('keydown', (event) => {
    // A field keeps its own keys, and a button its space; the browser keeps its shortcuts.
    const own = event.target.closest('select, input[type=range], textarea') ||
      (event.key === ' ' && event.target.closest('button, summary, input'));
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (own || event.ctrlKey || event.metaKey || event.altKey || !keys[key] || !act.ready()) return;
    event.preventDefault();
    keys[key](event);
  });
}
