// The viewer: what is to be seen, the show's clock, and the hands of whoever steers it.

import { cameraFor, lookOf, narrowest } from './angles.js';
import { Controls } from './controls.js';
import { clock, Instruments, tell, tellNothing } from './instruments.js';
import { Pictures } from './pictures.js';
import { degreesPerPixel, fitted, projections } from './projections.js';
import { Projector } from './projector.js';
import { Sound } from './sound.js';
import { steer } from './steering.js';
import { Timeline } from './timeline.js';

const $ = (id) => document.getElementById(id);
const canvas = $('view');

let show = null;
// own: the view is the show's camera, whose look the last picture told.
const view = { az: 0, alt: 45, roll: 0, fov: 100, projection: 'stereographic', own: true };
const play = { time: 0, on: false, speed: 1, loop: false, last: 0 };
const tests = window.domefall = { drawn: 0, frame: -1, mistake: null, ready: false, view, play,
  get fine() { return pictures.settled(); },
  get sound() { const { currentTime, duration, paused } = sound.element; return { currentTime, duration, paused }; } };

const projector = new Projector(canvas, () => { pictures.renew(); spheres.renew(); });
const instruments = new Instruments();
const controls = new Controls(() => change());
const sound = new Sound($('sound'));
const timeline = new Timeline($('timeline'), (seconds) => seek(seconds));

// ---- what is to be seen ----

const frameNow = () => Math.max(0, Math.min(show.frames - 1, Math.round(play.time * show.frames_per_second)));
const widest = () => projections[view.projection].widest;
// The parameters that both kinds of picture share.
function common() {
  const query = new URLSearchParams({ frame: frameNow() });
  controls.add(query);
  query.set('revision', show.revision);
  return query;
}

function wantedView() {
  if (!show || document.hidden) return null;
  const query = common();
  query.set('projection', view.projection);
  if (widest()) query.set('fov', view.fov);
  if (!view.own) query.set('look', [view.az, view.alt, view.roll].map((x) => x.toFixed(11)).join(','));
  if (controls.overlays()) query.set('overlays', controls.overlays());
  return { query: query.toString(), width: canvas.width, height: canvas.height,
    fit: (w, h) => fitted(view.projection, w, h), plays: play.on };
}

// The sphere behind the view is wanted while nothing plays, and once the view has its fine picture:
// a picture that is refined gives way to any other, so that two would stop each other for ever.
function wantedSphere() {
  if (!show || play.on || document.hidden || !pictures.settled()) return null;
  const query = common();
  query.set('projection', 'equirectangular');
  return { query: query.toString(), width: 1024, height: 512, fit: (w, h) => fitted('equirectangular', w, h) };
}

function refused(text) {
  if (!text && tests.refusal) { tests.refusal = ''; showMistake(tests.mistake); }
  if (text) { tests.refusal = text; showMistake(text); }
}

const pictures = new Pictures('view', wantedView, (bitmap, about) => {
  projector.take('shown', bitmap, about);
  if (view.own && about.projection === view.projection) Object.assign(view, lookOf(about.camera, about.projection));
  Object.assign(tests, { drawn: tests.drawn + 1, frame: about.frame, revision: about.revision,
    size: [about.width, about.height], ready: true });
  draw();
}, refused);

const spheres = new Pictures('sphere', wantedSphere, (bitmap, about) => {
  projector.take('whole', bitmap, about);
  redraw();
}, () => {});

let asked = false;
function redraw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(draw);
}

// What was told of a place is no longer there.
function change() {
  tellNothing();
  redraw();
}

function draw() {
  asked = false;
  const ratio = devicePixelRatio, width = Math.round(canvas.clientWidth * ratio),
    height = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const [w, h] = fitted(view.projection, width, height);
  projector.draw(view.projection, w, h, view.fov, cameraFor(view, view.projection));
  if (show) drawAround();
}

