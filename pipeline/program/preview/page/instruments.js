// What the observer's instruments say at a frame, the plots with the present marked, and the notes.

const $ = (id) => document.getElementById(id);

function digits(value, count = 5) {
  if (value === null || value === undefined) return '–';
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toExponential(3) : String(+value.toPrecision(count));
}

// "1:02.5"
export function clock(seconds) {
  const tenths = Math.round(seconds * 100) / 100;
  return `${Math.floor(tenths / 60)}:${(tenths % 60).toFixed(2).padStart(5, '0')}`;
}

export class Instruments {
  take(show) {
    this.show = show;
    $('title').textContent = show.title || show.file;
    document.title = `${show.title || show.file} – Domefall`;
    this.loadPlots(show);
    $('now').setAttribute('viewBox', `0 0 ${show.plots.width} ${show.plots.height}`);
  }

  async loadPlots({ revision, plots }) {
    const page = new Image();
    page.src = `plot.svg?${revision}`;
    await page.decode().catch(() => {});
    if (this.show.revision !== revision || !page.naturalWidth) return;
    this.page = page;
    $('plots').style.setProperty('--wide', plots.width / plots.height);
    this.drawPlots();
  }

  // The page of the plots is white; here it is dark, in the same hues. It is drawn once for each size,
  // since a browser without a graphics card takes long for an SVG.
  drawPlots() {
    const plot = $('plot'), { width, height } = this.show.plots, across = plot.clientWidth * devicePixelRatio;
    if (!this.page || !across) return;
    Object.assign(plot, { width: across, height: across * height / width });
    const pen = plot.getContext('2d');
    pen.filter = 'invert(0.9) hue-rotate(180deg)';
    pen.drawImage(this.page, 0, 0, plot.width, plot.height);
  }

  resizePlots(large = !$('plots').classList.contains('large')) {
    $('plots').classList.toggle('large', large);
    this.drawPlots();
  }

  // A number of the states at a frame, straight between the samples.
  at(name, frame) {
    const { frame: frames, [name]: values } = this.show.states;
    let low = 0, high = frames.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (frames[middle] <= frame) low = middle; else high = middle;
    }
    const [a, b] = [values[low], values[high]];
    if (typeof a !== 'number' || typeof b !== 'number' || low === high) return a;
    return a + (b - a) * Math.max(0, Math.min(1, (frame - frames[low]) / (frames[high] - frames[low])));
  }

  draw(frame, view) {
    const show = this.show, seconds = show.mass_solar ? 4.925490947e-6 * show.mass_solar : 1;
    const r = this.at('r', frame), tau = this.at('proper_time', frame), region = this.at('region', frame);
    $('i-frame').textContent = `${frame} of ${show.frames}`;
    $('i-r').textContent = r === null ? 'flat space' : `${digits(r)} M · ${region}`;
    $('i-clock').textContent = show.mass_solar ? `${digits(tau)} M · ${digits(tau * seconds, 4)} s` : `${digits(tau)} s`;
    // Inside a horizon nothing is at rest, and the speed is that against a free fall.
    const inside = region === 'II' || region === 'IV';
    $('i-speed').textContent = `${digits(this.at('speed', frame))} c${inside ? ' against free fall' : ''}`;
    $('i-shift').textContent = digits(this.at('shift_ahead', frame));
    $('i-view').textContent = view;
    this.mark(frame / show.frames_per_second);
  }

  mark(time) {
    const { marks, step_s: step } = this.show.plots, at = Math.min(marks.length - 1, Math.max(0, time / step));
    const low = marks[Math.floor(at)], high = marks[Math.min(marks.length - 1, Math.floor(at) + 1)], part = at % 1;
    const svg = $('now');
    while (svg.children.length < low.length / 2)
      svg.append(document.createElementNS('http://www.w3.org/2000/svg', 'circle'));
    while (svg.children.length > low.length / 2) svg.lastChild.remove();
    [...svg.children].forEach((circle, k) => {
      const [x, y] = [0, 1].map((c) => low[2 * k + c] + part * (high[2 * k + c] - low[2 * k + c]));
      circle.setAttribute('cx', x);
      circle.setAttribute('cy', y);
      circle.setAttribute('r', 13);
    });
  }

  // The notes of check as a list; seek(seconds) goes to one.
  list(warnings, done, seek) {
    const items = warnings.map((warning) => {
      const item = document.createElement('li'), button = document.createElement('button');
      if (warning.time_s !== null) {
        const at = document.createElement('span');
        at.className = 'at';
        at.textContent = clock(warning.time_s);
        button.append(at);
        button.addEventListener('click', () => seek(warning.time_s));
      }
      button.append(warning.text);
      item.append(button);
      return item;
    });
    if (!done) items.push('looking …');
    $('warnings').replaceChildren(...items);
  }
}

// The card of what is seen at a place, and rings around a star's images.
export function tell(found, x, y, scale) {
  const rows = [];
  const row = (name, value) => { if (value !== undefined && value !== null) rows.push([name, value]); };
  for (const text of found.titles ?? []) row('title', text);
  for (const body of found.bodies ?? []) row('body', body);
  for (const disc of found.disc ?? []) {
    row('disc', `${digits(disc.r)} M, ${digits(disc.azimuth_deg, 3)}°, image ${disc.order}`);
    row('', `1 + z ${digits(disc.redshift)}, ${digits(disc.temperature_k, 3)} K`);
  }
  if (found.disc) row('behind it', `${digits(100 * found.left, 3)} %`);
  row('sky', found.sky === 'IV' ? 'the past singularity' : found.sky);
  if (typeof found.ra_deg === 'number') {
    row('RA', `${found.ra_deg.toFixed(3)}°`);
    row('Dec', `${found.dec_deg.toFixed(3)}°`);
  }
  if (typeof found.redshift === 'number') row('1 + z', digits(found.redshift));
  if (typeof found.amplification === 'number') row('amplified', `${digits(found.amplification, 3)}×`);
  if (typeof found.order === 'number') row('image of order', found.order);
  if (found.star) row('magnitude', digits(found.star.magnitude, 3));
  const card = $('found'), heading = document.createElement('b'), table = document.createElement('table');
  heading.textContent = found.star ? found.star.name : 'light from here';
  for (const cells of rows) {
    const line = table.insertRow();
    for (const cell of cells) line.insertCell().textContent = cell;
  }
  card.replaceChildren(heading, table);
  card.hidden = false;
  const stage = card.parentElement;
  card.style.left = `${Math.min(x + 14, stage.clientWidth - card.offsetWidth - 8)}px`;
  card.style.top = `${Math.min(y + 14, stage.clientHeight - card.offsetHeight - 8)}px`;
  $('marks').replaceChildren(...(found.star ? found.star.images : []).map(([i, j]) => {
    const circle = document.createElementNS('http://www.w3.org/2000/svg', 'circle');
    for (const [name, value] of [['cx', scale(i, j)[0]], ['cy', scale(i, j)[1]], ['r', 10]])
      circle.setAttribute(name, value);
    return circle;
  }));
}

export function tellNothing() {
  $('found').hidden = true;
  $('marks').replaceChildren();
}