// What stands around the picture; while the show plays, ten times a second is enough.
let around = 0;
function drawAround() {
  const now = performance.now();
  if (play.on && now - around < 100) return;
  around = now;
  timeline.draw(play.time);
  const opening = widest() ? ` · ${+view.fov.toPrecision(3)}°` : '';
  instruments.draw(frameNow(), (view.own ? "show's camera" : `${view.az.toFixed(1)}°, ${view.alt.toFixed(1)}°`) + opening);
  $('time').textContent = `${clock(play.time)} / ${clock(show.duration_s)}`;
}

// ---- the clock ----

// Frames are dropped where pictures take too long; the show's time is never slowed.  Each picture that
// comes is drawn, and nothing between.
function tick(now) {
  if (!play.on) return;
  play.time += (now - play.last) / 1000 * play.speed;
  play.last = now;
  sound.follow(play);
  const end = (show.frames - 1) / show.frames_per_second;
  if (play.time > end) {
    if (play.loop) play.time = end > 0 ? play.time % end : 0;
    else { play.time = end; setPlaying(false); }
  }
  requestAnimationFrame(tick);
}

function setPlaying(on) {
  if (!show) return;
  if (on && frameNow() === show.frames - 1) play.time = 0;
  const begins = on && !play.on;
  play.on = on;
  play.last = performance.now();
  sound.follow(play);
  $('play').textContent = on ? '❚❚' : '▶';
  $('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
  tellNothing();
  if (begins) requestAnimationFrame(tick);
  redraw();
}

function seek(seconds) {
  play.time = Math.max(0, Math.min((show.frames - 1) / show.frames_per_second, seconds));
  change();
}

function step(frames) {
  setPlaying(false);
  seek((frameNow() + frames) / show.frames_per_second);
}

function setLoop(on) {
  play.loop = on;
  $('loop').setAttribute('aria-pressed', on);
}

// ---- the view ----

function zoom(factor) {
  if (!widest()) return;
  view.fov = Math.max(narrowest, Math.min(widest(), view.fov * factor));
  change();
}

function turn(dx, dy, rolls) {
  const [w, h] = fitted(view.projection, canvas.width, canvas.height);
  const degrees = degreesPerPixel(view.projection, w, h, view.fov) * devicePixelRatio;
  view.own = false;
  if (rolls) view.roll += dx * 0.3;
  else {
    const roll = view.roll * Math.PI / 180, right = dx * Math.cos(roll) - dy * Math.sin(roll),
      down = dx * Math.sin(roll) + dy * Math.cos(roll);
    view.alt = Math.max(-90, Math.min(90, view.alt + down * degrees));
    view.az -= right * degrees / Math.max(0.2, Math.cos(view.alt * Math.PI / 180));
    view.az = ((view.az + 540) % 360) - 180;
  }
  change();
}

function goHome() {
  Object.assign(view, { own: true, fov: 100 });
  change();
}

// Requests are about pictures of 4096 pixels at most, whatever the screen has.
function withinLimits() {
  const part = Math.min(1, 4096 / Math.max(canvas.width, canvas.height));
  const [width, height] = [canvas.width, canvas.height].map((side) => Math.round(side * part));
  const [w, h] = fitted(view.projection, width, height);
  return { w, h, left: (width - w) / 2, top: (height - h) / 2, ratio: devicePixelRatio * part };
}

async function probe(x, y) {
  setPlaying(false);
  const wanted = wantedView(), { w, h, left, top, ratio } = withinLimits();
  const query = `${wanted.query}&w=${w}&h=${h}&x=${x * ratio - left + 0.5}&y=${y * ratio - top + 0.5}`;
  const answer = await fetch(`probe?${query}`);
  if (!answer.ok) return;
  const found = await answer.json();
  tests.found = found;
  if (!found.inside) return tellNothing();
  tell(found, x, y, (i, j) => [(i - 0.5 + left) / ratio, (j - 0.5 + top) / ratio]);
}

async function copy(key) {
  const wanted = wantedView(), { w, h } = withinLimits();
  const answer = await fetch(`camera?${wanted.query}&w=${w}&h=${h}${key ? '&key=1' : ''}`);
  if (!answer.ok) return;
  const text = (await answer.text()).trim();
  Object.assign($('copied'), { hidden: false, value: text });
  $('copied').scrollIntoView({ block: 'nearest' });
  tests.copied = text;
  // Where the browser keeps the clipboard to itself, the text stands there to be taken.
  await navigator.clipboard?.writeText(text).catch(() => $('copied').select());
}

function save() {
  canvas.toBlob((blob) => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = `${show.file.replace(/\.[^.]*$/, '')}_${String(frameNow()).padStart(5, '0')}.png`;
    link.click();
    tests.saved = blob.size;
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }, 'image/png');
}

const toggle = (id) => { $(id).hidden = !$(id).hidden; };

steer(canvas, {
  turn, zoom, probe, step, save, goHome,
  togglePlay: () => setPlaying(!play.on),
  toggleLoop: () => setLoop(!play.loop),
  seekEnds: (end) => { setPlaying(false); seek(end ? Infinity : 0); },
  stepSecond: (sign) => step(sign * Math.round(show.frames_per_second)),
  faster: (by) => {
    $('speed').selectedIndex = Math.max(0, Math.min($('speed').options.length - 1, $('speed').selectedIndex + by));
    play.speed = +$('speed').value;
  },
  copy,
  togglePanel: () => { document.body.classList.toggle('bare'); redraw(); },
  toggleHelp: () => toggle('help'),
  togglePlots: () => instruments.resizePlots(),
  escape: () => { $('help').hidden = true; instruments.resizePlots(false); tellNothing(); },
  ready: () => show !== null,
});

// ---- the panel ----

$('projection').replaceChildren(...Object.keys(projections).map((name) =>
  new Option(name, name, false, name === view.projection)));
$('projection').addEventListener('change', () => {
  view.projection = $('projection').value;
  view.fov = projections[view.projection].usual ?? Math.min(view.fov, widest() ?? view.fov);
  change();
});
for (const [id, act] of Object.entries({
  play: () => setPlaying(!play.on), first: () => { setPlaying(false); seek(0); }, back: () => step(-1), ahead: () => step(1),
  loop: () => setLoop(!play.loop), home: goHome, save, 'copy-camera': () => copy(false), 'copy-key': () => copy(true),
  'show-help': () => toggle('help'), 'toggle-panel': () => { document.body.classList.toggle('bare'); redraw(); } }))
  $(id).addEventListener('click', act);
$('speed').addEventListener('change', () => { play.speed = +$('speed').value; });
$('plots').addEventListener('click', () => instruments.resizePlots());
new ResizeObserver(redraw).observe($('stage'));
document.addEventListener('visibilitychange', () => { play.last = performance.now(); });

// ---- the show, as its author writes it ----

function showMistake(text) {
  $('mistake').textContent = text || '';
  $('mistake').hidden = !text;
}

async function load() {
  show = await (await fetch('show')).json();
  tests.mistake = show.mistake;
  showMistake(show.mistake);
  instruments.take(show);
  timeline.take(show);
  controls.take(show);
  sound.take(show.sound);
  play.time = Math.min(play.time, show.duration_s);
  redraw();
  note(show.revision);
}

// The notes of check take a while, and are for this version only.
async function note(revision) {
  while (show.revision === revision) {
    const { done, warnings } = await fetch('warnings').then((answer) => answer.json())
      .catch(() => ({ done: false, warnings: [] }));
    if (show.revision !== revision) return;
    timeline.warnings = warnings;
    instruments.list(warnings, done, (seconds) => { setPlaying(false); seek(seconds); });
    tests.noted = done;
    redraw();
    if (done) return;
    await new Promise((resolve) => setTimeout(resolve, 2000));
  }
}

async function follow() {
  const pause = () => new Promise((resolve) => setTimeout(resolve, 1000));
  for (;;) {
    try {
      if (!show) await load();
      const began = performance.now();
      const { revision, readings, mistake } = await (await fetch(`changes?since=${show.readings}`)).json();
      if (revision !== show.revision) await load();
      else if (readings !== show.readings) {
        Object.assign(show, { readings, mistake });
        tests.mistake = mistake;
        showMistake(mistake);
      } else if (performance.now() - began < 1000) await pause();  // too many pages wait for news
    } catch {
      if (!show) showMistake('the preview does not answer');
      await pause();
    }
  }
}

redraw();
follow();
